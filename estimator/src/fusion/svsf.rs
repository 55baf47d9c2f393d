//! The smooth variable structure filter (paper A, Eqs. 12–19; Habibi 2007).

use nalgebra::{Matrix3, Matrix3x2, SVector};
use serde::{Deserialize, Serialize};

use super::filter::{Gain, Innovation, PoseFilter};
use super::gate::GateParams;
use super::planar::UncertainPose;

/// Parameters of the gain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SvsfParams {
    /// γ, 0–1: the share of the last step's unexplained error that an error may shrink to in this one.
    pub gamma: f64,
    /// φ, the width of the smoothing boundary layer, in σ of the measurement times S/P, so that a measurement that is less
    /// sure than the prediction is followed, at an error of one σ, as the Kalman filter follows it, and a surer one all the
    /// way (after the optimal layer of Gadsden & Habibi). Within it the gain falls with the error, so that noise is not
    /// followed; beyond it the estimate is brought to the measurement whatever the covariances say.
    pub layer_sigma: f64,
}

impl Default for SvsfParams {
    /// γ: between 0 and 0.4 errors on simulated drives differ by 3 %. φ: were all covariances right and the measurement less
    /// sure than the prediction, P − P²/S · (2 √(8/π)/φ − 3/φ²) would be left of P, least at 1.88; where covariances are too
    /// large, errors are small beside the layer and less is better. A compromise on simulated drives: from 1 to 1.9 the ATE
    /// falls from 0.10 to 0.05 m on one with a gyro and rises from 0.05 to 0.07 m on one without.
    fn default() -> Self {
        Self { gamma: 0.2, layer_sigma: 1.4 }
    }
}

/// The least variance, m² or rad²: what is predicted or measured may claim to be certain.
const LEAST_VARIANCE: f64 = 1e-18;

/// The gain that switches with the sign of the error and is smoothed near it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SvsfGain(SvsfParams);

/// Smooth variable structure filter over (x, y, heading).
pub type Svsf = PoseFilter<SvsfGain>;

impl Svsf {
    /// Starts from an estimate.
    pub fn new(start: UncertainPose, params: SvsfParams, gate: GateParams) -> Self {
        Self::with_gain(start, SvsfGain(params), gate)
    }
}

impl SvsfGain {
    /// Eqs. 15–16 for one component after the other: (|E| + γ|E_{k|k}|) · sat(E/φ) / E, which is
    /// (|E| + γ|E_{k|k}|) / max(|E|, φ) and so needs no care at E = 0. `expected`: what it is within the layer for an error of
    /// one σ.
    fn shares<const M: usize>(&self, seen: &Innovation<M>, expected: bool) -> SVector<f64, M> {
        let (predicted, covariance) = (seen.expected(), seen.covariance());
        SVector::from_fn(|i, _| {
            let (error, last) = (seen.error[i].abs(), seen.last_posterior[i].abs());
            let [predicted, noise, variance] =
                [predicted, seen.noise, covariance].map(|covariance| covariance[(i, i)].max(LEAST_VARIANCE));
            let layer = self.0.layer_sigma * noise.sqrt() * variance / predicted;
            if expected && error < layer {
                return ((variance.sqrt() + self.0.gamma * last) / layer).min(1.0);
            }
            (error + self.0.gamma * last) / error.max(layer)
        })
    }

    /// The gain along the axes on which neither the prediction's errors nor the measurement's go together, or a heading that
    /// is known would be turned because a position that is not would be moved: with S = P + R = L Lᵀ, those of L⁻¹ P L⁻ᵀ.
    /// Where both covariances are diagonal they are x, y and heading, as in the paper.
    fn along_own_axes(&self, seen: &Innovation<3>, expected: bool) -> Option<Matrix3<f64>> {
        let root = seen.covariance().cholesky()?.l();
        let inverse = root.try_inverse()?;
        let axes = (inverse * seen.predicted * inverse.transpose()).symmetric_eigen();
        let onto = axes.eigenvectors.transpose() * inverse;
        let along = Innovation {
            error: onto * seen.error,
            last_posterior: onto * seen.last_posterior,
            jacobian: Matrix3::identity(),
            predicted: Matrix3::from_diagonal(&axes.eigenvalues),
            noise: Matrix3::from_diagonal(&axes.eigenvalues.map(|predicted| 1.0 - predicted)),
        };
        Some(root * axes.eigenvectors * Matrix3::from_diagonal(&self.shares(&along, expected)) * onto)
    }
}

impl Gain for SvsfGain {
    fn for_pose(&self, seen: &Innovation<3>) -> Option<Matrix3<f64>> {
        self.along_own_axes(seen, false)
    }

    fn expected_for_pose(&self, seen: &Innovation<3>) -> Option<Matrix3<f64>> {
        self.along_own_axes(seen, true)
    }

