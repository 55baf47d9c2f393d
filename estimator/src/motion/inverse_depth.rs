//! Motion from rays with uncertain inverse depths, as a short baseline gives them: the perpendicular to the epipolar line
//! says how the camera turned and which way it went, what is along it how far.

use nalgebra::{Isometry3, Matrix2, Matrix2x3, Matrix2x6, Matrix3, Matrix6, Unit, Vector2, Vector6};

use super::annealed::annealed;
use super::{EpipolarMotion, MotionFailure, RayPair};
use crate::geometry::skew;

/// A pair of rays, and the inverse depth (1/Z) of what the reference camera sees.
#[derive(Clone, Copy, Debug)]
pub struct DepthPair {
    /// The rays.
    pub rays: RayPair,
    /// 1/m, and its σ but for what all pairs share; without a measurement [`DepthPair::UNMEASURED`].
    pub inverse_depth: (f64, f64),
}

impl DepthPair {
    /// Somewhere between half a metre and infinity.
    pub const UNMEASURED: (f64, f64) = (0.2, 1.0);
}

/// What is known of a motion before any pair is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// The reference camera's frame → the camera's.
    pub camera_from_reference: Isometry3<f64>,
    /// σ aside of the way, metres.
    pub stray: f64,
    /// σ along the way, metres.
    pub along: f64,
}

/// Rounds, at most.
const ITERATIONS: usize = 20;
/// Largest χ² of an inlier, of two degrees of freedom: one in 370 is larger, as of one degree beyond 3 σ.
const MAX_CHI_SQUARED: f64 = 11.83;
/// Largest inverse depth, 1/m.
const NEAREST: f64 = 4.0;

/// Minimises the distances between where the camera sees things and where the reference camera's rays and inverse depths
/// take them, in their σ; each inverse depth is improved by what both say. `shared_sigma` (1/m) is the σ by which all
/// inverse depths may be off together.
///
/// # Errors
/// [`MotionFailure::TooFewInliers`] or [`MotionFailure::DegenerateGeometry`].
pub fn inverse_depth_motion(
    pairs: &[DepthPair],
    expected: &Expected,
    shared_sigma: f64,
    min_inliers: usize,
) -> Result<EpipolarMotion, MotionFailure> {
    let normal = |motion: &Isometry3<f64>, cauchy: f64| {
        let Normal { hessian, gradient, .. } = Normal::of(pairs.iter(), expected, motion, cauchy);
        (hessian, gradient)
    };
    let motion = annealed(&expected.camera_from_reference, ITERATIONS, normal, |_| ());
    let inliers: Vec<bool> = pairs
        .iter()
        .map(|pair| Miss::of(pair, &motion).is_some_and(|miss| miss.chi_squared() < MAX_CHI_SQUARED))
        .collect();
    let found = inliers.iter().filter(|&&inlier| inlier).count();
    if found < min_inliers {
        return Err(MotionFailure::TooFewInliers { found, needed: min_inliers });
    }
    let agreeing = pairs.iter().zip(&inliers).filter(|(_, inlier)| **inlier).map(|(pair, _)| pair);
    let normal = Normal::of(agreeing, expected, &motion, f64::INFINITY);
    let Some(cholesky) = normal.hessian.cholesky() else {
        return Err(MotionFailure::DegenerateGeometry { sigma: f64::INFINITY });
    };
    let misfit = (normal.chi_squared / normal.freedom).max(1.0);
    let by_shared = cholesky.solve(&normal.by_inverse_depth) * shared_sigma;
    let covariance = cholesky.inverse() * misfit + by_shared * by_shared.transpose();
    Ok(EpipolarMotion { camera_from_reference: motion, covariance, inliers, turn_share: 1.0 })
}

/// How far a pair is from where a motion takes it.
struct Miss {
    /// Of a focal length of 1.
    distance: Vector2<f64>,
    information: Matrix2<f64>,
    /// d(where the motion takes it)/d(ρ, φ).
    by_motion: Matrix2x6<f64>,
    /// d(where the motion takes it)/d(inverse depth).
    by_inverse_depth: Vector2<f64>,
}

