//! Closed-form rigid motion between matched points.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The motion that minimises (1/N) Σ ‖to − (R from + t)‖², paper A, Eq. 4, by singular value decomposition
/// (Umeyama 1991, without scale). `None` for fewer than three pairs, or when they lie on a line and leave the
/// rotation about it open.
pub fn fit_rigid<'a>(
    pairs: impl Iterator<Item = (&'a Point3<f64>, &'a Point3<f64>)> + Clone,
) -> Option<Isometry3<f64>> {
    let count = pairs.clone().count();
    if count < 3 {
        return None;
    }
    let mean = |sum: Vector3<f64>| sum / count as f64;
    let from_mean = mean(pairs.clone().map(|(from, _)| from.coords).sum());
    let to_mean = mean(pairs.clone().map(|(_, to)| to.coords).sum());
    let correlation: Matrix3<f64> =
        pairs.map(|(from, to)| (to.coords - to_mean) * (from.coords - from_mean).transpose()).sum();
    let svd = correlation.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    // The second singular value vanishes for points on a line.
    let mut values: Vec<f64> = svd.singular_values.iter().copied().collect();
    values.sort_by(f64::total_cmp);
    if values[1] <= 1e-9 * values[2] || !values[2].is_normal() {
        return None;
    }
    // The smallest singular value's axis is flipped where the best orthogonal matrix would be a reflection.
    let mut sign = Matrix3::identity();
    let smallest = svd.singular_values.imin();
    sign[(smallest, smallest)] = (u * v_t).determinant().signum();
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(u * sign * v_t));
    Some(Isometry3::from_parts(Translation3::from(to_mean - rotation * from_mean), rotation))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{exp_se3, log_se3};
    use nalgebra::Vector6;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn an_exact_motion_is_found(xi in prop::array::uniform6(-1.5..1.5_f64), points in prop::collection::vec(prop::array::uniform3(-2.0..2.0_f64), 4..30)) {
            let motion = exp_se3(&Vector6::from(xi));
            let from: Vec<_> = points.into_iter().map(Point3::from).collect();
            let to: Vec<_> = from.iter().map(|point| motion * point).collect();
            let found = fit_rigid(from.iter().zip(&to)).unwrap();
            prop_assert!(log_se3(&(found.inverse() * motion)).norm() < 1e-6);
        }

        #[test]
        fn points_in_a_plane_are_enough(xi in prop::array::uniform6(-1.5..1.5_f64)) {
            let motion = exp_se3(&Vector6::from(xi));
            let from = [Point3::new(0.0, 0.0, 2.0), Point3::new(1.0, 0.0, 2.0), Point3::new(0.0, 1.0, 2.0)];
            let to = from.map(|point| motion * point);
            let found = fit_rigid(from.iter().zip(&to)).unwrap();
            prop_assert!(log_se3(&(found.inverse() * motion)).norm() < 1e-6);
        }
    }

    #[test]
    fn points_on_a_line_are_refused() {
        let line: Vec<_> = (0..10).map(|i| Point3::new(f64::from(i), 2.0 * f64::from(i), 1.0)).collect();
        assert_eq!(fit_rigid(line.iter().zip(&line)), None);
        assert_eq!(fit_rigid(line[..2].iter().zip(&line[..2])), None);
    }
}
