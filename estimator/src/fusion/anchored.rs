//! A filter whose pose is counted from the keyframe that visual odometry measures against.
//!
//! A measured pose that starts from the filter's own last pose shares that pose's error, and a filter that took the two
//! for independent would grow ever more certain for nothing. With the keyframe's pose in the state (a stochastic clone,
//! Roumeliotis & Burdick 2002) the shared error cancels in the innovation and the keyframe's own gain is zero, since a
//! relative motion says nothing about where it began. What is left is a filter over `keyframe_from_robot` alone, and a
//! keyframe whose pose and covariance stand still.

use super::filter::{Gain, PoseFilter};
use super::planar::UncertainPose;

/// `odom_from_keyframe`, and the filter over `keyframe_from_robot`.
#[derive(Clone, Debug)]
pub(super) struct Anchored<G> {
    odom_from_keyframe: UncertainPose,
    /// At the instant of the last measurement.
    filter: PoseFilter<G>,
    /// `keyframe_from_robot`, carried on to now.
    now: UncertainPose,
}

impl<G: Gain> Anchored<G> {
    pub fn new(filter: PoseFilter<G>) -> Self {
        let now = *filter.estimate();
        Self { odom_from_keyframe: UncertainPose::default(), filter, now }
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

    /// Takes a measured `keyframe_from_robot` of the filter's instant.
    pub fn update(&mut self, measured: &UncertainPose) {
        self.filter.update_pose(measured);
        self.now = *self.filter.estimate();
    }

    /// Makes the filter's pose the keyframe.
    pub fn anchor(&mut self) {
        self.odom_from_keyframe = self.odom_from_keyframe.compose(self.filter.estimate());
        self.filter.restart();
        self.now = *self.filter.estimate();
    }
}
