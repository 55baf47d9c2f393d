//! A Kinect on a test bench, walls to look at, and what is measured of them.

use glam::{DAffine3, DVec3};
use nalgebra::Isometry3;
use sunblind_estimator::camera::DepthCamera;
use sunblind_estimator::image::Image;

use super::scene::{self, Light, even, looking_north, object, turned_wall};
use super::statistics::spread;
use crate::kinect::calibration::Calibration;
use crate::kinect::matcher::NO_DEPTH;
use crate::kinect::{Imaging, Kinect, KinectFrame};
use crate::render::{RenderError, Sweep};
use crate::world::World;

/// b·f of the nominal unit, m·px (75 mm, 580 px).
pub const BASELINE_FOCAL: f64 = 43.5;
/// From one wall of a gallery to the next, metres: no view shows two.
const SPACING: f32 = 70.0;

/// A wall to look at.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    /// Straight ahead of the bench, metres.
    pub distance: f32,
    /// Between its normal and the view, degrees.
    pub angle: f32,
    /// At 830 nm.
    pub albedo: f32,
    /// On it.
    pub light: Light,
}

impl Wall {
    /// Facing, of white paint, in an office.
    pub fn at(distance: f32) -> Self {
        Self { distance, angle: 0.0, albedo: 0.8, light: Light::LED }
    }
}

/// A world of walls far from each other.
pub fn gallery(walls: &[Wall]) -> World {
    let materials = walls.iter().map(|wall| even("paint", [200, 200, 200], wall.albedo)).collect();
    let objects = walls.iter().enumerate().map(|(number, wall)| {
        let mut mesh = turned_wall(wall.distance, wall.angle.to_radians(), wall.light);
        mesh.positions.iter_mut().for_each(|position| position[0] += SPACING * number as f32);
        object("wall", mesh, number)
    });
    scene::world("gallery", objects.collect(), materials)
}

/// The device, and how much it has seen so far.
pub struct Bench {
    kinect: Kinect,
    camera: DepthCamera,
    frames: u64,
}

/// One frame, and the truth.
pub struct Seen {
    /// What the device gives out.
    pub frame: KinectFrame,
    /// True depth, metres.
    pub truth: Image<f32>,
    camera: DepthCamera,
}

impl Bench {
    /// The nominal unit in a world.
    ///
    /// # Errors
    /// No graphics adapter.
    pub fn new(world: &World) -> Result<Self, RenderError> {
        Self::with(world, Imaging::default())
    }

    /// As [`new`](Self::new), with other imperfections.
    ///
    /// # Errors
    /// No graphics adapter.
    pub fn with(world: &World, imaging: Imaging) -> Result<Self, RenderError> {
        let kinect = Kinect::new(world, Calibration::nominal(), imaging, 1)?;
        let camera = kinect.calibration().rig(Isometry3::identity()).depth;
        Ok(Self { kinect, camera, frames: 0 })
    }

    /// What is seen from the origin, exposures settled.
    ///
    /// # Errors
    /// The graphics adapter stopped working, as below.
    pub fn look(&mut self) -> Result<Seen, RenderError> {
        self.look_from(looking_north())
    }

    /// What is seen of a gallery's wall.
    ///
    /// # Errors
    /// As [`look`](Self::look).
    pub fn look_at(&mut self, number: usize) -> Result<Seen, RenderError> {
        let place = DAffine3::from_translation(DVec3::X * f64::from(SPACING) * number as f64);
        self.look_from(place * looking_north())
    }

    /// What is seen of each wall of a gallery.
    ///
    /// # Errors
    /// As [`look`](Self::look).
    pub fn look_at_all(walls: &[Wall]) -> Result<Vec<Seen>, RenderError> {
        let mut bench = Self::new(&gallery(walls))?;
        (0..walls.len()).map(|number| bench.look_at(number)).collect()
    }

    /// What is seen from a place, the device at rest (`world_from_infrared`).
    ///
    /// # Errors
    /// As [`look`](Self::look).
    pub fn look_from(&mut self, world_from_infrared: DAffine3) -> Result<Seen, RenderError> {
        self.look_along(&Sweep::still(world_from_infrared))
    }

    /// What is seen on the move, exposures settled.
    ///
    /// # Errors
    /// As [`look`](Self::look).
    pub fn look_along(&mut self, world_from_infrared: &Sweep) -> Result<Seen, RenderError> {
        self.kinect.restart();
        self.frames += 1;
        let frame = self.kinect.capture(world_from_infrared, self.frames)?;
        Ok(Seen { frame, truth: self.kinect.true_depth()?, camera: self.camera })
    }
}

/// What the device says of some pixels, and what is true.
pub struct Sample {
    /// Metres, measured and true, of those that have depth.
    pub depths: Vec<[f64; 2]>,
    /// Share of all that have.
    pub valid: f64,
}

impl Seen {
    /// What a pixel says, metres.
    pub fn depth(&self, x: usize, y: usize) -> Option<f64> {
        self.camera.depth_of(self.frame.depth_raw.at(x, y))
    }

    /// What is true of it, metres.
    pub fn true_depth(&self, x: usize, y: usize) -> f64 {
        f64::from(self.truth.at(x, y))
    }

    /// The image's middle, where depth is `z` metres, give or take 5 %: no border of the pattern or the image.
    pub fn about(&self, z: f64) -> Sample {
        let pixels = (120..360).flat_map(|y| (80..560).map(move |x| (x, y)));
        let near: Vec<_> = pixels.filter(|&(x, y)| (self.true_depth(x, y) / z - 1.0).abs() < 0.05).collect();
        let depths: Vec<_> =
            near.iter().filter_map(|&(x, y)| Some([self.depth(x, y)?, self.true_depth(x, y)])).collect();
        Sample { valid: depths.len() as f64 / near.len() as f64, depths }
    }

    /// Share of the interior's pixels (no dead border) that have depth.
    pub fn valid(&self) -> f64 {
        let raw = (8..472).flat_map(|y| &self.frame.depth_raw.row(y)[24..616]);
        raw.clone().filter(|raw| **raw != NO_DEPTH).count() as f64 / raw.count() as f64
    }

    /// Share of the infrared image's pixels at full scale.
    pub fn saturated(&self) -> f64 {
        let pixels = self.frame.infrared.pixels();
        pixels.iter().filter(|number| **number == 1023).count() as f64 / pixels.len() as f64
    }
}

impl Sample {
    /// Spread of the error about its mean, millimetres, of the pixels that are not wrong.
    pub fn noise(&self) -> f64 {
        let right = self.depths.iter().filter(|pair| !is_wrong(pair));
        spread(&right.map(|[measured, truth]| 1000.0 * (measured - truth)).collect::<Vec<_>>())
    }

    /// Share of the pixels with depth that are wrong.
    pub fn wrong(&self) -> f64 {
        self.depths.iter().filter(|pair| is_wrong(pair)).count() as f64 / self.depths.len() as f64
    }
}

/// Measured and true depth differ by more than a pixel of disparity: another place was matched.
fn is_wrong([measured, truth]: &[f64; 2]) -> bool {
    BASELINE_FOCAL * (1.0 / measured - 1.0 / truth).abs() > 1.0
}
