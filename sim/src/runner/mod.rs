//! Drives localisers through a recording: the only caller of the estimator.

pub mod log;
