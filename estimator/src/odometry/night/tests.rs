//! A metre along a wall by the projector's light and by a lamp's.

use nalgebra::{Isometry3, Vector3};

use super::*;
use crate::dark_room::{self, DarkRoom, Wall};
use crate::odometry::Keyframes;

/// Follows a drive of `steps` equal steps along `way`; the length that odometry made of it, and its frames without motion.
fn followed(room: &DarkRoom, way: Vector3<f64>, steps: u32) -> (f64, usize) {
    let (params, rig) = (EstimatorParams::default(), dark_room::rig());
    let mut frames = NightFrameBuilder::new(&params, &rig).unwrap();
    let mut odometry = Keyframes::new(&params, &rig);
    let (mut lost, mut gone) = (0, Vector3::zeros());
    for step in 0..=steps {
        let truth = Isometry3::from(way * (f64::from(step) / f64::from(steps)));
        let seen = room.seen_from(&truth, u64::from(step));
        let frame = frames.build(&seen.infrared, &seen.depth, &mut |_| {});
        let tracking = odometry.track(frame, &mut |_| {});
        if tracking.keyframe {
            frames.learn();
        }
        lost += usize::from(tracking.failure.is_some());
        gone = tracking.pose.start_from_camera.translation.vector;
    }
    (gone.dot(&way.normalize()), lost)
}

#[test]
fn a_metre_along_a_flat_wall_is_a_metre() {
    let normal = Vector3::new(0.1, 0.0, 1.0).normalize();
    // By the projector alone, and under a sodium lamp.
    for ambient in [0.0, 0.1] {
        let room = DarkRoom { walls: vec![Wall { normal, distance: 2.5, is_textured: true }], ambient };
        for way in [Vector3::x(), Vector3::z()] {
            let (length, lost) = followed(&room, way, 40);
            assert!(
                (length - 1.0).abs() < 0.03 && lost == 0,
                "ambient {ambient}, along {way:?}: {length} m, {lost} lost"
            );
        }
    }
}

#[test]
fn slopes_that_noise_makes_up_are_in_the_covariance() {
    let room = DarkRoom {
        walls: vec![Wall { normal: Vector3::z_axis().into_inner(), distance: 2.5, is_textured: true }],
        ambient: 0.0,
    };
    // However good the calibration.
    let (params, rig) = (EstimatorParams::default(), Rig { alignment_sigma: 0.0, ..dark_room::rig() });
    let mut frames = NightFrameBuilder::new(&params, &rig).unwrap();
    let mut odometry = Keyframes::new(&params, &rig);
    let mut track = |aside: f64| {
        let seen = room.seen_from(&Isometry3::translation(aside, 0.0, 0.0), 1);
        odometry.track(frames.build(&seen.infrared, &seen.depth, &mut |_| {}), &mut |_| {})
    };
    track(0.0);
    let sigma = track(0.05).pose.covariance[(0, 0)].sqrt();
    // 6 % of 5 cm, and a little for what a pixel's brightness leaves.
    assert!((0.003..0.0045).contains(&sigma), "{sigma}");
}
