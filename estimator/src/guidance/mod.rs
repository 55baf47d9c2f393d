//! Drives the robot along a path on its own estimated pose (paper A's trajectory tracking): `path` (with its `shapes`)
//! says where, `tracking` how. Nothing here knows where the pose came from.

mod path;
mod shapes;
mod tracking;

pub use path::{Path, PathError, PathPoint};
pub use tracking::{Tracker, TrackingParams};

/// What a robot with two driven sides is told (paper A, Eq. 3).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VelocityCommand {
    /// Forward, m/s.
    pub linear: f64,
    /// Counter-clockwise, rad/s.
    pub angular: f64,
}
