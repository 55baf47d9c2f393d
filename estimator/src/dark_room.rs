//! Walls in the dark, for tests: what an infrared camera sees of them by the dots of the projector beside it, and the
//! depth that goes with that.

use std::sync::LazyLock;

use nalgebra::{Isometry3, Point2, Point3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::camera::{CameraModel, DepthCamera, DepthEncoding, Rig};
use crate::image::{DepthImage, Image, InfraredImage};

pub const WIDTH: usize = 640;
pub const HEIGHT: usize = 480;
const FOCAL: f64 = 580.0;
const BASELINE: f64 = 0.075;
const OFFSET: f64 = 1090.0;
/// Radius of a dot, pixels, and its brightness at 1 m on white, numbers.
const DOT_RADIUS: f64 = 0.65;
const DOT_PEAK: f64 = 1500.0;
const SPECKLE: f64 = 0.14;
/// A number's worth of electrons, and read noise in electrons.
const ELECTRONS: f64 = 7.7;
const READ_NOISE: f64 = 24.0;
/// Spread of a raw depth value about its exact one, before it is rounded.
const RAW_NOISE: f64 = 0.4;

/// A plane n·p = d in the world.
#[derive(Clone, Copy)]
pub struct Wall {
    pub normal: Vector3<f64>,
    pub distance: f64,
    /// Otherwise it is grey all over.
    pub is_textured: bool,
}

pub struct DarkRoom {
    pub walls: Vec<Wall>,
    /// Ambient light at 830 nm; 1 is a dot's peak at 1 m.
    pub ambient: f64,
}

/// One instant.
pub struct Seen {
    pub infrared: InfraredImage,
    pub depth: DepthImage,
    /// What the surfaces truly reflect, pixel by pixel.
    pub albedo: Image<f32>,
}

/// Cameras that coincide, on a robot that is one of them; depth is the Kinect's raw disparity.
pub fn rig() -> Rig {
    let mut rig = Rig::kinect_default();
    (rig.colour.fx, rig.colour.fy) = (FOCAL, FOCAL);
    rig.depth = DepthCamera {
        model: rig.colour,
        encoding: DepthEncoding::KinectDisparity { offset: OFFSET, baseline: BASELINE },
        registered_to_colour: false,
    };
    rig
}

impl DarkRoom {
    pub fn seen_from(&self, world_from_camera: &Isometry3<f64>, seed: u64) -> Seen {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let camera = rig().depth.model;
        let mut infrared = InfraredImage::filled(WIDTH, HEIGHT, 0);
        let mut depth = DepthImage::filled(WIDTH, HEIGHT, 2047);
        let mut albedo = Image::filled(WIDTH, HEIGHT, 0.0);
        for index in 0..WIDTH * HEIGHT {
            let (x, y) = ((index % WIDTH) as f64, (index / WIDTH) as f64);
            let ray = camera.ray(&Point2::new(x, y));
            let Some((z, reflected, facing)) = self.meet(world_from_camera, &ray) else { continue };
            let disparity = FOCAL * BASELINE / z;
            let dots =
                PATTERN.at(x - disparity, index / WIDTH) * (1.0 + SPECKLE * normal()).max(0.0) * facing / (z * z);
            let electrons = ELECTRONS * DOT_PEAK * reflected * (dots + self.ambient);
            let noise = (electrons + READ_NOISE * READ_NOISE).sqrt() * normal();
            infrared.pixels_mut()[index] = ((electrons + noise) / ELECTRONS).round().clamp(0.0, 1023.0) as u16;
            let raw = (OFFSET - 8.0 * disparity + RAW_NOISE * normal()).round();
            // The device sees from 0.5 to some 6 m.
            if (0.5..6.0).contains(&z) {
                depth.pixels_mut()[index] = raw as u16;
            }
            albedo.pixels_mut()[index] = reflected as f32;
        }
        Seen { infrared, depth, albedo }
    }

    /// What the surfaces reflect where any camera looks; a pixel is the mean of four places in it.
    pub fn albedo(&self, camera: &CameraModel, world_from_camera: &Isometry3<f64>) -> Image<f32> {
        let pixel = |index: usize| {
            let place = |k: usize| {
                let (x, y) = ((index % camera.width) as f64, (index / camera.width) as f64);
                let pixel = Point2::new(x - 0.25 + 0.5 * (k % 2) as f64, y - 0.25 + 0.5 * (k / 2) as f64);
                self.meet(world_from_camera, &camera.ray(&pixel)).map_or(0.0, |(_, reflected, _)| reflected)
            };
            ((0..4).map(place).sum::<f64>() / 4.0) as f32
        };
        let pixels = (0..camera.width * camera.height).map(pixel).collect();
        Image::from_pixels(camera.width, camera.height, pixels).expect("one value a pixel")
    }

    /// Z, albedo and cosine of incidence where a ray through the camera meets the nearest wall.
    fn meet(&self, world_from_camera: &Isometry3<f64>, ray: &Vector3<f64>) -> Option<(f64, f64, f64)> {
        let direction = world_from_camera.rotation * ray;
        let origin = world_from_camera.translation.vector;
        let hits = self.walls.iter().enumerate().filter_map(|(number, wall)| {
            let slope = wall.normal.dot(&direction);
            let z = (wall.distance - wall.normal.dot(&origin)) / slope;
            (z > 0.0 && z.is_finite()).then(|| (z, number, slope.abs() / direction.norm()))
        });
        let (z, number, facing) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let wall = &self.walls[number];
        if !wall.is_textured {
            return Some((z, 0.4, facing));
        }
        // Two directions along the wall.
        let across = wall.normal.cross(&Vector3::new(0.3, 0.5, 0.8)).normalize();
        let along = wall.normal.cross(&across);
        let point = Point3::from(origin + direction * z).coords;
        Some((z, texture(across.dot(&point), along.dot(&point), number as u64), facing))
    }
}

/// The projector's light along the rows of an image of its own, in steps of a quarter of a pixel.
struct Pattern(Vec<f32>);

/// Columns to the left of the image: disparity at 0.4 m.
const MARGIN: usize = 110;
const STEPS: usize = 4;
const LENGTH: usize = (WIDTH + MARGIN) * STEPS;

static PATTERN: LazyLock<Pattern> = LazyLock::new(|| {
    let column = |step: usize| step as f64 / STEPS as f64 - MARGIN as f64;
    let row = |y: usize| (0..LENGTH).map(move |step| dots(column(step), y as f64) as f32);
    Pattern((0..HEIGHT).flat_map(row).collect())
});

impl Pattern {
    fn at(&self, x: f64, row: usize) -> f64 {
        let step = ((x + MARGIN as f64) * STEPS as f64).clamp(0.0, (LENGTH - 2) as f64);
        let (index, share) = (row * LENGTH + step as usize, step.fract());
        f64::from(self.0[index]) * (1.0 - share) + f64::from(self.0[index + 1]) * share
    }
}

/// The projector's light where a ray from it crosses an image of its own: one dot in each 3×3 positions.
fn dots(x: f64, y: f64) -> f64 {
    let (column, row) = ((x / 3.0).floor() as i64, (y / 3.0).floor() as i64);
    let mut light = 0.0;
    for cell_y in row - 1..=row + 1 {
        for cell_x in column - 1..=column + 1 {
            let place = hash(cell_x, cell_y, 77);
            let (dot_x, dot_y) = (3.0 * (cell_x as f64 + place), 3.0 * (cell_y as f64 + hash(cell_x, cell_y, 78)));
            let squared = (x - dot_x).powi(2) + (y - dot_y).powi(2);
            light += (-squared / (2.0 * DOT_RADIUS * DOT_RADIUS)).exp();
        }
    }
    light
}

/// Albedo at a place on a wall, metres: four octaves from 3 to 24 cm.
fn texture(x: f64, y: f64, wall: u64) -> f64 {
    let octaves = [0.03, 0.06, 0.12, 0.24].iter().enumerate();
    let sum: f64 = octaves.map(|(octave, size)| value_noise(x / size, y / size, 100 * wall + octave as u64)).sum();
    (0.4 + 0.45 * (sum - 2.0)).clamp(0.05, 0.9)
}

/// Random values at whole numbers, smooth between them; 0–1.
fn value_noise(x: f64, y: f64, seed: u64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (across, down) = (smooth(x - column), smooth(y - row));
    let value = |dx: i64, dy: i64| hash(column as i64 + dx, row as i64 + dy, seed);
    let top = value(0, 0) + across * (value(1, 0) - value(0, 0));
    let bottom = value(0, 1) + across * (value(1, 1) - value(0, 1));
    top + down * (bottom - top)
}

/// 0–1, by place (splitmix64).
fn hash(x: i64, y: i64, seed: u64) -> f64 {
    let mut bits =
        (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (y as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F) ^ seed;
    for factor in [0xBF58_476D_1CE4_E5B9, 0x94D0_49BB_1331_11EB, 0xD6E8_FEB8_6659_FD93] {
        bits = (bits ^ (bits >> 30)).wrapping_mul(factor);
    }
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}
