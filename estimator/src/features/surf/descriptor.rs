//! Orientation and descriptor from Haar wavelets on the integral image (§4).

use std::f32::consts::{PI, TAU};
use std::sync::LazyLock;

use pulp::{Arch, NullaryFnOnce};

use super::Feature;
use super::hessian::Maximum;
use super::integral::IntegralImage;

/// Sampling step along the descriptor window's side: 20 s in steps of s (§4.2).
const SAMPLES: usize = 20;
/// σ of the Gaussian over the descriptor window, in s (§4.2).
const WINDOW_SIGMA: f32 = 3.3;
/// σ of the Gaussian over the orientation disc, in s (§4.1).
const DISC_SIGMA: f32 = 2.0;
/// Radius of the orientation disc, in s (§4.1).
const DISC_RADIUS: i32 = 6;
/// The sliding sector of π/3 (§4.1) moves in steps of 5°.
const BINS: usize = 72;
const SECTOR_BINS: usize = BINS / 6;

/// Samples in the orientation disc.
const DISC_SAMPLES: usize = 113;

/// Orientation disc: offsets (x, y) in s and Gaussian weights, each of all samples.
static DISC: LazyLock<[[f32; DISC_SAMPLES]; 3]> = LazyLock::new(|| {
    let inside = |&(x, y): &(i32, i32)| x * x + y * y <= DISC_RADIUS * DISC_RADIUS;
    let offsets = (-DISC_RADIUS..=DISC_RADIUS).flat_map(|y| (-DISC_RADIUS..=DISC_RADIUS).map(move |x| (x, y)));
    let mut disc = [[0.0; DISC_SAMPLES]; 3];
    for (sample, (x, y)) in offsets.filter(inside).enumerate() {
        (disc[0][sample], disc[1][sample]) = (x as f32, y as f32);
        disc[2][sample] = gaussian((x * x + y * y) as f32, DISC_SIGMA);
    }
    disc
});

/// Gaussian weight along one axis of the descriptor window, by sample.
static WINDOW: LazyLock<[f32; SAMPLES]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let offset = from_middle(i);
        gaussian(offset * offset, WINDOW_SIGMA)
    })
});

/// Where a sample's values go: regions, as where in the 64 numbers they begin, and shares.
type Shares = [(usize, f32); 4];

/// The shares of each sample, row after row. A sample is shared linearly between the neighbouring regions, so that a shift
/// by a fraction of a region changes the descriptor by that fraction; where there are fewer than four the rest have no
/// share.
static SHARES: LazyLock<[[Shares; SAMPLES]; SAMPLES]> = LazyLock::new(|| {
    // In regions, from the first region's centre.
    let along_an_axis = |sample: usize| {
        let place = (sample as f32 - 2.0) / 5.0;
        let region = place.floor();
        [(region, region + 1.0 - place), (region + 1.0, place - region)]
    };
    let within = |region: f32| (0.0..4.0).contains(&region);
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let (rows, columns) = (along_an_axis(row), along_an_axis(column));
            std::array::from_fn(|neighbour| match (rows[neighbour / 2], columns[neighbour % 2]) {
                ((r, row_share), (c, column_share)) if within(r) && within(c) => {
                    ((r as usize * 4 + c as usize) * 4, row_share * column_share)
                }
                _ => (0, 0.0),
            })
        })
    })
});

/// A sample's place from the window's middle, in s.
fn from_middle(sample: usize) -> f32 {
    sample as f32 - (SAMPLES - 1) as f32 / 2.0
}

fn gaussian(distance_squared: f32, sigma: f32) -> f32 {
    (-distance_squared / (2.0 * sigma * sigma)).exp()
}

/// Completes maxima to features.
pub fn describe(integral: &IntegralImage, maxima: &[Maximum]) -> Vec<Feature> {
    Arch::new().dispatch(Description { integral, maxima })
}

/// Maxima to be described. A type of its own: [`Arch::dispatch`] inlines no closure.
struct Description<'a> {
    integral: &'a IntegralImage,
    maxima: &'a [Maximum],
}

impl NullaryFnOnce for Description<'_> {
    type Output = Vec<Feature>;

    #[inline(always)]
    fn call(self) -> Vec<Feature> {
        let mut features = Vec::with_capacity(self.maxima.len());
        for maximum in self.maxima {
            let haar = Haar { integral: self.integral, x: maximum.x, y: maximum.y };
            let orientation = orientation(&haar, maximum.scale);
            features.push(Feature {
                x: maximum.x,
                y: maximum.y,
                scale: maximum.scale,
                orientation,
                response: maximum.response,
                laplacian_positive: maximum.laplacian_positive,
                descriptor: descriptor(&haar, maximum.scale, orientation),
            });
        }
        features
    }
}

/// Haar wavelets around a point.
struct Haar<'a> {
    integral: &'a IntegralImage,
    x: f32,
    y: f32,
}

