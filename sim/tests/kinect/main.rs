//! The simulated Kinect v1 against what is published of the real one. Everything is seen through the device's own
//! images, rendered on whatever adapter there is; `cargo test --test kinect -- --nocapture` prints what was measured.
//!
//! Sources: ROS `kinect_calibration/technical` (Konolige & Mihelich); Khoshelham & Elberink, *Accuracy and Resolution
//! of Kinect Depth Data* (2012); Nguyen, Izadi & Lovell, *Modeling Kinect Sensor Noise* (2012); Reichinger, *Kinect
//! Pattern Uncovered* (2011); depth frames of the TUM RGB-D benchmark.

#[path = "../scene/mod.rs"]
mod scene;

mod bench;
mod geometry;
mod light;
mod pattern;
mod repeatability;
