//! Replaying a recording: what reaches the localisers, and what comes out of it.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{Isometry3, Matrix6};
use sunblind_estimator::{Disposition, Estimate, EstimatorParams, Localizer, Measurement, MeasurementData, Streams};
use sunblind_sim::record::Recording;
use sunblind_sim::runner::log::{FrameLog, RunLog};
use sunblind_sim::runner::{Driven, ReplayOptions, replay};
use sunblind_tests::fake_localizer::FakeLocalizer;
use sunblind_tests::tiny_recording::TinyRecording;

fn open(recording: &TinyRecording) -> Recording {
    Recording::open(&recording.folder(), None).unwrap()
}

fn fake(name: &str) -> Driven {
    Driven::own(name, "fake", Box::new(FakeLocalizer::default()))
}

fn run(recording: &Recording) -> RunLog {
    replay(recording, vec![fake("fake")], &ReplayOptions::default()).unwrap()
}

/// The bits of all that a log says about frames, timings apart.
fn bits(frames: &[FrameLog]) -> Vec<u64> {
    let numbers = |frame: &FrameLog| {
        let pose = frame.world_from_body.to_homogeneous();
        pose.iter().chain(frame.covariance.iter()).map(|value| value.to_bits()).collect::<Vec<_>>()
    };
    frames.iter().flat_map(numbers).collect()
}

fn apart(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    let difference = a.inverse() * b;
    difference.translation.vector.norm() + difference.rotation.angle()
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let files = TinyRecording::new(50);
    let recording = open(&files);
    let run = |threads| {
        let options = ReplayOptions { threads: NonZero::new(threads).unwrap(), ..Default::default() };
        let product = Driven::product("mvo", "product", EstimatorParams::default(), recording.rig.clone()).unwrap();
        replay(&recording, vec![fake("a"), product, fake("b")], &options).unwrap()
    };
    let alone = run(1);
    for threads in [2, 3, 16] {
        let log = run(threads);
        assert_eq!(log.digest, alone.digest);
        for (track, expected) in log.tracks.iter().zip(&alone.tracks) {
            assert_eq!(track.name, expected.name);
            assert_eq!(bits(&track.frames), bits(&expected.frames));
        }
        let times = |log: &RunLog| log.snapshots.iter().map(|snapshot| snapshot.time).collect::<Vec<_>>();
        assert_eq!(times(&log), times(&alone));
    }
}

#[test]
fn the_truth_never_reaches_a_localizer() {
    let files = TinyRecording::new(20);
    let with_truth = run(&open(&files));
    files.remove("groundtruth.txt");
    let without = run(&open(&files));
    assert_eq!(with_truth.digest, without.digest);
    assert!(without.truth.is_empty());
    assert!(without.warnings.iter().any(|warning| warning.contains("no ground truth")), "{:?}", without.warnings);

    // Placed in the truth's world they differ by one rigid motion.
    let (placed, raw) = (&with_truth.tracks[0].frames, &without.tracks[0].frames);
    let world_from_odom = placed[0].world_from_body * raw[0].world_from_body.inverse();
    assert!(apart(&world_from_odom, &Isometry3::identity()) > 1.0);
    for (placed, raw) in placed.iter().zip(raw) {
        assert!(apart(&placed.world_from_body, &(world_from_odom * raw.world_from_body)) < 1e-12);
    }
}

#[test]
fn every_pixel_counts_in_the_digest() {
    let files = TinyRecording::new(3);
    let before = run(&open(&files)).digest;
    assert_eq!(before.len(), 64);
    assert_eq!(run(&open(&files)).digest, before);
    let file = files.path("depth/2.png");
    let mut depth = image::open(&file).unwrap().into_luma16();
    depth.get_pixel_mut(63, 47).0[0] += 1;
    depth.save(&file).unwrap();
    assert_ne!(run(&open(&files)).digest, before);
}

#[test]
fn the_first_pose_is_the_truths() {
    let files = TinyRecording::new(10);
    let log = run(&open(&files));
    assert_eq!(log.truth.len(), 10);
    assert!(apart(&log.tracks[0].frames[0].world_from_body, &log.truth[0].world_from_body) < 1e-12);
}

