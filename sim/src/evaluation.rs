//! Trajectories held against the truth.

use nalgebra::Isometry3;
use sunblind_estimator::Timestamp;

/// A pose at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampedPose {
    /// When.
    pub time: Timestamp,
    /// The body's pose in the world.
    pub world_from_body: Isometry3<f64>,
}

/// How far a track is from the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// RMSE along x without alignment, metres.
    pub rmse_x_m: f64,
    /// RMSE along y without alignment, metres.
    pub rmse_y_m: f64,
    /// RMSE of the heading without alignment, degrees.
    pub rmse_theta_deg: f64,
    /// RMSE of the position after rigid alignment, metres.
    pub ate_m: f64,
    /// RMSE of the relative translation over 1 s, metres.
    pub rpe_m: f64,
    /// RMSE of the relative rotation over 1 s, degrees.
    pub rpe_deg: f64,
    /// RMSE of the relative translation over one frame, metres.
    pub rpe_frame_m: f64,
    /// RMSE of the relative rotation over one frame, degrees.
    pub rpe_frame_deg: f64,
    /// Translation error over length, mean over all sub-paths, percent.
    pub drift_percent: f64,
    /// Error of the last position, metres.
    pub end_error_m: f64,
}

/// Holds a track against the truth; `None` when they share no instant.
pub fn evaluate(_track: &[crate::runner::log::FrameLog], _truth: &[StampedPose]) -> Option<Evaluation> {
    None
}
