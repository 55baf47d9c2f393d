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

/// What would make the way more than this much longer or shorter is no ground.
const LARGEST_ERROR: f64 = 0.4;
/// σ of how the ground under the wheels is tilted against the ground ahead, radians: 6°, as a bank in a lawn. A guess.
const TILT: f64 = 0.1;
/// σ of how far the ground is from being flat, as a share of the camera's height: 3 cm of 60. A guess.
const UNEVEN: f64 = 0.05;
/// Where ground ahead is tilted against the ground below, it bends on the way there: so far ahead, as a share of how far what
/// is seen of it is, and σ of that. Were it evenly bent, half; half of the way there can't be seen. A guess.
const BEND: [f64; 2] = [0.4, 0.2];
/// Fewest patches on the ground.
const LEAST_PATCHES: usize = 15;
/// Scale of the Cauchy weight, in σ: of the first round, which is then halved down to one.
const CAUCHY: f64 = 8.0;
/// Rounds.
const ITERATIONS: u32 = 10;

/// By how much the way between two views is longer than `camera_from_reference` says, whose rotation and direction are
/// right, but for a σ of `pitch` of how far it bowed, radians; `pairs` may lie on the ground. The inverse depth of a plane is
/// linear in image coordinates, 1/z = a·(x, y, 1); triangulated with a way that is too short by a share, all of it is too
/// large by the same share. The camera's height is the one above that plane where it meets the ground below. `None` where
/// too little of the ground is seen.
pub fn scale_over_ground(
    pairs: &[RayPair],
    camera_from_reference: &Isometry3<f64>,
    ground: &GroundPlane,
    pitch: f64,
) -> Option<Scale> {
    let expected = ground.down / ground.height;
    let candidates: Vec<(Vector3<f64>, f64, f64)> = pairs
        .iter()
        .map(|pair| (pair.reference, pair.inverse_depth(camera_from_reference)))
        .filter(|(ray, (inverse_depth, _))| (inverse_depth / expected.dot(ray) - 1.0).abs() < LARGEST_ERROR)
        .map(|(ray, (inverse_depth, sigma))| (ray, inverse_depth, sigma))
        .collect();
    let ahead = (Vector3::z() - ground.down * ground.down.z).normalize();
    // The tilt is about what it was; how high the camera is the data alone say.
    let across = Matrix3::identity() - ground.down * ground.down.transpose();
    let known = across * (TILT / ground.height).powi(-2);
    let mut plane = expected;
    let mut information = known;
    let (mut agreeing, mut distances) = (0.0, 0.0);
    for round in 0..ITERATIONS {
        let cauchy = (CAUCHY / f64::from(1 << round)).max(1.0);
        information = known;
        let mut right = known * expected;
        (agreeing, distances) = (0.0, 0.0);
        for (ray, inverse_depth, sigma) in &candidates {
            let of_plane = plane.dot(ray);
            let sigma = sigma.hypot(UNEVEN * of_plane);
            let weight = (1.0 + ((inverse_depth - of_plane) / (cauchy * sigma)).powi(2)).recip();
            information += ray * ray.transpose() * (weight / (sigma * sigma));
            right += ray * (inverse_depth * weight / (sigma * sigma));
            agreeing += weight;
            distances += weight * ahead.dot(ray) / of_plane;
        }
        plane = information.cholesky()?.solve(&right);
    }
    if agreeing < LEAST_PATCHES as f64 {
        return None;
    }
    let distance = distances / agreeing;
    let [bend, bend_sigma] = BEND.map(|share| share * distance);
    let steepness = plane.dot(&ground.down);
    let rise = plane.dot(&ahead) / steepness;
    let height = 1.0 / steepness - bend * rise;
    let value = ground.height / height;
    let meeting = ahead * bend + ground.down * height;
    let variance = meeting.dot(&(information.try_inverse()? * meeting)) / (steepness * height).powi(2);
    let is_plausible = (value - 1.0).abs() < LARGEST_ERROR;
    // A bow moves the ground in the image by its angle, the way gone by way · height / distance².
    let by_bow = pitch * distance * distance / (height * camera_from_reference.translation.vector.norm());
    let sigma = variance.sqrt().hypot(bend_sigma * rise / height).hypot(by_bow);
    is_plausible.then_some(Scale { value, sigma })
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    use super::*;

    /// Where a camera looks `pitch` down: rays to points of a grid on the ground ahead, which from 0.8 m on rises, and to a
    /// wall beside it.
    fn pairs(
        camera_from_reference: &Isometry3<f64>,
        pitch: f64,
        height: f64,
        rise: f64,
    ) -> (Vec<RayPair>, GroundPlane) {
        let level_from_camera = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -pitch);
        let down = level_from_camera.inverse() * Vector3::y();
        let on_ground = (0..100).map(|i| {
            let (x, z) = (0.2 * f64::from(i % 10) - 0.9, 1.2 + 0.2 * f64::from(i / 10));
            Vector3::new(x, height - rise * (z - 0.8), z)
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
            rise in -0.03..0.03_f64,
        ) {
            let way = Isometry3::new(Vector3::new(0.01, 0.0, -0.4), Vector3::y() * turn);
            let (pairs, ground) = pairs(&way, 0.1, 0.4, rise);
            let mut assumed = way;
            assumed.translation.vector *= 1.0 + slip;
            let found = scale_over_ground(&pairs, &assumed, &ground, 0.0).unwrap();
            prop_assert!((found.value * (1.0 + slip) - 1.0).abs() < 0.03, "{found:?}");
            prop_assert!(found.sigma < 0.05, "{found:?}");
        }
    }

    #[test]
    fn the_steeper_the_bend_and_the_less_sure_the_bow_the_less_is_known() {
        let way = Isometry3::new(Vector3::new(0.0, 0.0, -0.4), Vector3::zeros());
        let sigma = |rise: f64, bow: f64| {
            let (pairs, ground) = pairs(&way, 0.1, 0.4, rise);
            scale_over_ground(&pairs, &way, &ground, bow).unwrap().sigma
        };
        assert!(sigma(0.0, 0.0) < 0.025 && sigma(0.06, 0.0) > 0.05);
        // A milliradian at 2 m: 2 mm of the 0.4 m · 0.4 m / 2 m by which what is there went down.
        assert!((sigma(0.0, 0.004).hypot(-sigma(0.0, 0.0)) - 0.1).abs() < 0.05);
    }

    #[test]
    fn without_ground_nothing_is_said() {
        let way = Isometry3::new(Vector3::new(0.0, 0.0, -0.4), Vector3::zeros());
        let (pairs, ground) = pairs(&way, 0.1, 0.4, 0.0);
        assert_eq!(scale_over_ground(&pairs[100..], &way, &ground, 0.0), None);
        assert_eq!(scale_over_ground(&[], &way, &ground, 0.0), None);
    }
}
