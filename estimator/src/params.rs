//! Every parameter of the estimator: one home, each with its unit, meaning and source.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::features::matching::MatchParams;
use crate::features::surf::SurfParams;
use crate::motion::{PaperMotionParams, RansacParams, RefineParams};
use crate::odometry::KeyframeParams;
use crate::structure::DepthNoise;

/// All that can be set. In a file every key carries its unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EstimatorParams {
    /// Which visual odometry.
    pub variant: Variant,
    /// Detector.
    pub surf: SurfParams,
    /// Matching of descriptors.
    pub matching: MatchParams,
    /// How uncertain pixels and depths are.
    pub depth_noise: DepthNoise,
    /// Search for a first motion.
    pub ransac: RansacParams,
    /// Weighted refinement (variant `keyframes`).
    pub refine: RefineParams,
    /// Keyframes (variant `keyframes`).
    pub keyframes: KeyframeParams,
    /// Reject and refit (variant `paper`).
    pub paper: PaperMotionParams,
}

/// Which visual odometry runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variant {
    /// Weighted by depth noise, against a window of keyframes.
    #[default]
    Keyframes,
    /// As in paper A: frame to frame, every point with equal weight.
    Paper,
}

/// A parameter no estimator can run with.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ParamError {
    /// The calibration describes no camera.
    #[error(transparent)]
    Rig(#[from] crate::camera::RigError),
    /// A number outside its range.
    #[error("{key} = {value} is out of range: {wanted}")]
    OutOfRange {
        /// The parameter's key.
        key: &'static str,
        /// The value found.
        value: f64,
        /// What would do.
        wanted: &'static str,
    },
}
