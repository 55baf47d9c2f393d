//! Sub-pixel disparity: the correlation of the window with the reference at the found candidate and beside it.

use super::RADIUS;
use super::residual::{Residual, RowPairs};
use super::search::NO_MATCH;

/// Columns of the correlated window, a whole vector of 16-bit numbers; rows are 2·[`RADIUS`] + 1.
const COLUMNS: usize = 8;
/// Normalised correlation below which a match is none. Chosen so that shadows are as wide as geometry says: a window
/// half in the shadow matches less.
const WEAKEST_CORRELATION: f32 = 0.57;
/// How far a shifted dot's correlation falls below that of unrelated windows, relative to the peak: dots have no
/// neighbours. Chosen for least bias (measured: 0.02 of a step at most).
const TROUGH: f32 = 0.4;
/// Written where there is none: as if nothing were ever so far away.
pub(super) const NO_SHIFT: f32 = f32::NEG_INFINITY;
/// Runs of equal candidates up to this length are correlated pixel by pixel: in noise most are. Measured.
const SHORT: usize = 3;
/// How often the found candidate may turn out to be beside the best one.
const CLIMB: usize = 2;

/// The reference image and how strong each of its windows is.
pub(super) struct Reference {
    residual: Residual,
    pairs: RowPairs,
    /// Columns left of the live image's first.
    margin: usize,
    /// Of the first candidate, pixels.
    first_shift: isize,
    /// 1/√(sum of squares) of the window at each pixel.
    inverse_norm: Vec<f32>,
}

/// Roots of the sums of squares over every window; 0 nearer to the border than a window reaches.
fn norms(image: &Residual) -> Vec<f32> {
    let width = image.width;
    let mut norms = vec![0.0; width * image.height];
    let mut columns = vec![0_u32; width];
    let square = |value: i16| (i32::from(value) * i32::from(value)) as u32;
    for bottom in 0..image.height {
        for (sum, &value) in columns.iter_mut().zip(image.row(bottom)) {
            *sum += square(value);
        }
        let Some(top) = bottom.checked_sub(2 * RADIUS) else {
            continue;
        };
        let out = &mut norms[(top + RADIUS) * width + COLUMNS / 2..][..width - COLUMNS];
        for (x, norm) in out.iter_mut().enumerate() {
            *norm = (columns[x..x + COLUMNS].iter().sum::<u32>() as f32).sqrt();
        }
        for (sum, &value) in columns.iter_mut().zip(image.row(top)) {
            *sum -= square(value);
        }
    }
    norms
}

/// An image to find depth in.
pub(super) struct Live {
    residual: Residual,
    pairs: RowPairs,
    norms: Vec<f32>,
}

impl Live {
    pub fn of(residual: Residual) -> Self {
        Self { norms: norms(&residual), pairs: RowPairs::of(&residual), residual }
    }
}

impl Reference {
    pub fn of(residual: Residual, margin: usize, first_shift: isize) -> Self {
        let inverse_norm = norms(&residual).into_iter().map(|norm| norm.max(1.0).recip()).collect();
        Self { pairs: RowPairs::of(&residual), residual, margin, first_shift, inverse_norm }
    }