#[test]
fn frames_outside_the_truth_are_not_scored() {
    let files = TinyRecording::new(10);
    files.replace("groundtruth.txt", "100.000", "#");
    files.replace("groundtruth.txt", "100.900", "#");
    let log = run(&open(&files));
    let (frames, truth) = (&log.tracks[0].frames, &log.truth);
    assert_eq!((frames.len(), truth.len()), (10, 8));
    // What is placed is the first frame that the truth covers.
    assert_eq!(truth[0].time, frames[1].time);
    assert!(apart(&frames[1].world_from_body, &truth[0].world_from_body) < 1e-12);
    assert!(log.warnings.iter().any(|warning| warning.contains("does not cover 2 of 10 frames")), "{:?}", log.warnings);
}

#[test]
fn the_covariance_is_carried_into_the_truths_world() {
    /// Stands still, sure of all but its position along its own x.
    struct Still;
    impl Localizer for Still {
        fn handle(&mut self, _: Measurement) -> Disposition {
            Disposition::Used
        }
        fn estimate(&self) -> Estimate {
            let mut covariance = Matrix6::zeros();
            covariance[(0, 0)] = 4.0;
            Estimate { covariance, odom_from_robot: Isometry3::identity(), ..FakeLocalizer::default().estimate() }
        }
        fn wanted_streams(&self) -> Streams {
            Streams { rgb: false, infrared: false, depth: false }
        }
    }
    let files = TinyRecording::new(1);
    // Turned by a quarter about z, its x is the world's y.
    files.write("groundtruth.txt", "100 2 1 0.5 0 0 0.70710678 0.70710678\n");
    let log =
        replay(&open(&files), vec![Driven::own("still", "", Box::new(Still))], &ReplayOptions::default()).unwrap();
    let covariance = log.tracks[0].frames[0].covariance;
    assert!((covariance[(1, 1)] - 4.0).abs() < 1e-6 && covariance[(0, 0)].abs() < 1e-6, "{covariance}");
}

#[test]
fn a_localizer_gets_what_it_wants_in_the_order_of_time() {
    /// Refuses colour, which it never asked for, and whatever comes late.
    struct DepthOnly(FakeLocalizer);
    impl Localizer for DepthOnly {
        fn handle(&mut self, measurement: Measurement) -> Disposition {
            assert!(matches!(measurement.data, MeasurementData::Depth(_)));
            self.0.handle(measurement)
        }
        fn estimate(&self) -> Estimate {
            self.0.estimate()
        }
        fn wanted_streams(&self) -> Streams {
            Streams { rgb: false, infrared: false, depth: true }
        }
    }
    let files = TinyRecording::new(5);
    // Depth before colour in the first frame, after it in the others.
    files.replace("depth.txt", "100.001", "99.995");
    let depth_only = Driven::own("depth", "", Box::new(DepthOnly(FakeLocalizer::default())));
    let log = replay(&open(&files), vec![fake("both"), depth_only], &ReplayOptions::default()).unwrap();
    assert!(log.warnings.is_empty(), "{:?}", log.warnings);
}

#[test]
fn snapshots_show_the_frame_they_are_of() {
    let files = TinyRecording::new(12);
    let log = run(&open(&files));
    assert_eq!(log.snapshots.len(), 6);
    let snapshot = &log.snapshots[1];
    assert_eq!(snapshot.time, log.tracks[0].frames[3].time);
    assert_eq!(snapshot.rgb.at(0, 0), [3, 0, 3]);
    assert!((snapshot.depth.at(10, 0) - 5503.0 / 5000.0).abs() < 1e-6);
}

#[test]
fn progress_is_told_once_a_frame() {
    let files = TinyRecording::new(20);
    let told = AtomicUsize::new(0);
    let on_frame = || {
        told.fetch_add(1, Ordering::Relaxed);
    };
    let options = ReplayOptions { on_frame: &on_frame, ..Default::default() };
    replay(&open(&files), vec![fake("a"), fake("b")], &options).unwrap();
    assert_eq!(told.into_inner(), 20);
}

#[test]
fn without_a_calibration_a_kinect_is_assumed_and_said() {
    let files = TinyRecording::new(1);
    files.remove("calibration.toml");
    let recording = open(&files);
    assert_eq!(recording.rig, sunblind_estimator::Rig::kinect_default());
    assert!(recording.warnings[0].contains("no calibration.toml"), "{:?}", recording.warnings);
}

#[test]
fn images_without_a_partner_are_left_out_and_counted() {
    let files = TinyRecording::new(4);
    files.replace("depth.txt", "100.101", "100.150");
    let recording = open(&files);
    assert_eq!(recording.frames.len(), 3);
    assert!(recording.warnings[0].starts_with("1 of 4 colour images are left out"), "{:?}", recording.warnings);
}
