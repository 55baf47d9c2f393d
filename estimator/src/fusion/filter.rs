//! What the filters share: a planar pose that wheels carry on and measurements correct. They differ in the gain.

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Matrix3x2, Point2, SMatrix, SVector, Vector2, Vector3};

use super::gate::{Gate, GateParams, Verdict};
use super::planar::{PlanarPose, UncertainPose, symmetric, wrap_angle};

/// How much of an innovation goes into the state.
pub trait Gain {
    /// The gain for a measurement of the whole pose, H = I.
    fn for_pose(&self, seen: &Innovation<3>) -> Option<Matrix3<f64>>;
    /// The gain by which the covariance shrinks: of one that depends on the error, what it is of an error of one σ. By the
    /// error's own it would be luck how sure the filter is.
    fn expected_for_pose(&self, seen: &Innovation<3>) -> Option<Matrix3<f64>> {
        self.for_pose(seen)
    }
    /// The gain for a measurement that is shorter than the state.
    fn for_landmark(&self, seen: &Innovation<2>) -> Option<Matrix3x2<f64>>;
}

/// What a measurement of `M` numbers says that the filter did not expect, and how much of that was to be expected.
#[derive(Clone, Debug)]
pub struct Innovation<const M: usize> {
    /// E_{k+1|k}: measured minus predicted, angles within [−π, π].
    pub error: SVector<f64, M>,
    /// E_{k|k}: what the last measurement of this kind left unexplained.
    pub last_posterior: SVector<f64, M>,
    /// H.
    pub jacobian: SMatrix<f64, M, 3>,
    /// P_{k+1|k}.
    pub predicted: Matrix3<f64>,
    /// R.
    pub noise: SMatrix<f64, M, M>,
}

impl<const M: usize> Innovation<M> {
    /// H P Hᵀ: how uncertain what was predicted is where it is measured.
    pub fn expected(&self) -> SMatrix<f64, M, M> {
        self.jacobian * self.predicted * self.jacobian.transpose()
    }

    /// H P Hᵀ + R.
    pub fn covariance(&self) -> SMatrix<f64, M, M> {
        self.expected() + self.noise
    }

    /// Eᵀ (H P Hᵀ + R)⁻¹ E.
    fn mahalanobis_squared(&self) -> Option<f64> {
        Some(self.error.dot(&(self.covariance().try_inverse()? * self.error)))
    }

    /// Whether another error points the same way, within 60° where a σ is as long in each direction: of random ones a
    /// quarter does.
    fn agrees_with(&self, other: &SVector<f64, M>) -> bool {
        let Some(information) = self.covariance().try_inverse() else { return false };
        let product = |a: &SVector<f64, M>, b: &SVector<f64, M>| a.dot(&(information * b));
        product(&self.error, other) >= 0.5 * (product(&self.error, &self.error) * product(other, other)).sqrt()
    }
}

/// A landmark as the robot sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeBearing {
    /// Metres.
    pub range: f64,
    /// From the robot's x axis, counter-clockwise, radians.
    pub bearing: f64,
    /// Covariance of (range, bearing); m², m·rad, rad².
    pub covariance: Matrix2<f64>,
}

/// What became of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is in the estimate.
    Fused,
    /// The gate kept it out.
    Gated,
    /// It would leave no finite estimate, or says nothing new: certain of what is known for certain already.
    Unusable,
}

/// A filter over (x, y, heading).
#[derive(Clone, Debug)]
pub struct PoseFilter<G> {
    estimate: UncertainPose,
    gain: G,
    gate: Gate,
    pose_posterior: Vector3<f64>,
    landmark_posterior: Vector2<f64>,
    /// The innovation of the last pose, if that was beyond the gate.
    surprise: Option<Vector3<f64>>,
}

impl<G: Gain> PoseFilter<G> {
    /// Starts from an estimate.
    pub fn with_gain(start: UncertainPose, gain: G, gate: GateParams) -> Self {
        let (pose_posterior, landmark_posterior) = (Vector3::zeros(), Vector2::zeros());
        Self { estimate: start, gain, gate: Gate::new(gate), pose_posterior, landmark_posterior, surprise: None }
    }

    /// The pose and its covariance.
    pub fn estimate(&self) -> &UncertainPose {
        &self.estimate
    }

    /// Paper A, Eqs. 7–8 and 12: `start_from_end` of a motion carries the pose on, its noise is Q.
    pub fn predict(&mut self, motion: &UncertainPose) {
        self.estimate = self.estimate.carried(motion);
    }

    /// Takes a measured pose, H = I.
    pub fn update_pose(&mut self, measured: &UncertainPose) -> Outcome {
        let predicted = self.estimate;
        self.update_pose_from(&predicted, measured)
    }

