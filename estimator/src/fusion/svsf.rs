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
    /// φ, the width of the smoothing boundary layer, in σ of the measurement; wider by as much as the measurement is less
    /// sure than the prediction. Within it the gain falls with the error, so that noise is not followed; beyond it the
    /// estimate is brought to the measurement whatever the covariances say.
    pub layer_sigma: f64,
}

impl Default for SvsfParams {
    /// Chosen on simulated drives: between 0.3 and 3 σ of layer, and between 0 and 0.4 for γ, the error differs by 3 %;
    /// what differs is the covariance, which the Joseph form makes larger than the error the wider the layer is (mean
    /// NEES 2.4 of 3 at 0.3 σ, 1.7 at 1 σ, 0.9 at 3 σ), because it takes a gain that rises with the error for a
    /// constant one.
    fn default() -> Self {
        Self { gamma: 0.2, layer_sigma: 1.0 }
    }
}

/// The narrowest boundary layer, metres or radians: a measurement may claim to be certain.
const NARROWEST_LAYER: f64 = 1e-9;

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
    /// (|E| + γ|E_{k|k}|) / max(|E|, φ) and so needs no care at E = 0.
    fn shares<const M: usize>(&self, seen: &Innovation<M>) -> SVector<f64, M> {
        let expected = seen.expected();
        SVector::from_fn(|i, _| {
            let (error, last) = (seen.error[i].abs(), seen.last_posterior[i].abs());
            let [noise, predicted] = [seen.noise, expected].map(|covariance| covariance[(i, i)].max(0.0).sqrt());
            let widened = (noise / predicted.max(NARROWEST_LAYER)).max(1.0);
            let layer = (self.0.layer_sigma * noise * widened).max(NARROWEST_LAYER);
            (error + self.0.gamma * last) / error.max(layer)
        })
    }
}

impl Gain for SvsfGain {
    fn for_pose(&self, seen: &Innovation<3>) -> Option<Matrix3<f64>> {
        Some(Matrix3::from_diagonal(&self.shares(seen)))
    }

    /// With fewer numbers than the state has, H⁺ must say how a share of the error is spread over x, y and heading. As
    /// in the covariance form (Gadsden & Habibi 2010) the filter carries P; here P also weighs the pseudoinverse,
    /// H⁺ = P Hᵀ (H P Hᵀ)⁻¹, because the plain one would weigh metres against radians.
    fn for_landmark(&self, seen: &Innovation<2>) -> Option<Matrix3x2<f64>> {
        let spread = seen.predicted * seen.jacobian.transpose();
        let inverse = spread * (seen.jacobian * spread).try_inverse()?;
        Some(inverse * nalgebra::Matrix2::from_diagonal(&self.shares(seen)))
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
        let params = SvsfParams { gamma: 0.0, layer_sigma: 2.0 };
        let mut svsf = Svsf::new(at(0.0, 0.0, 0.0), params, GateParams::open());
        // σ is 0.1, so the layer is 0.2: x and heading lie beyond it, the heading the short way round; y half way in.
        svsf.update_pose(&at(0.5, 0.1, -0.3));
        let estimate = svsf.estimate();
        assert!((estimate.pose.to_vector() - Vector3::new(0.5, 0.05, -0.3)).norm() < 1e-12);
        // Joseph with K = 1 leaves R, with K = 1/2 a quarter of P and of R.
        assert!((estimate.covariance.diagonal() - Vector3::new(0.01, 0.005, 0.01)).norm() < 1e-12);
    }

    #[test]
    fn what_is_less_sure_than_the_prediction_has_a_wider_layer() {
        let params = SvsfParams { gamma: 0.0, layer_sigma: 2.0 };
        let mut svsf = Svsf::new(at(0.0, 0.0, 0.0), params, GateParams::open());
        // σ is 0.5, five times the prediction's: the layer is 2 · 0.5 · 5.
        let doubtful = UncertainPose { covariance: Matrix3::identity() * 0.25, ..at(1.0, 0.0, 0.0) };
        svsf.update_pose(&doubtful);
        assert!((svsf.estimate().pose.x - 0.2).abs() < 1e-12);
    }

    #[test]
    fn what_was_left_unexplained_is_added_to_the_next_step() {
        let params = SvsfParams { gamma: 0.4, layer_sigma: 2.0 };
        let doubtful = UncertainPose { covariance: Matrix3::identity(), ..UncertainPose::default() };
        let mut svsf = Svsf::new(doubtful, params, GateParams::open());
        svsf.update_pose(&at(0.1, 0.0, 0.0));
        assert!((svsf.estimate().pose.x - 0.05).abs() < 1e-12);
        svsf.predict(&doubtful);
        // E = 0.05 again and E_{k|k} = 0.05: K = (0.05 + 0.4 · 0.05) / 0.2.
        svsf.update_pose(&at(0.1, 0.0, 0.0));
        assert!((svsf.estimate().pose.x - (0.05 + 0.35 * 0.05)).abs() < 1e-12);
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
