//! Orientation and descriptor from Haar wavelets on the integral image (§4).

use std::f32::consts::{PI, TAU};
use std::sync::LazyLock;

use super::Feature;
use super::hessian::Maximum;
use super::integral::IntegralImage;

/// Sampling step along the descriptor window's side: 20 s in steps of s (§4.2).
const SAMPLES: i32 = 20;
/// σ of the Gaussian over the descriptor window, in s (§4.2).
const WINDOW_SIGMA: f32 = 3.3;
/// σ of the Gaussian over the orientation disc, in s (§4.1).
const DISC_SIGMA: f32 = 2.0;
/// Radius of the orientation disc, in s (§4.1).
const DISC_RADIUS: i32 = 6;
/// The sliding sector of π/3 (§4.1) moves in steps of 5°.
const BINS: usize = 72;
const SECTOR_BINS: usize = BINS / 6;

/// Orientation disc: offsets in s and Gaussian weights.
static DISC: LazyLock<Vec<(f32, f32, f32)>> = LazyLock::new(|| {
    let inside = |x: i32, y: i32| x * x + y * y <= DISC_RADIUS * DISC_RADIUS;
    let offsets = (-DISC_RADIUS..=DISC_RADIUS).flat_map(|y| (-DISC_RADIUS..=DISC_RADIUS).map(move |x| (x, y)));
    offsets
        .filter(|&(x, y)| inside(x, y))
        .map(|(x, y)| (x as f32, y as f32, gaussian((x * x + y * y) as f32, DISC_SIGMA)))
        .collect()
});

/// Gaussian weight along one axis of the descriptor window, by sample.
static WINDOW: LazyLock<[f32; SAMPLES as usize]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let offset = i as f32 - (SAMPLES - 1) as f32 / 2.0;
        gaussian(offset * offset, WINDOW_SIGMA)
    })
});

fn gaussian(distance_squared: f32, sigma: f32) -> f32 {
    (-distance_squared / (2.0 * sigma * sigma)).exp()
}

/// Completes a maximum to a feature.
pub fn describe(integral: &IntegralImage, maximum: &Maximum) -> Feature {
    let haar = Haar { integral, x: maximum.x, y: maximum.y };
    let orientation = orientation(&haar, maximum.scale);
    Feature {
        x: maximum.x,
        y: maximum.y,
        scale: maximum.scale,
        orientation,
        response: maximum.response,
        laplacian_positive: maximum.laplacian_positive,
        descriptor: descriptor(&haar, maximum.scale, orientation),
    }
}

/// Haar wavelets around a point.
struct Haar<'a> {
    integral: &'a IntegralImage,
    x: f32,
    y: f32,
}

impl Haar<'_> {
    /// Responses (dx, dy) of wavelets of edge 2·`half`, centred at an offset in pixels. Outside the image the
    /// wavelet is cut at its border.
    fn at(&self, dx: f32, dy: f32, half: i32) -> (f32, f32) {
        // A corner between pixels: the wavelet's edge is even, so its middle is the nearest pixel corner.
        let (x, y) = (nearest(self.x + dx + 0.5), nearest(self.y + dy + 0.5));
        let (width, height) = (self.integral.width() as i32, self.integral.height() as i32);
        let column = |x: i32| x.clamp(0, width) as usize;
        let row = |y: i32| self.integral.row(y.clamp(0, height) as usize);
        let (left, middle, right) = (column(x - half), column(x), column(x + half));
        let (top, centre, bottom) = (row(y - half), row(y), row(y + half));
        let whole_left = bottom[left].wrapping_sub(top[left]);
        let whole_middle = bottom[middle].wrapping_sub(top[middle]);
        let whole_right = bottom[right].wrapping_sub(top[right]);
        let horizontal = (whole_right.wrapping_sub(whole_middle)).wrapping_sub(whole_middle.wrapping_sub(whole_left));
        let upper = (centre[right].wrapping_sub(top[right])).wrapping_sub(centre[left].wrapping_sub(top[left]));
        let lower = (bottom[right].wrapping_sub(centre[right])).wrapping_sub(bottom[left].wrapping_sub(centre[left]));
        (horizontal as f32, lower.wrapping_sub(upper) as f32)
    }
}

/// The nearest whole number by truncation, for values above −4096: a window reaches no further out of the image, and
/// `f32::round` is slow where the processor lacks an instruction for it.
fn nearest(value: f32) -> i32 {
    (value + 4096.5) as i32 - 4096
}

