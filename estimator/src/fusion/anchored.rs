//! A filter whose pose is counted from the keyframe that visual odometry measures against.
//!
//! A measured pose that starts from the filter's own last pose shares that pose's error, and a filter that took the two
//! for independent would grow ever more certain for nothing. With the keyframe's pose in the state (a stochastic clone,
//! Roumeliotis & Burdick 2002) the shared error cancels in the innovation and the keyframe's own gain is zero, since a
//! relative motion says nothing about where it began. What is left is a filter over `keyframe_from_robot` alone, and a
//! keyframe whose pose and covariance stand still.
//!
//! All frames of one keyframe share its error, too: fused one after the other they would count it as often as there are
//! frames, and the filter would believe a bare wall's slide thirty times. So they are `pooled` into one motion, which is
//! held against what the wheels alone say of the whole way since the keyframe, and takes the place of the one before.

use nalgebra::Vector3;

use super::arc::Arc;
use super::filter::{Gain, Outcome, PoseFilter};
use super::planar::UncertainPose;
use super::pooled::Pooled;
use super::visual::VisualPose;

/// Over how many metres an error of length stays what it is: a lawn's bumps are so long, and so is what a few looks reach. A
/// guess.
const SHARED_OVER: f64 = 2.0;

/// A motion of which a share of the length errs as it did in the motions before. The variance of a sum of such errors grows
/// with its length L as 2 · SHARED_OVER · L (of a first-order Markov process), and so that of the motion is made to.
fn with_shared_error(motion: &UncertainPose, sigma: f64) -> UncertainPose {
    let along = Vector3::new(motion.pose.x, motion.pose.y, 0.0);
    let length = along.norm();
    if length <= 0.0 {
        return *motion;
    }
    let shared = along * along.transpose() * (sigma * sigma * 2.0 * SHARED_OVER / length);
    UncertainPose { covariance: motion.covariance + shared, ..*motion }
}

/// `odom_from_keyframe`, and the filter over `keyframe_from_robot`.
#[derive(Clone, Debug)]
pub(super) struct Anchored<G> {
    /// As visual odometry has it; `None` before the first.
    keyframe: Option<VisualPose>,
    odom_from_keyframe: UncertainPose,
    /// `keyframe_from_robot` by the wheels alone, at the filter's instant.
    by_wheels: UncertainPose,
    /// The same by what was seen.
    by_frames: Pooled,
    /// At the instant of the last measurement.
    filter: PoseFilter<G>,
    /// `keyframe_from_robot`, carried on to now.
    now: UncertainPose,
    /// σ of how far the wheels' heading has drifted since the keyframe, until the filter's instant and until now; radians.
    drift: f64,
    drift_now: f64,
}

impl<G: Gain> Anchored<G> {
    pub fn new(filter: PoseFilter<G>) -> Self {
        let now = *filter.estimate();
        let odom_from_keyframe = UncertainPose::default();
        let by_frames = Pooled::default();
        Self { keyframe: None, odom_from_keyframe, by_wheels: now, by_frames, filter, now, drift: 0.0, drift_now: 0.0 }
    }

    /// The pose now.
    pub fn odom_from_robot(&self) -> UncertainPose {
        self.odom_from_keyframe.compose(&self.now)
    }

    /// Carries the pose of now on; the filter stays where its last measurement was.
    pub fn carry(&mut self, arc: &Arc) {
        self.now = self.now.carried(&arc.motion_after(self.drift_now));
        self.drift_now += arc.turn_drift;
    }

    /// Carries the filter on.
    pub fn predict(&mut self, arc: &Arc) {
        let motion = arc.motion_after(self.drift);
        self.filter.predict(&motion);
        self.by_wheels = self.by_wheels.carried(&motion);
        self.by_frames = self.by_frames.carried(&motion);
        self.drift += arc.turn_drift;
        (self.now, self.drift_now) = (*self.filter.estimate(), self.drift);
    }

