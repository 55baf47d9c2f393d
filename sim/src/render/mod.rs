//! A headless renderer of what a Kinect's two cameras see. The only room that names wgpu.
//!
//! For each camera the triangles are rasterised into a G-buffer (where, what, how lit), the image of a pinhole a little
//! larger than the sensor. Compute shaders then turn it into light, and light into the sensor's numbers. The lens acts
//! in the second step, where light is resampled: distorting vertices would leave large triangles' edges straight.
//!
//! Equal inputs give equal bytes, on one adapter and driver.

mod bounds;
mod daylight;
mod device;
#[cfg(test)]
mod gloss_tests;
mod occluder;
mod passes;
mod raster;
mod readback;
mod renderer;
mod scene;
mod shader;
mod stage;
mod texture;
mod uniforms;
mod view;

pub use device::{Adapter, RenderError};
pub use passes::{Optics, ProjectorLight};
pub use renderer::{Begun, Frame, Images, Renderer, StageCost};
pub use uniforms::{ColourSensor, InfraredSensor};
pub use view::{CameraFrame, Sweep, affine};
