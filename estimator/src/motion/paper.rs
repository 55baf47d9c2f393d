//! ICP-SURF as paper A has it: every pair weighs the same.

use nalgebra::Matrix6;
use serde::{Deserialize, Serialize};

use super::{Motion, MotionFailure, Pair, RansacParams, fit_rigid, ransac};

/// Parameters of the paper's variant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PaperMotionParams {
    /// Distance above which a pair is rejected before the next fit, metres. The paper names none: a guess.
    #[serde(rename = "max_distance_m")]
    pub max_distance: f64,
    /// Rounds of reject and refit, at most.
    pub max_iterations: usize,
    /// Points beyond this are not used (paper A, §3), metres.
    #[serde(rename = "max_depth_m")]
    pub max_depth: f64,
}

impl Default for PaperMotionParams {
    fn default() -> Self {
        Self { max_distance: 0.05, max_iterations: 20, max_depth: 2.4 }
    }
}

/// Starts from [`ransac`], as the paper is silent on where ICP starts, then
/// minimises (1/N) Σ ‖R P^{i+1} + t − P^i‖² (Eq. 4) over the pairs that agree, until they no longer change.
/// The paper gives no covariance; this one is the least squares' own, σ² (Σ JᵀJ)⁻¹ with σ from the residuals.
///
/// # Errors
/// [`MotionFailure::TooFewMatches`] or [`MotionFailure::TooFewInliers`].
pub fn icp_surf(pairs: &[Pair], search: &RansacParams, params: &PaperMotionParams) -> Result<Motion, MotionFailure> {
    let needed = search.min_inliers;
    let mut motion = ransac(pairs, search)?;
    let mut inliers: Vec<bool> = Vec::new();
    for _ in 0..params.max_iterations {
        let agreeing: Vec<bool> = pairs
            .iter()
            .map(|pair| (motion * pair.camera.position - pair.reference.position).norm() < params.max_distance)
            .collect();
        if agreeing == inliers {
            break;
        }
        inliers = agreeing;
        let kept = pairs.iter().zip(&inliers).filter(|(_, inlier)| **inlier);
        let found = kept.clone().count();
        let fitted = fit_rigid(kept.map(|(pair, _)| (&pair.camera.position, &pair.reference.position)));
        motion = match fitted {
            Some(fitted) if found >= needed => fitted,
            _ => return Err(MotionFailure::TooFewInliers { found, needed }),
        };
    }
    let (mut hessian, mut squares, mut count) = (Matrix6::zeros(), 0.0, 0_usize);
    for (pair, _) in pairs.iter().zip(&inliers).filter(|(_, inlier)| **inlier) {
        let point = motion * pair.camera.position;
        let mut jacobian = nalgebra::Matrix3x6::identity();
        jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-crate::geometry::skew(&point.coords));
        hessian += jacobian.transpose() * jacobian;
        squares += (point - pair.reference.position).norm_squared();
        count += 1;
    }
    let variance = squares / (3 * count - 6) as f64;
    let covariance =
        hessian.try_inverse().ok_or(MotionFailure::DegenerateGeometry { sigma: f64::INFINITY })? * variance;
    Ok(Motion { reference_from_camera: motion, covariance, inliers })
}
