//! What visual odometry says of a gyro's bias: between two keyframes the turn that was felt and the one that was seen
//! differ by it.

use super::arc::Arc;
use super::planar::wrap_angle;
use super::visual::VisualPose;

/// A difference beyond so many σ tells of a wrong match, not of a bias.
const GATE_SIGMA: f64 = 3.0;

/// A bias is learnt where it may have done more than this share of the turn. What calibration leaves of focal lengths and of
/// a gyro's scale, blur that trails, and above all a skid that looks like a turn are the same each time in a turn, and would
/// not average out. A guess.
const LEAST_SHARE: f64 = 0.15;

/// How far turns that were felt were off, by what was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lesson {
    /// Felt minus seen, radians.
    pub error: f64,
    /// Variance of all in it but the bias, rad².
    pub variance: f64,
    /// σ of what the bias may have done to it, radians.
    pub drift: f64,
}

/// The turn since visual odometry's keyframe as wheels and gyro felt it.
#[derive(Clone, Debug, Default)]
pub(super) struct SightedTurn {
    keyframe: Option<VisualPose>,
    turn: f64,
    variance: f64,
    drift: f64,
}

impl SightedTurn {
    /// Goes on along an arc, up to the next frame's instant.
    pub fn drive(&mut self, arc: &Arc) {
        self.turn += arc.turn;
        self.variance += arc.turn_variance;
        self.drift += arc.turn_drift;
    }

    /// Takes a frame of this instant. Where the keyframe ends, what it has taught: once each, for what all its frames say
    /// is said with the keyframe's own errors.
    pub fn see(&mut self, frame: &VisualPose) -> Option<Lesson> {
        if !frame.keyframe {
            return None;
        }
        let felt = std::mem::take(self);
        self.keyframe = Some(*frame);
        let seen = felt.keyframe.filter(|_| frame.tracked).map(|keyframe| frame.since(&keyframe))?;
        let error = wrap_angle(felt.turn - seen.pose.heading) / frame.turn_share;
        let variance = felt.variance + seen.covariance[(2, 2)];
        let is_likely = error.abs() < GATE_SIGMA * variance.sqrt().hypot(felt.drift);
        let is_straight = LEAST_SHARE * felt.turn.abs() < felt.drift;
        (is_likely && is_straight).then_some(Lesson { error, variance, drift: felt.drift })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Matrix6};

    use super::*;
    use crate::fusion::planar::PlanarPose;
    use crate::fusion::{Drive, GyroParams, WheelOdometry, WheelOdometryParams};
    use crate::time::Timestamp;

    fn at(secs: f64) -> Timestamp {
        Timestamp::from_secs(secs).unwrap()
    }

    /// At a heading, after so many seconds of growing doubt.
    fn keyframe(secs: f64, heading: f64, turn_share: f64) -> VisualPose {
        let start_from_robot = PlanarPose::new(0.2 * secs, 0.0, heading).to_isometry();
        let covariance = Matrix6::identity() * (1e-6 * (1.0 + secs));
        VisualPose { turn_share, ..VisualPose::keyframe(at(secs), start_from_robot, covariance) }
    }

    fn felt(turn: f64, turn_drift: f64) -> Arc {
        Arc { distance: 0.2, turn, turn_variance: 3e-6, turn_drift, ..Arc::default() }
    }

    #[test]
    fn a_bias_is_learnt_on_the_way() {
        const BIAS: f64 = 0.002;
        // As it comes from a driver that averages for a second.
        let gyro = GyroParams { bias: 0.0017, ..GyroParams::default() };
        let mut wheels = WheelOdometry::new(Drive::default(), WheelOdometryParams::default(), gyro);
        let mut turned = SightedTurn::default();
        let mut heading = 0.0;
        for hundredth in 0..=6000 {
            let time = 0.01 * f64::from(hundredth);
            wheels.handle_gyro(at(time), BIAS).unwrap();
            if hundredth % 10 == 0 {
                let ticks = (0.2 * time * 138_000.0) as i64;
                if let Some(step) = wheels.handle_ticks(at(time), ticks, ticks).unwrap() {
                    turned.drive(&step.arc);
                }
            }
            if hundredth % 100 == 0
                && let Some(lesson) = turned.see(&keyframe(time, 0.0, 1.0))
            {
                wheels.learn_by_sight(&lesson);
            }
            if hundredth == 3000 {
                heading = wheels.odom_from_robot().pose.heading;
            }
        }
        let since = wheels.odom_from_robot().pose.heading - heading;
        assert!(since.abs() < 0.1 * BIAS * 30.0, "{since}");
    }

    #[test]
    fn what_a_compromise_has_left_of_a_difference_is_made_up_for() {
        let lesson = |share: f64| {
            let mut turned = SightedTurn::default();
            assert_eq!(turned.see(&keyframe(0.0, 0.0, 1.0)), None);
            turned.drive(&felt(0.004, 0.004));
            turned.see(&keyframe(1.0, 0.004 * (1.0 - share), share)).unwrap().error
        };
        assert!((lesson(1.0) - 0.004).abs() < 1e-9 && (lesson(0.25) - 0.004).abs() < 1e-9);
    }

    #[test]
    fn nothing_is_learnt_of_turns_and_outliers_and_lost_frames() {
        let seen = |turn: f64, frame: VisualPose| {
            let mut turned = SightedTurn::default();
            turned.see(&keyframe(0.0, 0.0, 1.0));
            turned.drive(&felt(turn, 0.002));
            turned.see(&frame)
        };
        assert!(seen(0.001, keyframe(1.0, 0.0, 1.0)).is_some());
        assert_eq!(seen(0.5, keyframe(1.0, 0.499, 1.0)), None);
        assert_eq!(seen(0.02, keyframe(1.0, 0.0, 1.0)), None);
        assert_eq!(seen(0.001, VisualPose { tracked: false, ..keyframe(1.0, 0.0, 1.0) }), None);
        assert_eq!(seen(0.001, VisualPose { keyframe: false, ..keyframe(1.0, 0.0, 1.0) }), None);
        // Without a gyro there is no bias.
        let mut turned = SightedTurn::default();
        turned.see(&keyframe(0.0, 0.0, 1.0));
        turned.drive(&felt(0.0, 0.0));
        assert_eq!(
            turned.see(&VisualPose { start_from_robot: Isometry3::identity(), ..keyframe(1.0, 0.0, 1.0) }),
            None
        );
    }
}
