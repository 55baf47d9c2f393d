//! Standing still, a drive, a covered lens, and a place never seen before.

use super::*;
use crate::features::surf::Feature;
use crate::geometry::{exp_se3, log_se3};
use crate::structure::Landmark;
use nalgebra::{Matrix3, Point3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Points with descriptors of their own, 2–4 m away, seen with a Kinect's noise.
struct World {
    points: Vec<(Point3<f64>, [f32; 64])>,
    random: ChaCha8Rng,
}

impl World {
    fn new(seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let points = (0..200)
            .map(|_| {
                let position = Point3::from(Vector3::from_fn(|axis, _| match axis {
                    2 => random.random_range(2.0..4.0),
                    _ => random.random_range(-1.5..1.5),
                }));
                let mut descriptor: [f32; 64] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
                let norm = descriptor.iter().map(|value| value * value).sum::<f32>().sqrt();
                descriptor.iter_mut().for_each(|value| *value /= norm);
                (position, descriptor)
            })
            .collect();
        Self { points, random }
    }

    fn seen_from(&mut self, start_from_camera: &Isometry3<f64>) -> Frame {
        let (mut features, mut landmarks) = (Vec::new(), Vec::new());
        for (point, descriptor) in &self.points {
            let seen = start_from_camera.inverse_transform_point(point);
            let mut normal = || -> f64 { StandardNormal.sample(&mut self.random) };
            let (across, along) = (seen.z / 525.0, 1.425e-3 * seen.z * seen.z);
            let covariance = Matrix3::from_diagonal(&Vector3::new(across, across, along).map(|sigma| sigma * sigma));
            let position = seen + Vector3::new(across * normal(), across * normal(), along * normal());
            features.push(Feature {
                x: (525.0 * position.x / position.z) as f32,
                y: (525.0 * position.y / position.z) as f32,
                scale: 2.0,
                orientation: 0.0,
                response: 1.0,
                laplacian_positive: true,
                descriptor: *descriptor,
            });
            landmarks.push(Landmark { position, covariance });
        }
        Frame { features, landmarks, view: None }
    }
}

fn nothing_seen() -> Frame {
    Frame { features: Vec::new(), landmarks: Vec::new(), view: None }
}

fn error(tracking: &Tracking, truth: &Isometry3<f64>) -> Vector6<f64> {
    log_se3(&(tracking.pose.start_from_camera * truth.inverse()))
}

#[test]
fn standing_still_does_not_drift() {
    let mut world = World::new(1);
    let mut odometry = Keyframes::new(&EstimatorParams::default(), &Rig::kinect_default());
    let mut furthest = 0.0_f64;
    for _ in 0..300 {
        let tracking = odometry.track(world.seen_from(&Isometry3::identity()), &mut |_| {});
        furthest = furthest.max(tracking.pose.start_from_camera.translation.vector.norm());
    }
    // One frame's own noise is about 2.3 mm, and none of 300 is beyond 4 σ; 300 steps of a walk would reach 35 mm.
    assert!(furthest < 0.0092, "{furthest}");
    assert_eq!(odometry.window.len(), 1);
}

#[test]
fn a_drive_is_followed_within_its_covariance() {
    let (mut sum, runs) = (0.0, 20);
    for seed in 0..runs {
        let mut world = World::new(100 + seed);
        let mut params = EstimatorParams::default();
        // These cameras are calibrated perfectly, and nothing bends what they see.
        params.keyframes.systematic_share = 0.0;
        let rig = Rig { alignment_sigma: 0.0, ..Rig::kinect_default() };
        let mut odometry = Keyframes::new(&params, &rig);
        let mut last = None;
        for step in 0..60 {
            let along = f64::from(step) / 60.0;
            let truth = exp_se3(&Vector6::new(0.5 * along, 0.0, 0.8 * along, 0.0, 0.2 * along, 0.0));
            last = Some((odometry.track(world.seen_from(&truth), &mut |_| {}), truth));
        }
        let (tracking, truth) = last.unwrap();
        let error = error(&tracking, &truth);
        assert!(error.norm() < 0.05, "{error}");
        sum += error.dot(&(tracking.pose.covariance.try_inverse().unwrap() * error));
    }
    // Six degrees of freedom, mean 6. A keyframe's noise enters twice with opposite signs, as reference and as
    // referenced; the covariance adds both, so it may be too large here, but never too small.
    let anees = sum / f64::from(runs as u32);
    assert!((0.3..9.0).contains(&anees), "{anees}");
}

#[test]
fn a_good_calibration_is_believed() {
    let way = Isometry3::translation(0.3, 0.0, 0.0);
    // σ along a way of 0.3 m.
    let sigma_after = |alignment_sigma: f64| {
        let (mut world, rig) = (World::new(2), Rig { alignment_sigma, ..Rig::kinect_default() });
        let mut odometry = Keyframes::new(&EstimatorParams::default(), &rig);
        odometry.track(world.seen_from(&Isometry3::identity()), &mut |_| {});
        odometry.track(world.seen_from(&way), &mut |_| {}).pose.covariance[(0, 0)].sqrt()
    };
    let (uncalibrated, good) = (sigma_after(2.0), sigma_after(0.2));
    // 6 % of the way; 1.2 %, and what the points' own noise leaves.
    assert!((0.018..0.020).contains(&uncalibrated), "{uncalibrated}");
    assert!((0.0035..0.006).contains(&good), "{good}");
}

#[test]
fn a_covered_lens_is_said_and_survived() {
    let mut world = World::new(3);
    let mut odometry = Keyframes::new(&EstimatorParams::default(), &Rig::kinect_default());
    odometry.track(world.seen_from(&Isometry3::identity()), &mut |_| {});
    let before = odometry.track(world.seen_from(&Isometry3::identity()), &mut |_| {});
    for _ in 0..10 {
        let lost = odometry.track(nothing_seen(), &mut |_| {});
        assert!(matches!(lost.failure, Some(MotionFailure::TooFewFeatures { found: 0, .. })));
        assert_eq!(lost.pose.start_from_camera, before.pose.start_from_camera);
    }
    // The same place again: the pose comes back, and with it the trust in it.
    let back = odometry.track(world.seen_from(&Isometry3::identity()), &mut |_| {});
    assert_eq!(back.failure, None);
    assert!(back.pose.covariance.trace() < 1e-3);
}

#[test]
fn a_place_never_seen_before_starts_anew_with_less_trust() {
    let mut odometry = Keyframes::new(&EstimatorParams::default(), &Rig::kinect_default());
    odometry.track(World::new(4).seen_from(&Isometry3::identity()), &mut |_| {});
    let mut elsewhere = World::new(5);
    let lost = EstimatorParams::default().keyframes.max_lost_frames;
    for _ in 0..lost {
        assert!(odometry.track(elsewhere.seen_from(&Isometry3::identity()), &mut |_| {}).failure.is_some());
    }
    let new_start = odometry.track(elsewhere.seen_from(&Isometry3::identity()), &mut |_| {});
    assert!(new_start.failure.is_some() && new_start.keyframe);
    let found = odometry.track(elsewhere.seen_from(&Isometry3::identity()), &mut |_| {});
    assert_eq!(found.failure, None);
    assert!(found.pose.covariance[(0, 0)] > lost as f64 * 0.033_f64.powi(2));
}
