//! The simulated Kinect v1 against what is published of the real one, and against itself. Everything is seen through
//! the device's own images, rendered on whatever adapter there is.

mod energy;
mod gloss;
mod light;
mod projector;
mod repeatability;
mod targets;
