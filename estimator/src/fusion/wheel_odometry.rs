//! Where the wheels say the robot is (papers A, Eqs. 1–3, and B, Eqs. 16–28): encoder counts become arcs, with a gyro's
//! turn where one is fitted.

use serde::{Deserialize, Serialize};

use super::arc::Arc;
use super::gyro::{GyroParams, HeadingGyro};
use super::planar::UncertainPose;
use super::sighted_turn::Lesson;
use crate::measurement::Rejection;
use crate::time::Timestamp;

/// No gyro of a ground robot reads more, rad/s: MEMS ranges end at 4000 °/s.
const MAX_RATE: f64 = 100.0;

/// What the estimator believes of the driven wheels. The true ones are another object, elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Drive {
    /// Encoder counts in a metre of rolling.
    pub ticks_per_metre: f64,
    /// The track that a differential drive would need to turn as this robot does, metres. On a skid-steer robot it is
    /// wider than the distance between the wheels, by about half.
    #[serde(rename = "effective_track_m")]
    pub effective_track: f64,
}

impl Default for Drive {
    /// A Pioneer P3-AT: about 138 counts a millimetre, and the track in ARIA's `p3at.p`, 2 mm/DiffConvFactor with
    /// 0.0034, which is 1.49 times the 0.394 m between its wheels.
    fn default() -> Self {
        Self { ticks_per_metre: 138_000.0, effective_track: 0.588 }
    }
}

/// How far wheels are to be believed. Variances grow with distance, turn and time, so that a way driven in small steps
/// is as uncertain as in one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WheelOdometryParams {
    /// σ of the distance after one metre. Tyres and floor: 1–2 % on tiles, 3–5 % on grass (an estimate).
    #[serde(rename = "distance_noise_m_per_sqrt_m")]
    pub distance_per_metre: f64,
    /// σ of the shift, forwards as well as sideways, after one radian: the point a skid-steer robot turns about wanders
    /// by ± 0.05 m.
    #[serde(rename = "shift_noise_m_per_sqrt_rad")]
    pub shift_per_radian: f64,
    /// σ of the sideways slip after one metre. A guess.
    #[serde(rename = "side_noise_m_per_sqrt_m")]
    pub side_per_metre: f64,
    /// σ of the heading after one metre. Half of what one uncalibrated robot showed, 6.9° in 5 m.
    #[serde(rename = "turn_noise_rad_per_sqrt_m")]
    pub turn_per_metre: f64,
    /// σ of the heading after a turn of one radian: 5–15 % without a gyro (an estimate).
    #[serde(rename = "turn_noise_rad_per_sqrt_rad")]
    pub turn_per_radian: f64,
    /// σ of the position after one second, whatever the wheels do: a robot may be pushed. A guess, small.
    #[serde(rename = "position_noise_m_per_sqrt_s")]
    pub position_per_second: f64,
    /// σ of the heading after one second, likewise.
    #[serde(rename = "turn_noise_rad_per_sqrt_s")]
    pub turn_per_second: f64,
    /// A side that seems to have rolled faster than this, m/s, has had its encoder reset: a P3-AT's software stops at
    /// 1.2.
    #[serde(rename = "max_speed_m_per_s")]
    pub max_speed: f64,
    /// σ of the speed while the wheels give no reading, m/s. A guess: the usual driving speed.
    #[serde(rename = "silent_speed_m_per_s")]
    pub silent_speed: f64,
    /// σ of the turn rate while the wheels give no reading, rad/s. A guess.
    #[serde(rename = "silent_turn_rad_per_s")]
    pub silent_turn: f64,
}

impl Default for WheelOdometryParams {
    fn default() -> Self {
        Self {
            distance_per_metre: 0.02,
            shift_per_radian: 0.05,
            side_per_metre: 0.01,
            turn_per_metre: 0.025,
            turn_per_radian: 0.1,
            position_per_second: 0.001,
            turn_per_second: 0.001,
            max_speed: 3.0,
            silent_speed: 0.5,
            silent_turn: 0.5,
        }
    }
}

impl WheelOdometryParams {
    /// Any motion that is likely in `seconds` without a reading.
    pub fn unseen(&self, seconds: f64) -> Arc {
        let (shift, turn) = ((self.silent_speed * seconds).powi(2), (self.silent_turn * seconds).powi(2));
        Arc { distance_variance: shift, turn_variance: turn, side_variance: shift, ..Arc::default() }
    }

