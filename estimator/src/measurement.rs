//! The seam: what goes into a localiser and what comes out. The runner, replay and the robot drive it;
//! whoever brings an estimator of their own implements [`Localizer`].

use std::sync::Arc;

use nalgebra::{Isometry3, Matrix6, Vector3};
use serde::{Deserialize, Serialize};

use crate::image::{DepthImage, InfraredImage, RgbImage};
use crate::motion::MotionFailure;
use crate::time::Timestamp;

/// One reading of one sensor.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// When the sensor saw it (middle of the exposure).
    pub captured_at: Timestamp,
    /// When the estimator can have it. Measurements are handed over in this order.
    pub available_at: Timestamp,
    /// What was seen.
    pub data: MeasurementData,
}

/// The reading itself. Images are shared, not copied.
#[derive(Clone, Debug)]
pub enum MeasurementData {
    /// Encoder counts since the encoders were reset.
    WheelTicks {
        /// Left side.
        left: i64,
        /// Right side.
        right: i64,
    },
    /// Angular velocity in the robot frame, rad/s.
    Gyro(Vector3<f64>),
    /// Specific force in the robot frame, m/s².
    Accelerometer(Vector3<f64>),
    /// Colour image.
    Rgb(Arc<RgbImage>),
    /// Infrared image.
    Infrared(Arc<InfraredImage>),
    /// Depth image as the sensor gives it; the rig says what a value means.
    Depth(Arc<DepthImage>),
    /// Illuminance, lux.
    AmbientLight(f64),
}

/// What became of a measurement: data, never a panic.
#[derive(Clone, Debug, PartialEq)]
pub enum Disposition {
    /// Taken, now or with the reading that completes it.
    Used,
    /// Not taken, and why.
    Rejected(Rejection),
}

/// Why a measurement was not used.
#[derive(Clone, Debug, PartialEq)]
pub enum Rejection {
    /// The estimator has no use for this kind of reading.
    Unsupported,
    /// Captured no later than the last reading of its kind.
    OutOfOrder,
    /// An image of another size than the rig's.
    WrongSize {
        /// The rig's (width, height).
        expected: (usize, usize),
        /// The image's.
        found: (usize, usize),
    },
    /// A wheel that rolled faster than the robot can drive: its encoder was reset, or lies.
    ImpossibleSpeed {
        /// m/s.
        speed: f64,
    },
    /// A turn rate that no ground robot has, or none at all.
    ImpossibleRate {
        /// rad/s.
        rate: f64,
    },
    /// A pose that no robot has, or numbers that are none.
    ImpossiblePose,
    /// Taken in, but no motion could be had from it.
    NoMotion(MotionFailure),
}

/// Which images a localiser wants next (a Kinect gives colour *or* infrared, never both).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Streams {
    /// Colour.
    pub rgb: bool,
    /// Infrared.
    pub infrared: bool,
    /// Depth.
    pub depth: bool,
}

/// Which sensors the pose rests on (paper A, Table 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// RGB + depth.
    Indoor,
    /// RGB + infrared in the paper; here RGB, whose views are apart by a way that the wheels know.
    Outdoor,
    /// Infrared + depth.
    Night,
    /// Wheels only.
    Odometer,
}

/// How far the estimate can be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Health {
    /// Nothing seen yet.
    Initialising,
    /// Tracking; in [`Mode::Odometer`] by the wheels.
    Good,
    /// The last frame gave no motion, and no wheels step in; the pose is the last good one, its covariance has grown.
    Lost(MotionFailure),
}

/// Where the robot believes it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The instant that the pose is of; `None` before the first frame or wheel reading.
    pub time: Option<Timestamp>,
    /// Pose in the frame where the robot started. Metres.
    pub odom_from_robot: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ) of `odom_from_robot`, expressed in the odom frame; m², m·rad, rad².
    pub covariance: Matrix6<f64>,
    /// What the pose rests on.
    pub mode: Mode,
    /// Whether to believe it.
    pub health: Health,
}

/// What is driven: takes measurements, answers with a pose.
pub trait Localizer {
    /// Takes one measurement, in the order of `available_at`.
    fn handle(&mut self, measurement: Measurement) -> Disposition;
    /// The newest estimate.
    fn estimate(&self) -> Estimate;
    /// The images it wants next.
    fn wanted_streams(&self) -> Streams;
}
