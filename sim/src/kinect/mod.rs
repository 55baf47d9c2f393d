//! What a Kinect v1 makes of light: the dot pattern, the infrared image with that pattern in it, and depth computed
//! from the infrared image alone. Knows no truth.

pub mod calibration;
pub mod matcher;
pub mod pattern;
pub mod projector;
