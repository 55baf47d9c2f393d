//! Least squares over all pairs, weighted by what each point is worth.

use nalgebra::{Isometry3, Matrix3, Matrix3x6, Matrix6, Vector3, Vector6};
use serde::{Deserialize, Serialize};

use super::{Motion, MotionFailure, Pair};
use crate::geometry::{exp_se3, skew};

/// Parameters of the refinement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RefineParams {
    /// Rounds, at most.
    pub max_iterations: usize,
    /// Ends when a step is shorter than this, metres and radians.
    pub step_tolerance: f64,
    /// Scale of the Cauchy weight 1 / (1 + (d/c)²), in σ; 2.4 keeps 95 % of the efficiency on normal errors
    /// (Zhang 1997).
    pub cauchy_sigma: f64,
    /// Largest Mahalanobis distance of an inlier, in σ.
    pub max_distance_sigma: f64,
    /// Fewest inliers of a motion that is believed.
    pub min_inliers: usize,
    /// Largest standard deviation of the weakest direction, at the points' centre, of a motion that is believed.
    #[serde(rename = "max_weakest_sigma_m")]
    pub max_weakest_sigma: f64,
}

impl Default for RefineParams {
    fn default() -> Self {
        Self {
            max_iterations: 20,
            step_tolerance: 1e-6,
            cauchy_sigma: 2.4,
            max_distance_sigma: 3.4,
            min_inliers: 12,
            max_weakest_sigma: 0.05,
        }
    }
}

/// Minimises Σ ρ(eᵀ (Σ_reference + R Σ_camera Rᵀ)⁻¹ e), e = R camera + t − reference: paper A's Eq. 4 with each
/// point weighted by its uncertainty on both sides (maximum likelihood), by Gauss–Newton from `start`.
///
/// # Errors
/// [`MotionFailure::TooFewInliers`] or [`MotionFailure::DegenerateGeometry`].
pub fn refine(pairs: &[Pair], start: &Isometry3<f64>, params: &RefineParams) -> Result<Motion, MotionFailure> {
    let mut motion = *start;
    for _ in 0..params.max_iterations {
        let system = linearise(pairs, &motion, params.cauchy_sigma);
        let Some(cholesky) = system.hessian.cholesky() else { break };
        let step: Vector6<f64> = -cholesky.solve(&system.gradient);
        motion = exp_se3(&step) * motion;
        if step.norm() < params.step_tolerance {
            break;
        }
    }
    let limit = params.max_distance_sigma * params.max_distance_sigma;
    let inliers: Vec<bool> =
        pairs.iter().map(|pair| mahalanobis_squared(pair, &motion).is_some_and(|d| d < limit)).collect();
    let found = inliers.iter().filter(|&&inlier| inlier).count();
    if found < params.min_inliers {
        return Err(MotionFailure::TooFewInliers { found, needed: params.min_inliers });
    }
    let system = linearise(pairs, &motion, params.cauchy_sigma);
    let Some(cholesky) = system.hessian.cholesky() else {
        return Err(MotionFailure::DegenerateGeometry { sigma: f64::INFINITY });
    };
    // The residuals say how far the assumed noise was off; it is never taken for smaller than assumed.
    let covariance = cholesky.inverse() * system.misfit().max(1.0);
    let sigma = weakest_sigma(&covariance, &system.centre);
    if sigma > params.max_weakest_sigma {
        return Err(MotionFailure::DegenerateGeometry { sigma });
    }
    Ok(Motion { reference_from_camera: motion, covariance, inliers })
}

/// Normal equations at one motion.
struct System {
    hessian: Matrix6<f64>,
    gradient: Vector6<f64>,
    /// Weighted mean of the points, reference frame.
    centre: Vector3<f64>,
    weighted_squares: f64,
    weight: f64,
}

impl System {
    /// Mean weighted square of the residuals over its expectation, three a pair.
    fn misfit(&self) -> f64 {
        self.weighted_squares / (3.0 * self.weight)
    }
}

fn linearise(pairs: &[Pair], motion: &Isometry3<f64>, cauchy: f64) -> System {
    let rotation = motion.rotation.to_rotation_matrix();
    let mut system = System {
        hessian: Matrix6::zeros(),
        gradient: Vector6::zeros(),
        centre: Vector3::zeros(),
        weighted_squares: 0.0,
        weight: 0.0,
    };
    for pair in pairs {
        let Some(information) = information(pair, rotation.matrix()) else { continue };
        let point = motion * pair.camera.position;
        let error = point - pair.reference.position;
        let squared = error.dot(&(information * error));
        let weight = 1.0 / (1.0 + squared / (cauchy * cauchy));
        let mut jacobian = Matrix3x6::identity();
        jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-skew(&point.coords));
        let weighted = jacobian.transpose() * (information * weight);
        system.hessian += weighted * jacobian;
        system.gradient += weighted * error;
        system.centre += point.coords * weight;
        system.weighted_squares += squared * weight;
        system.weight += weight;
    }
    system.centre /= system.weight.max(f64::MIN_POSITIVE);
    system
}

fn information(pair: &Pair, rotation: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    (pair.reference.covariance + rotation * pair.camera.covariance * rotation.transpose()).try_inverse()
}

fn mahalanobis_squared(pair: &Pair, motion: &Isometry3<f64>) -> Option<f64> {
    let error = motion * pair.camera.position - pair.reference.position;
    Some(error.dot(&(information(pair, motion.rotation.to_rotation_matrix().matrix())? * error)))
}

/// Standard deviation of the weakest direction in which the point `centre` may move; metres.
fn weakest_sigma(covariance: &Matrix6<f64>, centre: &Vector3<f64>) -> f64 {
    let mut jacobian = Matrix3x6::identity();
    jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-skew(centre));
    (jacobian * covariance * jacobian.transpose()).symmetric_eigenvalues().max().max(0.0).sqrt()
}
