//! How far a camera went, from how fast the ground passes below it: its height above the ground is known.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::RayPair;

/// What a camera on a robot stands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundPlane {
    /// From the camera straight down, in its frame; length 1.
    pub down: Vector3<f64>,
    /// Of the camera above the ground, metres.
    pub height: f64,
}

/// The length of a way, as a share of the one that was assumed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// 1 = as assumed.
    pub value: f64,
    /// σ.
    pub sigma: f64,
}

/// Sine of the least angle below the horizon of what may be ground: further off, a degree of tilt is a third of its depth.
const LEAST_SINE: f64 = 0.09;
/// What would make the way more than this much longer or shorter is no ground.
const LARGEST_ERROR: f64 = 0.3;
/// σ of how the ground under the wheels is tilted against the ground ahead, radians: 2°. A guess.
const TILT: f64 = 0.035;
/// σ of how far the ground is from being flat, as a share of the camera's height: 2 cm of 40. A guess.
const UNEVEN: f64 = 0.05;
/// σ of the height that all frames share, as a share of it: half a centimetre of suspension and tyres. A guess.
const HEIGHT: f64 = 0.015;
/// Fewest features on the ground.
const LEAST_FEATURES: usize = 15;
/// Scale of the Cauchy weight, in σ.
const CAUCHY: f64 = 1.0;
/// Rounds.
const ITERATIONS: usize = 10;

/// A feature that may lie on the ground.
struct Candidate {
    /// From the reference camera, z = 1.
    ray: Vector3<f64>,
    /// 1/z by triangulation, and its σ; 1/m.
    inverse_depth: f64,
    sigma: f64,
}

/// By how much the way between two views is longer than `camera_from_reference` says, whose rotation and direction are
/// right. The inverse depth of a plane is linear in image coordinates, 1/z = a·(x, y, 1), and |a| is the inverse of the
/// camera's height; triangulated with a way that is too short by a share, all of it is too large by the same share.
/// `None` where too little of the ground is seen.
pub fn scale_over_ground<'a>(
    pairs: impl Iterator<Item = &'a RayPair>,
    camera_from_reference: &Isometry3<f64>,
    ground: &GroundPlane,
) -> Option<Scale> {
    let candidates: Vec<Candidate> = pairs.filter_map(|pair| candidate(pair, camera_from_reference, ground)).collect();
    let expected = ground.down / ground.height;
    // The tilt is about what it was; how high the camera is the data alone say.
    let across = Matrix3::identity() - ground.down * ground.down.transpose();
    let known = across * (TILT / ground.height).powi(-2);
    let mut plane = expected;
    let mut information = known;
    let mut agreeing = 0.0;
    for _ in 0..ITERATIONS {
        information = known;
        let mut right = known * expected;
        agreeing = 0.0;
        for Candidate { ray, inverse_depth, sigma } in &candidates {
            let of_plane = plane.dot(ray);
            let sigma = sigma.hypot(UNEVEN * of_plane);
            let weight = (1.0 + ((inverse_depth - of_plane) / (CAUCHY * sigma)).powi(2)).recip();
            information += ray * ray.transpose() * (weight / (sigma * sigma));
            right += ray * (inverse_depth * weight / (sigma * sigma));
            agreeing += weight;
        }
        plane = information.cholesky()?.solve(&right);
    }
    if agreeing < LEAST_FEATURES as f64 {
        return None;
    }
    let value = plane.norm() * ground.height;
    let direction = plane.normalize();
    let variance = direction.dot(&(information.try_inverse()? * direction)) * ground.height * ground.height;
    let is_plausible = (value - 1.0).abs() < LARGEST_ERROR;
    is_plausible.then(|| Scale { value, sigma: variance.sqrt().hypot(HEIGHT) })
}

fn candidate(pair: &RayPair, camera_from_reference: &Isometry3<f64>, ground: &GroundPlane) -> Option<Candidate> {
    let sine = ground.down.dot(&pair.reference.normalize());
    if sine < LEAST_SINE {
        return None;
    }
    let (inverse_depth, sigma) = pair.inverse_depth(camera_from_reference);
    let error = inverse_depth * ground.height / ground.down.dot(&pair.reference) - 1.0;
    (error.abs() < LARGEST_ERROR).then_some(Candidate { ray: pair.reference, inverse_depth, sigma })
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    use super::*;

    /// Rays to points of a grid on the ground ahead and to a wall beside it, from a camera that looks `pitch` down.
    fn pairs(camera_from_reference: &Isometry3<f64>, pitch: f64, height: f64) -> (Vec<RayPair>, GroundPlane) {
        let level_from_camera = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -pitch);
        let down = level_from_camera.inverse() * Vector3::y();
        let on_ground = (0..100).map(|i| {
            let (x, z) = (0.2 * f64::from(i % 10) - 0.9, 1.2 + 0.2 * f64::from(i / 10));
            Vector3::new(x, height, z)
        });
        let on_wall = (0..40).map(|i| Vector3::new(1.0, 0.1 * f64::from(i % 5), 1.0 + 0.3 * f64::from(i / 5)));
        let pairs = on_ground.chain(on_wall).map(|point| {
            let point = level_from_camera.inverse() * point;
            let seen = camera_from_reference.rotation * point + camera_from_reference.translation.vector;
            RayPair { reference: point / point.z, camera: seen / seen.z, sigma: 0.5 / 525.0 }
        });
        (pairs.collect(), GroundPlane { down, height })
    }

    proptest! {
        #[test]
        fn what_the_wheels_slip_the_ground_gives_back(
            slip in -0.12..0.12_f64,
            turn in -0.05..0.05_f64,
            tilt in -0.02..0.02_f64,
        ) {
            let way = Isometry3::new(Vector3::new(0.01, 0.0, -0.4), Vector3::y() * turn);
            let (pairs, ground) = pairs(&way, 0.1, 0.4);
            let mut assumed = way;
            assumed.translation.vector *= 1.0 + slip;
            // The robot stands on a bump.
            let tilted = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), tilt) * ground.down;
            let found = scale_over_ground(pairs.iter(), &assumed, &GroundPlane { down: tilted, ..ground }).unwrap();
            prop_assert!((found.value * (1.0 + slip) - 1.0).abs() < 0.02, "{found:?}");
            prop_assert!(found.sigma < 0.05);
        }
    }

    #[test]
    fn without_ground_nothing_is_said() {
        let way = Isometry3::new(Vector3::new(0.0, 0.0, -0.4), Vector3::zeros());
        let (pairs, ground) = pairs(&way, 0.1, 0.4);
        assert_eq!(scale_over_ground(pairs[100..].iter(), &way, &ground), None);
        assert_eq!(scale_over_ground([].iter(), &way, &ground), None);
    }
}
