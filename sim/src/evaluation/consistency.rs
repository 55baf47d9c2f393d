//! Whether a track's covariance says how wrong its poses are.

use nalgebra::{Isometry2, Isometry3, Matrix2, Matrix3, SMatrix, Vector2, Vector3};

use super::PosePair;

/// The normalised estimation error squared eᵀ P⁻¹ e, averaged over the frames, of the pose in the plane. With three
/// degrees of freedom it is 3, on average over many runs, where P is right (Bar-Shalom, Li & Kirubarajan, *Estimation
/// with Applications to Tracking and Navigation*, §5.4.2); it is not divided by the 3. Frames whose covariance has no
/// inverse are left out: who stands still at the start may well be certain. NaN when that are all of them.
///
/// The error is what the covariance is of: the left perturbation (ρ, φ) that takes the estimate to the truth, so that
/// neither where the world lies nor how far the robot is from its origin matters.
pub(super) fn average_nees(pairs: &[PosePair]) -> f64 {
    let (sum, count) = pairs.iter().filter_map(nees).fold((0.0, 0), |(sum, count), nees| (sum + nees, count + 1));
    sum / f64::from(count)
}

fn nees(pair: &PosePair) -> Option<f64> {
    let error = logarithm(&(planar(&pair.truth) * planar(&pair.estimate).inverse()));
    let to_plane = planar_from_spatial(&pair.estimate);
    let covariance: Matrix3<f64> = to_plane * pair.covariance * to_plane.transpose();
    Some(error.dot(&covariance.cholesky()?.solve(&error)))
}

/// The ground track: the position without its height, and where the x axis points as seen from above.
fn planar(world_from_body: &Isometry3<f64>) -> Isometry2<f64> {
    let forward = world_from_body.rotation * Vector3::x();
    Isometry2::new(world_from_body.translation.vector.xy(), forward.y.atan2(forward.x))
}

/// (ρx, ρy, φ) of a motion of the plane: Solà, Deray & Atchuthan, *A micro Lie theory*, eqs. 156–158.
fn logarithm(motion: &Isometry2<f64>) -> Vector3<f64> {
    let angle = motion.rotation.angle();
    let (sine, versine) = match angle.abs() < 1e-6 {
        true => (1.0, angle / 2.0),
        false => (angle.sin() / angle, (1.0 - angle.cos()) / angle),
    };
    let inverse = Matrix2::new(sine, versine, -versine, sine) / (sine * sine + versine * versine);
    let rho: Vector2<f64> = inverse * motion.translation.vector;
    Vector3::new(rho.x, rho.y, angle)
}

/// What a left perturbation (ρ, φ) of a pose in space is to its ground track, to first order. The point p moves by
/// ρ + φ × p and the x axis f by φ × f, so the heading by φz − fz (fx φx + fy φy) / (fx² + fy²); and what moves p beyond
/// that turn about the world's origin is the plane's own ρ.
fn planar_from_spatial(world_from_body: &Isometry3<f64>) -> SMatrix<f64, 3, 6> {
    let p = world_from_body.translation.vector;
    let f = world_from_body.rotation * Vector3::x();
    let tilt = -f.z / (f.x * f.x + f.y * f.y).max(1e-12);
    let (by_roll, by_pitch) = (tilt * f.x, tilt * f.y);
    #[rustfmt::skip]
    let jacobian = SMatrix::from_row_slice(&[
        1.0, 0.0, 0.0, by_roll * p.y, p.z + by_pitch * p.y, 0.0,
        0.0, 1.0, 0.0, -p.z - by_roll * p.x, -by_pitch * p.x, 0.0,
        0.0, 0.0, 0.0, by_roll, by_pitch, 1.0,
    ]);
    jacobian
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix6, Vector6};
    use rand_distr::{Distribution, StandardNormal};
    use sunblind_estimator::Timestamp;
    use sunblind_estimator::geometry::{adjoint, exp_se3};

    use super::*;
    use crate::random::stream;

    const COUNT: u64 = 2000;

    /// Poses here and there whose errors are drawn from their covariances, `scale` times as large.
    fn drawn(scale: f64, sigma: f64) -> Vec<PosePair> {
        let pair = |index| {
            let mut numbers = stream(7, "drawn errors", index);
            let mut normal = || -> f64 { StandardNormal.sample(&mut numbers) };
            let pose = Isometry3::new(
                Vector3::new(9.0 * normal(), 9.0 * normal(), 0.2 * normal()),
                Vector3::new(0.1 * normal(), 0.1 * normal(), normal()),
            );
            let root = sigma * Matrix6::from_fn(|_, _| normal());
            let error = scale * root * Vector6::from_fn(|_, _| normal());
            let time = Timestamp::from_nanos(0);
            PosePair { time, estimate: pose, truth: exp_se3(&error) * pose, covariance: root * root.transpose() }
        };
        (0..COUNT).map(pair).collect()
    }

    /// The mean of N values of χ² with 3 degrees of freedom has the variance 6 / N; 95 % lie within 1.96 σ of 3.
    #[test]
    fn errors_of_the_size_that_is_claimed_give_three() {
        let interval = 1.96 * (6.0 / COUNT as f64).sqrt();
        let honest = average_nees(&drawn(1.0, 1e-4));
        assert!((honest - 3.0).abs() < interval, "{honest}");
        // Twice the error is four times its square.
        let bold = average_nees(&drawn(2.0, 1e-4));
        assert!((bold - 12.0).abs() < 4.0 * interval, "{bold}");
    }

    #[test]
    fn where_the_world_lies_is_of_no_matter() {
        let here = drawn(1.0, 1e-2);
        let motion = Isometry3::new(Vector3::new(30.0, -20.0, 0.0), Vector3::z() * 2.0);
        let moved = |pair: &PosePair| {
            let adjoint = adjoint(&motion);
            let covariance = adjoint * pair.covariance * adjoint.transpose();
            PosePair { estimate: motion * pair.estimate, truth: motion * pair.truth, covariance, ..*pair }
        };
        let there: Vec<_> = here.iter().map(moved).collect();
        let (here, there) = (average_nees(&here), average_nees(&there));
        assert!((here / there - 1.0).abs() < 1e-6, "{here} became {there}");
    }

    #[test]
    fn an_error_along_a_circle_is_one_of_heading_alone() {
        // A robot that started 0.3 rad askew and went 10 m: its position is off by what the heading is, however far.
        let estimate = Isometry3::translation(10.0, 0.0, 0.0);
        let truth = exp_se3(&Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.3)) * estimate;
        let covariance = Matrix6::from_diagonal(&Vector6::new(1e-4, 1e-4, 0.0, 0.0, 0.0, 0.09));
        let found = average_nees(&[PosePair { time: Timestamp::from_nanos(0), estimate, truth, covariance }]);
        assert!((found - 1.0).abs() < 1e-9, "{found}");
    }

    #[test]
    fn who_claims_certainty_is_not_asked() {
        let certain = PosePair { covariance: Matrix6::zeros(), ..drawn(1.0, 1e-4)[0] };
        assert!(average_nees(&[certain]).is_nan());
        let honest = drawn(1.0, 1e-4);
        assert_eq!(average_nees(&[&[certain][..], &honest].concat()), average_nees(&honest));
    }
}