impl Miss {
    fn of(pair: &DepthPair, motion: &Isometry3<f64>) -> Option<Self> {
        let (measured, sigma) = pair.inverse_depth;
        let far = motion.rotation * pair.rays.reference;
        let gone = motion.translation.vector;
        // Both images' noise.
        let noise = Matrix2::from_diagonal_element(2.0 * pair.rays.sigma * pair.rays.sigma);
        let mut inverse_depth = measured.clamp(0.0, NEAREST);
        // Linear about the inverse depth that both views agree on, not about the measured one: as the noise of a regressor
        // would, that of inverse depths would make ways too short.
        let mut round = || {
            let place = far + gone * inverse_depth;
            (place.z > 1e-3).then_some(())?;
            let seen = place.xy() / place.z;
            let projected = Matrix2x3::new(1.0, 0.0, -seen.x, 0.0, 1.0, -seen.y) / place.z;
            let by_inverse_depth = projected * gone;
            let distance = pair.rays.camera.xy() - seen - by_inverse_depth * (measured - inverse_depth);
            let variance = noise + by_inverse_depth * by_inverse_depth.transpose() * (sigma * sigma);
            let information = variance.try_inverse()?;
            let mut by_motion = Matrix2x6::zeros();
            by_motion.fixed_columns_mut::<3>(0).copy_from(&(projected * inverse_depth));
            by_motion.fixed_columns_mut::<3>(3).copy_from(&(-projected * skew(&place)));
            let gain = (by_inverse_depth.transpose() * information * distance).x * sigma * sigma;
            inverse_depth = (measured + gain).clamp(0.0, NEAREST);
            Some(Self { distance, information, by_motion, by_inverse_depth })
        };
        round()?;
        round()?;
        round()
    }

    fn chi_squared(&self) -> f64 {
        (self.distance.transpose() * self.information * self.distance).x
    }
}

/// Normal equations of a step (ρ, φ).
struct Normal {
    hessian: Matrix6<f64>,
    gradient: Vector6<f64>,
    /// How the gradient falls when all inverse depths grow by one.
    by_inverse_depth: Vector6<f64>,
    chi_squared: f64,
    /// Two degrees for each pair, but for one whose inverse depth takes the other.
    freedom: f64,
}

