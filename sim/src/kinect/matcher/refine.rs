//! Sub-pixel disparity: the correlation of the window with the reference at the found candidate and beside it.

use super::residual::Residual;
use super::search::NO_MATCH;
use super::{NEAREST, RADIUS};

/// Columns of the correlated window, a whole vector of 16-bit numbers; rows are 2·[`RADIUS`] + 1.
const COLUMNS: usize = 8;
/// Normalised correlation below which a match is none. Chosen so that shadows are as wide as geometry says: a window
/// half in the shadow matches less.
const WEAKEST_CORRELATION: f32 = 0.57;
/// How far a shifted dot's correlation falls below that of unrelated windows, relative to the peak: dots have no
/// neighbours. Chosen for least bias (measured: 0.02 of a step at most).
const TROUGH: f32 = 0.4;
/// How often the found candidate may turn out to be beside the best one.
const CLIMB: usize = 2;

/// The reference image and how strong each of its windows is.
pub(super) struct Reference {
    residual: Residual,
    /// Columns left of the live image's first.
    margin: usize,
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
    norms: Vec<f32>,
}

impl Live {
    pub fn of(residual: Residual) -> Self {
        Self { norms: norms(&residual), residual }
    }
}

impl Reference {
    pub fn of(residual: Residual, margin: usize) -> Self {
        let inverse_norm = norms(&residual).into_iter().map(|norm| norm.max(1.0).recip()).collect();
        Self { residual, margin, inverse_norm }
    }

    /// The depth engine's last step for row `y` of an image: from the candidates found for its pixels to shifts from
    /// the reference, pixels, positive when nearer. `keep` gets each pixel that has one.
    pub fn refine_row(&self, live: &Live, y: usize, candidates: &[u8], mut keep: impl FnMut(usize, f32)) {
        let columns = RADIUS..candidates.len() - RADIUS;
        let mut products = Products::new(columns.len());
        let mut x = columns.start;
        for run in candidates[columns].chunk_by(|a, b| a == b) {
            if run[0] != NO_MATCH {
                let shift = NEAREST + isize::from(run[0]);
                // The reference's pixel for the middle one of three shifts.
                let reference = (x + self.margin).wrapping_add_signed(-shift);
                let first = [reference + 1, reference, reference - 1];
                products.set(live, &self.residual, [x, y], first, run.len());
                for at in 0..run.len() {
                    let inverse_norms = &self.inverse_norm[y * self.residual.width + at..];
                    let correlation = |place: usize| products.windows[place][at] as f32 * inverse_norms[first[place]];
                    let around = [correlation(0), correlation(1), correlation(2)];
                    if let Some(shift) = self.refine(live, x + at, y, shift, around) {
                        keep(x + at, shift);
                    }
                }
            }
            x += run.len();
        }
    }

    /// Climbs from a candidate with the correlations around it to the best one nearby; `None` when the window
    /// resembles the reference too little.
    fn refine(&self, live: &Live, x: usize, y: usize, mut shift: isize, mut around: [f32; 3]) -> Option<f32> {
        for _ in 0..CLIMB {
            if around[2] > around[1] {
                shift += 1;
                around = [around[1], around[2], self.correlation(live, x, y, shift + 1)];
            } else if around[0] > around[1] {
                shift -= 1;
                around = [self.correlation(live, x, y, shift - 1), around[0], around[1]];
            }
        }
        let [before, best, after] = around;
        if best < before.max(after) || best <= WEAKEST_CORRELATION * live.norms[y * live.residual.width + x] {
            return None;
        }
        Some(shift as f32 + peak(before, best, after))
    }

    /// Of one window with the reference shifted by `shift`, relative to how strong the reference is there.
    fn correlation(&self, live: &Live, x: usize, y: usize, shift: isize) -> f32 {
        let reference = (x + self.margin).wrapping_add_signed(-shift);
        let rows = (y - RADIUS..=y + RADIUS).map(|row| {
            let live = &live.residual.row(row)[x - COLUMNS / 2..][..COLUMNS];
            let reference = &self.residual.row(row)[reference - COLUMNS / 2..][..COLUMNS];
            live.iter().zip(reference).map(|(&a, &b)| i32::from(a) * i32::from(b)).sum::<i32>()
        });
        rows.sum::<i32>() as f32 * self.inverse_norm[y * self.residual.width + reference]
    }
}

