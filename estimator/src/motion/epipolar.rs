//! Motion from rays alone: two views without depth say how the camera turned and which way it went, not how far.

use nalgebra::{Isometry3, Matrix6, SMatrix, Vector3, Vector6};

use super::annealed::annealed;
use super::{MotionFailure, Scale};

/// The same thing in two views: the rays to it, z = 1, and σ of either, in the same measure.
#[derive(Clone, Copy, Debug)]
pub struct RayPair {
    /// From the reference camera.
    pub reference: Vector3<f64>,
    /// From the camera.
    pub camera: Vector3<f64>,
    /// σ of the distance from the epipolar line, of a focal length of 1.
    pub sigma: f64,
}

impl RayPair {
    /// 1/z in the reference camera's frame under a motion, and its σ; 1/m.
    pub fn inverse_depth(&self, camera_from_reference: &Isometry3<f64>) -> (f64, f64) {
        // c × (R r + t/z) = 0.
        let turned = self.camera.cross(&(camera_from_reference.rotation * self.reference));
        let shift = self.camera.cross(&camera_from_reference.translation.vector);
        (-turned.dot(&shift) / shift.norm_squared(), std::f64::consts::SQRT_2 * self.sigma / shift.norm())
    }

    /// Whether, within so many σ, it lies before the camera and not too near: on its epipolar line alone, and near the
    /// epipole on any, much would agree that never was one thing.
    fn may_be_seen(&self, motion: &Isometry3<f64>, sigmas: f64) -> bool {
        let (inverse_depth, sigma) = self.inverse_depth(motion);
        let slack = sigmas * sigma;
        inverse_depth > -slack && inverse_depth < 1.0 / NEAREST + slack
    }
}

/// What wheels say of a motion.
#[derive(Clone, Copy, Debug)]
pub struct Rolled {
    /// The reference camera's frame → the camera's.
    pub camera_from_reference: Isometry3<f64>,
    /// σ of how far from there the camera may be on either side, metres.
    pub stray: f64,
    /// What the robot turns about, in the camera's frame; length 1.
    pub down: Vector3<f64>,
    /// σ of the turn, radians.
    pub turn: f64,
}

impl Rolled {
    /// How far a motion takes the camera from where the wheels have it, in the reference's frame, metres.
    fn strayed(&self, camera_from_reference: &Isometry3<f64>) -> Vector3<f64> {
        camera_from_reference.inverse().translation.vector - self.camera_from_reference.inverse().translation.vector
    }
}

/// A motion whose length was given.
#[derive(Clone, Debug)]
pub struct EpipolarMotion {
    /// The reference camera's frame → the camera's.
    pub camera_from_reference: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ) in the camera's frame. Along the way gone it is only large.
    pub covariance: Matrix6<f64>,
    /// For each pair, whether it agrees.
    pub inliers: Vec<bool>,
    /// What is left of the difference between the turn by the pairs and the one by the wheels, which is a compromise: 0–1.
    pub turn_share: f64,
}

impl EpipolarMotion {
    /// The same, its variance so many times as large.
    pub fn shared_by(mut self, factor: f64) -> Self {
        self.covariance *= factor;
        self
    }

    /// The same way with another length, and what is then known of it.
    pub fn scaled(mut self, scale: &Scale) -> Self {
        let assumed = self.camera_from_reference.translation.vector;
        let (along, sigma) = (assumed.normalize(), scale.sigma * assumed.norm());
        self.camera_from_reference.translation.vector = scale.value * assumed;
        let mut corner = self.covariance.fixed_view_mut::<3, 3>(0, 0);
        corner += along * along.transpose() * (sigma * sigma - along.dot(&(corner.clone_owned() * along)));
        self
    }
}

/// Rounds, at most.
const ITERATIONS: usize = 20;
/// Largest distance of an inlier from its epipolar line, in σ.
const MAX_DISTANCE: f64 = 3.0;
/// The least misfit, of the assumed variance: pairs that agree by chance are not as good as that. Of features along a lane
/// in the sun a tenth is usual. A guess.
const LEAST_MISFIT: f64 = 0.05;
/// How far, in σ, a motion may be from the wheels' if its pairs are off by as much as was assumed; if by a tenth of that, as
/// along a lane, three times as far, since then it is the robot that skids. What is further, and fits badly, is made of
/// mismatches, as on the slats of a roller shutter. A guess, made by looking at what such motions were off by.
const MAX_STRAY: f64 = 2.5;
/// Nothing nearer is seen, metres: a Kinect on a robot looks ahead from above its wheels.
const NEAREST: f64 = 0.3;
/// σ along the way gone, metres: nothing is known of it.
const UNKNOWN: f64 = 3.0;

