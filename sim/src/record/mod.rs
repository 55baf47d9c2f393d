//! Recordings on disk: the TUM RGB-D layout with a `calibration.toml`. Images are decoded when they are wanted;
//! a recording that is written appears whole or not at all.

pub mod calibration;
pub mod error;
pub mod frame;
mod list;
pub mod place;
mod truth;
pub mod tum;
pub mod writer;

pub use calibration::Body;
pub use error::RecordError;
pub use frame::{Frame, FrameFiles, ImageFile};
pub use place::Place;
pub use tum::Recording;
