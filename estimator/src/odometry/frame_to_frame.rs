//! Paper A's own odometry: each frame against the one before.

use crate::estimator::Stage;
use crate::features::matching::match_features;
use crate::geometry::adjoint;
use crate::motion::{MotionFailure, Pair, icp_surf};
use crate::params::EstimatorParams;

use super::{CameraPose, FeatureTrack, Frame, Tracking};

/// Chains the motions between consecutive frames.
pub struct FrameToFrame {
    params: EstimatorParams,
    last: Option<Frame>,
    /// Whether there was a frame before.
    started: bool,
    pose: CameraPose,
}

impl FrameToFrame {
    /// Nothing seen yet.
    pub fn new(params: &EstimatorParams) -> Self {
        Self { params: params.clone(), last: None, started: false, pose: CameraPose::start() }
    }

    /// Gives the last frame up: what comes next shows other images, or another place, and is seen from `pose`.
    pub fn restart(&mut self, pose: CameraPose) {
        (self.pose, self.started) = (pose, true);
        self.last = None;
    }

    /// Follows one frame. A motion that could not be had counts as none, as the paper has no word on it; the next
    /// frame is held against this one.
    pub fn track(&mut self, frame: Frame, stage: &mut dyn FnMut(Stage)) -> Tracking {
        let Some(last) = self.last.replace(frame) else {
            let failure = std::mem::replace(&mut self.started, true).then_some(MotionFailure::NoReference);
            return Tracking { pose: self.pose.clone(), failure, tracks: Vec::new(), keyframe: true };
        };
        let frame = self.last.as_ref().expect("just put there");
        stage(Stage::Matching);
        let matches = match_features(&frame.features, &last.features, &self.params.matching);
        let pairs: Vec<Pair> = matches
            .iter()
            .map(|found| Pair { camera: frame.landmarks[found.from], reference: last.landmarks[found.to] })
            .collect();
        let mut tracks: Vec<FeatureTrack> = matches
            .iter()
            .map(|found| FeatureTrack::between(&last.features[found.to], &frame.features[found.from]))
            .collect();
        stage(Stage::Motion);
        let motion = icp_surf(&pairs, &self.params.ransac, &self.params.paper);
        if let Ok(motion) = &motion {
            for (track, &inlier) in tracks.iter_mut().zip(&motion.inliers) {
                track.inlier = inlier;
            }
            let carry = adjoint(&self.pose.start_from_camera);
            self.pose = CameraPose {
                start_from_camera: self.pose.start_from_camera * motion.reference_from_camera,
                covariance: self.pose.covariance + carry * motion.covariance * carry.transpose(),
            };
        }
        Tracking { pose: self.pose.clone(), keyframe: true, failure: motion.err(), tracks }
    }
}