/// Minimises the pairs' distances from their epipolar lines (Sampson's approximation; Hartley & Zisserman 2004, §11.4.3)
/// from what the wheels say, whose length stays. Going aside and turning look much alike: what the wheels know of either
/// says which it was. Of the turn, that is not in the covariance, so that whoever knows it as well does not count it twice.
/// What the pairs are worth beside the wheels they say themselves: by how far they are off in a first fit.
///
/// # Errors
/// [`MotionFailure::TooFewInliers`], [`MotionFailure::AgainstTheWheels`] or [`MotionFailure::DegenerateGeometry`].
pub fn epipolar_motion(
    pairs: &[RayPair],
    rolled: &Rolled,
    min_inliers: usize,
) -> Result<EpipolarMotion, MotionFailure> {
    let (first, misfit) = fit(pairs, rolled, min_inliers)?;
    let strayed = rolled.strayed(&first.camera_from_reference).norm() / rolled.stray;
    if strayed * misfit.sqrt() > MAX_STRAY {
        return Err(MotionFailure::AgainstTheWheels { sigmas: strayed });
    }
    if misfit >= 1.0 {
        return Ok(first);
    }
    let share = misfit.max(LEAST_MISFIT).sqrt();
    let pairs: Vec<RayPair> = pairs.iter().map(|pair| RayPair { sigma: share * pair.sigma, ..*pair }).collect();
    Ok(fit(&pairs, rolled, min_inliers).map_or(first, |(second, _)| second))
}

/// The motion, and how many times as large as assumed the variance of a pair is.
fn fit(pairs: &[RayPair], rolled: &Rolled, min_inliers: usize) -> Result<(EpipolarMotion, f64), MotionFailure> {
    let start = &rolled.camera_from_reference;
    let length = start.translation.vector.norm();
    let motion = annealed(
        start,
        ITERATIONS,
        |motion, cauchy| normal(pairs, rolled, motion, cauchy),
        |motion| motion.translation.vector = motion.translation.vector.normalize() * length,
    );
    let inliers: Vec<bool> = pairs
        .iter()
        .map(|pair| {
            pair.may_be_seen(&motion, MAX_DISTANCE)
                && Line::of(pair, &motion).is_some_and(|line| line.distance.abs() < MAX_DISTANCE)
        })
        .collect();
    let found = inliers.iter().filter(|&&inlier| inlier).count();
    if found < min_inliers {
        return Err(MotionFailure::TooFewInliers { found, needed: min_inliers });
    }
    let agreeing: Vec<RayPair> =
        pairs.iter().zip(&inliers).filter(|(_, inlier)| **inlier).map(|(pair, _)| *pair).collect();
    let (hessian, _) = normal(&agreeing, &Rolled { turn: f64::INFINITY, ..*rolled }, &motion, f64::INFINITY);
    let Some(cholesky) = hessian.cholesky() else {
        return Err(MotionFailure::DegenerateGeometry { sigma: f64::INFINITY });
    };
    let inverse = cholesky.inverse();
    let turn_variance = rolled.down.dot(&(inverse.fixed_view::<3, 3>(3, 3) * rolled.down));
    let turn_share = 1.0 / (1.0 + turn_variance / rolled.turn.powi(2));
    let squares: f64 = agreeing.iter().filter_map(|pair| Some(Line::of(pair, &motion)?.distance.powi(2))).sum();
    let misfit = squares / found as f64;
    let mut covariance = inverse * misfit.max(1.0);
    let along = motion.translation.vector.normalize();
    let mut corner = covariance.fixed_view_mut::<3, 3>(0, 0);
    corner += along * along.transpose() * (UNKNOWN * UNKNOWN);
    Ok((EpipolarMotion { camera_from_reference: motion, covariance, inliers, turn_share }, misfit))
}

