//! 3D points from images: depth carried into the colour image, features lifted to points with their uncertainty.

mod lift;
mod register;

pub use lift::{DepthNoise, Landmark, MAX_WINDOW, depth_at, lift};
pub use register::{RegisteredDepth, Registration};
