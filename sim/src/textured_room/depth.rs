//! The depth camera: geometry, plus the errors a Kinect's disparity is known for.
//!
//! A shortcut, **not the Kinect synthesis**: the real device finds depth by matching its dots in the infrared image,
//! where shadow, drop-out and noise come about by themselves. Here each is put on from published numbers.

use glam::Vec3A;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use sunblind_estimator::camera::CameraModel;
use sunblind_estimator::image::{DepthImage, Image};

use super::lens::Lens;
use super::lit_scene::Pose;
use super::noise::smoothstep;
use super::rig::{BASELINE, UNITS_PER_METRE};
use super::scene::Scene;
use super::solid::Ray;

/// Steps of disparity in a pixel (ROS `kinect_calibration/technical`; confirmed on TUM's frames).
pub const STEPS_PER_PIXEL: f32 = 8.0;
/// Standard deviation of disparity, pixels, before rounding. With the rounding it gives the 1.4e-3 z² of
/// Khoshelham & Elberink 2012.
const DISPARITY_NOISE: f32 = 0.07;
/// Least and greatest depth, metres; nearer the device finds nothing, further its steps are decimetres.
const RANGE: std::ops::RangeInclusive<f32> = 0.45..=8.0;
/// Columns without value at the right border (OpenNI's drivers; the search window leaves the reference there).
const BLIND_COLUMNS: usize = 8;
/// Angles of incidence between which dots get lost, as cosines: 72° and 84° (estimate: stretched dots fail from 75°).
const GRAZING: [f32; 2] = [0.31, 0.10];
/// Neighbouring disparities further apart than this are an edge, pixels.
const EDGE: f32 = 1.0;
/// Edges follow the dots around them: blocks of this many pixels are moved together, by up to as many as `RAGGED`.
const BLOCK: usize = 3;
/// See [`BLOCK`]; the estimate for a 9 × 9 window is 2–4.
const RAGGED: i32 = 2;

/// The depth camera of the simulated device.
pub struct DepthSensor {
    lens: Lens,
    model: CameraModel,
}

impl DepthSensor {
    /// A sensor with the optics of a model.
    pub fn new(model: &CameraModel) -> Self {
        Self { lens: Lens::new(model), model: *model }
    }

    /// Takes a depth image; no `noise`: disparity is exact but for its rounding, and no dot gets lost.
    pub fn shoot(&self, scene: &Scene, pose: &Pose, noise: Option<ChaCha8Rng>) -> DepthImage {
        let mut disparity = self.disparity(scene, pose);
        if let Some(mut noise) = noise {
            disparity = self.disturbed(&disparity, &mut noise);
        }
        let (width, height) = self.model.size();
        let values = disparity.iter().enumerate().map(|(pixel, seen)| {
            let steps = (seen.disparity * STEPS_PER_PIXEL).round();
            let depth = STEPS_PER_PIXEL * self.focal_baseline() / steps;
            let is_seen = steps > 0.0 && RANGE.contains(&depth) && pixel % width < width - BLIND_COLUMNS;
            if is_seen { (depth * UNITS_PER_METRE as f32).round() as u16 } else { 0 }
        });
        // One value a pixel of the lens.
        Image::from_pixels(width, height, values.collect()).unwrap_or_else(|| Image::filled(width, height, 0))
    }

    /// Focal length times baseline, pixel metres: disparity is this over Z.
    fn focal_baseline(&self) -> f32 {
        (self.model.fx * BASELINE) as f32
    }

    /// What an ideal device would see.
    fn disparity(&self, scene: &Scene, pose: &Pose) -> Vec<Dot> {
        let (width, height) = self.model.size();
        let mut dots = vec![Dot::NONE; width * height];
        let projector = pose.position + pose.rotation * (Vec3A::X * BASELINE as f32);
        let solids = scene.solids();
        self.lens.by_tiles(scene, &[*pose], BASELINE as f32, |pixels, candidates| {
            let mut guess = 0;
            for &pixel in pixels {
                let ray = Ray { origin: pose.position, direction: pose.rotation * self.lens.ray(pixel) };
                let hit = candidates.first_hit_near(&ray, guess);
                guess = hit.solid;
                let solid = &solids[hit.solid];
                let point = ray.at(hit.t);
                let normal = solid.normal(hit.face, point);
                let to_projector = projector - point;
                let facing = normal.dot(to_projector) / to_projector.length();
                let is_lit = facing > 0.0
                    && solid.material(hit.face).returns_dots()
                    && !candidates.is_blocked(&Ray { origin: point, direction: to_projector }, hit.solid);
                if is_lit {
                    // The ray has z = 1, so t is Z.
                    dots[pixel] = Dot { disparity: self.focal_baseline() / hit.t, facing };
                }
            }
        });
        dots
    }

    /// Ragged edges, drop-outs and noise.
    fn disturbed(&self, exact: &[Dot], noise: &mut ChaCha8Rng) -> Vec<Dot> {
        let (width, height) = self.model.size();
        let blocks_across = width.div_ceil(BLOCK);
        let blocks: Vec<(i32, i32, f32)> = (0..blocks_across * height.div_ceil(BLOCK))
            .map(|_| (noise.random_range(-RAGGED..=RAGGED), noise.random_range(-RAGGED..=RAGGED), noise.random()))
            .collect();
        let disturb = |(pixel, own): (usize, &Dot)| {
            let (x, y) = (pixel % width, pixel / width);
            let (dx, dy, luck) = blocks[y / BLOCK * blocks_across + x / BLOCK];
            let (from_x, from_y) = (x.saturating_add_signed(dx as isize), y.saturating_add_signed(dy as isize));
            let other = exact[from_y.min(height - 1) * width + from_x.min(width - 1)];
            let dot = if (other.disparity - own.disparity).abs() > EDGE { other } else { *own };
            let normal: f32 = StandardNormal.sample(noise);
            if dot.disparity == 0.0 || luck < smoothstep(-GRAZING[0], -GRAZING[1], -dot.facing) {
                return Dot::NONE;
            }
            Dot { disparity: dot.disparity + DISPARITY_NOISE * normal, ..dot }
        };
        exact.iter().enumerate().map(disturb).collect()
    }
}

/// What a pixel sees of the projected dots.
#[derive(Clone, Copy, Debug)]
struct Dot {
    /// Pixels, against infinity; 0 where no dot comes back.
    disparity: f32,
    /// Cosine of the angle at which the projector's light arrives.
    facing: f32,
}

impl Dot {
    const NONE: Self = Self { disparity: 0.0, facing: 0.0 };
}
