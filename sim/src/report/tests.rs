//! Reports of logs that are full, thin, or without truth.

mod simulated;

use std::f64::consts::TAU;
use std::fs;

use nalgebra::{Isometry3, Matrix6, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;
use sunblind_estimator::image::{Image, RgbImage};
use sunblind_estimator::mode::{Energies, ModeChoice, ModeSwitch, Stream, SwitchParams};
use sunblind_estimator::motion::MotionFailure;
use sunblind_estimator::odometry::FeatureTrack;
use sunblind_estimator::{Health, Mode, Timestamp};

use super::write;
use crate::evaluation::StampedPose;
use crate::modes::{Information, StampedInformation, StampedReport};
use crate::runner::log::{FrameCounts, FrameLog, RunLog, Snapshot, Track};

/// A name and a warning as an attacker would choose them.
const HOSTILE: &str = r#"</title><script src="https://example.org/x.js">alert('1')</script>&amp;"#;

/// Where the camera truly is in frame `index` of a walk at 30 Hz: away from the world's origin, turning, bobbing.
fn true_pose(index: u32) -> Isometry3<f64> {
    let t = f64::from(index) / 30.0;
    let position = Translation3::new(3.0 + 0.6 * (TAU * t / 9.0).sin(), -1.0 + 0.25 * t, 1.2 + 0.05 * (2.0 * t).sin());
    Isometry3::from_parts(position, UnitQuaternion::from_euler_angles(0.1 * t.sin(), 0.05, 0.2 * t))
}

fn time(index: u32) -> Timestamp {
    Timestamp::from_nanos(1_305_031_102_000_000_000 + i64::from(index) * 33_333_333)
}

fn frame(index: u32, drift: f64) -> FrameLog {
    let t = f64::from(index) / 30.0;
    let wobble =
        Vector3::new((3.1 * t).sin(), (2.3 * t).cos() - 1.0, (1.7 * t).sin()) * 0.3 + Vector3::new(t, -t, 0.2 * t);
    let error = Isometry3::new(drift * wobble, drift * Vector3::new(0.1 * t, (1.3 * t).sin(), 0.3 * t));
    let lost = (130..140).contains(&index) || index == 200;
    let inliers = (180.0 + 60.0 * (1.1 * t).sin()) as usize;
    FrameLog {
        time: time(index),
        world_from_body: true_pose(index) * error,
        covariance: Matrix6::from_diagonal_element(1e-5 * t),
        mode: Mode::Indoor,
        health: if lost { Health::Lost(MotionFailure::TooFewInliers { found: 7, needed: 12 }) } else { Health::Good },
        counts: Some(FrameCounts {
            features: inliers + 320,
            matches: inliers + 60,
            inliers: if lost { 7 } else { inliers },
            keyframe: index.is_multiple_of(23),
            depth_valid_share: 0.7 + 0.1 * (0.6 * t).sin(),
        }),
        stage_ms: [2.1, 21.0 + (5.0 * t).sin(), 6.0, 3.2 + t.cos()],
    }
}

/// A mode switch that wavers for as long as the lamp flickers.
fn report(index: u32) -> StampedReport {
    let mut switch = ModeSwitch::new(ModeChoice::Auto, SwitchParams::default());
    let rgb = if index % 90 < 60 { 0.2 } else { 0.0 };
    for (stream, energy) in [(Stream::Rgb, rgb), (Stream::Infrared, 0.01), (Stream::Depth, 0.4)] {
        switch.see(stream, time(index), energy);
    }
    let mut report = switch.report();
    report.mode = report.answer;
    StampedReport { time: time(index), report }
}

fn information(index: u32) -> StampedInformation {
    let rgb = if index % 90 < 58 { 0.5 } else { 0.0 };
    StampedInformation { time: time(index), information: Information { rgb, infrared: 0.9, depth: 0.6 } }
}

fn snapshot(index: u32, [width, height]: [usize; 2]) -> Snapshot {
    let pixel = |x: usize, y: usize| [(x % 256) as u8, (y % 256) as u8, ((x ^ y) % 256) as u8];
    let pixels = (0..width * height).map(|i| pixel(i % width, i / width)).collect();
    let metres = |x: usize, y: usize| if x < width / 8 { 0.0 } else { 1.0 + 4.0 * y as f32 / height as f32 };
    let depth = (0..width * height).map(|i| metres(i % width, i / width)).collect();
    let track = |i: u16| {
        let to = [f32::from(i * 37 % 640), f32::from(i * 53 % 480)];
        FeatureTrack { from: [to[0] + 6.0, to[1] - 3.0], to, inlier: !i.is_multiple_of(5) }
    };
    Snapshot {
        time: time(index),
        rgb: RgbImage::from_pixels(width, height, pixels).unwrap(),
        infrared: None,
        depth: Image::from_pixels(width, height, depth).unwrap(),
        tracks: (0..200).map(track).collect(),
        mode: Mode::Indoor,
    }
}

/// Two localisers on a walk of `frames` frames with truth, a loss of tracking and pictures.
fn made_up_log(frames: u32) -> RunLog {
    let track = |name: &str, label: &str, drift: f64| Track {
        name: name.into(),
        label: label.into(),
        parameters: "variant = \"keyframes\"\n".into(),
        frames: (0..frames).map(|index| frame(index, drift)).collect(),
    };
    RunLog {
        recording: HOSTILE.into(),
        warnings: vec![HOSTILE.into()],
        truth: (0..frames).map(|i| StampedPose { time: time(i), world_from_body: true_pose(i) }).collect(),
        tracks: vec![
            track("mvo", "visual odometry, keyframes", 0.004),
            track("mvo_paper", "visual odometry, as in the paper", 0.009),
        ],
        snapshots: (0..6).map(|index| snapshot(index * frames / 6, [640, 480])).collect(),
        has_wheels: false,
        thumbnails: Vec::new(),
        energies: Energies { rgb: Some(0.21), infrared: None, depth: Some(0.3) },
        modes: (0..frames).map(report).collect(),
        information: (0..frames).map(information).collect(),
        plan: None,
        planned_path: Vec::new(),
        expectations: Vec::new(),
        facts: None,
        digest: "0123456789abcdef".repeat(4),
        wall: 11.5,
        cpu: 12.25,
    }
}

/// Writes the report, checks that the page is sound, and gives it back with the summary.
fn written(log: &RunLog) -> (tempfile::TempDir, String, Value) {
    let out = tempfile::tempdir().unwrap();
    let page = fs::read_to_string(write(log, out.path()).unwrap()).unwrap();
    check_page(&page);
    let summary = serde_json::from_slice(&fs::read(out.path().join("summary.json")).unwrap()).unwrap();
    (out, page, summary)
}

/// The page closes every tag (it is XHTML at the same time), fetches nothing, runs nothing but its own script and shows
/// no broken number.
fn check_page(page: &str) {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(page, options).unwrap();
    for node in document.descendants() {
        let script = node.has_tag_name("script").then(|| node.text().unwrap());
        assert!(script.is_none_or(|script| script == include_str!("page.js")), "a foreign script: {script:?}");
        assert!(!["link", "iframe", "object"].contains(&node.tag_name().name()));
        for attribute in node.attributes() {
            let (name, value) = (attribute.name(), attribute.value());
            assert!(!name.starts_with("on"), "{name}");
            assert!(!["src", "href"].contains(&name) || value.starts_with("data:image/jpeg;base64,"), "{name}={value}");
            assert!(
                !["d", "x", "y", "width", "height", "viewBox", "transform", "data-run"].contains(&name)
                    || !value.contains("NaN"),
                "{value}"
            );
            assert!(!value.contains("inf"), "{name}={value}");
        }
    }
    let style = document.descendants().find(|node| node.has_tag_name("style")).unwrap().text().unwrap();
    assert!(!style.contains("url(") && !style.contains("@import"));
    assert!(page.len() < 1_800_000, "{} bytes", page.len());
}

#[test]
fn a_full_run_is_reported_in_full() {
    let (out, page, summary) = written(&made_up_log(300));
    for section in ["Path", "Error", "Modes", "What was seen", "Numbers", "Pictures", "Time", "Behind it"] {
        assert!(page.contains(&format!("<h2>{section}</h2>")), "{section}");
    }
    assert!(page.contains("Tracked 289 of 300 frames over "));
    assert_eq!(page.matches("data:image/jpeg;base64,").count(), 12);
    assert_eq!(summary["scenario"], HOSTILE);
    assert_eq!(summary["judged"], "mvo");
    assert_eq!(summary["frames"], 300);
    assert_eq!(summary["lost_frames"], 11);
    assert_eq!(summary["expectations"], serde_json::json!([]));
    let fields = ["schema", "digest", "duration_s", "path_m", "wall_s", "cpu_s", "real_time_factor", "warnings"];
    assert!(fields.iter().all(|field| !summary[field].is_null()), "{summary}");
    assert!((summary["cpu_ms_per_frame"]["estimator"].as_f64().unwrap() - 32.3).abs() < 0.5);
    for field in
        "rmse_x_m rmse_y_m rmse_theta_deg ate_m rpe_m rpe_deg rpe_frame_m rpe_frame_deg drift_percent end_error_m"
            .split(' ')
    {
        let of = |name: &str| summary["estimators"][name][field].as_f64().unwrap();
        assert!(0.0 < of("mvo") && of("mvo") < of("mvo_paper"), "{field}");
    }
    assert_eq!(summary["estimators"]["mvo"]["stages"]["matching"]["median_ms"], 6.0);
    for (file, lines) in [("truth.tum", 300), ("mvo.tum", 300), ("mvo_paper.tum", 300)] {
        let text = fs::read_to_string(out.path().join(file)).unwrap();
        assert_eq!(text.lines().count(), lines);
        assert!(text.lines().all(|line| line.split(' ').filter(|n| n.parse::<f64>().is_ok()).count() == 8), "{file}");
        assert!(text.starts_with("1305031102.000000000 3.000000000 -1.000000000 1.200000000 "), "{file}");
    }
    let mut timeline = csv::Reader::from_path(out.path().join("timeline.csv")).unwrap();
    for column in ["time_s", "track", "sigma_about_z_deg", "health", "inliers", "motion_ms", "position_error_m"] {
        assert!(timeline.headers().unwrap().iter().any(|header| header == column), "{column}");
    }
    assert_eq!(timeline.records().map(Result::unwrap).count(), 600);
}

#[test]
fn the_modes_are_shown_beside_the_best_ones() {
    let (out, page, summary) = written(&made_up_log(300));
    // Four stretches in the light and three in the dark; a note says how late the switch was.
    for (class, count) in [("indoor", 8), ("night", 6), ("outdoor", 0), ("wheels", 0)] {
        assert_eq!(page.matches(&format!("class=\"stretch {class}\"")).count(), count, "{class}");
    }
    assert!(page.contains("6 switches for 6 changes of the best mode"), "a note");
    assert_eq!((&summary["modes"]["switches"], &summary["modes"]["accuracy_percent"]), (&6.into(), &100.0.into()));
    let mut modes = csv::Reader::from_path(out.path().join("modes.csv")).unwrap();
    let header = modes.headers().unwrap().clone();
    let row = modes.records().nth(70).unwrap().unwrap();
    let value = |name: &str| &row[header.iter().position(|column| column == name).unwrap()];
    assert_eq!([value("mode"), value("best_mode"), value("energy_rgb")], ["night", "night", "0.0"]);
    // (0.4 - 0.32) / (0.42 - 0.32).
    assert!((value("high_depth").parse::<f64>().unwrap() - 0.8).abs() < 1e-9);
    assert_eq!([value("high_rgb"), value("high_infrared"), value("rule_lhh")], ["0.0", "1.0", value("high_depth")]);
    assert_eq!([value("degree_night"), value("rgb_contrast_share")], [value("rule_lhh"), "0.0"]);

    let mut log = made_up_log(60);
    log.information.clear();
    let (_, page, summary) = written(&log);
    assert!(page.contains("<h2>Modes</h2>") && !page.contains(">best</text>") && summary["modes"].is_null());
    log.modes.clear();
    let (out, page, _) = written(&log);
    assert!(!page.contains("<h2>Modes</h2>") && !out.path().join("modes.csv").exists());
}

/// A robot with wheels: its visual odometry is one of several tracks, and not the judged one.
#[test]
fn many_tracks_share_an_estimator() {
    let mut log = made_up_log(60);
    for (name, label) in
        [("ekf", "wheels and vision, EKF"), ("odometry", "wheels alone"), ("svsf", "wheels and vision, SVSF")]
    {
        // Wheels have another rhythm.
        let mut frames: Vec<_> = (0..40).map(|index| frame(index, 0.002)).collect();
        frames.iter_mut().for_each(|frame| (frame.counts, frame.stage_ms) = (None, [0.0; 4]));
        let parameters = log.tracks[0].parameters.clone();
        log.tracks.insert(0, Track { name: name.into(), label: label.into(), parameters, frames });
    }
    log.tracks[4].parameters = "variant = \"paper\"\n".into();
    let (_, page, summary) = written(&log);
    assert_eq!(summary["judged"], "svsf");
    assert_eq!(summary["frames"], 60, "the camera's");
    assert!(summary["cpu_ms_per_frame"]["estimator"].as_f64().unwrap() > 30.0);
    assert!(page.contains("a frame (median)"));
    let groups: Vec<_> = page.matches("<summary>Parameters: ").collect();
    assert_eq!(groups.len(), 2);
    assert!(page.contains("<summary>Parameters: svsf, odometry, ekf, mvo</summary>"));
    assert!(page.contains("class=\"metrics many\""));
}

#[test]
fn equal_logs_give_equal_bytes() {
    let (first, ..) = written(&made_up_log(60));
    let (second, ..) = written(&made_up_log(60));
    for entry in fs::read_dir(first.path()).unwrap() {
        let name = entry.unwrap().file_name();
        let [one, other] = [&first, &second].map(|folder| fs::read(folder.path().join(&name)).unwrap());
        assert!(one == other, "{name:?}");
    }
}

#[test]
fn without_truth_nothing_is_judged() {
    let mut log = made_up_log(60);
    log.truth.clear();
    let (out, page, summary) = written(&log);
    assert!(!out.path().join("truth.tum").exists());
    assert!(!page.contains("<h2>Error</h2>") && page.contains("no truth to compare with"));
    assert!(summary["estimators"]["mvo"]["ate_m"].is_null());
    assert!(summary["path_m"].as_f64().unwrap() > 0.1);
}

#[test]
fn a_localiser_that_says_little_gets_a_short_report() {
    let mut log = made_up_log(60);
    log.snapshots.clear();
    log.tracks.truncate(1);
    for frame in &mut log.tracks[0].frames {
        (frame.counts, frame.covariance, frame.stage_ms) = (None, Matrix6::zeros(), [0.0; 4]);
    }
    let (_, page, summary) = written(&log);
    for section in ["What was seen", "Pictures", "Time"] {
        assert!(!page.contains(&format!("<h2>{section}</h2>")), "{section}");
    }
    assert!(page.contains("The estimator gave no covariance."));
    assert!(summary["cpu_ms_per_frame"]["estimator"].is_null());
}

#[test]
fn runs_of_hardly_any_frames_have_a_report() {
    for frames in [0, 1, 2, 3] {
        let (_, page, summary) = written(&made_up_log(frames));
        assert_eq!(summary["frames"], frames);
        assert!(page.contains(if frames == 0 { "has no frames" } else { "Tracked" }));
    }
}

#[test]
fn a_run_that_never_tracked_says_so() {
    let mut log = made_up_log(60);
    for frame in &mut log.tracks[0].frames {
        frame.health = Health::Lost(MotionFailure::TooFewFeatures { found: 0, needed: 12 });
        frame.world_from_body = true_pose(0);
    }
    let (_, page, summary) = written(&log);
    assert!(page.contains("Tracked none of 60 frames."));
    assert_eq!(summary["lost_frames"], 60);
}

#[test]
fn what_makes_no_sense_breaks_nothing() {
    let mut log = made_up_log(60);
    log.tracks[0].frames[30].world_from_body.translation.x = f64::NAN;
    log.tracks[0].frames[31].covariance.fill(f64::INFINITY);
    log.snapshots[0].depth.pixels_mut().fill(f32::NAN);
    log.snapshots[1].rgb = RgbImage::from_pixels(640, 0, Vec::new()).unwrap();
    log.snapshots[2].depth = Image::from_pixels(640, 0, Vec::new()).unwrap();
    written(&log);
}

#[test]
fn a_quarter_of_an_hour_stays_a_small_page() {
    written(&made_up_log(27_000));
}

#[test]
fn a_track_cannot_write_elsewhere() {
    for name in ["../mvo", "", "truth", "mvo_paper", "a b", "/mvo"] {
        let mut log = made_up_log(3);
        log.tracks[0].name = name.into();
        let out = tempfile::tempdir().unwrap();
        assert_eq!(write(&log, out.path()).unwrap_err().kind(), std::io::ErrorKind::InvalidInput, "{name}");
        assert_eq!(fs::read_dir(out.path()).unwrap().count(), 0);
    }
}
