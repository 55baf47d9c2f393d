//! What there is to know of a skid-steer robot before it moves.

use std::path::Path;

use nalgebra::{Isometry3, Point3};

use super::drive::DriveParams;
use super::encoder::EncoderParams;
use super::inertial_sensor::InertialNoise;
use super::mass::Inertial;
use super::urdf::{self, UrdfError};

/// The built-in Pioneer P3-AT.
const P3AT: &str = include_str!("../../../assets/robots/p3at.urdf");

/// A skid-steer robot: one body, wheels that do not steer, a camera. Nothing in it changes while it drives.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotModel {
    /// For readers.
    pub name: String,
    /// Everything that is no wheel.
    pub chassis: Chassis,
    /// At least two on each side.
    pub wheels: Vec<Wheel>,
    /// Points in the camera's optical frame (x right, y down, z forward; the colour lens) → the robot's.
    pub robot_from_camera: Isometry3<f64>,
    /// How the motors follow a command.
    pub drive: DriveParams,
    /// What the encoders resolve.
    pub encoder: EncoderParams,
    /// The gyro, if the robot has one.
    pub gyro: Option<InertialNoise>,
    /// The accelerometer, if the robot has one.
    pub accelerometer: Option<InertialNoise>,
}

/// The body and all that is bolted to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Chassis {
    /// In the robot frame.
    pub inertial: Inertial,
    /// What bumps into things.
    pub shapes: Vec<Shape>,
}

/// A driven wheel; its axle is parallel to the robot's y axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheel {
    /// For readers and errors.
    pub name: String,
    /// Which encoder counts it.
    pub side: Side,
    /// The hub, in the robot frame.
    pub hub: Point3<f64>,
    /// Metres.
    pub radius: f64,
    /// Of the tyre, metres.
    pub width: f64,
    /// In a frame at the hub, parallel to the robot's.
    pub inertial: Inertial,
    /// What the motor can do, N·m at the wheel.
    pub max_torque: f64,
    /// How fast it turns at most, rad/s.
    pub max_speed: f64,
}

/// Left or right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// y > 0.
    Left,
    /// y < 0.
    Right,
}

/// A solid, somewhere on the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Where.
    pub robot_from_shape: Isometry3<f64>,
    /// What.
    pub geometry: Geometry,
}

/// A solid about its own origin. Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// Full edge lengths along x, y, z.
    Box {
        /// Edges.
        size: [f64; 3],
    },
    /// Along z, as URDF has it.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Full length.
        length: f64,
    },
    /// A ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
}

/// How the camera sits on the robot, where that differs from the description file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraMount {
    /// Of the lens above the ground, metres. The built-in robot has 0.60 m.
    pub height: Option<f64>,
    /// Rad; positive looks up, as the Kinect's own motor counts it. The built-in robot has 0.
    pub tilt: Option<f64>,
}

impl RobotModel {
    /// The built-in Pioneer P3-AT, without gyro and accelerometer.
    ///
    /// # Panics
    /// Never on a build that passes its tests: the description is part of the program.
    pub fn p3at(mount: &CameraMount) -> Self {
        Self::from_urdf(P3AT, mount).expect("the built-in robot description is valid")
    }

    /// Reads a description file.
    ///
    /// # Errors
    /// Unreadable, not URDF, or not a skid-steer robot.
    pub fn load(path: &Path, mount: &CameraMount) -> Result<Self, UrdfError> {
        let text =
            std::fs::read_to_string(path).map_err(|source| UrdfError::Unreadable { path: path.into(), source })?;
        Self::from_urdf(&text, mount)
    }

    /// From the text of a description file.
    ///
    /// # Errors
    /// Not URDF, or not a skid-steer robot.
    pub fn from_urdf(text: &str, mount: &CameraMount) -> Result<Self, UrdfError> {
        urdf::load(text, mount)
    }

    /// Mean radius of the wheels, metres.
    pub fn wheel_radius(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.radius).sum::<f64>() / self.wheels.len() as f64
    }

    /// From the left wheels' middle to the right ones', metres.
    pub fn track(&self) -> f64 {
        let mean = |side| mean(self.wheels.iter().filter(|wheel| wheel.side == side).map(|wheel| wheel.hub.y));
        mean(Side::Left) - mean(Side::Right)
    }

    /// From the foremost axle to the rearmost, metres.
    pub fn wheelbase(&self) -> f64 {
        let xs = || self.wheels.iter().map(|wheel| wheel.hub.x);
        xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min)
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}
