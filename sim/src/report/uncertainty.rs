//! What a track's covariance says about its errors.

use nalgebra::{Matrix3, Matrix3x6};
use sunblind_estimator::geometry::skew;

use crate::runner::log::FrameLog;

/// Covariance of the body's position in the world, m². A left perturbation (ρ, φ) turns the body about the *world's*
/// origin, so that it moves by ρ + φ × t: far from the origin ρ alone says little.
pub(super) fn position_covariance(frame: &FrameLog) -> Matrix3<f64> {
    let mut position_from_perturbation = Matrix3x6::identity();
    position_from_perturbation.fixed_columns_mut::<3>(3).copy_from(&-skew(&frame.world_from_body.translation.vector));
    position_from_perturbation * frame.covariance * position_from_perturbation.transpose()
}

/// Covariance of the rotation vector in the world, rad².
pub(super) fn rotation_covariance(frame: &FrameLog) -> Matrix3<f64> {
    frame.covariance.fixed_view::<3, 3>(3, 3).into_owned()
}

/// Standard deviations along the axes.
pub(super) fn sigmas(covariance: &Matrix3<f64>) -> [f64; 3] {
    covariance.diagonal().map(|variance| variance.max(0.0).sqrt()).into()
}

/// The length that a Gaussian error of zero mean and this covariance stays below in 95 % of all cases; 0 without
/// covariance. Its squared length is taken for a scaled χ² (Satterthwaite, Biometrics 1946), whose quantile follows
/// Wilson and Hilferty (PNAS 1931): right to 3 % whatever the ellipsoid's shape.
pub(super) fn bound_95(covariance: &Matrix3<f64>) -> f64 {
    const NORMAL_QUANTILE_95: f64 = 1.644_854;
    let trace = covariance.trace();
    if trace.is_nan() || trace <= 0.0 {
        return 0.0;
    }
    let freedom = trace * trace / (covariance * covariance).trace();
    let spread = 2.0 / (9.0 * freedom);
    (trace * (1.0 - spread + NORMAL_QUANTILE_95 * spread.sqrt()).powi(3)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Isometry3, Matrix6, Vector3};
    use sunblind_estimator::{Health, Mode, Timestamp};

    #[test]
    fn the_bound_is_that_of_the_chi_square_tables() {
        for (axes, chi_square_95) in [([1.0, 0.0, 0.0], 3.841), ([1.0, 1.0, 0.0], 5.991), ([1.0, 1.0, 1.0], 7.815)] {
            let bound = bound_95(&Matrix3::from_diagonal(&Vector3::from(axes)));
            assert!((bound / f64::sqrt(chi_square_95) - 1.0).abs() < 0.03, "{axes:?}: {bound}");
        }
        assert_eq!(bound_95(&Matrix3::zeros()), 0.0);
    }

    #[test]
    fn an_uncertain_heading_moves_what_is_far_from_the_origin() {
        let mut covariance = Matrix6::zeros();
        covariance[(5, 5)] = 0.01_f64.powi(2);
        let frame = FrameLog {
            time: Timestamp::from_nanos(0),
            world_from_body: Isometry3::translation(10.0, 0.0, 0.0),
            covariance,
            mode: Mode::Indoor,
            health: Health::Good,
            counts: None,
            stage_ms: [0.0; 4],
        };
        let [x, y, z] = sigmas(&position_covariance(&frame));
        assert!(x < 1e-12 && (y - 0.1).abs() < 1e-12 && z < 1e-12);
    }
}
