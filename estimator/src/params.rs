//! Every parameter of the estimator: one home, each with its unit, meaning and source.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// All that can be set. In a file every key carries its unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EstimatorParams {
    /// Which visual odometry.
    pub variant: Variant,
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
