//! The projector's dot pattern: an own draw with the published statistics of the Kinect's, not a copy of it.
//!
//! Statistics counted on the Reichinger map (*Kinect Pattern Uncovered*, 2011; bitmap in ankurhanda/simkinect): 3×3
//! identical tiles of 211×165 grid positions, 3,861 bright dots a tile (one position in nine), no two of them
//! 8-neighbours, each tile symmetric about its middle, 9.0 ± 1.2 dots in a 9×9 window and at least one in every 5×5.

use std::sync::OnceLock;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Grid positions across a tile.
pub const TILE_WIDTH: usize = 211;
/// Grid positions down a tile.
pub const TILE_HEIGHT: usize = 165;
/// Tiles across and down the pattern.
pub const TILES: usize = 3;
/// Bright dots in a tile.
pub const TILE_DOTS: usize = 3861;

/// The matcher's window, whose share of dots must be even: positions.
const WINDOW: usize = 9;
/// Published spread of the number of dots in such a window.
const WINDOW_SPREAD: f64 = 1.20;
/// The smaller window that is nowhere empty.
const SMALL_WINDOW: usize = 5;
/// What an empty small window counts against a draw, in dots² of unevenness. A guess; it only has to be much.
const EMPTY_PENALTY: i32 = 200;
/// How far one step of the evening-out moves a dot, positions. A guess; small steps converge.
const REACH: usize = 3;
/// Any draw will do, but every device has this one: the pattern is etched in glass.
const SEED: u64 = 0x830;

/// One tile of the pattern; it adjoins itself on all sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    bright: Vec<bool>,
}

impl Tile {
    /// The tile every simulated Kinect has.
    pub fn kinect() -> &'static Self {
        static TILE: OnceLock<Tile> = OnceLock::new();
        TILE.get_or_init(|| Self::draw(SEED))
    }

    /// Whether there is a bright dot at a grid position.
    pub fn is_bright(&self, column: usize, row: usize) -> bool {
        self.bright[row * TILE_WIDTH + column]
    }

    /// Throws dots at random where none is near, then nudges them until every window holds about as many.
    fn draw(seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut draft = Draft::with_middle_dot();
        while draft.dots.len() < TILE_DOTS / 2 {
            let position = random.random_range(0..TILE_WIDTH * TILE_HEIGHT);
            if draft.is_free(position) {
                draft.put(position);
                draft.dots.push(position);
            }
        }
        while draft.spread() > WINDOW_SPREAD {
            let all: Vec<usize> = (0..draft.dots.len()).collect();
            draft.nudge_some(&all, TILE_DOTS / 8, &mut random);
        }
        while draft.small_counts.contains(&0) {
            let near = draft.dots_near_an_empty_small_window();
            draft.nudge_some(&near, near.len(), &mut random);
        }
        Self { bright: draft.bright }
    }
}

/// The position opposite, seen from the tile's middle.
fn opposite(position: usize) -> usize {
    TILE_WIDTH * TILE_HEIGHT - 1 - position
}

/// The positions of the window around a position, round the tile's edges.
fn window(position: usize, edge: usize) -> impl Iterator<Item = usize> {
    let (column, row) = (position % TILE_WIDTH, position / TILE_WIDTH);
    let (left, top) = (column + TILE_WIDTH - edge / 2, row + TILE_HEIGHT - edge / 2);
    (0..edge).flat_map(move |y| (0..edge).map(move |x| (top + y) % TILE_HEIGHT * TILE_WIDTH + (left + x) % TILE_WIDTH))
}

/// A tile in the making. Every dot has its opposite, so half of them are kept in a list.
struct Draft {
    bright: Vec<bool>,
    /// Dots in the window around each position.
    counts: Vec<i32>,
    /// Dots in the small window around each position.
    small_counts: Vec<i32>,
    /// One of each pair.
    dots: Vec<usize>,
}

impl Draft {
    fn with_middle_dot() -> Self {
        let positions = TILE_WIDTH * TILE_HEIGHT;
        let none = vec![0; positions];
        let mut draft =
            Self { bright: vec![false; positions], counts: none.clone(), small_counts: none, dots: Vec::new() };
        draft.set(positions / 2, true);
        draft
    }

    fn set(&mut self, position: usize, bright: bool) {
        self.bright[position] = bright;
        let change = if bright { 1 } else { -1 };
        for around in window(position, WINDOW) {
            self.counts[around] += change;
        }
        for around in window(position, SMALL_WINDOW) {
            self.small_counts[around] += change;
        }
    }

    /// Puts a dot and its opposite.
    fn put(&mut self, position: usize) {
        self.set(position, true);
        self.set(opposite(position), true);
    }

    fn take(&mut self, position: usize) {
        self.set(position, false);
        self.set(opposite(position), false);
    }

