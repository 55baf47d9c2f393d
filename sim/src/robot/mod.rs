//! The robot as a device: what its description file says, how its motors follow a command, what its encoders and
//! inertial sensors read. Knows no physics engine and no world; `physics` moves it.
//!
//! Robot frame: on the ground in the middle between the wheels; x forward, y left, z up; metres.

mod drive;
mod encoder;
mod inertial_sensor;
mod mass;
mod model;
mod urdf;

pub use drive::{Drive, DriveParams, VelocityCommand, WheelSpeeds};
pub use encoder::EncoderParams;
pub use inertial_sensor::{InertialNoise, InertialSensor};
pub use mass::Inertial;
pub use model::{CameraMount, Chassis, Geometry, RobotModel, Shape, Side, Wheel};
pub use urdf::UrdfError;
