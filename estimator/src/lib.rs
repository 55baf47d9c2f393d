//! Localisation for ground robots with a Kinect. This crate is all that runs on the robot, and it is sans-IO:
//! no file, no clock, no thread, no GPU and no simulation reaches it. Measurements go in through
//! [`Localizer::handle`], estimates come out of [`Localizer::estimate`]; equal inputs give equal bytes.
//!
//! Rooms, bottom to top: [`time`], [`geometry`], [`image`], [`camera`], [`features`], [`structure`], [`motion`],
//! [`measurement`] (the seam), [`odometry`], [`mode`], [`fusion`], [`guidance`], [`estimator`].

pub mod camera;
pub mod estimator;
pub mod features;
pub mod fusion;
pub mod geometry;
pub mod guidance;
pub mod image;
pub mod measurement;
pub mod mode;
pub mod motion;
pub mod odometry;
pub mod params;
pub mod structure;
pub mod time;
mod vision;

#[cfg(test)]
mod dark_room;

pub use camera::Rig;
pub use estimator::{Estimator, PoseSource, Stage};
pub use measurement::{
    Disposition, Estimate, Health, Localizer, Measurement, MeasurementData, Mode, Rejection, Streams,
};
pub use params::{EstimatorParams, ParamError};
pub use time::Timestamp;
