//! What surfaces reflect at 830 nm, from an infrared image full of the projector's dots (paper A, §3.3).
//!
//! The dots are fixed to the sensor: features on them say "no motion", whatever the robot does. But the projector is also
//! the lamp. Light falls off with z², which depth takes back; the dots are evened out by a Gaussian as wide as their
//! distance, and what that leaves of them is divided out by the [`Pattern`], learnt while driving and shifted to where
//! depth says that it falls. Ambient light only makes the dots fainter, which is measured place by place.

use crate::camera::{DepthCamera, DepthEncoding};
use crate::image::{DepthImage, GrayImage, Image, InfraredImage};

use super::blur::blur;
use super::pattern::Pattern;

/// Full scale; such a pixel's light is unknown.
const SATURATED: u16 = 1023;
/// From a Kinect's infrared camera to its projector where the calibration does not say, metres.
const BASELINE: f64 = 0.075;
/// The Gaussian over the dots: σ = 2 px. One grid position in nine of about a pixel holds a dot: three pixels apart.
const NARROW: (usize, usize) = (2, 2);
/// The Gaussian that an image's own light is judged against when dots are learnt: σ = 4.5 px, wide enough to hold many.
const WIDE: (usize, usize) = (5, 2);
/// Edge of the cells in which the dots' contrast is measured, pixels.
const CELL: usize = 32;
/// Fewest pixels of a cell that say something about its contrast, share.
const CELL_FILLED: f64 = 0.2;
/// Smallest share of a Gaussian's weight that must fall on pixels with light and depth.
const FILLED: f32 = 0.3;
/// Grey levels for each factor of e: 5 e-foldings fill the scale, so that a level is 2 %, less than the noise.
const LEVELS_PER_E: f32 = 50.0;
/// σ of the levels, once means of blocks are taken of them: speckle, and what is left of the dots, leave 3 to 5.
pub const ALBEDO_NOISE: f32 = 4.0;
/// Light that counts as none, numbers at 1 m: below it there is only noise. A guess: read noise is 3.
const DARK: f32 = 3.0;

/// Recovers albedo from the infrared images of one device.
pub struct AlbedoCamera {
    pattern: Pattern,
    /// Metres by depth value; 0 = no value.
    metres: Vec<f32>,
    /// Disparity at 1 m, f·b, pixels.
    disparity_at_1_m: f32,
    /// Light at 1 m of the newest image, 0 where it is unknown; its wide mean; and f·b/z, pixels, 0 without a depth.
    light: Image<f32>,
    wide: Image<f32>,
    disparity: Image<f32>,
}

/// An infrared image without its light.
pub struct Albedo {
    /// Logarithm of the albedo, 50 grey levels for each factor of e about the image's median, 128.
    pub image: GrayImage,
    /// The same, not rounded; 0 = unknown.
    pub levels: Image<f32>,
    /// Z of each pixel, metres; 0 = no value.
    pub depth: Image<f32>,
}

impl AlbedoCamera {
    /// Nothing learnt yet. `camera` gives depth in the infrared image's own pixels.
    pub fn new(camera: &DepthCamera) -> Self {
        let (width, height) = camera.model.size();
        let baseline = match camera.encoding {
            DepthEncoding::KinectDisparity { baseline, .. } => baseline,
            DepthEncoding::Linear { .. } => BASELINE,
        };
        Self {
            pattern: Pattern::unknown(width, height),
            metres: (0..=u16::MAX).map(|value| camera.depth_of(value).unwrap_or(0.0) as f32).collect(),
            disparity_at_1_m: (camera.model.fx * baseline) as f32,
            light: Image::filled(width, height, 0.0),
            wide: Image::filled(width, height, 0.0),
            disparity: Image::filled(width, height, 0.0),
        }
    }

    /// The albedo in one image; `depth` is of the same instant.
    pub fn recover(&mut self, infrared: &InfraredImage, depth: &DepthImage) -> Albedo {
        let (width, height) = infrared.size();
        let metres = depth.pixels().iter().map(|&value| self.metres[usize::from(value)]).collect();
        let depth = Image::from_pixels(width, height, metres).expect("depth lies in the infrared image's pixels");
        let known = self.take(infrared, &depth);
        self.wide = ratio(&blur(&self.light, WIDE.0, WIDE.1), &blur(&known, WIDE.0, WIDE.1));
        let pattern = self.pattern.light(&self.disparity);
        let expected = self.contrast(&known, &pattern).expected(&known, &pattern);
        let albedo = ratio(&blur(&self.light, NARROW.0, NARROW.1), &blur(&expected, NARROW.0, NARROW.1));
        let levels = self.to_levels(&albedo);
        // Levels are at least 1, where half up is what `round` does, without a call.
        let rounded =
            levels.pixels().iter().map(|&level| if level > 0.0 { (level + 0.5) as u8 } else { 128 }).collect();
        Albedo { image: Image::from_pixels(width, height, rounded).expect("same size in and out"), levels, depth }
    }

    /// Learns the dots from the image that was recovered last. Images of one and the same view teach the view.
    pub fn learn(&mut self) {
        self.pattern.fade();
        let (width, height) = self.light.size();
        for y in 0..height {
            for x in 0..width {
                let index = y * width + x;
                let (light, wide) = (self.light.pixels()[index], self.wide.pixels()[index]);
                if light > 0.0 && wide > DARK {
                    self.pattern.learn(x, y, self.disparity.pixels()[index], light / wide);
                }
            }
        }
    }

