//! Sub-pixel disparity: the correlation of the window with the reference at the found candidate and beside it.

use wide::{f32x8, i16x16, i32x8};

use super::RADIUS;
use super::residual::{Residual, RowPairs, STRIDE};
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
/// The shift before a candidate, the candidate, and the one after.
const AROUND: usize = 3;
/// How often the found candidate may turn out to be beside the best one.
const CLIMB: usize = 2;

/// The reference image and how strong each of its windows is.
pub(super) struct Reference {
    width: usize,
    pairs: RowPairs,
    /// Columns left of the live image's first.
    margin: usize,
    /// Of the first candidate, pixels.
    first_shift: isize,
    /// 1/√(sum of squares) of the window at each pixel.
    inverse_norm: Vec<f32>,
}

/// Roots of the sums of squares over every window; 0 nearer to the border than a window reaches.
#[inline(always)]
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
    pairs: RowPairs,
    norms: Vec<f32>,
}

impl Live {
    #[inline(always)]
    pub fn of(residual: &Residual) -> Self {
        Self { norms: norms(residual), pairs: RowPairs::of(residual) }
    }
}

impl Reference {
    pub fn of(residual: &Residual, margin: usize, first_shift: isize) -> Self {
        let inverse_norm = norms(residual).into_iter().map(|norm| norm.max(1.0).recip()).collect();
        Self { pairs: RowPairs::of(residual), width: residual.width, margin, first_shift, inverse_norm }
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
        for _ in 0..CLIMB {
            self.climb(live, y, row, shifts);
        }
        let width = shifts.len();
        let norms = &live.norms[y * width..][..width];
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
        // Seen by the smallest shift; by every larger one a column further left.
        let reference = (x + 1 + self.margin).wrapping_add_signed(-shift);
        let norms = &self.inverse_norm[y * self.width..];
        if length <= SHORT {
            for at in 0..length {
                let columns = self.column_products::<AROUND>(live, x + at, reference + at, y);
                for place in 0..AROUND {
                    row.around[place][x + at] = sum(columns[place]) as f32 * norms[reference + at - place];
                }
            }
            return;
        }
        // Neighbouring windows share columns. Whole vectors of them.
        let vectors = (length + COLUMNS - 1).div_ceil(COLUMNS);
        for vector in 0..vectors {
            let at = vector * COLUMNS;
            let products = self.column_products::<AROUND>(live, x + at, reference + at, y);
            for (columns, products) in row.columns.iter_mut().zip(products) {
                columns[at..at + COLUMNS].copy_from_slice(&products.to_array());
            }
        }
        for place in 0..AROUND {
            // What the last vector has beyond the run is of no run, and the next one overwrites it.
            let mut at = 0;
            while at < length {
                let norms = f32x8::new(*norms[reference + at - place..].first_chunk().expect("a margin"));
                let correlations = sums_of_eight(&row.columns[place][at..]).round_float() * norms;
                row.around[place][x + at..][..COLUMNS].copy_from_slice(&correlations.to_array());
                at += COLUMNS;
            }
        }
    }

    /// Goes one step from each shift of a row to the better one beside it, if there is one.
    #[inline(always)]
    fn climb(&self, live: &Live, y: usize, row: &mut Row, shifts: &mut [f32]) {
        let width = shifts.len();
        let [befores, bests, afters] = row.around.each_mut().map(|correlations| &mut correlations[..width]);
        // Those to move are listed first: which they are is as good as random, and processors that guess guess wrong.
        let climbing = &mut row.climbing[..width];
        let mut count = 0;
        for x in 0..width {
            climbing[count] = x as u16;
            let better_beside = (afters[x] > bests[x]) | (befores[x] > bests[x]);
            count += usize::from((shifts[x] != NO_SHIFT) & better_beside);
        }
        for &x in &climbing[..count] {
            let x = usize::from(x);
            let (before, best, after) = (befores[x], bests[x], afters[x]);
            let up = after > best;
            let step = if up { 1 } else { -1 };
            let shift = shifts[x] as isize + step;
            let reference = (x + self.margin).wrapping_add_signed(-shift - step);
            let [columns] = self.column_products(live, x, reference, y);
            let further = sum(columns) as f32 * self.inverse_norm[y * self.width + reference];
            shifts[x] = shift as f32;
            befores[x] = if up { best } else { further };
            bests[x] = if up { after } else { before };
            afters[x] = if up { further } else { best };
        }
    }

    /// Products of the live image's columns with the reference's, summed over a window's rows around `y`: of those that
    /// the windows around pixel `x` and the reference's pixel `reference` have, then the one left of it, ….
    #[inline(always)]
    fn column_products<const COUNT: usize>(&self, live: &Live, x: usize, reference: usize, y: usize) -> [i32x8; COUNT] {
        let (first_live, last_other) = (2 * (x - COLUMNS / 2), 2 * (reference - COLUMNS / 2));
        let live_pairs: &[_; 2 * RADIUS + 1] = live.pairs.rows(y - RADIUS);
        let other_pairs: &[_; 2 * RADIUS + 1] = self.pairs.rows(y - RADIUS);
        let mut sums = [i32x8::ZERO; COUNT];
        for pair in (0..2 * RADIUS + 1).step_by(2) {
            let mut live = sixteen(&live_pairs[pair], first_live);
            if pair == 2 * RADIUS {
                // A window has an odd number of rows.
                live &= i16x16::new([-1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0, -1, 0]);
            }
            for (place, sum) in sums.iter_mut().enumerate() {
                *sum += live.dot(sixteen(&other_pairs[pair], last_other - 2 * place));
            }
        }
        sums
    }
}

/// Eight pairs, from a number of a row on.
#[inline(always)]
fn sixteen(pairs: &[i16; 2 * STRIDE], first: usize) -> i16x16 {
    i16x16::new(*pairs[first..].first_chunk().expect("room at the end"))
}

/// What is known of a row of pixels while it is refined.
pub(super) struct Row {
    columns: [Vec<i32>; AROUND],
    /// Correlations at the shift before, at the shift, and at the one after.
    around: [Vec<f32>; AROUND],
    /// Pixels whose shift is not the best one.
    climbing: Vec<u16>,
}

impl Row {
    pub fn new(width: usize) -> Self {
        Self {
            columns: std::array::from_fn(|_| vec![0; width + 3 * COLUMNS]),
            around: std::array::from_fn(|_| vec![0.0; width + COLUMNS]),
            climbing: vec![0; width],
        }
    }
}

#[inline(always)]
fn sum(numbers: i32x8) -> i32 {
    let mut sum = 0;
    for number in numbers.to_array() {
        sum += number;
    }
    sum
}

/// Sums of eight neighbouring numbers, from each of the first eight on.
#[inline(always)]
fn sums_of_eight(numbers: &[i32]) -> i32x8 {
    let numbers: &[i32; 2 * COLUMNS] = numbers.first_chunk().expect("two vectors");
    let mut sums = i32x8::ZERO;
    for step in 0..COLUMNS {
        sums += i32x8::new(*numbers[step..].first_chunk().expect("a vector"));
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