    /// The depth engine's last step for row `y` of an image: from the candidates found for its pixels, none near its
    /// ends, to shifts from the reference, pixels, positive when nearer; [`NO_SHIFT`] where the window resembles the
    /// reference too little.
    #[inline(always)]
    pub fn refine_row(&self, live: &Live, y: usize, candidates: &[u8], row: &mut Row, shifts: &mut [f32]) {
        let mut x = 0;
        for run in candidates.chunk_by(|a, b| a == b) {
            let whole = if run[0] == NO_MATCH { NO_SHIFT } else { f32::from(run[0]) + self.first_shift as f32 };
            shifts[x..x + run.len()].fill(whole);
            if run[0] != NO_MATCH {
                self.correlate(live, [x, y], self.first_shift + isize::from(run[0]), run.len(), row);
            }
            x += run.len();
        }
        for (x, shift) in shifts.iter_mut().enumerate() {
            if *shift != NO_SHIFT {
                self.climb(live, [x, y], row, shift);
            }
        }
        let width = shifts.len();
        let norms = &live.norms[y * live.residual.width..][..width];
        let [befores, bests, afters] = row.around.each_ref().map(|correlations| &correlations[..width]);
        // Without a branch, so that it is done for a vector of pixels at a time.
        for x in 0..width {
            let (before, best, after) = (befores[x], bests[x], afters[x]);
            let found = (shifts[x] != NO_SHIFT) & (best >= before) & (best >= after);
            let refined = shifts[x] + peak(before, best, after);
            shifts[x] = if found & (best > WEAKEST_CORRELATION * norms[x]) { refined } else { NO_SHIFT };
        }
    }

    /// Correlates the windows of `length` pixels in a row, from (x, y) on, with the reference shifted by `shift`, by one
    /// less and by one more.
    #[inline(always)]
    fn correlate(&self, live: &Live, [x, y]: [usize; 2], shift: isize, length: usize, row: &mut Row) {
        if length <= SHORT {
            for (around, shift) in row.around.iter_mut().zip(shift - 1..) {
                for (x, correlation) in (x..).zip(&mut around[x..x + length]) {
                    *correlation = self.correlation(live, [x, y], shift);
                }
            }
            return;
        }
        let norms = &self.inverse_norm[y * self.residual.width..];
        // Neighbouring windows share columns. Whole vectors of them.
        let columns = &mut row.columns[..(length + COLUMNS - 1).next_multiple_of(COLUMNS) + COLUMNS];
        for (place, around) in row.around.iter_mut().enumerate() {
            let reference = (x + 1 + self.margin).wrapping_add_signed(-shift) - place;
            let (vectors, _) = columns.as_chunks_mut();
            let needed = vectors.len() - 1;
            for (vector, columns) in vectors[..needed].iter_mut().enumerate() {
                let at = vector * COLUMNS;
                *columns = self.column_products(live, x + at, reference + at, y);
            }
            // What the last vector has beyond the run is of no run, and the next one overwrites it.
            let mut at = 0;
            while at < length {
                let norms: &[f32; COLUMNS] = norms[reference + at..].first_chunk().expect("a margin");
                let around: &mut [f32; COLUMNS] = around[x + at..].first_chunk_mut().expect("a margin");
                let products = sums_of_eight(&columns[at..]);
                for lane in 0..COLUMNS {
                    around[lane] = products[lane] as f32 * norms[lane];
                }
                at += COLUMNS;
            }
        }
    }

    /// Goes from a shift to the best one nearby.
    #[inline(always)]
    fn climb(&self, live: &Live, at: [usize; 2], row: &mut Row, shift: &mut f32) {
        let [befores, bests, afters] = &mut row.around;
        let (before, best, after) = (&mut befores[at[0]], &mut bests[at[0]], &mut afters[at[0]]);
        for _ in 0..CLIMB {
            if *after > *best {
                *shift += 1.0;
                (*before, *best) = (*best, *after);
                *after = self.correlation(live, at, *shift as isize + 1);
            } else if *before > *best {
                *shift -= 1.0;
                (*best, *after) = (*before, *best);
                *before = self.correlation(live, at, *shift as isize - 1);
            } else {
                break;
            }
        }
    }

    /// Of one window with the reference shifted by `shift`, relative to how strong the reference is there.
    #[inline(always)]
    fn correlation(&self, live: &Live, [x, y]: [usize; 2], shift: isize) -> f32 {
        let reference = (x + self.margin).wrapping_add_signed(-shift);
        let mut product = 0;
        for column in self.column_products(live, x, reference, y) {
            product += column;
        }
        product as f32 * self.inverse_norm[y * self.residual.width + reference]
    }

