//! A Kinect without noise outdoors, whose numbers are read as light.

use glam::DVec3;
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::{Imaging, Kinect};
use sunblind_sim::light::LightState;
use sunblind_sim::render::Sweep;
use sunblind_sim::validation::scene::looking;
use sunblind_sim::world::World;

/// Where pixels are compared; the infrared camera's middle.
pub const MIDDLE: [usize; 2] = [320, 240];

pub struct Camera {
    pub kinect: Kinect,
}

/// What both cameras see, relative to the sensor's own scale: proportional to light.
pub struct Seen {
    pub infrared: Vec<f64>,
    pub colour: Vec<[f64; 3]>,
}

impl Camera {
    pub fn new(world: &World) -> Self {
        let imaging = Imaging { noise: false, ..Imaging::default() };
        Self { kinect: Kinect::new(world, Calibration::nominal(), imaging, 1).expect("a graphics adapter") }
    }

    /// From a place in a direction, exposures settled.
    pub fn look(&mut self, light: &LightState, from: DVec3, towards: DVec3) -> Seen {
        self.kinect.illuminate(light);
        self.kinect.restart();
        let pose = looking(from, towards);
        let first = self.kinect.capture(&Sweep::still(pose), 0).expect("a frame");
        drop(first);
        let [colour, infrared] = self.kinect.exposures().map(|exposure| exposure.time * exposure.gain);
        let frame = self.kinect.capture(&Sweep::still(pose), 1).expect("a frame");
        let linear = |encoded: u8| (f64::from(encoded) / 255.0).powf(2.2) / colour;
        Seen {
            infrared: frame.infrared.pixels().iter().map(|&number| f64::from(number) / infrared).collect(),
            colour: frame.rgb.pixels().iter().map(|pixel| pixel.map(linear)).collect(),
        }
    }
}

impl Seen {
    /// At a pixel, mean over its neighbours.
    pub fn infrared_at(&self, [x, y]: [usize; 2]) -> f64 {
        mean(&self.infrared, [x, y], |&number| number)
    }

    /// Green likewise.
    pub fn green_at(&self, [x, y]: [usize; 2]) -> f64 {
        mean(&self.colour, [x, y], |pixel| pixel[1])
    }
}

fn mean<T>(pixels: &[T], [x, y]: [usize; 2], value: impl Fn(&T) -> f64) -> f64 {
    let around = (y - 2..=y + 2).flat_map(|y| (x - 2..=x + 2).map(move |x| 640 * y + x));
    around.map(|index| value(&pixels[index])).sum::<f64>() / 25.0
}
