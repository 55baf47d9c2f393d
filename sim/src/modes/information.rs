//! How much of an instant's images says something about the world.
//!
//! Contrast free of noise is had without an image free of noise: where the chip's noise is known, a contrast of 3 σ makes a
//! block's variance ten times the noise's own, and 64 pixels tell a variance to 18 %.

use sunblind_estimator::Mode;
use sunblind_estimator::camera::DepthCamera;
use sunblind_estimator::image::{DepthImage, Image, InfraredImage, RgbImage};
use sunblind_estimator::mode::{Class, RULES};
use sunblind_estimator::structure::DepthNoise;

use crate::render::{ColourSensor, InfraredSensor};
use crate::world::material::substance::linear;

/// Edge of the blocks in which contrast is judged, pixels: about what a small feature covers.
const BLOCK: usize = 8;
/// Contrast that counts, in standard deviations of the noise.
const CONTRAST_SIGMAS: f64 = 3.0;
/// Error up to which depth is right, in standard deviations.
const DEPTH_SIGMAS: f64 = 3.0;
/// Every how manieth pixel, across and down, has its depth compared.
pub const DEPTH_STEP: usize = 8;

/// Share of colour's blocks with contrast that is enough. A guess, made by looking at what places hold: lit rooms 30 % and
/// more, the mouth of an unlit tunnel 8 to 13 %, its depth 2 to 6 %, street lamps at night 2 to 4 %.
const ENOUGH_COLOUR: f64 = 0.07;
/// The same of infrared's. A guess: where dots or daylight are seen there are 20 % and more, in a white image none.
const ENOUGH_INFRARED: f64 = 0.05;
/// Share of depth's pixels with the true depth that is enough: by definition.
const ENOUGH_DEPTH: f64 = 0.3;

/// Largest value of an infrared pixel, which says no more than that there was too much light.
const INFRARED_FULL_SCALE: u16 = 1023;

/// The images of one instant, and what made them.
pub struct Seen<'a> {
    /// Colour.
    pub rgb: &'a RgbImage,
    /// Infrared, 10 bits.
    pub infrared: &'a InfraredImage,
    /// Depth, in the device's own numbers.
    pub depth: &'a DepthImage,
    /// The chips as they were, colour's and infrared's.
    pub chips: (ColourSensor, InfraredSensor),
    /// How the device is truly built.
    pub depth_camera: &'a DepthCamera,
    /// z in metres of every [`DEPTH_STEP`]th pixel of the depth image.
    pub true_depth: &'a Image<f32>,
}

/// Shares of an instant's images that say something, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Information {
    /// Of colour's blocks of 8 × 8 pixels, those with contrast.
    pub rgb: f64,
    /// Of infrared's, likewise.
    pub infrared: f64,
    /// Of depth's pixels, those with the true depth.
    pub depth: f64,
}

impl Information {
    /// What there is in the images.
    pub fn of(seen: &Seen) -> Self {
        Self {
            rgb: of_colour(seen.rgb, &seen.chips.0),
            infrared: of_infrared(seen.infrared, &seen.chips.1),
            depth: of_depth(seen.depth, seen.depth_camera, seen.true_depth),
        }
    }

    /// Which of colour, infrared and depth hold enough.
    pub fn informed(&self) -> [bool; 3] {
        [self.rgb >= ENOUGH_COLOUR, self.infrared >= ENOUGH_INFRARED, self.depth >= ENOUGH_DEPTH]
    }

    /// The mode that the paper's rules have for it.
    pub fn best_mode(&self) -> Mode {
        let classes = self.informed().map(|is_high| if is_high { Class::High } else { Class::Low });
        let rule = RULES.into_iter().find(|(conditions, _)| *conditions == classes);
        rule.expect("the rules have every combination").1
    }
}