    /// An arc driven in `seconds`, with its noise.
    pub fn arc(&self, distance: f64, turn: f64, seconds: f64) -> Arc {
        let over = |per_metre: f64, per_radian: f64, per_second: f64| {
            per_metre.powi(2) * distance.abs() + per_radian.powi(2) * turn.abs() + per_second.powi(2) * seconds
        };
        Arc {
            distance,
            turn,
            distance_variance: over(self.distance_per_metre, self.shift_per_radian, self.position_per_second),
            turn_variance: over(self.turn_per_metre, self.turn_per_radian, self.turn_per_second),
            turn_drift: 0.0,
            side_variance: over(self.side_per_metre, self.shift_per_radian, self.position_per_second),
        }
    }
}

/// An arc and when it was driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Beginning.
    pub from: Timestamp,
    /// End; later than the beginning.
    pub to: Timestamp,
    /// The way between.
    pub arc: Arc,
}

impl Step {
    /// The two parts before and after an instant within the step.
    pub fn split(&self, at: Timestamp) -> (Self, Self) {
        let share = (at.since(self.from) / self.to.since(self.from)).clamp(0.0, 1.0);
        let (before, after) = (self.arc.part(share), self.arc.part(1.0 - share));
        (Self { to: at, arc: before, ..*self }, Self { from: at, arc: after, ..*self })
    }
}

/// How far the heading may have strayed since some instant; of two of them, what lies between is what they differ by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TurnDoubt {
    /// Variance of what differs from step to step, rad².
    pub variance: f64,
    /// σ of what goes on in one direction, a gyro's bias; rad.
    pub drift: f64,
}

impl TurnDoubt {
    /// σ of a turn that ended at `self` and began at `start`, radians.
    pub fn sigma_since(&self, start: &Self) -> f64 {
        (self.variance - start.variance).max(0.0).sqrt().hypot(self.drift - start.drift)
    }

    /// Some of the way (0–1) from here to another one.
    pub fn towards(&self, to: &Self, share: f64) -> Self {
        let between = |from: f64, to: f64| from + share * (to - from);
        Self { variance: between(self.variance, to.variance), drift: between(self.drift, to.drift) }
    }
}

/// Encoder counts and when they were read.
#[derive(Clone, Copy, Debug)]
struct Reading {
    time: Timestamp,
    left: i64,
    right: i64,
}

/// Integrates encoder counts.
#[derive(Clone, Debug)]
pub struct WheelOdometry {
    drive: Drive,
    params: WheelOdometryParams,
    gyro: HeadingGyro,
    last: Option<Reading>,
    /// The end of the last step, and the seconds since then that no reading accounts for.
    reached: Option<Timestamp>,
    unseen: f64,
    odom_from_robot: UncertainPose,
    turn_doubt: TurnDoubt,
}

impl WheelOdometry {
    /// At rest at the origin; the first counts are the zero.
    pub fn new(drive: Drive, params: WheelOdometryParams, gyro: GyroParams) -> Self {
        Self {
            drive,
            params,
            gyro: HeadingGyro::new(gyro),
            last: None,
            reached: None,
            unseen: 0.0,
            odom_from_robot: UncertainPose::default(),
            turn_doubt: TurnDoubt::default(),
        }
    }

    /// When the newest counts were read.
    pub fn time(&self) -> Option<Timestamp> {
        self.last.map(|reading| reading.time)
    }

    /// Where the wheels alone have brought the robot, from where it was at the first counts.
    pub fn odom_from_robot(&self) -> &UncertainPose {
        &self.odom_from_robot
    }

    /// How far the heading may have strayed since the first counts.
    pub fn turn_doubt(&self) -> TurnDoubt {
        self.turn_doubt
    }

