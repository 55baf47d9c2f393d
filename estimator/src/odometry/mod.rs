//! Visual odometry (paper A, §4): features with 3D points from colour and depth (`frame`) or infrared and depth
//! (`night`), then motion against a window of keyframes (`keyframes`) or, as the paper has it, against the frame before
//! (`frame_to_frame`). Where there is no depth (`by_bearing`): the direction from colour, the length from the wheels
//! (`way_length`), less what they slip (`wheel_slip`) by the ground that passes below (`ground_patches`), or from colour
//! and infrared as a stereo camera.

mod by_bearing;
mod frame;
mod frame_to_frame;
mod ground_patches;
mod keyframes;
mod night;
mod way_length;
mod wheel_slip;

use nalgebra::{Isometry3, Matrix6};

use crate::features::surf::Feature;
use crate::measurement::Mode;
use crate::motion::MotionFailure;
use crate::time::Timestamp;

pub use by_bearing::{ByBearing, CameraByWheels, OutdoorMethod, OutdoorParams};
pub use frame::{Frame, FrameBuilder, FrameView};
pub use frame_to_frame::FrameToFrame;
pub use keyframes::{KeyframeParams, Keyframes};
pub use night::NightFrameBuilder;

use frame::{depth_noise, view_maker};

/// Where a frame's camera was, in the frame of the first camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPose {
    /// Camera frame → the first camera's frame.
    pub start_from_camera: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ), in the first camera's frame.
    pub covariance: Matrix6<f64>,
}

impl CameraPose {
    /// The first camera's own pose, exact by definition.
    pub fn start() -> Self {
        Self { start_from_camera: Isometry3::identity(), covariance: Matrix6::zeros() }
    }
}

/// What came of following one frame.
#[derive(Clone, Debug)]
pub struct Tracking {
    /// The frame's pose; of a lost frame the last known one, with a covariance that has grown.
    pub pose: CameraPose,
    /// Why the frame is lost.
    pub failure: Option<MotionFailure>,
    /// The matches to the reference frame, in image coordinates.
    pub tracks: Vec<FeatureTrack>,
    /// Whether the frame became a reference for others.
    pub keyframe: bool,
}

impl Tracking {
    /// Of a frame that nobody followed.
    pub(crate) fn none() -> Self {
        let failure = Some(MotionFailure::NotSought);
        Self { pose: CameraPose::start(), failure, tracks: Vec::new(), keyframe: false }
    }
}

/// What the odometry made of one frame: for reports, not for control.
#[derive(Clone, Debug)]
pub struct FrameReport {
    /// The frame's instant.
    pub time: Timestamp,
    /// Which images it was followed by: at night tracks are in infrared pixels, otherwise in colour's.
    pub mode: Mode,
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

/// One match in image coordinates: pixels of the image that the mode takes its features from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureTrack {
    /// In the reference frame.
    pub from: [f32; 2],
    /// In this frame.
    pub to: [f32; 2],
    /// Whether it agrees with the motion.
    pub inlier: bool,
}

impl FeatureTrack {
    /// A match that nobody has judged yet.
    fn between(from: &Feature, to: &Feature) -> Self {
        Self { from: [from.x, from.y], to: [to.x, to.y], inlier: false }
    }

    /// How far the feature moved in the image, pixels.
    pub fn length(&self) -> f32 {
        (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1])
    }
}
