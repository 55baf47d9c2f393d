//! Recordings on disk: the TUM RGB-D layout with a `calibration.toml`, and lists of what else a robot measures.
//!
//! | file | a line | |
//! |---|---|---|
//! | `rgb.txt`, `depth.txt` | `timestamp filename` | 8-bit colour; 16-bit grey: linear, or raw 11-bit disparity |
//! | `ir.txt` | `timestamp filename` | optional; 16-bit grey with 10-bit values |
//! | `odometry.txt` | `timestamp left_ticks right_ticks` | optional; whole encoder counts since their reset |
//! | `gyro.txt` | `timestamp wx wy wz` | optional; rad/s in the robot's frame |
//! | `specific_force.txt` | `timestamp fx fy fz` | optional; m/s² in the robot's frame |
//! | `light.txt` | `timestamp illuminance` | optional; lux |
//! | `groundtruth.txt` | `timestamp tx ty tz qx qy qz qw` | optional; m, unit quaternion; never shown to a localiser |
//!
//! Time stamps are seconds on one clock, exact to the nanosecond, rising in each file: the instants of capture. What
//! takes time to arrive does so by one constant for each sensor, `[latency]` in the [`calibration`]; [`sensor::Arrival`]
//! is the order in which a localiser gets what all files hold. Every number is written with all its digits: what is
//! read is what was measured, bit for bit.
//!
//! Images are decoded when they are wanted; a recording that is written appears whole or not at all.

pub mod calibration;
pub mod error;
pub mod frame;
mod list;
pub mod place;
pub mod reading;
mod rotation;
pub mod sensor;
pub(crate) mod stamp;
mod truth;
pub mod tum;
pub mod writer;

pub use calibration::{Body, Calibration};
pub use error::RecordError;
pub use frame::{Frame, FrameFiles, ImageFile};
pub use place::Place;
pub use reading::Reading;
pub use sensor::{Arrival, Latency, Sensor};
pub use tum::Recording;