    /// Products of the live image's columns with the reference's, summed over a window's rows around `y`: of those that
    /// the windows around pixel `x` and the reference's pixel `reference` have.
    #[inline(always)]
    fn column_products(&self, live: &Live, x: usize, reference: usize, y: usize) -> [i32; COLUMNS] {
        let (x, reference) = (x - COLUMNS / 2, reference - COLUMNS / 2);
        let live_pairs: &[_; 2 * RADIUS] = live.pairs.rows(y - RADIUS);
        let other_pairs: &[_; 2 * RADIUS] = self.pairs.rows(y - RADIUS);
        let mut sums = [0; COLUMNS];
        for pair in (0..2 * RADIUS).step_by(2) {
            let live: &[i16; 2 * COLUMNS] = live_pairs[pair][2 * x..].first_chunk().expect("room at the end");
            let other: &[i16; 2 * COLUMNS] = other_pairs[pair][2 * reference..].first_chunk().expect("room at the end");
            let mut products = [0; 2 * COLUMNS];
            for lane in 0..2 * COLUMNS {
                products[lane] = i32::from(live[lane]) * i32::from(other[lane]);
            }
            for lane in 0..COLUMNS {
                sums[lane] += products[2 * lane] + products[2 * lane + 1];
            }
        }
        // A window has an odd number of rows.
        let [live]: &[_; 1] = live.residual.rows(y + RADIUS);
        let [other]: &[_; 1] = self.residual.rows(y + RADIUS);
        let live: &[i16; COLUMNS] = live[x..].first_chunk().expect("room at the end");
        let other: &[i16; COLUMNS] = other[reference..].first_chunk().expect("room at the end");
        for lane in 0..COLUMNS {
            sums[lane] += i32::from(live[lane]) * i32::from(other[lane]);
        }
        sums
    }
}

/// What is known of a row of pixels while it is refined.
pub(super) struct Row {
    columns: Vec<i32>,
    /// Correlations at the shift before, at the shift, and at the one after.
    around: [Vec<f32>; 3],
}

impl Row {
    pub fn new(width: usize) -> Self {
        let room = vec![0.0; width + COLUMNS];
        Self { columns: vec![0; width + 3 * COLUMNS], around: [room.clone(), room.clone(), room] }
    }
}

/// Sums of eight neighbouring numbers, from each of the first eight on.
#[inline(always)]
fn sums_of_eight(numbers: &[i32]) -> [i32; COLUMNS] {
    let numbers: &[i32; 2 * COLUMNS] = numbers.first_chunk().expect("two vectors");
    let mut sums = [0; COLUMNS];
    for step in 0..COLUMNS {
        for lane in 0..COLUMNS {
            sums[lane] += numbers[lane + step];
        }
    }
    sums
}

/// Where between −1 and 1 three correlations have their peak. The pattern resembles its shifted self as a Gaussian
/// does that has been lowered by [`TROUGH`]; a parabola through them would draw results to whole pixels, by up to
/// half a step.
#[inline(always)]
fn peak(before: f32, best: f32, after: f32) -> f32 {
    let above_trough = |correlation: f32| (correlation + TROUGH * best).max(f32::EPSILON * best);
    let (before, best, after) = (above_trough(before), above_trough(best), above_trough(after));
    let curvature = ln_of_ratio(best * best, before * after);
    0.5 * ln_of_ratio(after, before) / curvature.max(f32::EPSILON)
}

/// ln(a/b) by the first terms of 2·artanh((a−b)/(a+b)): within 0.02 up to a ratio of 5, and a fraction of `ln`'s time.
#[inline(always)]
fn ln_of_ratio(a: f32, b: f32) -> f32 {
    let y = (a - b) / (a + b);
    let square = y * y;
    2.0 * y * (1.0 + square * (1.0 / 3.0 + square * 0.2))
}