/// A pair under a motion.
struct Line {
    /// From the epipolar line, in σ.
    distance: f64,
    /// d(distance)/d(ρ, φ).
    row: Vector6<f64>,
}

impl Line {
    fn of(pair: &RayPair, motion: &Isometry3<f64>) -> Option<Self> {
        let (from, to) = (motion.rotation * pair.reference, pair.camera);
        let gone = motion.translation.vector;
        let normal = gone.cross(&from);
        // xᵀ E x' with E = [t]ₓ R; its gradients along both images make a distance of it.
        let back = motion.rotation.inverse_transform_vector(&to.cross(&gone));
        let steepness = (normal.xy().norm_squared() + back.xy().norm_squared()).sqrt();
        if steepness < 1e-12 {
            return None;
        }
        // (φ × t) × y + t × (φ × y) = φ × (t × y), Jacobi's identity. The steepness is taken for constant (Sampson).
        let (shift, turn) = (from.cross(&to), normal.cross(&to));
        let unit = steepness * pair.sigma;
        let row = Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z) / unit;
        Some(Self { distance: to.dot(&normal) / unit, row })
    }
}

/// Normal equations; the length of the way is held.
fn normal(pairs: &[RayPair], rolled: &Rolled, motion: &Isometry3<f64>, cauchy: f64) -> (Matrix6<f64>, Vector6<f64>) {
    let (mut hessian, mut gradient): (Matrix6<f64>, Vector6<f64>) = (SMatrix::zeros(), SMatrix::zeros());
    for pair in pairs {
        if !pair.may_be_seen(motion, 2.0 * cauchy) {
            continue;
        }
        let Some(Line { distance, row }) = Line::of(pair, motion) else { continue };
        let weight = 1.0 / (1.0 + (distance / cauchy).powi(2));
        hessian.ger(weight, &row, &row, 1.0);
        gradient.axpy(weight * distance, &row, 1.0);
    }
    // The camera lies at −Rᵀt in the reference's frame, where ρ moves it by −Rᵀρ.
    let strayed = rolled.strayed(motion);
    let information = rolled.stray.powi(-2);
    for axis in 0..3 {
        hessian[(axis, axis)] += information;
    }
    let mut shift = gradient.fixed_rows_mut::<3>(0);
    shift -= motion.rotation * strayed * information;
    let turned = rolled.down.dot(&(motion.rotation * rolled.camera_from_reference.rotation.inverse()).scaled_axis());
    let row = Vector6::new(0.0, 0.0, 0.0, rolled.down.x, rolled.down.y, rolled.down.z) / rolled.turn;
    hessian.ger(1.0, &row, &row, 1.0);
    gradient.axpy(turned / rolled.turn, &row, 1.0);
    // The motion stays as long as it was: a turn φ swings it, but that is no change of length.
    let along = motion.translation.vector.normalize();
    let along = Vector6::new(along.x, along.y, along.z, 0.0, 0.0, 0.0);
    hessian.ger(1e8, &along, &along, 1.0);
    (hessian, gradient)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::exp_se3;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    fn truth() -> Isometry3<f64> {
        exp_se3(&Vector6::new(0.02, -0.01, -0.3, 0.01, 0.06, -0.005))
    }

    /// Points 1–12 m ahead, seen to 0.75 px of a Kinect; the first `outliers` are mismatched.
    fn pairs(count: usize, outliers: usize, seed: u64) -> Vec<RayPair> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let sigma = 0.75 / 525.0;
        let pair = |index| {
            let z: f64 = random.random_range(1.0..12.0);
            let point = Vector3::new(random.random_range(-0.6..0.6) * z, random.random_range(-0.4..0.4) * z, z);
            let mut seen = truth() * nalgebra::Point3::from(point);
            if index < outliers {
                seen.x += random.random_range(-0.4..0.4) * z;
                seen.y += random.random_range(-0.4..0.4) * z;
            }
            let mut noise =
                || -> f64 { sigma * <StandardNormal as Distribution<f64>>::sample(&StandardNormal, &mut random) };
            let reference = point / point.z + Vector3::new(noise(), noise(), 0.0);
            let camera = seen.coords / seen.z + Vector3::new(noise(), noise(), 0.0);
            RayPair { reference, camera, sigma }
        };
        (0..count).map(pair).collect()
    }

    /// What wheels would say: the length right, the rest off by half a degree.
    fn by_wheels() -> Rolled {
        let mut start = exp_se3(&Vector6::new(0.003, 0.0, 0.0, 0.0, 0.009, 0.0)) * truth();
        start.translation.vector *= truth().translation.vector.norm() / start.translation.vector.norm();
        Rolled { camera_from_reference: start, stray: 0.006, down: Vector3::y(), turn: 0.1 }
    }

    #[test]
    fn turn_and_direction_are_found_among_mismatches() {
        // However large a σ the pairs claim.
        for claimed in [1.0, 3.0] {
            let (mut sum, runs) = (0.0, 50);
            for seed in 0..runs {
                let mut pairs = pairs(300, 30, seed);
                pairs.iter_mut().for_each(|pair| pair.sigma *= claimed);
                let motion = epipolar_motion(&pairs, &by_wheels(), 30).unwrap();
                let error = crate::geometry::log_se3(&(motion.camera_from_reference * truth().inverse()));
                assert!(error.fixed_rows::<3>(3).norm() < 0.003, "{error}");
                assert!(error.fixed_rows::<3>(0).norm() < 0.02, "{error}");
                sum += error.dot(&(motion.covariance.try_inverse().unwrap() * error));
            }
            // Five degrees of freedom, the length having been given right; but one mismatch in ten makes the covariance too
            // small: whoever uses it makes it larger.
            let mean = sum / f64::from(runs as u32);
            assert!((3.0..16.0).contains(&mean), "{claimed}: {mean}");
        }
    }

    #[test]
    fn of_a_turn_that_is_a_compromise_the_share_that_was_seen_is_known() {
        let pairs = pairs(300, 0, 7);
        let found = |turn: f64| {
            let wheels = Rolled { turn, ..by_wheels() };
            let motion = epipolar_motion(&pairs, &wheels, 30).unwrap();
            let off = motion.camera_from_reference.rotation * wheels.camera_from_reference.rotation.inverse();
            (off.scaled_axis().y, motion.turn_share)
        };
        let (seen, all) = found(10.0);
        assert!((seen + 0.009).abs() < 0.001 && all > 0.999, "{seen} {all}");
        for turn in [1e-2, 3e-3, 1e-3] {
            let (off, share) = found(turn);
            assert!((off / share - seen).abs() < 0.1 * seen.abs(), "{turn}: {off} {share} {seen}");
        }
    }

    #[test]
    fn what_fits_badly_and_contradicts_the_wheels_is_refused() {
        // As slats of a roller shutter that are taken for their neighbours: they agree, but with another way aside.
        let slats = |shift: f64, blur: f64| {
            let mut pairs = pairs(150, 0, 3);
            let aside = Isometry3::translation(shift, 0.0, 0.0) * truth();
            for (index, pair) in pairs.iter_mut().enumerate() {
                let depth = 1.0 + 0.07 * index as f64;
                let seen = aside * nalgebra::Point3::from(pair.reference * depth);
                let off = blur * pair.sigma * if index % 2 == 0 { 1.0 } else { -1.0 };
                pair.camera = seen.coords / seen.z + Vector3::new(0.0, off, 0.0);
            }
            let wheels = Rolled { turn: 1e-4, camera_from_reference: truth(), ..by_wheels() };
            epipolar_motion(&pairs, &wheels, 30)
        };
        let found = slats(0.08, 1.5);
        assert!(matches!(found, Err(MotionFailure::AgainstTheWheels { .. })), "{found:?}");
        // A robot that skids as far is believed if all agree, and so is what fits badly but goes the robot's way.
        assert!(slats(0.05, 0.1).is_ok(), "{:?}", slats(0.05, 0.1));
        assert!(slats(0.0, 1.5).is_ok(), "{:?}", slats(0.0, 1.5));
    }

    #[test]
    fn nothing_but_mismatches_is_said_so() {
        let found = epipolar_motion(&pairs(100, 100, 1), &by_wheels(), 50);
        assert!(matches!(found, Err(MotionFailure::TooFewInliers { .. })), "{found:?}");
    }
}