    /// Takes the counts of both sides since the encoders were reset; gives the step since the reading before, none for
    /// the first.
    ///
    /// # Errors
    /// [`Rejection::OutOfOrder`], or [`Rejection::ImpossibleSpeed`] after which counting goes on from these counts.
    pub fn handle_ticks(&mut self, time: Timestamp, left: i64, right: i64) -> Result<Option<Step>, Rejection> {
        let reading = Reading { time, left, right };
        let Some(last) = self.last else {
            self.last = Some(reading);
            self.reached = Some(time);
            return Ok(None);
        };
        if time <= last.time {
            return Err(Rejection::OutOfOrder);
        }
        self.last = Some(reading);
        let seconds = time.since(last.time);
        // Counters may run over their end; what lies between two readings does not.
        let rolled = |now: i64, before: i64| now.wrapping_sub(before) as f64 / self.drive.ticks_per_metre;
        let (left, right) = (rolled(left, last.left), rolled(right, last.right));
        let speed = left.abs().max(right.abs()) / seconds;
        if speed > self.params.max_speed {
            self.unseen += seconds;
            return Err(Rejection::ImpossibleSpeed { speed });
        }
        let from = self.reached.replace(time).unwrap_or(last.time);
        let (arc, drifted) = self.arc(left, right, time, seconds);
        self.odom_from_robot = self.odom_from_robot.compose(&arc.motion_after(drifted));
        self.turn_doubt.variance += arc.turn_variance;
        self.turn_doubt.drift += arc.turn_drift;
        Ok(Some(Step { from, to: time, arc }))
    }

    /// The arc of two sides that rolled so many metres in so many seconds, and σ of how far the heading has drifted before.
    fn arc(&mut self, left: f64, right: f64, time: Timestamp, seconds: f64) -> (Arc, f64) {
        let turn = (right - left) / self.drive.effective_track;
        let mut arc = self.params.arc((left + right) / 2.0, turn, seconds);
        let moved = left != 0.0 || right != 0.0;
        let mut drifted = 0.0;
        if let Some(felt) = self.gyro.turn_until(time, seconds, moved) {
            // Two independent readings of one turn: weights go by the inverse of the variances.
            let variance = felt.variance + felt.drift * felt.drift;
            let total = arc.turn_variance + variance;
            if total > 0.0 {
                let weight = arc.turn_variance / total;
                arc.turn += weight * (felt.angle - arc.turn);
                arc.turn_drift = weight * felt.drift;
                arc.turn_variance = weight * variance - arc.turn_drift * arc.turn_drift;
                drifted = weight * felt.drifted;
            }
        }
        let unseen = self.params.unseen(std::mem::take(&mut self.unseen));
        arc.distance_variance += unseen.distance_variance;
        arc.turn_variance += unseen.turn_variance;
        arc.side_variance += unseen.side_variance;
        (arc, drifted)
    }

    /// Takes the gyro's rate about the robot's z axis, rad/s.
    ///
    /// # Errors
    /// [`Rejection::OutOfOrder`], or [`Rejection::ImpossibleRate`].
    pub fn handle_gyro(&mut self, time: Timestamp, rate: f64) -> Result<(), Rejection> {
        if !rate.is_finite() || rate.abs() > MAX_RATE {
            return Err(Rejection::ImpossibleRate { rate });
        }
        if self.gyro.last_reading().is_some_and(|last| time <= last) {
            return Err(Rejection::OutOfOrder);
        }
        self.gyro.take(time, rate);
        Ok(())
    }

