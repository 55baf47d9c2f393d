//! A filter whose pose is counted from the keyframe that visual odometry measures against.
//!
//! A measured pose that starts from the filter's own last pose shares that pose's error, and a filter that took the two
//! for independent would grow ever more certain for nothing. With the keyframe's pose in the state (a stochastic clone,
//! Roumeliotis & Burdick 2002) the shared error cancels in the innovation and the keyframe's own gain is zero, since a
//! relative motion says nothing about where it began. What is left is a filter over `keyframe_from_robot` alone, and a
//! keyframe whose pose and covariance stand still.

use super::filter::{Gain, Outcome, PoseFilter};
use super::planar::UncertainPose;
use super::visual::VisualPose;

/// `odom_from_keyframe`, and the filter over `keyframe_from_robot`.
#[derive(Clone, Debug)]
pub(super) struct Anchored<G> {
    /// As visual odometry has it; `None` before the first.
    keyframe: Option<VisualPose>,
    odom_from_keyframe: UncertainPose,
    /// At the instant of the last measurement.
    filter: PoseFilter<G>,
    /// `keyframe_from_robot`, carried on to now.
    now: UncertainPose,
}

impl<G: Gain> Anchored<G> {
    pub fn new(filter: PoseFilter<G>) -> Self {
        let now = *filter.estimate();
        Self { keyframe: None, odom_from_keyframe: UncertainPose::default(), filter, now }
    }

    /// The pose now.
    pub fn odom_from_robot(&self) -> UncertainPose {
        self.odom_from_keyframe.compose(&self.now)
    }

    /// Carries the pose of now on; the filter stays where its last measurement was.
    pub fn carry(&mut self, motion: &UncertainPose) {
        let carried = self.now.compose(motion);
        if carried.is_finite() {
            self.now = carried;
        }
    }

    /// Carries the filter on.
    pub fn predict(&mut self, motion: &UncertainPose) {
        self.filter.predict(motion);
        self.now = *self.filter.estimate();
    }

    /// Takes a frame of the filter's instant: the motion since the keyframe, and a new keyframe if it is one. `stays`: the
    /// first keyframe stays the only one.
    pub fn take(&mut self, frame: &VisualPose, stays: bool) {
        let measured = self.keyframe.filter(|_| frame.tracked).map(|keyframe| frame.since(&keyframe));
        let outcome = measured.map(|measured| self.filter.update_pose(&measured));
        // What was kept out may turn out to be true: with the old keyframe nothing of it is lost by then.
        let may_anchor = outcome != Some(Outcome::Gated) && !(stays && self.keyframe.is_some());
        if frame.keyframe && may_anchor {
            self.keyframe = Some(*frame);
            self.odom_from_keyframe = self.odom_from_keyframe.compose(self.filter.estimate());
            self.filter.restart();
        }
        self.now = *self.filter.estimate();
    }
}
