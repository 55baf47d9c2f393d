//! 3D points from images: depth carried into the colour image, or albedo recovered from the infrared one (`albedo`, with
//! the projector's `pattern`); features lifted to points with their uncertainty; or,
//! where the projector is outshone, depth by the two cameras' disparity (`stereo`).

mod albedo;
mod blur;
mod lift;
mod pattern;
mod register;
mod stereo;
mod view;

pub use albedo::{ALBEDO_NOISE, Albedo, AlbedoCamera};
pub use lift::{DepthNoise, Landmark, MAX_WINDOW, depth_at, lift};
pub use register::{RegisteredDepth, Registration};
pub use stereo::{InverseDepth, Stereo};
pub use view::{DenseView, PIXELS, ViewMaker};