    /// With fewer numbers than the state has, H⁺ must say how a share of the error is spread over x, y and heading. As
    /// in the covariance form (Gadsden & Habibi 2010) the filter carries P; here P also weighs the pseudoinverse,
    /// H⁺ = P Hᵀ (H P Hᵀ)⁻¹, because the plain one would weigh metres against radians.
    fn for_landmark(&self, seen: &Innovation<2>) -> Option<Matrix3x2<f64>> {
        let spread = seen.predicted * seen.jacobian.transpose();
        let inverse = spread * (seen.jacobian * spread).try_inverse()?;
        Some(inverse * nalgebra::Matrix2::from_diagonal(&self.shares(seen, false)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::{Outcome, PlanarPose};
    use nalgebra::Vector3;

    fn at(x: f64, y: f64, heading: f64) -> UncertainPose {
        UncertainPose { pose: PlanarPose::new(x, y, heading), covariance: Matrix3::identity() * 0.01 }
    }

    #[test]
    fn beyond_the_layer_the_estimate_goes_all_the_way() {
        let params = SvsfParams { gamma: 0.0, layer_sigma: 1.0 };
        let mut svsf = Svsf::new(at(0.0, 0.0, 0.0), params, GateParams::open());
        // P and R are 0.01, so the layer is 0.1 · 2: x and heading lie beyond it, the heading the short way round; y half way
        // in.
        svsf.update_pose(&at(0.5, 0.1, -0.3));
        let estimate = svsf.estimate();
        assert!((estimate.pose.to_vector() - Vector3::new(0.5, 0.05, -0.3)).norm() < 1e-12);
        // Joseph with K = 1 leaves R; within the layer with that of one σ, here √0.02 / 0.2, its share of P and of R.
        let share = 0.5_f64.sqrt();
        let left = 0.01 * ((1.0 - share).powi(2) + share * share);
        assert!((estimate.covariance.diagonal() - Vector3::new(0.01, left, 0.01)).norm() < 1e-12);
    }

    #[test]
    fn what_is_less_sure_than_the_prediction_has_a_wider_layer() {
        let params = SvsfParams { gamma: 0.0, layer_sigma: 1.0 };
        let mut svsf = Svsf::new(at(0.0, 0.0, 0.0), params, GateParams::open());
        // σ is 0.5, five times the prediction's: the layer is 0.5 · 26.
        let doubtful = UncertainPose { covariance: Matrix3::identity() * 0.25, ..at(1.3, 0.0, 0.0) };
        svsf.update_pose(&doubtful);
        assert!((svsf.estimate().pose.x - 0.13).abs() < 1e-12);
    }

    #[test]
    fn a_position_that_is_moved_turns_no_heading_that_is_known() {
        // Where turning and going aside look alike, a measurement may be off by both together; the heading is known.
        let covariance = Matrix3::from_diagonal(&Vector3::new(0.01, 0.01, 1e-6));
        let start = UncertainPose { covariance, ..UncertainPose::default() };
        let mut svsf = Svsf::new(start, SvsfParams::default(), GateParams::open());
        #[rustfmt::skip]
        let covariance = Matrix3::new(
            0.01, 0.0, 0.0,
            0.0, 0.01, 0.0099,
            0.0, 0.0099, 0.01,
        );
        svsf.update_pose(&UncertainPose { covariance, ..at(0.0, 0.1, 0.1) });
        let PlanarPose { y, heading, .. } = svsf.estimate().pose;
        // The heading's error is the measurement's, and so is most of y's.
        assert!(heading.abs() < 0.002 && y.abs() < 0.03, "{y} {heading}");
    }

    #[test]
    fn what_was_left_unexplained_is_added_to_the_next_step() {
        let params = SvsfParams { gamma: 0.4, layer_sigma: 2.0 };
        let doubtful = UncertainPose { covariance: Matrix3::identity(), ..UncertainPose::default() };
        let mut svsf = Svsf::new(doubtful, params, GateParams::open());
        let layer = |svsf: &Svsf| {
            let predicted = svsf.estimate().covariance[(0, 0)];
            2.0 * 0.1 * (predicted + 0.01) / predicted
        };
        let first = 0.1 * 0.1 / layer(&svsf);
        svsf.update_pose(&at(0.1, 0.0, 0.0));
        assert!((svsf.estimate().pose.x - first).abs() < 1e-12);
        svsf.predict(&doubtful);
        // E is what was left, E_{k|k}, again: K = (E + 0.4 E) / φ.
        let (left, width) = (0.1 - first, layer(&svsf));
        svsf.update_pose(&at(0.1, 0.0, 0.0));
        assert!((svsf.estimate().pose.x - (first + left * 1.4 * left / width)).abs() < 1e-12);
        // Beyond the layer the posterior error is γ times the last, on the other side (the stability of Eq. 15).
        let last = 0.1 - svsf.estimate().pose.x;
        svsf.update_pose(&at(1.0, 0.0, 0.0));
        assert!((1.0 - svsf.estimate().pose.x + 0.4 * last).abs() < 1e-12);
    }

    #[test]
    fn angles_wrap_before_they_are_compared() {
        let start = UncertainPose { pose: PlanarPose::new(0.0, 0.0, 3.1), ..UncertainPose::default() };
        let mut svsf = Svsf::new(start, SvsfParams::default(), GateParams::open());
        svsf.update_pose(&at(0.0, 0.0, -3.1));
        assert!((svsf.estimate().pose.heading.abs() - std::f64::consts::PI).abs() < 0.05);
    }

    #[test]
    fn no_error_needs_no_guard() {
        let mut svsf = Svsf::new(UncertainPose::default(), SvsfParams::default(), GateParams::open());
        let certain = UncertainPose::default();
        assert_eq!(svsf.update_pose(&certain), Outcome::Unusable);
        assert_eq!(svsf.update_pose(&at(0.0, 0.0, 0.0)), Outcome::Fused);
        assert!(svsf.estimate().is_finite());
    }
}
