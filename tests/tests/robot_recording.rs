//! Recordings of a robot with wheels: what is written is read, and what is replayed is what a session with the robot
//! itself would have said.

use std::fs;
use std::num::NonZero;
use std::path::Path;

use sunblind_estimator::{EstimatorParams, Measurement, MeasurementData, PoseSource};
use sunblind_sim::evaluation::evaluate;
use sunblind_sim::record::{Body, Recording};
use sunblind_sim::runner::log::RunLog;
use sunblind_sim::runner::{Driven, ReplayOptions, Session, replay};
use sunblind_tests::command::{stderr_of, stdout_of, sunblind};
use sunblind_tests::tiny_drive::TinyDrive;
use sunblind_tests::tiny_recording::TinyRecording;

const MOUNT: &str =
    "\n[mount]\nrobot_from_colour = { translation_m = [0, 0, 0.6], rotation_xyzw = [-0.5, 0.5, -0.5, 0.5] }\n";
const DRIVE: &str = "\n[drive]\nticks_per_m = 138000.0\neffective_track_m = 0.588\n";

fn recorded(drive: &TinyDrive, place: &Path) -> Recording {
    let folder = place.join("drive");
    drive.record(&folder).unwrap();
    Recording::open(&folder, None).unwrap()
}

fn product(drive: &TinyDrive, pose_from: PoseSource) -> Vec<Driven> {
    let params = EstimatorParams { pose_from, ..EstimatorParams::default() };
    vec![Driven::product("mvo", "visual odometry", params, drive.calibration.rig.clone()).unwrap()]
}

/// A measurement down to its bits.
fn bits(measurement: &Measurement) -> (i64, i64, &'static str, Vec<u8>) {
    let numbers = |values: &[f64]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<_>>();
    let pixels = |values: &[u16]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<_>>();
    let (kind, bytes) = match &measurement.data {
        MeasurementData::WheelTicks { left, right } => ("ticks", [left.to_le_bytes(), right.to_le_bytes()].concat()),
        MeasurementData::Gyro(rate) => ("gyro", numbers(rate.as_slice())),
        MeasurementData::Accelerometer(force) => ("accelerometer", numbers(force.as_slice())),
        MeasurementData::AmbientLight(light) => ("light", numbers(&[*light])),
        MeasurementData::Rgb(image) => ("rgb", image.pixels().as_flattened().to_vec()),
        MeasurementData::Infrared(image) => ("infrared", pixels(image.pixels())),
        MeasurementData::Depth(image) => ("depth", pixels(image.pixels())),
    };
    (measurement.captured_at.as_nanos(), measurement.available_at.as_nanos(), kind, bytes)
}

/// The bits of every estimate of every track, with their times.
fn said(log: &RunLog) -> Vec<(String, Vec<u64>)> {
    let of_track = |frames: &[sunblind_sim::runner::log::FrameLog]| {
        let of_frame = |frame: &sunblind_sim::runner::log::FrameLog| {
            let pose = frame.world_from_body.to_homogeneous();
            let numbers: Vec<_> = pose.iter().chain(frame.covariance.iter()).map(|value| value.to_bits()).collect();
            [vec![frame.time.as_nanos() as u64], numbers].concat()
        };
        frames.iter().flat_map(of_frame).collect()
    };
    log.tracks.iter().map(|track| (track.name.clone(), of_track(&track.frames))).collect()
}

#[test]
fn what_is_written_is_what_is_read() {
    let place = tempfile::tempdir().unwrap();
    let drive = TinyDrive::new(7);
    let recording = recorded(&drive, place.path());
    assert_eq!((&recording.rig, recording.body), (&drive.calibration.rig, Body::Robot));
    assert_eq!(recording.truth, drive.truth);
    assert!(recording.warnings.is_empty(), "{:?}", recording.warnings);
    let read: Vec<_> = recording.stream().iter().map(|reading| reading.load(&recording.rig).unwrap()).collect();
    assert_eq!(read.len(), drive.measurements.len());
    for (read, written) in read.iter().zip(&drive.measurements) {
        assert!(bits(read) == bits(written), "{:?}: {}", read.captured_at, bits(read).2);
    }
}

#[test]
fn a_session_and_a_replay_say_the_same_with_any_number_of_threads() {
    let place = tempfile::tempdir().unwrap();
    let drive = TinyDrive::new(12);
    let recording = recorded(&drive, place.path());
    let session = |portion: usize| {
        let frames = recording.frames.len();
        let mut session =
            Session::new(product(&drive, PoseSource::Svsf), drive.calibration.rig.clone(), frames, &|| {});
        drive.measurements.chunks(portion).for_each(|portion| session.take(portion));
        assert!(session.estimate().unwrap().time.is_some() && session.wanted_streams().unwrap().depth);
        session.finish("drive".into(), Vec::new(), &drive.truth)
    };
    let live = session(1);
    let replayed = |threads| {
        let options = ReplayOptions { threads: NonZero::new(threads).unwrap(), ..ReplayOptions::default() };
        replay(&recording, product(&drive, PoseSource::Svsf), &options).unwrap()
    };
    for other in [session(1000), replayed(1), replayed(2)] {
        assert_eq!(other.digest, live.digest);
        assert_eq!(said(&other), said(&live));
        assert_eq!(other.truth, live.truth);
        assert_eq!(other.snapshots.len(), live.snapshots.len());
    }
}