/// By green, which every pixel has of its own.
fn of_colour(image: &RgbImage, chip: &ColourSensor) -> f64 {
    let linear: [f64; 256] = std::array::from_fn(|level| f64::from(linear(level as f32 / 255.0)));
    let per_electron = f64::from(chip.level_per_electron.y);
    let noise = |level: f64| {
        let step = 255_f64.recip() * slope_of_linear(level);
        electrons_squared(level / per_electron, chip.shot_noise, chip.read_variance) * per_electron.powi(2)
            + step * step / 12.0
    };
    share_with_contrast(image, |[_, green, _]| (green < u8::MAX).then(|| linear[usize::from(green)]), noise)
}

fn of_infrared(image: &InfraredImage, chip: &InfraredSensor) -> f64 {
    let per_electron = f64::from(chip.numbers_per_electron);
    let noise = |number: f64| {
        electrons_squared(number / per_electron, chip.shot_noise, chip.read_variance) * per_electron.powi(2)
            + 1.0 / 12.0
    };
    share_with_contrast(image, |number| (number < INFRARED_FULL_SCALE).then_some(f64::from(number)), noise)
}

/// Against the published noise of a Kinect's depth.
fn of_depth(image: &DepthImage, camera: &DepthCamera, truth: &Image<f32>) -> f64 {
    let axial = DepthNoise::default().axial;
    let is_right = |(index, &true_z): (usize, &f32)| {
        let (x, y) = (index % truth.width() * DEPTH_STEP, index / truth.width() * DEPTH_STEP);
        let true_z = f64::from(true_z);
        let limit = DEPTH_SIGMAS * axial * true_z * true_z;
        // Of nothing, nothing is right.
        limit.is_finite() && camera.depth_of(image.at(x, y)).is_some_and(|z| (z - true_z).abs() <= limit)
    };
    let right = truth.pixels().iter().enumerate().filter(|pixel| is_right(*pixel)).count();
    right as f64 / truth.pixels().len().max(1) as f64
}

/// Variance of a chip's noise at a brightness, in electrons.
fn electrons_squared(electrons: f64, shot_noise: f32, read_variance: f32) -> f64 {
    f64::from(shot_noise) * electrons + f64::from(read_variance)
}

/// Share of the whole blocks of an image whose values scatter by more than noise makes them, by [`CONTRAST_SIGMAS`].
/// `value` is `None` of a saturated pixel, `noise` the variance at a brightness. A block that is saturated for the better
/// part has no contrast.
fn share_with_contrast<P: Copy>(image: &Image<P>, value: impl Fn(P) -> Option<f64>, noise: impl Fn(f64) -> f64) -> f64 {
    let (columns, rows) = (image.width() / BLOCK, image.height() / BLOCK);
    let mut with_contrast = 0;
    // Of each block in a row of them: how many values, their sum, the sum of their squares.
    let mut sums = vec![(0_u32, 0.0, 0.0); columns];
    for row in 0..rows {
        sums.fill((0, 0.0, 0.0));
        for y in row * BLOCK..(row + 1) * BLOCK {
            for (block, (count, sum, squares)) in image.row(y).chunks_exact(BLOCK).zip(&mut sums) {
                for value in block.iter().filter_map(|&pixel| value(pixel)) {
                    *count += 1;
                    *sum += value;
                    *squares += value * value;
                }
            }
        }
        let has_contrast = |&&(count, sum, squares): &&(u32, f64, f64)| {
            let count = f64::from(count);
            let mean = sum / count;
            let variance = (squares - sum * mean) / (count - 1.0);
            2.0 * count >= (BLOCK * BLOCK) as f64 && variance > (1.0 + CONTRAST_SIGMAS.powi(2)) * noise(mean)
        };
        with_contrast += sums.iter().filter(has_contrast).count();
    }
    with_contrast as f64 / (columns * rows).max(1) as f64
}

/// How fast sRGB's linear level grows with the encoded one (IEC 61966-2-1), at a linear level.
fn slope_of_linear(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92_f64.recip() } else { 2.4 / 1.055 * linear.powf(1.4 / 2.4) }
}

#[cfg(test)]
mod tests;
