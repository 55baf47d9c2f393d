//! The recordings of real Kinects, where they are at hand.

use std::num::NonZero;

use nalgebra::Isometry3;
use sunblind_estimator::EstimatorParams;
use sunblind_sim::record::{Body, Recording};
use sunblind_sim::runner::log::RunLog;
use sunblind_sim::runner::{Driven, ReplayOptions, replay};
use sunblind_tests::fake_localizer::FakeLocalizer;
use sunblind_tests::recorded;

#[test]
fn an_unregistered_kinect_with_the_depth_cameras_truth() {
    let Some(recording) = recorded::open("kinect1_redkitchen") else { return };
    assert_eq!((recording.frames.len(), recording.truth.len(), recording.body), (300, 300, Body::Depth));
    let robot_from_depth = recording.rig.robot_from_colour * recording.rig.colour_from_depth;
    assert_eq!(robot_from_depth, Isometry3::identity());
    assert!(recording.warnings.is_empty(), "{:?}", recording.warnings);

    let fake = Driven::own("fake", "", Box::new(FakeLocalizer::default()));
    let log = replay(&recording, vec![fake], &ReplayOptions::default()).unwrap();
    assert_eq!(log.truth, recording.truth);
    assert_eq!(log.tracks[0].frames.len(), 300);
}

#[test]
fn a_registered_kinect_with_the_colour_cameras_truth() {
    let Some(recording) = recorded::open("kinect1_tum_fr1_10") else { return };
    assert_eq!((recording.frames.len(), recording.body), (10, Body::Colour));
    assert_eq!(recording.rig.robot_from_colour, Isometry3::identity());
    assert!((recording.rig.colour.distortion.k1 - 0.2624).abs() < 1e-12);
}

/// The product's estimates, however many threads there are and whether or not there is a truth.
#[test]
fn the_products_estimates_depend_on_measurements_only() {
    let Some(with_truth) = recorded::open("kinect1_tum_fr1_10") else { return };
    let mut without = with_truth.clone();
    without.truth.clear();
    let run = |recording: &Recording, threads| {
        let rig = recording.rig.clone();
        let product = Driven::product("mvo", "", EstimatorParams::default(), rig).unwrap();
        let options = ReplayOptions { threads: NonZero::new(threads).unwrap(), ..Default::default() };
        replay(recording, vec![product], &options).unwrap()
    };
    let expected = run(&with_truth, 1);
    assert_eq!((expected.truth.len(), expected.digest.len()), (10, 64));
    assert_eq!(run(&with_truth, 4).digest, expected.digest);
    let without = run(&without, 4);
    assert_eq!(without.digest, expected.digest);
    let first = |log: &RunLog| log.tracks[0].frames[0].world_from_body;
    let world_from_odom = first(&expected) * first(&without).inverse();
    for (placed, raw) in expected.tracks[0].frames.iter().zip(&without.tracks[0].frames) {
        let apart = placed.world_from_body.inverse() * (world_from_odom * raw.world_from_body);
        assert!(apart.translation.vector.norm() + apart.rotation.angle() < 1e-12);
    }
}