impl Haar<'_> {
    /// The middle of a wavelet at an offset in pixels. It's a corner between pixels, the nearest one: the wavelet's edge is
    /// even.
    #[inline(always)]
    fn corner(&self, dx: f32, dy: f32) -> (i32, i32) {
        (nearest(self.x + dx + 0.5), nearest(self.y + dy + 0.5))
    }

    /// Responses (dx, dy) of wavelets of edge 2·`half` round a corner between pixels. Outside the image the wavelet is cut
    /// at its border.
    #[inline(always)]
    fn at(&self, x: i32, y: i32, half: i32) -> (f32, f32) {
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
#[inline(always)]
fn nearest(value: f32) -> i32 {
    (value + 4096.5) as i32 - 4096
}

/// Direction of the strongest sector of gradients within 6 s (§4.1).
#[inline(always)]
fn orientation(haar: &Haar, scale: f32) -> f32 {
    // Wavelets of edge 4 s.
    let half = (2.0 * scale).round().max(1.0) as i32;
    let [xs, ys, weights] = &*DISC;
    // Each step for the whole disc: the processor does many samples at once.
    let mut corners = [(0, 0); DISC_SAMPLES];
    for (sample, corner) in corners.iter_mut().enumerate() {
        *corner = haar.corner(xs[sample] * scale, ys[sample] * scale);
    }
    let mut gradients = [[0.0_f32; DISC_SAMPLES]; 2];
    for (sample, &(x, y)) in corners.iter().enumerate() {
        (gradients[0][sample], gradients[1][sample]) = haar.at(x, y, half);
    }
    let mut sectors = [0_u32; DISC_SAMPLES];
    for sample in 0..DISC_SAMPLES {
        let (dx, dy) = (gradients[0][sample] * weights[sample], gradients[1][sample] * weights[sample]);
        (gradients[0][sample], gradients[1][sample]) = (dx, dy);
        sectors[sample] = (angle_quickly(dy, dx) * (BINS as f32 / TAU)) as u32;
    }
    // The first bins again after the last ones: the sector slides round.
    let mut bins = [[0.0_f32; BINS + SECTOR_BINS]; 2];
    for (sample, &sector) in sectors.iter().enumerate() {
        let bin = sector as usize % BINS;
        bins[0][bin] += gradients[0][sample];
        bins[1][bin] += gradients[1][sample];
    }
    let mut sums = [[0.0_f32; BINS]; 2];
    for (bins, sums) in bins.iter_mut().zip(&mut sums) {
        bins.copy_within(..SECTOR_BINS, BINS);
        for bin in 0..SECTOR_BINS {
            sums.iter_mut().zip(&bins[bin..]).for_each(|(sum, value)| *sum += value);
        }
    }
    let mut strongest = (0.0_f32, 0.0_f32);
    for (&x, &y) in sums[0].iter().zip(&sums[1]) {
        if x * x + y * y > strongest.0 * strongest.0 + strongest.1 * strongest.1 {
            strongest = (x, y);
        }
    }
    strongest.1.atan2(strongest.0)
}

/// atan2 in [0, 2π) to 0.3°, enough to choose a bin of 5° and a fifth of the time.
#[inline(always)]
fn angle_quickly(y: f32, x: f32) -> f32 {
    let (small, large) = if x.abs() < y.abs() { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
    let ratio = if large == 0.0 { 0.0 } else { small / large };
    // atan(r) ≈ r(π/4 + 0.273(1 − r)) on [0, 1] (Rajan et al. 2006).
    let octant = ratio * (PI / 4.0 + 0.273 * (1.0 - ratio));
    let quadrant = if y.abs() > x.abs() { PI / 2.0 - octant } else { octant };
    let half_plane = if x < 0.0 { PI - quadrant } else { quadrant };
    if y < 0.0 { TAU - half_plane } else { half_plane }
}

/// The 64 numbers (§4.2).
#[inline(always)]
fn descriptor(haar: &Haar, scale: f32, orientation: f32) -> [f32; 64] {
    let (sin, cos) = orientation.sin_cos();
    // Wavelets of edge 2 s.
    let half = scale.round().max(1.0) as i32;
    let window = &*WINDOW;
    let mut sums = [0.0_f32; 64];
    for (row, shares) in SHARES.iter().enumerate() {
        let v = from_middle(row);
        // A row at a time, and each step for the whole row: the processor does many at once.
        let mut corners = [(0, 0); SAMPLES];
        for (column, corner) in corners.iter_mut().enumerate() {
            let u = from_middle(column);
            *corner = haar.corner(scale * (u * cos - v * sin), scale * (u * sin + v * cos));
        }
        let mut gradients = [[0.0_f32; SAMPLES]; 2];
        for (column, &(x, y)) in corners.iter().enumerate() {
            (gradients[0][column], gradients[1][column]) = haar.at(x, y, half);
        }
        let mut values = [[0.0_f32; 4]; SAMPLES];
        for (column, values) in values.iter_mut().enumerate() {
            let (dx, dy) = (gradients[0][column], gradients[1][column]);
            let weight = window[row] * window[column];
            let along = weight * (dx * cos + dy * sin);
            let across = weight * (dy * cos - dx * sin);
            *values = [along, across, along.abs(), across.abs()];
        }
        for (shares, values) in shares.iter().zip(values) {
            for &(start, share) in shares {
                for (sum, value) in sums[start..start + 4].iter_mut().zip(values) {
                    *sum += share * value;
                }
            }
        }
    }
    let norm = sums.iter().map(|value| value * value).sum::<f32>().sqrt();
    if norm > 0.0 {
        sums.iter_mut().for_each(|value| *value /= norm);
    }
    sums
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