/// Products of the windows of neighbouring pixels with the reference's, for each of three shifts. Neighbouring windows
/// share all but one of their columns.
struct Products {
    columns: Vec<i32>,
    pairs: Vec<i32>,
    windows: [Vec<i32>; 3],
}

impl Products {
    fn new(longest: usize) -> Self {
        let room = vec![0; (longest + COLUMNS).next_multiple_of(COLUMNS)];
        Self { columns: room.clone(), pairs: room.clone(), windows: [room.clone(), room.clone(), room] }
    }

    /// For `length` pixels of a row from `x` on, against the reference's from each of `first` on.
    fn set(&mut self, live: &Live, reference: &Residual, [x, y]: [usize; 2], first: [usize; 3], length: usize) {
        // Whole vectors of columns, a few more than needed.
        let columns = (length + COLUMNS - 1).next_multiple_of(COLUMNS);
        let sums = &mut self.columns[..columns];
        let live_width = live.residual.width;
        for (windows, first) in self.windows.iter_mut().zip(first) {
            let live = live.residual.from(x - COLUMNS / 2, y - RADIUS);
            let other = reference.from(first - COLUMNS / 2, y - RADIUS);
            for (vector, sums) in sums.as_chunks_mut().0.iter_mut().enumerate() {
                let (live, other) = (&live[vector * COLUMNS..], &other[vector * COLUMNS..]);
                *sums = column_products(live, live_width, other, reference.width);
            }
            add_shifted(&mut self.pairs[..columns], sums, 1);
            add_shifted(sums, &self.pairs[..columns], 2);
            add_shifted(&mut windows[..columns], sums, 4);
        }
    }
}

/// Products of the columns of two images, summed over a window's rows.
#[inline(always)]
fn column_products(a: &[i16], a_width: usize, b: &[i16], b_width: usize) -> [i32; COLUMNS] {
    let mut sums = [0; COLUMNS];
    for row in 0..=2 * RADIUS {
        let a: &[i16; COLUMNS] = a[row * a_width..].first_chunk().expect("rows that lie in the image");
        let b: &[i16; COLUMNS] = b[row * b_width..].first_chunk().expect("rows that lie in the image");
        for lane in 0..COLUMNS {
            sums[lane] += i32::from(a[lane]) * i32::from(b[lane]);
        }
    }
    sums
}

/// Sums of numbers `step` places apart. The last `step` results are void.
fn add_shifted(sums: &mut [i32], numbers: &[i32], step: usize) {
    for ((sum, a), b) in sums.iter_mut().zip(numbers).zip(&numbers[step..]) {
        *sum = a + b;
    }
}

/// Where between −1 and 1 three correlations have their peak. The pattern resembles its shifted self as a Gaussian
/// does that has been lowered by [`TROUGH`]; a parabola through them would draw results to whole pixels, by up to
/// half a step.
fn peak(before: f32, best: f32, after: f32) -> f32 {
    let above_trough = |correlation: f32| (correlation + TROUGH * best).max(f32::EPSILON * best);
    let (before, best, after) = (above_trough(before), above_trough(best), above_trough(after));
    let curvature = ln_of_ratio(best * best, before * after);
    0.5 * ln_of_ratio(after, before) / curvature.max(f32::EPSILON)
}

/// ln(a/b) by the first terms of 2·artanh((a−b)/(a+b)): within 0.02 up to a ratio of 5, and a fraction of `ln`'s time.
fn ln_of_ratio(a: f32, b: f32) -> f32 {
    let y = (a - b) / (a + b);
    let square = y * y;
    2.0 * y * (1.0 + square * (1.0 / 3.0 + square * 0.2))
}