impl Normal {
    fn of<'a>(
        pairs: impl Iterator<Item = &'a DepthPair>,
        expected: &Expected,
        motion: &Isometry3<f64>,
        cauchy: f64,
    ) -> Self {
        let mut normal = Self {
            hessian: Matrix6::zeros(),
            gradient: Vector6::zeros(),
            by_inverse_depth: Vector6::zeros(),
            chi_squared: 0.0,
            freedom: 0.0,
        };
        for pair in pairs {
            let Some(miss) = Miss::of(pair, motion) else { continue };
            let chi_squared = miss.chi_squared();
            let weight = 1.0 / (1.0 + chi_squared / (cauchy * cauchy));
            let weighted = miss.by_motion.transpose() * miss.information * weight;
            normal.hessian += weighted * miss.by_motion;
            normal.gradient -= weighted * miss.distance;
            normal.by_inverse_depth -= weighted * miss.by_inverse_depth;
            normal.chi_squared += chi_squared;
            normal.freedom += if pair.inverse_depth == DepthPair::UNMEASURED { 1.0 } else { 2.0 };
        }
        normal.expect(expected, motion);
        normal
    }

    /// Adds what is known before. The camera lies at −Rᵀt in the reference's frame, where ρ moves it by −Rᵀρ.
    fn expect(&mut self, expected: &Expected, motion: &Isometry3<f64>) {
        let way = expected.camera_from_reference.inverse().translation.vector;
        let along = Unit::new_normalize(way).into_inner();
        let along = along * along.transpose();
        let aside = (Matrix3::identity() - along) / expected.stray.powi(2);
        let information = aside + along / (expected.along * expected.along);
        let turned = motion.rotation.to_rotation_matrix();
        let strayed = motion.inverse().translation.vector - way;
        let mut corner = self.hessian.fixed_view_mut::<3, 3>(0, 0);
        corner += turned.matrix() * information * turned.matrix().transpose();
        let mut shift = self.gradient.fixed_rows_mut::<3>(0);
        shift -= turned * (information * strayed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{exp_se3, log_se3};
    use nalgebra::{Point3, Vector3};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    const PIXEL: f64 = 1.0 / 525.0;
    /// Half a pixel of disparity over 25 mm, 1/m: 15 cm at 2 m.
    const SIGMA: f64 = 0.5 * PIXEL / 0.025;

    fn truth() -> Isometry3<f64> {
        exp_se3(&Vector6::new(0.02, -0.01, -0.3, 0.01, 0.06, -0.005))
    }

    /// Points 1.5–15 m ahead, seen to 0.5 px and ranged to half a pixel of disparity, but for one in five that is not
    /// ranged; the first `outliers` are mismatched. All inverse depths are off by `shared`.
    fn pairs(count: usize, outliers: usize, shared: f64, seed: u64) -> Vec<DepthPair> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let pair = |index| {
            let z: f64 = 1.0 / random.random_range(0.067..0.67);
            let point = Vector3::new(random.random_range(-0.6..0.6) * z, random.random_range(-0.4..0.4) * z, z);
            let mut seen = truth() * Point3::from(point);
            if index < outliers {
                seen.x += random.random_range(-0.4..0.4) * z;
                seen.y += random.random_range(-0.4..0.4) * z;
            }
            let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
            let sigma = 0.5 * PIXEL;
            let reference = point / point.z + Vector3::new(noise(), noise(), 0.0) * sigma;
            let camera = seen.coords / seen.z + Vector3::new(noise(), noise(), 0.0) * sigma;
            let measured = (1.0 / z + SIGMA * noise() + shared, SIGMA);
            let inverse_depth = if index % 5 == 4 { DepthPair::UNMEASURED } else { measured };
            DepthPair { rays: RayPair { reference, camera, sigma }, inverse_depth }
        };
        (0..count).map(pair).collect()
    }

    /// Wheels that slip by a tenth, and miss half a degree of the turn.
    fn by_wheels() -> Expected {
        let mut start = exp_se3(&Vector6::new(0.003, 0.0, 0.0, 0.0, 0.009, 0.0)) * truth();
        start.translation.vector *= 1.1;
        Expected { camera_from_reference: start, stray: 0.015, along: 1.0 }
    }

    #[test]
    fn turn_and_way_are_found_with_their_length_and_as_well_as_is_said() {
        let (mut sum, mut bias, runs) = (0.0, 0.0, 60);
        for seed in 0..runs {
            let pairs = pairs(300, 0, 0.0, seed);
            let motion = inverse_depth_motion(&pairs, &by_wheels(), 0.0, 30).unwrap();
            let error = log_se3(&(motion.camera_from_reference * truth().inverse()));
            assert!(error.norm() < 0.02, "{error}");
            bias += motion.camera_from_reference.translation.vector.norm() / truth().translation.vector.norm() - 1.0;
            sum += error.dot(&(motion.covariance.try_inverse().unwrap() * error));
        }
        let (mean, bias) = (sum / runs as f64, bias / runs as f64);
        assert!((4.0..9.0).contains(&mean), "{mean}");
        assert!(bias.abs() < 0.006, "{bias}");
    }

    #[test]
    fn mismatches_are_told_apart_and_an_error_that_all_depths_share_is_in_the_covariance() {
        // A fifth of a pixel.
        let shared = 0.2 * PIXEL / 0.025;
        let mut lengths = Vec::new();
        for seed in 0..20 {
            let pairs = pairs(300, 30, shared, seed);
            let motion = inverse_depth_motion(&pairs, &by_wheels(), shared, 30).unwrap();
            assert!(motion.inliers[..30].iter().filter(|&&inlier| inlier).count() < 6);
            assert!(motion.inliers[30..].iter().filter(|&&inlier| !inlier).count() < 15);
            let length = motion.camera_from_reference.translation.vector.norm();
            lengths.push((length / truth().translation.vector.norm() - 1.0, motion.covariance[(2, 2)].sqrt() / 0.3));
        }
        let mean = |value: &dyn Fn(&(f64, f64)) -> f64| lengths.iter().map(value).sum::<f64>() / lengths.len() as f64;
        let (error, sigma) = (mean(&|length| length.0), mean(&|length| length.1));
        assert!(error < -0.01 && (0.5..2.0).contains(&(sigma / -error)), "{error} {sigma}");
    }

    #[test]
    fn without_depths_the_length_is_the_wheels() {
        let mut pairs = pairs(200, 0, 0.0, 1);
        pairs.iter_mut().for_each(|pair| pair.inverse_depth = DepthPair::UNMEASURED);
        let expected = Expected { along: 0.01, ..by_wheels() };
        let motion = inverse_depth_motion(&pairs, &expected, 0.0, 30).unwrap();
        let length = motion.camera_from_reference.translation.vector.norm();
        assert!((length - 1.1 * truth().translation.vector.norm()).abs() < 0.004, "{length}");
        let turned = motion.camera_from_reference.rotation.angle_to(&truth().rotation);
        assert!(turned < 0.003, "{turned}");
    }

    #[test]
    fn nothing_but_mismatches_is_said_so() {
        let found = inverse_depth_motion(&pairs(100, 100, 0.0, 1), &by_wheels(), 0.0, 50);
        assert!(matches!(found, Err(MotionFailure::TooFewInliers { .. })), "{found:?}");
    }
}
