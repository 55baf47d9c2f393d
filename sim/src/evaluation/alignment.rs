//! The rigid motion that lays one path best upon another. Deliberately not the estimator's own: who judges shares no
//! code with who is judged.

use nalgebra::{Matrix3, Vector3};

use super::{PosePair, root_mean_square};

/// RMSE of the estimated positions after the rigid alignment without scale that makes it least, in metres:
/// Umeyama (PAMI 1991), eqs. 34–43 with c = 1.
pub(super) fn aligned_rmse(pairs: &[PosePair]) -> f64 {
    let count = pairs.len() as f64;
    let mean_estimate = pairs.iter().map(|pair| pair.estimate.translation.vector).sum::<Vector3<f64>>() / count;
    let mean_truth = pairs.iter().map(|pair| pair.truth.translation.vector).sum::<Vector3<f64>>() / count;
    let centred = || {
        pairs
            .iter()
            .map(|pair| (pair.estimate.translation.vector - mean_estimate, pair.truth.translation.vector - mean_truth))
    };
    // Eq. 38.
    let covariance: Matrix3<f64> = centred().map(|(estimate, truth)| truth * estimate.transpose()).sum();
    let truth_from_estimate = nearest_rotation(&covariance);
    root_mean_square(centred().map(|(estimate, truth)| (truth_from_estimate * estimate - truth).norm()))
}

/// The rotation R that makes tr(Rᵀ M) largest (eqs. 40 and 43). On a straight path it isn't unique, but the
/// distances that it leaves are.
fn nearest_rotation(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = matrix.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return Matrix3::identity() };
    // Singular values come sorted, so that the reflection is taken out of the weakest direction.
    let handedness = (u.determinant() * v_t.determinant()).signum();
    u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, handedness)) * v_t
}
