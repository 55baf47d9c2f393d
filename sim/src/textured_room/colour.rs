//! The colour camera: light through a lens onto a Bayer mosaic, its noise, and the picture made of it.

use glam::{Vec2, Vec3A};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use sunblind_estimator::camera::CameraModel;
use sunblind_estimator::image::{Image, RgbImage};

use super::lens::Lens;
use super::lit_scene::{LitScene, Pose};
use super::solid::Ray;

/// A sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Pixels from the centre.
    offset: Vec2,
    /// When, in exposures from its middle.
    pub when: f64,
}

const fn sample(x: f32, y: f32, when: f64) -> Sample {
    Sample { offset: Vec2::new(x, y), when }
}

/// A rotated grid, which smooths edges of every direction, a little wider than the pixel, as a lens blurs. The first
/// two alone have the mean and about the spread of a whole exposure.
pub const SAMPLES: [Sample; 4] =
    [sample(-0.3, -0.6, -0.3), sample(0.3, 0.6, 0.3), sample(0.6, -0.3, -0.1), sample(-0.6, 0.3, 0.1)];
/// Width of a sample in pixels: what lies between two samples is not to be missed.
const SAMPLE_WIDTH: f64 = 1.1;
/// Two samples further apart than this show as a double image, pixels.
const DOUBLE: f32 = 1.5;
/// What a full pixel holds at the gain an indoor picture needs, electrons: a guess at gain 16 of a sensor with a full
/// well of 25,000.
const FULL: f32 = 1500.0;
/// Read noise as a share of full: 7 electrons.
const READ_NOISE: f32 = 7.0 / FULL;
/// Loss in the corners: half of what cos⁴ of a simple lens would be.
const VIGNETTING: f32 = 0.5;
/// Brightness to share of full, before the tone curve; chosen by eye.
const EXPOSURE: f32 = 1.15;

/// The colour camera of the simulated device.
pub struct ColourCamera {
    lens: Lens,
    width: usize,
    height: usize,
    /// Radians a sample is wide.
    sample_angle: f32,
    pixels_per_unit: Vec2,
    tone: Vec<u8>,
}

impl ColourCamera {
    /// A camera of a model.
    pub fn new(model: &CameraModel) -> Self {
        Self {
            lens: Lens::new(model),
            width: model.width,
            height: model.height,
            sample_angle: (SAMPLE_WIDTH / model.fx) as f32,
            pixels_per_unit: Vec2::new(model.fx as f32, model.fy as f32),
            tone: (0..4096).map(tone).collect(),
        }
    }

    /// Takes a picture. `poses` are the camera's during the exposure, one a sample; no `noise`: an ideal sensor.
    pub fn shoot(&self, scene: &LitScene, poses: &[Pose; 4], noise: Option<ChaCha8Rng>) -> RgbImage {
        let is_steady = self.smear(&poses[0], &poses[1]) < DOUBLE;
        let mut mosaic = vec![0.0; self.width * self.height];
        self.lens.by_tiles(scene.geometry(), poses, 0.0, |pixels, candidates| {
            let mut guess = 0;
            for &pixel in pixels {
                let centre = self.lens.ray(pixel);
                let mut look = |sample: usize| {
                    let offset = SAMPLES[sample].offset / self.pixels_per_unit;
                    let pose = &poses[sample];
                    let ray = Ray {
                        origin: pose.position,
                        direction: pose.rotation * (centre + Vec3A::new(offset.x, offset.y, 0.0)),
                    };
                    let hit = candidates.first_hit_near(&ray, guess);
                    guess = hit.solid;
                    (scene.colour(&ray, &hit, self.sample_angle), (hit.solid, hit.face))
                };
                let (first, second) = (look(0), look(1));
                // Where both see the same face there is no edge to smooth, and close together they leave no double image.
                let light = match is_steady && first.1 == second.1 {
                    true => (first.0 + second.0) / 2.0,
                    false => (first.0 + second.0 + look(2).0 + look(3).0) / 4.0,
                };
                let cos_squared = 1.0 / centre.length_squared();
                let vignette = 1.0 - VIGNETTING * (1.0 - cos_squared * cos_squared);
                let site = channel(pixel % self.width, pixel / self.width);
                mosaic[pixel] = light[site] * vignette * EXPOSURE;
            }
        });
        if let Some(mut noise) = noise {
            for value in &mut mosaic {
                let normal: f32 = StandardNormal.sample(&mut noise);
                *value += normal * (value.max(0.0) / FULL + READ_NOISE * READ_NOISE).sqrt();
            }
        }
        self.develop(&mosaic)
    }

    /// By how many pixels the picture's corner moves from one pose to the other, far away.
    fn smear(&self, from: &Pose, to: &Pose) -> f32 {
        let corner = self.lens.ray(0);
        (from.rotation * corner).distance(to.rotation * corner) * self.pixels_per_unit.x
    }

    /// Fills in the two colours each photosite lacks from its neighbours, and applies the tone curve.
    fn develop(&self, mosaic: &[f32]) -> RgbImage {
        let mut image = Image::filled(self.width, self.height, [0; 3]);
        let tone = |value: f32| self.tone[((value.clamp(0.0, 1.0)).sqrt() * 4095.0) as usize];
        for (y, row) in image.pixels_mut().chunks_exact_mut(self.width).enumerate() {
            // Mirrored at the border, which keeps the mosaic's order.
            let above = if y == 0 { 1 } else { y - 1 } * self.width;
            let below = if y + 1 == self.height { y - 1 } else { y + 1 } * self.width;
            let here = y * self.width;
            for (x, pixel) in row.iter_mut().enumerate() {
                let left = if x == 0 { 1 } else { x - 1 };
                let right = if x + 1 == self.width { x - 1 } else { x + 1 };
                let own = mosaic[here + x];
                let level = (mosaic[here + left] + mosaic[here + right]) / 2.0;
                let upright = (mosaic[above + x] + mosaic[below + x]) / 2.0;
                let diagonal =
                    (mosaic[above + left] + mosaic[above + right] + mosaic[below + left] + mosaic[below + right]) / 4.0;
                let rgb = match (y % 2, x % 2) {
                    (0, 0) => [level, own, upright],
                    (0, _) => [own, (level + upright) / 2.0, diagonal],
                    (_, 0) => [diagonal, (level + upright) / 2.0, own],
                    _ => [upright, own, level],
                };
                *pixel = rgb.map(tone);
            }
        }
        image
    }
}

/// The colour a photosite sees: 0 red, 1 green, 2 blue; the Kinect's mosaic is G R / B G (libfreenect).
fn channel(x: usize, y: usize) -> usize {
    match (y % 2, x % 2) {
        (0, 1) => 0,
        (1, 0) => 2,
        _ => 1,
    }
}

/// From the square root of the light, in 4096 steps, to 8 bits: the sRGB curve (IEC 61966-2-1) over a soft shoulder.
fn tone(step: usize) -> u8 {
    let light = (step as f32 / 4095.0).powi(2);
    let shown = (1.0 - (-1.7 * light).exp()) / (1.0 - (-1.7_f32).exp());
    let encoded = if shown <= 0.003_130_8 { 12.92 * shown } else { 1.055 * shown.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}
