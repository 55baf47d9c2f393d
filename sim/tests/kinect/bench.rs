//! A Kinect on a test bench, walls to look at, and a table of what is measured.

use std::ops::RangeInclusive;

use glam::{DAffine3, DVec3};
use nalgebra::Isometry3;
use sunblind_estimator::camera::DepthCamera;
use sunblind_estimator::image::Image;
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::matcher::NO_DEPTH;
use sunblind_sim::kinect::{Imaging, Kinect, KinectFrame};
use sunblind_sim::render::Sweep;
use sunblind_sim::world::World;

use crate::scene::{self, Light, even, looking_north, object, turned_wall};

/// b·f of the nominal unit, m·px (75 mm, 580 px).
pub const BASELINE_FOCAL: f64 = 43.5;
/// From one wall of a gallery to the next, metres: no view shows two.
const SPACING: f32 = 70.0;

/// A wall to look at.
#[derive(Clone, Copy)]
pub struct Wall {
    /// Straight ahead of the bench, metres.
    pub distance: f32,
    /// Between its normal and the view, degrees.
    pub angle: f32,
    /// At 830 nm.
    pub albedo: f32,
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

/// The device, and what it has seen so far.
pub struct Bench {
    kinect: Kinect,
    camera: DepthCamera,
    frames: u64,
}

/// One frame, and the truth.
pub struct Seen {
    pub frame: KinectFrame,
    pub truth: Image<f32>,
    camera: DepthCamera,
}

impl Bench {
    pub fn new(world: &World) -> Self {
        let kinect = Kinect::new(world, Calibration::nominal(), Imaging::default(), 1).expect("a graphics adapter");
        let camera = kinect.calibration().rig(Isometry3::identity()).depth;
        Self { kinect, camera, frames: 0 }
    }

    /// What is seen from the origin, exposures settled.
    pub fn look(&mut self) -> Seen {
        self.look_from(looking_north())
    }

    /// What is seen of a gallery's wall.
    pub fn look_at(&mut self, number: usize) -> Seen {
        let place = DAffine3::from_translation(DVec3::X * f64::from(SPACING) * number as f64);
        self.look_from(place * looking_north())
    }

    fn look_from(&mut self, world_from_infrared: DAffine3) -> Seen {
        self.kinect.restart();
        self.frames += 1;
        let frame = self.kinect.capture(&Sweep::still(world_from_infrared), self.frames).expect("a frame");
        Seen { frame, truth: self.kinect.true_depth().expect("true depth"), camera: self.camera }
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
    pub fn depth(&self, x: usize, y: usize) -> Option<f64> {
        self.camera.depth_of(self.frame.depth_raw.at(x, y))
    }

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

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub fn spread(values: &[f64]) -> f64 {
    let middle = mean(values);
    (values.iter().map(|value| (value - middle).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

/// The line through points (x, y) with least squares: intercept and slope.
pub fn line(points: &[[f64; 2]]) -> [f64; 2] {
    let of = |axis: usize| points.iter().map(|point| point[axis]).collect::<Vec<_>>();
    let [x, y] = [mean(&of(0)), mean(&of(1))];
    let products: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    let squares: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    [y - products / squares * x, products / squares]
}

/// Everything measured in a test; what is not accepted fails when all is printed.
#[derive(Default)]
pub struct Report {
    failures: Vec<String>,
}

impl Report {
    /// `what` names the unit; `target` is the published figure, `accepted` what passes for it.
    pub fn expect(&mut self, what: &str, target: f64, accepted: RangeInclusive<f64>, measured: f64) {
        let (low, high) = (accepted.start(), accepted.end());
        let line =
            format!("{what:<52} target {target:10.5}  accepted {low:10.5} to {high:10.5}  measured {measured:10.5}");
        println!("{line}");
        if !accepted.contains(&measured) {
            self.failures.push(line);
        }
    }

    pub fn finish(self) {
        assert!(self.failures.is_empty(), "not as published:\n{}", self.failures.join("\n"));
    }
}
