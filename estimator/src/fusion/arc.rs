//! The piece of a circle that two wheels drive between two readings.

use nalgebra::{Matrix3, Vector3};

use super::planar::{PlanarPose, UncertainPose, symmetric};

/// Below this turn the series take over: their first neglected term, relative, is under 1e-14. Radians.
const SMALL_TURN: f64 = 1e-3;

/// A drive along an arc: distance, turn, and how uncertain each is. All its numbers grow in proportion along the arc,
/// so a part of an arc is an arc.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Arc {
    /// Along the arc, metres; negative backwards.
    pub distance: f64,
    /// Counter-clockwise, radians; any number of turns.
    pub turn: f64,
    /// Variance of the distance, m².
    pub distance_variance: f64,
    /// Variance of the turn, rad², but for the drift.
    pub turn_variance: f64,
    /// σ of a part of the turn's error that goes on into the next arc as it was in this, radians: a gyro's bias.
    pub turn_drift: f64,
    /// Variance of a slip across the chord, m². The wheels see none (paper A, Eq. 1), the ground allows some.
    pub side_variance: f64,
}

impl Arc {
    /// The first `share` (0–1) of the arc, driven at an even pace.
    pub fn part(&self, share: f64) -> Self {
        Self {
            distance: self.distance * share,
            turn: self.turn * share,
            distance_variance: self.distance_variance * share,
            turn_variance: self.turn_variance * share,
            turn_drift: self.turn_drift * share,
            side_variance: self.side_variance * share,
        }
    }

    /// `start_from_end`. Paper B's Eqs. 16–28, x = (d/α) sin α and y = (d/α)(1 − cos α) with d = (d_R + d_L)/2 and
    /// α = (d_R − d_L)/b, written so that straight (α = 0) and spin (d = 0) are no special cases.
    pub fn motion(&self) -> UncertainPose {
        self.motion_after(0.0)
    }

    /// The same where the turns before, since when errors are counted, have drifted by a σ of so many radians already:
    /// errors of one sign add up, not their squares.
    pub fn motion_after(&self, drift: f64) -> UncertainPose {
        let (d, a) = (self.distance, self.turn);
        // s = sin α / α, c = (1 − cos α)/α and their derivatives by α.
        let (s, c, ds, dc) = if a.abs() < SMALL_TURN {
            (1.0 - a * a / 6.0, a / 2.0 - a.powi(3) / 24.0, -a / 3.0 + a.powi(3) / 30.0, 0.5 - a * a / 8.0)
        } else {
            let (s, c) = (a.sin() / a, 2.0 * (a / 2.0).sin().powi(2) / a);
            (s, c, (a.cos() - s) / a, (a.sin() - c) / a)
        };
        let (sin_half, cos_half) = (a / 2.0).sin_cos();
        #[rustfmt::skip]
        let jacobian = Matrix3::new(
            s, d * ds, -sin_half,
            c, d * dc, cos_half,
            0.0, 1.0, 0.0,
        );
        let turn_variance = self.turn_variance + self.turn_drift * (2.0 * drift + self.turn_drift);
        let noise = Vector3::new(self.distance_variance, turn_variance, self.side_variance);
        UncertainPose {
            pose: PlanarPose::new(d * s, d * c, a),
            covariance: symmetric(&(jacobian * Matrix3::from_diagonal(&noise) * jacobian.transpose())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// ẋ = v cos θ, ẏ = v sin θ, θ̇ = ω (paper A, Eq. 3) over one second, by the midpoint rule.
    fn integrated(distance: f64, turn: f64) -> PlanarPose {
        let steps = 20_000;
        let dt = 1.0 / f64::from(steps);
        let (mut x, mut y) = (0.0, 0.0);
        for step in 0..steps {
            let heading = turn * (f64::from(step) + 0.5) * dt;
            x += distance * heading.cos() * dt;
            y += distance * heading.sin() * dt;
        }
        PlanarPose::new(x, y, turn)
    }

    fn arc(distance: f64, turn: f64) -> Arc {
        Arc { distance, turn, distance_variance: 4e-4, turn_variance: 9e-4, turn_drift: 0.0, side_variance: 1e-4 }
    }

    proptest! {
        #[test]
        fn an_arc_is_the_integral_of_the_kinematics(distance in -2.0..2.0_f64, turn in -7.0..7.0_f64) {
            let error = arc(distance, turn).motion().pose.minus(&integrated(distance, turn));
            prop_assert!(error.norm() < 1e-7, "{error}");
        }

        #[test]
        fn the_limits_are_met_without_a_step(distance in -2.0..2.0_f64, turn in -1.0..1.0_f64) {
            // Just inside and just outside the series, and a spin with a trace of driving.
            for (one, other) in [
                (arc(distance, SMALL_TURN * (1.0 - 1e-9)), arc(distance, SMALL_TURN * (1.0 + 1e-9))),
                (arc(distance, 0.0), arc(distance, 1e-12)),
                (arc(0.0, turn), arc(1e-12, turn)),
            ] {
                let (one, other) = (one.motion(), other.motion());
                prop_assert!(one.pose.minus(&other.pose).norm() < 1e-11);
                prop_assert!((one.covariance - other.covariance).norm() < 1e-12);
            }
        }

        #[test]
        fn two_parts_make_the_whole(distance in -2.0..2.0_f64, turn in -3.0..3.0_f64, share in 0.0..1.0_f64) {
            let whole = arc(distance, turn);
            let (first, second) = (whole.part(share).motion(), whole.part(1.0 - share).motion());
            prop_assert!((first.pose * second.pose).minus(&whole.motion().pose).norm() < 1e-9);
        }
    }

    #[test]
    fn what_drifts_adds_up_whatever_the_number_of_arcs() {
        let whole = Arc { turn_variance: 0.0, turn_drift: 0.1, ..arc(0.0, 0.5) };
        let tenth = whole.part(0.1);
        let sum: f64 = (0..10).map(|i| tenth.motion_after(0.01 * f64::from(i)).covariance[(2, 2)]).sum();
        assert!((sum - 0.01).abs() < 1e-12 && (whole.motion().covariance[(2, 2)] - 0.01).abs() < 1e-12);
    }

    #[test]
    fn straight_and_spin() {
        assert_eq!(arc(1.5, 0.0).motion().pose, PlanarPose::new(1.5, 0.0, 0.0));
        let spin = arc(0.0, 1.0).motion();
        assert_eq!(spin.pose, PlanarPose::new(0.0, 0.0, 1.0));
        // Across a spin of 1 rad the slip is split between x and y, never lost.
        assert!((spin.covariance.trace() - (4e-4 + 9e-4 + 1e-4)).abs() < 1e-4);
    }
}