    /// Takes an image in; where its light is known: 1, elsewhere 0.
    fn take(&mut self, infrared: &InfraredImage, depth: &Image<f32>) -> Image<f32> {
        let mut known = Image::filled(infrared.width(), infrared.height(), 0.0);
        let out = known.pixels_mut().iter_mut().zip(self.light.pixels_mut()).zip(self.disparity.pixels_mut());
        for (((known, light), disparity), (&number, &z)) in out.zip(infrared.pixels().iter().zip(depth.pixels())) {
            let is_known = z > 0.0 && number < SATURATED;
            *known = f32::from(u8::from(is_known));
            *light = if is_known { f32::from(number) * z * z } else { 0.0 };
            *disparity = if z > 0.0 { self.disparity_at_1_m / z } else { 0.0 };
        }
        known
    }

    /// How strong the dots are against what was learnt: the slope of light over pattern, cell by cell.
    fn contrast(&self, known: &Image<f32>, pattern: &Image<f32>) -> Contrast {
        let (width, height) = known.size();
        let (columns, rows) = (width.div_ceil(CELL), height.div_ceil(CELL));
        let mut moments = vec![[0.0_f64; 5]; columns * rows];
        for y in 0..height {
            let moments = &mut moments[y / CELL * columns..][..columns];
            let cells = [known, pattern, &self.light, &self.wide].map(|image| image.row(y).chunks(CELL));
            let [known, pattern, light, wide] = cells;
            for ((((sums, known), pattern), light), wide) in
                moments.iter_mut().zip(known).zip(pattern).zip(light).zip(wide)
            {
                add_moments(sums, known, pattern, light, wide);
            }
        }
        let slope = |[count, p, l, pp, pl]: [f64; 5]| {
            let (variance, covariance) = (pp - p * p / count, pl - p * l / count);
            let filled = count > CELL_FILLED * (CELL * CELL) as f64;
            if filled && variance > 1e-3 * count { (covariance / variance).clamp(0.0, 2.0) as f32 } else { 1.0 }
        };
        Contrast { columns, rows, values: moments.into_iter().map(slope).collect() }
    }

    fn to_levels(&self, albedo: &Image<f32>) -> Image<f32> {
        let mut known: Vec<f32> = albedo.pixels().iter().copied().filter(|value| *value > 0.0).step_by(7).collect();
        let middle = known.len() / 2;
        let median = if known.is_empty() { 1.0 } else { *known.select_nth_unstable_by(middle, f32::total_cmp).1 };
        let level = |(&narrow, &wide): (&f32, &f32)| {
            // At the rim of what is known, the wide mean has to do.
            let value = if narrow > 0.0 { narrow } else { wide };
            if value > 0.0 { (128.0 + LEVELS_PER_E * ((value + DARK) / (median + DARK)).ln()).max(1.0) } else { 0.0 }
        };
        let pixels = albedo.pixels().iter().zip(self.wide.pixels()).map(level).collect();
        Image::from_pixels(albedo.width(), albedo.height(), pixels).expect("same size in and out")
    }
}

/// `above / below` where enough is below, elsewhere 0.
fn ratio(above: &Image<f32>, below: &Image<f32>) -> Image<f32> {
    let pixels = above.pixels().iter().zip(below.pixels());
    let pixels = pixels.map(|(above, below)| if *below > FILLED { above / below } else { 0.0 }).collect();
    Image::from_pixels(above.width(), above.height(), pixels).expect("same size in and out")
}

/// Adds the number of pixels that say something, and their sums of pattern, light, pattern² and pattern · light.
fn add_moments(sums: &mut [f64; 5], known: &[f32], pattern: &[f32], light: &[f32], wide: &[f32]) {
    for (((known, pattern), light), wide) in known.iter().zip(pattern).zip(light).zip(wide) {
        if *known == 0.0 || *wide <= DARK {
            continue;
        }
        let (pattern, light) = (f64::from(*pattern), f64::from(light / wide));
        for (sum, value) in sums.iter_mut().zip([1.0, pattern, light, pattern * pattern, pattern * light]) {
            *sum += value;
        }
    }
}

/// How strong the dots are, in cells of an image; it changes evenly from one cell's middle to the next one's.
struct Contrast {
    columns: usize,
    rows: usize,
    values: Vec<f32>,
}

impl Contrast {
    /// The dots' light in an image where it is `known`, and 0 where it is not; 1 is that of no dots.
    fn expected(&self, known: &Image<f32>, pattern: &Image<f32>) -> Image<f32> {
        let (width, height) = known.size();
        let columns: Vec<_> = (0..width).map(|x| between(x, self.columns)).collect();
        let mut expected = Vec::with_capacity(width * height);
        for y in 0..height {
            let (top, bottom, down) = between(y, self.rows);
            let (top, bottom) = (&self.values[top * self.columns..], &self.values[bottom * self.columns..]);
            let pixels = columns.iter().zip(known.row(y)).zip(pattern.row(y));
            expected.extend(pixels.map(|((&(left, right, across), &known), &pattern)| {
                let along = |row: &[f32]| row[left] + across * (row[right] - row[left]);
                let contrast = along(top) + down * (along(bottom) - along(top));
                if known > 0.0 { (1.0 + contrast * (pattern - 1.0)).max(0.0) } else { 0.0 }
            }));
        }
        Image::from_pixels(width, height, expected).expect("same size in and out")
    }
}

/// The two of `count` cells between whose middles a pixel lies, and how far from the first to the second.
fn between(pixel: usize, count: usize) -> (usize, usize, f32) {
    let at = ((pixel as f32 + 0.5) / CELL as f32 - 0.5).clamp(0.0, (count - 1) as f32);
    let first = (at as usize).min(count.saturating_sub(2));
    (first, (first + 1).min(count - 1), at - first as f32)
}

#[cfg(test)]
mod tests;