    /// Takes a measured pose and another prediction than the estimate, which has in it what was measured before with the
    /// same error. What is kept out leaves the estimate as it was.
    pub fn update_pose_from(&mut self, predicted: &UncertainPose, measured: &UncertainPose) -> Outcome {
        let mut seen = Innovation {
            error: measured.pose.minus(&predicted.pose),
            last_posterior: self.pose_posterior,
            jacobian: Matrix3::identity(),
            predicted: predicted.covariance,
            noise: measured.covariance,
        };
        let repeats = self.surprise.is_none_or(|last| seen.agrees_with(&last));
        let outcome = self.correct(&predicted.pose, &mut seen, Some(repeats), |gain, seen| {
            Some((gain.for_pose(seen)?, gain.expected_for_pose(seen)?))
        });
        self.surprise = (!self.gate.is_calm()).then_some(seen.error);
        if outcome == Outcome::Fused {
            self.pose_posterior = measured.pose.minus(&self.estimate.pose);
        }
        outcome
    }

    /// Takes a sighting of a landmark whose place is known, in the frame of the estimate.
    pub fn update_landmark(&mut self, sighting: &RangeBearing, landmark: &Point2<f64>) -> Outcome {
        let error = landmark_error(sighting, landmark, &self.estimate.pose);
        let mut seen = Innovation {
            error,
            last_posterior: self.landmark_posterior,
            jacobian: landmark_jacobian(landmark, &self.estimate.pose),
            predicted: self.estimate.covariance,
            noise: sighting.covariance,
        };
        // Sightings of different landmarks can't be compared.
        let predicted = self.estimate.pose;
        let outcome =
            self.correct(&predicted, &mut seen, None, |gain, seen| gain.for_landmark(seen).map(|gain| (gain, gain)));
        if outcome == Outcome::Fused {
            self.landmark_posterior = landmark_error(sighting, landmark, &self.estimate.pose);
        }
        outcome
    }

    /// From here on the pose is counted from where the robot stands, with nothing to doubt.
    pub fn restart(&mut self) {
        // What was left unexplained is still so; it is only seen from the new axes.
        self.pose_posterior = self.estimate.pose.turn().transpose() * self.pose_posterior;
        self.surprise = self.surprise.map(|error| self.estimate.pose.turn().transpose() * error);
        self.estimate = UncertainPose::default();
    }

    fn correct<const M: usize>(
        &mut self,
        predicted: &PlanarPose,
        seen: &mut Innovation<M>,
        repeats: Option<bool>,
        gains: impl Fn(&G, &Innovation<M>) -> Option<(SMatrix<f64, 3, M>, SMatrix<f64, 3, M>)>,
    ) -> Outcome {
        let Some(squared) = seen.mahalanobis_squared().filter(|squared| squared.is_finite()) else {
            return Outcome::Unusable;
        };
        match self.gate.judge(squared, repeats) {
            Verdict::Admit => {}
            Verdict::Refuse => return Outcome::Gated,
            Verdict::AdmitDoubting(factor) => {
                seen.predicted *= factor;
                seen.noise *= factor;
            }
        }
        let Some((gain, expected)) = gains(&self.gain, seen) else { return Outcome::Unusable };
        // The Joseph form holds for any gain and stays positive semi-definite; Eq. 11 is its special case for the
        // Kalman gain. Bucy & Joseph 1968.
        let rest = Matrix3::identity() - expected * seen.jacobian;
        let covariance = rest * seen.predicted * rest.transpose() + expected * seen.noise * expected.transpose();
        let corrected =
            UncertainPose { pose: predicted.plus(&(gain * seen.error)), covariance: symmetric(&covariance) };
        if !corrected.is_finite() {
            return Outcome::Unusable;
        }
        self.estimate = corrected;
        Outcome::Fused
    }
}

/// Measured minus predicted (range, bearing).
fn landmark_error(sighting: &RangeBearing, landmark: &Point2<f64>, robot: &PlanarPose) -> Vector2<f64> {
    let (dx, dy) = (landmark.x - robot.x, landmark.y - robot.y);
    let bearing = dy.atan2(dx) - robot.heading;
    Vector2::new(sighting.range - dx.hypot(dy), wrap_angle(sighting.bearing - bearing))
}

/// ∂(range, bearing)/∂(x, y, heading). Not finite on the landmark itself, which the update then refuses.
fn landmark_jacobian(landmark: &Point2<f64>, robot: &PlanarPose) -> Matrix2x3<f64> {
    let (dx, dy) = (landmark.x - robot.x, landmark.y - robot.y);
    let range = dx.hypot(dy);
    let squared = range * range;
    Matrix2x3::new(-dx / range, -dy / range, 0.0, dy / squared, -dx / squared, -1.0)
}