#[test]
fn every_reading_counts_in_the_digest() {
    let place = tempfile::tempdir().unwrap();
    let drive = TinyDrive::new(2);
    let folder = place.path().join("drive");
    drive.record(&folder).unwrap();
    let digest = || {
        let recording = Recording::open(&folder, None).unwrap();
        replay(&recording, product(&drive, PoseSource::Svsf), &ReplayOptions::default()).unwrap().digest
    };
    let before = digest();
    for (file, from, to) in [
        ("odometry.txt", " -77\n", " -76\n"),
        ("gyro.txt", " -0.12\n", " -0.1200001\n"),
        ("specific_force.txt", " 9.81\n", " 9.8\n"),
        ("light.txt", "250.125", "250.126"),
    ] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        assert!(text.contains(from), "{text}");
        fs::write(folder.join(file), text.replacen(from, to, 1)).unwrap();
        assert_ne!(digest(), before, "{file}");
        fs::write(folder.join(file), text).unwrap();
    }
    fs::remove_file(folder.join("ir.txt")).unwrap();
    assert_ne!(digest(), before, "ir.txt");
}

#[test]
fn each_track_is_judged_at_the_instants_of_its_own_poses() {
    let drive = TinyDrive::new(20);
    for judged in [PoseSource::Svsf, PoseSource::Odometry] {
        let mut session = Session::new(product(&drive, judged), drive.calibration.rig.clone(), 20, &|| {});
        session.take(&drive.measurements);
        let log = session.finish("drive".into(), Vec::new(), &drive.truth);
        assert!(log.warnings.is_empty(), "{:?}", log.warnings);
        let names: Vec<_> = log.tracks.iter().map(|track| track.name.as_str()).collect();
        let expected = match judged {
            PoseSource::Svsf => ["svsf", "odometry", "mvo", "ekf"],
            _ => ["odometry", "mvo", "ekf", "svsf"],
        };
        assert_eq!(names, expected);
        for track in &log.tracks {
            assert!(track.frames.is_sorted_by(|a, b| a.time < b.time), "{}", track.name);
            assert!(track.frames.len() >= 19, "{}: {} frames", track.name, track.frames.len());
            let counted = track.frames.iter().any(|frame| frame.counts.is_some());
            assert_eq!(counted, track.name == "mvo", "only visual odometry counts features");
            // A pose judged 0.03 s too late would be off by 9 mm, which the wheels show; the others follow a camera that
            // sees too little to say.
            let score = evaluate(&track.frames, &log.truth).unwrap();
            let limit = if track.name == "odometry" { 0.004 } else { 0.025 };
            assert!(score.end_error_m < limit, "{}: {score:?}", track.name);
        }
    }
}

#[test]
fn the_command_shows_every_track() {
    let place = tempfile::tempdir().unwrap();
    let (folder, out) = (place.path().join("drive"), place.path().join("out"));
    TinyDrive::new(6).record(&folder).unwrap();
    let run = sunblind().arg("replay").arg(&folder).arg("--out").arg(&out).args(["--set", "pose_from=ekf"]).output();
    let run = run.unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr_of(&run));
    let shown = stdout_of(&run);
    assert!(shown.contains("drive: 6 frames, poses of the robot"), "{shown}");
    for track in ["odometry", "mvo", "ekf", "svsf", "mvo_paper"] {
        assert!(shown.contains(&format!("│ {track} ")), "no {track} in {shown}");
        assert!(out.join(format!("{track}.tum")).is_file(), "{track}");
    }
    assert!(fs::read_to_string(out.join("summary.json")).unwrap().contains("\"judged\": \"ekf\""));
}

#[test]
fn wheels_without_a_drive_and_a_drive_without_wheels_are_mentioned() {
    let recording = TinyRecording::new(2);
    recording.write("odometry.txt", "of another make\n");
    let warnings = || Recording::open(&recording.folder(), None).unwrap().warnings;
    assert!(warnings()[0].starts_with("odometry.txt is left out"), "{:?}", warnings());
    recording.remove("odometry.txt");
    let calibration = fs::read_to_string(recording.path("calibration.toml")).unwrap();
    recording.write("calibration.toml", format!("{calibration}{MOUNT}{DRIVE}"));
    assert!(warnings()[0].starts_with("no odometry.txt"), "{:?}", warnings());
}

#[test]
fn a_robot_gets_images_without_a_partner_too() {
    let recording = TinyRecording::new(4);
    recording.replace("depth.txt", "100.101", "100.150");
    let images = || Recording::open(&recording.folder(), None).unwrap().stream().len();
    assert_eq!(images(), 6);
    let calibration = fs::read_to_string(recording.path("calibration.toml")).unwrap();
    recording.write("calibration.toml", format!("{calibration}{MOUNT}{DRIVE}"));
    assert_eq!(images(), 8);
}