/// Direction of the strongest sector of gradients within 6 s (§4.1).
fn orientation(haar: &Haar, scale: f32) -> f32 {
    // Wavelets of edge 4 s.
    let half = (2.0 * scale).round().max(1.0) as i32;
    let mut bins = [(0.0_f32, 0.0_f32); BINS];
    for &(x, y, weight) in DISC.iter() {
        let (dx, dy) = haar.at(x * scale, y * scale, half);
        let (dx, dy) = (dx * weight, dy * weight);
        let bin = (angle_quickly(dy, dx) * (BINS as f32 / TAU)) as usize % BINS;
        bins[bin].0 += dx;
        bins[bin].1 += dy;
    }
    let mut strongest = (0.0_f32, 0.0_f32);
    for first in 0..BINS {
        let mut sum = (0.0_f32, 0.0_f32);
        for bin in first..first + SECTOR_BINS {
            sum.0 += bins[bin % BINS].0;
            sum.1 += bins[bin % BINS].1;
        }
        if sum.0 * sum.0 + sum.1 * sum.1 > strongest.0 * strongest.0 + strongest.1 * strongest.1 {
            strongest = sum;
        }
    }
    strongest.1.atan2(strongest.0)
}

/// atan2 in [0, 2π) to 0.3°, enough to choose a bin of 5° and a fifth of the time.
fn angle_quickly(y: f32, x: f32) -> f32 {
    let (small, large) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    if large == 0.0 {
        return 0.0;
    }
    let ratio = small / large;
    // atan(r) ≈ r(π/4 + 0.273(1 − r)) on [0, 1] (Rajan et al. 2006).
    let octant = ratio * (PI / 4.0 + 0.273 * (1.0 - ratio));
    let quadrant = if y.abs() > x.abs() { PI / 2.0 - octant } else { octant };
    let half_plane = if x < 0.0 { PI - quadrant } else { quadrant };
    if y < 0.0 { TAU - half_plane } else { half_plane }
}

/// The 64 numbers (§4.2). Each sample is shared linearly between the neighbouring regions, so that a shift by a
/// fraction of a region changes the descriptor by that fraction.
fn descriptor(haar: &Haar, scale: f32, orientation: f32) -> [f32; 64] {
    let (sin, cos) = orientation.sin_cos();
    // Wavelets of edge 2 s.
    let half = scale.round().max(1.0) as i32;
    let mut sums = [0.0_f32; 64];
    for row in 0..SAMPLES {
        let v = row as f32 - (SAMPLES - 1) as f32 / 2.0;
        for column in 0..SAMPLES {
            let u = column as f32 - (SAMPLES - 1) as f32 / 2.0;
            let (dx, dy) = haar.at(scale * (u * cos - v * sin), scale * (u * sin + v * cos), half);
            let weight = WINDOW[row as usize] * WINDOW[column as usize];
            let along = weight * (dx * cos + dy * sin);
            let across = weight * (dy * cos - dx * sin);
            add_shared(&mut sums, (column as f32 - 2.0) / 5.0, (row as f32 - 2.0) / 5.0, along, across);
        }
    }
    let norm = sums.iter().map(|value| value * value).sum::<f32>().sqrt();
    if norm > 0.0 {
        sums.iter_mut().for_each(|value| *value /= norm);
    }
    sums
}

/// Adds a sample at (column, row), in regions from the first region's centre, to the regions around it.
fn add_shared(sums: &mut [f32; 64], column: f32, row: f32, along: f32, across: f32) {
    let values = [along, across, along.abs(), across.abs()];
    let (column0, row0) = (column.floor(), row.floor());
    for (r, row_share) in [(row0, row0 + 1.0 - row), (row0 + 1.0, row - row0)] {
        for (c, column_share) in [(column0, column0 + 1.0 - column), (column0 + 1.0, column - column0)] {
            if (0.0..4.0).contains(&r) && (0.0..4.0).contains(&c) {
                let start = (r as usize * 4 + c as usize) * 4;
                for (sum, value) in sums[start..start + 4].iter_mut().zip(values) {
                    *sum += row_share * column_share * value;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quick_angle_is_near_the_true_one() {
        for degree in 0..360 {
            let angle = (degree as f32).to_radians();
            assert!((angle_quickly(angle.sin(), angle.cos()) - angle).abs() < 0.006, "{degree}");
        }
    }
}