    /// Takes a frame of the filter's instant: the motion since the keyframe, and a new keyframe if it is one. `stays`: the
    /// first keyframe stays the only one.
    pub fn take(&mut self, frame: &VisualPose, stays: bool) {
        let measured = self.keyframe.filter(|_| frame.tracked).map(|keyframe| frame.since(&keyframe));
        let outcome = measured.map(|measured| match stays {
            true => self.filter.update_pose(&measured),
            false => self.filter.update_pose_from(&self.by_wheels, &self.by_frames.take(&measured)),
        });
        let is_gated = outcome == Some(Outcome::Gated);
        let is_left_out = measured.is_some() && self.by_frames.is_contradicted();
        if is_gated {
            // Later frames need not agree with what was not believed.
            self.by_frames = Pooled::default();
        }
        // What was kept out may turn out to be true: with the old keyframe nothing of it is lost by then.
        let must_stay = is_gated || is_left_out || (stays && self.keyframe.is_some());
        if frame.keyframe && !must_stay {
            self.keyframe = Some(*frame);
            let gone = with_shared_error(self.filter.estimate(), frame.shared_sigma);
            self.odom_from_keyframe = self.odom_from_keyframe.compose(&gone);
            self.filter.restart();
            (self.by_wheels, self.by_frames, self.drift) = (UncertainPose::default(), Pooled::default(), 0.0);
        }
        (self.now, self.drift_now) = (*self.filter.estimate(), self.drift);
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix6;

    use super::*;
    use crate::fusion::{Ekf, GateParams, PlanarPose, WheelOdometryParams};
    use crate::time::Timestamp;

    #[test]
    fn however_many_frames_a_keyframe_has_what_they_share_counts_once() {
        let after = |frames: u32| {
            let mut anchored = Anchored::new(Ekf::new(UncertainPose::default(), GateParams::default()));
            for number in 0..=frames {
                let (share, step) = (f64::from(number) / f64::from(frames), 1.0 / f64::from(frames));
                if number > 0 {
                    anchored.predict(&WheelOdometryParams::default().arc(0.3 * step, 0.0, 2.0 * step));
                }
                // Half a centimetre aside, as the keyframe has it.
                let start_from_robot = PlanarPose::new(0.3 * share, 0.005 * share, 0.0).to_isometry();
                let (time, covariance) =
                    (Timestamp::from_nanos(i64::from(number)), Matrix6::identity() * (1e-5 * share));
                let visual = VisualPose::keyframe(time, start_from_robot, covariance);
                anchored.take(&VisualPose { tracked: number > 0, keyframe: number == 0, ..visual }, false);
            }
            anchored.odom_from_robot()
        };
        let (once, often) = (after(1), after(30));
        assert!(once.pose.y > 0.001, "{once:?}");
        // Half of each frame's variance is its own and may average out.
        assert!(once.pose.minus(&often.pose).norm() < 2e-4, "{once:?} {often:?}");
        assert!((often.covariance - once.covariance * 0.5).cholesky().is_some(), "{once:?} {often:?}");
    }

    #[test]
    fn however_often_a_way_is_cut_its_length_is_as_unsure() {
        let variance = |pieces: u32| {
            let piece = PlanarPose::new(20.0 / f64::from(pieces), 0.0, 0.0);
            let motion = UncertainPose { pose: piece, ..UncertainPose::default() };
            let way =
                (0..pieces).fold(UncertainPose::default(), |way, _| way.compose(&with_shared_error(&motion, 0.02)));
            way.covariance
        };
        for pieces in [20, 50] {
            // σ of 2 % of two metres, ten times one after the other, and as much again for what neighbours share.
            let found = variance(pieces);
            assert!((found[(0, 0)] - 2.0 * 10.0 * 0.04_f64.powi(2)).abs() < 1e-9, "{found}");
            assert!(found[(1, 1)].abs() < 1e-12 && found[(2, 2)].abs() < 1e-12, "{found}");
        }
    }
}
