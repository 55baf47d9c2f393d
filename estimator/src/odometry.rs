//! Visual odometry.

use crate::time::Timestamp;

/// What the odometry made of one frame: for reports, not for control.
#[derive(Clone, Debug)]
pub struct FrameReport {
    /// The frame's instant.
    pub time: Timestamp,
    /// Features found.
    pub features: usize,
    /// Matches to the reference.
    pub matches: usize,
    /// Matches that agree with the motion.
    pub inliers: usize,
    /// Whether the frame became a keyframe.
    pub keyframe: bool,
    /// Share of pixels of the sensor's depth image that hold a value, 0–1.
    pub depth_valid_share: f64,
    /// The matches in image coordinates.
    pub tracks: Vec<FeatureTrack>,
}

/// One match in image coordinates (colour pixels).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureTrack {
    /// In the reference frame.
    pub from: [f32; 2],
    /// In this frame.
    pub to: [f32; 2],
    /// Whether it agrees with the motion.
    pub inlier: bool,
}
