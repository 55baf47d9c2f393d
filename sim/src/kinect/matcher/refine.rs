//! Sub-pixel disparity: the correlation of the window with the reference at the found candidate and beside it.

use super::residual::Residual;
use super::{NEAREST, RADIUS};

/// Columns of the correlated window, a whole vector of 16-bit numbers; rows are 2·[`RADIUS`] + 1.
const COLUMNS: usize = 8;
/// Normalised correlation below which a match is none. Unrelated windows reach 0.5 by chance once in some thousand.
const WEAKEST_CORRELATION: f32 = 0.5;
/// How far a shifted dot's correlation falls below that of unrelated windows, relative to the peak: dots have no
/// neighbours. Chosen for least bias (measured: 0.03 of a step at most).
const TROUGH: f32 = 0.25;
/// How often the found candidate may turn out to be beside the best one.
const CLIMB: usize = 2;

/// The reference image and how strong each of its windows is.
pub(super) struct Reference {
    residual: Residual,
    /// Columns left of the live image's first.
    margin: usize,
    /// 1/√(sum of squares) of the window at each pixel; 0 where there is nothing to match.
    inverse_norm: Vec<f32>,
}

/// A window's pixels, row after row. In one piece, so that the compiler multiplies and adds eight at a time.
type Patch = [i16; COLUMNS * (2 * RADIUS + 1)];

#[inline(always)]
fn patch(image: &Residual, x: usize, y: usize) -> Patch {
    let mut patch = [0; _];
    for (row, pixels) in patch.chunks_exact_mut(COLUMNS).enumerate() {
        let start = (y + row - RADIUS) * image.width + x - COLUMNS / 2;
        pixels.copy_from_slice(&image.values[start..start + COLUMNS]);
    }
    patch
}

#[inline(always)]
fn product(a: &Patch, b: &Patch) -> f32 {
    a.iter().zip(b).map(|(&a, &b)| i32::from(a) * i32::from(b)).sum::<i32>() as f32
}

impl Reference {
    pub fn of(residual: Residual, margin: usize) -> Self {
        let mut inverse_norm = vec![0.0; residual.values.len()];
        for y in RADIUS..residual.height - RADIUS {
            for x in RADIUS..residual.width - RADIUS {
                let window = patch(&residual, x, y);
                inverse_norm[y * residual.width + x] = product(&window, &window).max(1.0).sqrt().recip();
            }
        }
        Self { residual, margin, inverse_norm }
    }

    /// Shift from the reference in pixels, positive when nearer, from the candidate found for a pixel; `None` when
    /// the window resembles the reference too little.
    pub fn refine(&self, live: &Residual, x: usize, y: usize, candidate: u8) -> Option<f32> {
        let window = patch(live, x, y);
        let correlation = |shift: isize| {
            let at = (x + self.margin).wrapping_add_signed(-shift);
            product(&window, &patch(&self.residual, at, y)) * self.inverse_norm[y * self.residual.width + at]
        };
        let mut shift = NEAREST + isize::from(candidate);
        let mut around = [correlation(shift - 1), correlation(shift), correlation(shift + 1)];
        for _ in 0..CLIMB {
            if around[2] > around[1] {
                shift += 1;
                around = [around[1], around[2], correlation(shift + 1)];
            } else if around[0] > around[1] {
                shift -= 1;
                around = [correlation(shift - 1), around[0], around[1]];
            }
        }
        let [before, best, after] = around;
        let strength = product(&window, &window).sqrt();
        if best < before.max(after) || best < WEAKEST_CORRELATION * strength {
            return None;
        }
        Some(shift as f32 + peak(before, best, after))
    }
}

/// Where between −1 and 1 three correlations have their peak. The pattern resembles its shifted self as a Gaussian
/// does that has been lowered by [`TROUGH`]; a parabola through them would draw results to whole pixels, by up to
/// half a step.
fn peak(before: f32, best: f32, after: f32) -> f32 {
    let above_trough = |correlation: f32| (correlation + TROUGH * best).max(f32::EPSILON * best);
    let (before, best, after) = (above_trough(before), above_trough(best), above_trough(after));
    let curvature = (best * best / (before * after)).ln();
    0.5 * (after / before).ln() / curvature.max(f32::EPSILON)
}