    /// Whether a pair of dots fits here: no neighbours, not even each other.
    fn is_free(&self, position: usize) -> bool {
        !window(position, 3).any(|near| self.bright[near] || near == opposite(position))
    }

    /// How uneven the windows around a position are. By symmetry the opposite's are equally so.
    fn unevenness(&self, position: usize) -> i32 {
        let large: i32 = window(position, WINDOW).map(|around| (self.counts[around] - WINDOW as i32).pow(2)).sum();
        let empty = window(position, SMALL_WINDOW).filter(|&around| self.small_counts[around] == 0).count();
        large + EMPTY_PENALTY * empty as i32
    }

    fn nudge_some(&mut self, candidates: &[usize], times: usize, random: &mut ChaCha8Rng) {
        let reach = 2 * REACH + 1;
        for _ in 0..times {
            let dot = candidates[random.random_range(0..candidates.len())];
            self.nudge(dot, (random.random_range(0..reach), random.random_range(0..reach)));
        }
    }

    /// Moves a dot by `step` less [`REACH`] where that makes the pattern more even.
    fn nudge(&mut self, dot: usize, step: (usize, usize)) {
        let from = self.dots[dot];
        let column = (from % TILE_WIDTH + TILE_WIDTH + step.0 - REACH) % TILE_WIDTH;
        let row = (from / TILE_WIDTH + TILE_HEIGHT + step.1 - REACH) % TILE_HEIGHT;
        let to = row * TILE_WIDTH + column;
        let before = self.unevenness(from) + self.unevenness(to);
        self.take(from);
        let free = self.is_free(to);
        let landing = if free { to } else { from };
        self.put(landing);
        if free && self.unevenness(from) + self.unevenness(to) >= before {
            self.take(to);
            self.put(from);
        } else {
            self.dots[dot] = landing;
        }
    }

    fn spread(&self) -> f64 {
        let unevenness: i32 = self.counts.iter().map(|count| (count - WINDOW as i32).pow(2)).sum();
        (f64::from(unevenness) / self.counts.len() as f64).sqrt()
    }

    fn dots_near_an_empty_small_window(&self) -> Vec<usize> {
        let near = |dot: &usize| window(self.dots[*dot], WINDOW).any(|around| self.small_counts[around] == 0);
        (0..self.dots.len()).filter(near).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(edge: usize) -> Vec<f64> {
        let tile = Tile::kinect();
        (0..TILE_WIDTH * TILE_HEIGHT)
            .map(|middle| window(middle, edge).filter(|&around| tile.bright[around]).count() as f64)
            .collect()
    }

    fn mean_and_spread(values: &[f64]) -> (f64, f64) {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (mean, (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt())
    }

    #[test]
    fn a_tile_has_3861_dots_and_no_two_are_neighbours() {
        let tile = Tile::kinect();
        assert_eq!(tile.bright.iter().filter(|&&bright| bright).count(), TILE_DOTS);
        for position in (0..tile.bright.len()).filter(|&position| tile.bright[position]) {
            assert_eq!(window(position, 3).filter(|&near| tile.bright[near]).count(), 1, "at {position}");
        }
    }

    #[test]
    fn a_tile_is_symmetric_about_its_middle() {
        let tile = Tile::kinect();
        assert!((0..tile.bright.len()).all(|position| tile.bright[position] == tile.bright[opposite(position)]));
    }

    #[test]
    fn a_matching_window_holds_nine_dots_give_or_take_1_2() {
        let (mean, spread) = mean_and_spread(&counts(9));
        assert!((mean - 9.0).abs() < 0.05, "{mean}");
        assert!((spread - 1.2).abs() < 0.05, "{spread}");
    }

    #[test]
    fn smaller_windows_come_near_the_published_counts() {
        let (mean, spread) = mean_and_spread(&counts(7));
        assert!((mean - 5.43).abs() < 0.05 && (spread - 1.09).abs() < 0.15, "7×7: {mean} ± {spread}");
        let small = counts(5);
        assert!(small.iter().all(|&count| (1.0..=8.0).contains(&count)), "5×5: 1 to 7 in the original");
    }

    #[test]
    fn the_pattern_resembles_itself_nowhere_else() {
        // Published: at most 0.040 off the peak, over all shifts; here those a matcher could confuse, along the row.
        let tile = Tile::kinect();
        let fill = 1.0 / 9.0;
        for shift in 2..=96 {
            let both = (0..tile.bright.len())
                .filter(|&position| {
                    let column = (position % TILE_WIDTH + shift) % TILE_WIDTH;
                    tile.bright[position] && tile.is_bright(column, position / TILE_WIDTH)
                })
                .count();
            let correlation = (both as f64 / tile.bright.len() as f64 - fill * fill) / (fill * (1.0 - fill));
            assert!(correlation.abs() < 0.06, "shift {shift}: {correlation}");
        }
    }
}
