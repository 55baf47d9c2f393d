//! Rigid motions and their tangent space, on nalgebra.
//!
//! A transform is named `a_from_b`: it takes coordinates in frame b to coordinates in frame a.
//! A tangent vector of SE(3) is (ρ, φ): translation part first, then rotation, perturbing **on the left**:
//! `perturbed = exp(ξ) · a_from_b`, so ξ is expressed in frame a.

use nalgebra::{Isometry3, Matrix3, Matrix6, Rotation3, Translation3, UnitQuaternion, Vector3, Vector6};

/// The matrix `[v]ₓ` with `[v]ₓ w = v × w`.
pub fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// Exponential map se(3) → SE(3) of (ρ, φ) (Barfoot, *State Estimation for Robotics*, eqs. 7.32, 7.37).
pub fn exp_se3(xi: &Vector6<f64>) -> Isometry3<f64> {
    let rho = xi.fixed_rows::<3>(0).into_owned();
    let phi = xi.fixed_rows::<3>(3).into_owned();
    let rotation = UnitQuaternion::from_scaled_axis(phi);
    Isometry3::from_parts(Translation3::from(left_jacobian_so3(&phi) * rho), rotation)
}

/// Logarithm SE(3) → se(3), the inverse of [`exp_se3`] for rotations below π.
pub fn log_se3(transform: &Isometry3<f64>) -> Vector6<f64> {
    let phi = transform.rotation.scaled_axis();
    let jacobian = left_jacobian_so3(&phi);
    // det J = 2(1 − cos θ)/θ² > 0 below 2π, so the inverse exists for every rotation vector up to π.
    let rho = jacobian.try_inverse().unwrap_or_else(Matrix3::identity) * transform.translation.vector;
    Vector6::new(rho.x, rho.y, rho.z, phi.x, phi.y, phi.z)
}

/// Left Jacobian of SO(3) (Barfoot eq. 7.37), by its series near zero.
fn left_jacobian_so3(phi: &Vector3<f64>) -> Matrix3<f64> {
    let angle_squared = phi.norm_squared();
    let angle = angle_squared.sqrt();
    let cross = skew(phi);
    let (a, b) = if angle < 1e-4 {
        (0.5 - angle_squared / 24.0, 1.0 / 6.0 - angle_squared / 120.0)
    } else {
        ((1.0 - angle.cos()) / angle_squared, (angle - angle.sin()) / (angle_squared * angle))
    };
    Matrix3::identity() + cross * a + cross * cross * b
}

/// Adjoint of SE(3) for (ρ, φ): carries a left perturbation through a transform,
/// `a_from_b · exp(ξ) = exp(Ad ξ) · a_from_b`.
pub fn adjoint(transform: &Isometry3<f64>) -> Matrix6<f64> {
    let rotation: Rotation3<f64> = transform.rotation.to_rotation_matrix();
    let mut adjoint = Matrix6::zeros();
    adjoint.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation.matrix());
    adjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(rotation.matrix());
    adjoint.fixed_view_mut::<3, 3>(0, 3).copy_from(&(skew(&transform.translation.vector) * rotation.matrix()));
    adjoint
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tangent(rotation: f64) -> impl Strategy<Value = Vector6<f64>> {
        (prop::array::uniform3(-5.0..5.0_f64), prop::array::uniform3(-1.0..1.0_f64), 0.0..rotation).prop_map(
            |(rho, axis, angle)| {
                let axis = Vector3::from(axis);
                let phi = if axis.norm() > 1e-3 { axis.normalize() * angle } else { Vector3::zeros() };
                Vector6::new(rho[0], rho[1], rho[2], phi.x, phi.y, phi.z)
            },
        )
    }

    proptest! {
        #[test]
        fn log_undoes_exp(xi in tangent(3.1)) {
            prop_assert!((log_se3(&exp_se3(&xi)) - xi).norm() < 1e-8);
        }

        #[test]
        fn exp_near_zero_meets_exp_away_from_it(xi in tangent(2e-4)) {
            // The series and the closed form must agree across the switch between them.
            prop_assert!((log_se3(&exp_se3(&xi)) - xi).norm() < 1e-10);
        }

        #[test]
        fn the_adjoint_carries_a_perturbation_through(pose in tangent(3.0), xi in tangent(0.5)) {
            let pose = exp_se3(&pose);
            let left = pose * exp_se3(&xi);
            let right = exp_se3(&(adjoint(&pose) * xi)) * pose;
            prop_assert!((left.to_homogeneous() - right.to_homogeneous()).norm() < 1e-9);
        }
    }
}
