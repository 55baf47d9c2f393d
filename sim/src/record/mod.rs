//! Recordings on disk: the TUM RGB-D layout with a `calibration.toml`.

pub mod place;
pub mod writer;

pub use place::Place;
