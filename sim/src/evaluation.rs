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