    /// Takes what was seen of the gyro's bias.
    pub(super) fn learn_by_sight(&mut self, lesson: &Lesson) {
        self.gyro.learn_by_sight(lesson);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::planar::PlanarPose;
    use proptest::prelude::*;

    fn odometry() -> WheelOdometry {
        WheelOdometry::new(Drive::default(), WheelOdometryParams::default(), GyroParams::default())
    }

    fn at(secs: f64) -> Timestamp {
        Timestamp::from_secs(secs).unwrap()
    }

    #[test]
    fn counts_become_metres_and_radians() {
        let mut wheels = odometry();
        assert_eq!(wheels.handle_ticks(at(0.0), 1000, -7), Ok(None));
        wheels.handle_ticks(at(2.0), 1000 + 138_000, 138_000 - 7).unwrap();
        assert!(wheels.odom_from_robot().pose.minus(&PlanarPose::new(1.0, 0.0, 0.0)).norm() < 1e-12);
        // A spin to the left by one radian: each side rolls half a track.
        let half = (0.294 * 138_000.0) as i64;
        wheels.handle_ticks(at(4.0), 139_000 - half, 138_000 - 7 + half).unwrap();
        assert!(wheels.odom_from_robot().pose.minus(&PlanarPose::new(1.0, 0.0, 1.0)).norm() < 1e-5);
        assert_eq!(wheels.handle_ticks(at(4.0), 0, 0), Err(Rejection::OutOfOrder));
    }

    #[test]
    fn a_reset_encoder_is_no_motion_but_a_doubt() {
        let mut wheels = odometry();
        for tenth in 0..=10 {
            wheels
                .handle_ticks(at(0.1 * f64::from(tenth)), 6_900 * i64::from(tenth), 6_900 * i64::from(tenth))
                .unwrap();
        }
        let before = *wheels.odom_from_robot();
        assert!(matches!(wheels.handle_ticks(at(1.1), 5_000_000, 0), Err(Rejection::ImpossibleSpeed { .. })));
        let step = wheels.handle_ticks(at(1.2), 5_006_900, 6_900).unwrap().unwrap();
        assert_eq!((step.from, step.to), (at(1.0), at(1.2)));
        let after = wheels.odom_from_robot();
        assert!((after.pose.distance(&before.pose) - 0.05).abs() < 1e-9);
        assert!(after.covariance[(0, 0)] > before.covariance[(0, 0)] + 0.04 * 0.04);
    }

    #[test]
    fn a_gyro_outweighs_wheels_that_slip_in_a_turn() {
        let mut wheels = odometry();
        // Two seconds at rest, in which the bias is learnt, then two of a turn in which the wheels say 0.75 rad/s.
        for hundredth in 0..=400 {
            let time = 0.01 * f64::from(hundredth);
            let turning = (time - 2.0).max(0.0);
            wheels.handle_gyro(at(time), if turning > 0.0 { 0.5 } else { 0.0 }).unwrap();
            if hundredth % 10 == 0 {
                let ticks = (0.75 * 0.294 * turning * 138_000.0) as i64;
                wheels.handle_ticks(at(time), -ticks, ticks).unwrap();
            }
        }
        let turned = wheels.odom_from_robot();
        assert!((turned.pose.heading - 1.0).abs() < 0.02, "{}", turned.pose.heading);
        assert!(matches!(wheels.handle_gyro(at(5.0), f64::NAN), Err(Rejection::ImpossibleRate { .. })));
        assert_eq!(wheels.handle_gyro(at(1.0), 0.0), Err(Rejection::OutOfOrder));
    }

    #[test]
    fn a_gyro_outweighs_slipping_wheels_long_after_its_bias_was_learnt() {
        let mut wheels = odometry();
        // Never at rest: a minute straight on, then a turn that the wheels overrate by half.
        for hundredth in 0..=6400 {
            let time = 0.01 * f64::from(hundredth);
            let turning = (time - 60.0).max(0.0);
            wheels.handle_gyro(at(time), if turning > 0.0 { 0.5 } else { 0.0 }).unwrap();
            let (forwards, apart) = (0.5 * time.min(60.0), 0.75 * 0.294 * turning);
            let ticks = |metres: f64| (metres * 138_000.0) as i64;
            wheels.handle_ticks(at(time), ticks(forwards - apart), ticks(forwards + apart)).unwrap();
        }
        let turned = wheels.odom_from_robot();
        assert!((turned.pose.heading - 2.0).abs() < 0.03, "{}", turned.pose.heading);
        // What the bias may have done in 64 s is said all the same.
        let sigma = turned.covariance[(2, 2)].sqrt();
        assert!(sigma > 0.02 && sigma < 0.1, "{sigma}");
    }

    proptest! {
        #[test]
        fn any_counts_leave_numbers(readings in prop::collection::vec((any::<i64>(), any::<i64>(), any::<i64>(), -1e300..1e300_f64), 1..20)) {
            let mut wheels = odometry();
            for (nanos, left, right, rate) in readings {
                let _ = wheels.handle_gyro(Timestamp::from_nanos(nanos), rate);
                let _ = wheels.handle_ticks(Timestamp::from_nanos(nanos), left, right);
                prop_assert!(wheels.odom_from_robot().is_finite());
            }
        }

        #[test]
        fn small_steps_are_as_uncertain_as_large_ones(distance in 0.1..1.0_f64, turn in -1.0..1.0_f64) {
            let params = WheelOdometryParams::default();
            let tenth = params.arc(0.1 * distance, 0.1 * turn, 0.1).motion();
            let small = (0..10).fold(UncertainPose::default(), |sum, _| sum.compose(&tenth));
            let large = params.arc(distance, turn, 1.0).motion();
            prop_assert!(small.pose.minus(&large.pose).norm() < 1e-9);
            // Not equal: in small steps an early turn swings the rest of the way. Along and across, within a third.
            let ratio = small.covariance.trace() / large.covariance.trace();
            prop_assert!((0.66..1.5).contains(&ratio), "{ratio}");
        }
    }
}
