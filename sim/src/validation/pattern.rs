//! The projector's pattern against counts on Reichinger's map of the real one.

use super::statistics::{mean, spread};
use super::{Effort, Finding, Findings};
use crate::kinect::pattern::{TILE_HEIGHT, TILE_WIDTH, Tile};

fn dots_around(tile: &Tile, column: usize, row: usize, edge: usize) -> usize {
    let near = |at: usize, offset: usize, size: usize| (at + size + offset - edge / 2) % size;
    let places = (0..edge * edge).map(|place| (place % edge, place / edge));
    places.filter(|&(x, y)| tile.is_bright(near(column, x, TILE_WIDTH), near(row, y, TILE_HEIGHT))).count()
}

/// V9.
pub(super) fn counts(_: Effort) -> Findings {
    let tile = Tile::kinect();
    let positions = || (0..TILE_WIDTH * TILE_HEIGHT).map(|position| (position % TILE_WIDTH, position / TILE_WIDTH));
    let dots: Vec<_> = positions().filter(|&(column, row)| tile.is_bright(column, row)).collect();
    let touching = dots.iter().filter(|&&(column, row)| dots_around(tile, column, row, 3) > 1).count();
    let around: Vec<f64> = positions().map(|(column, row)| dots_around(tile, column, row, 9) as f64).collect();
    let empty = positions().filter(|&(column, row)| dots_around(tile, column, row, 5) == 0).count();
    let exactly =
        |what: &str, target: f64, measured: usize| Finding::new(what, target, target..=target, measured as f64);
    Ok(vec![
        exactly("grid positions of a tile", 34_815.0, TILE_WIDTH * TILE_HEIGHT),
        exactly("dots of a tile", 3861.0, dots.len()),
        exactly("dots with an 8-neighbour", 0.0, touching),
        exactly("empty windows of 5×5", 0.0, empty),
        Finding::new("dots in 9×9, mean", 8.97, 8.92..=9.02, mean(&around)),
        Finding::new("dots in 9×9, spread", 1.2, 1.1..=1.3, spread(&around)),
    ])
}
