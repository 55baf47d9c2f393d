//! Calibration files: what they mean, what is refused and where, and that they come back as written.

use super::*;

const KINECT: &str = include_str!("kinect.toml");

/// Where and what the fault is once `from` has been replaced by `to`.
fn fault_after(from: &str, to: &str) -> String {
    assert!(KINECT.contains(from), "{from}");
    let text = KINECT.replacen(from, to, 1);
    let Fault { span, problem } = parse(&text).expect_err("a fault");
    let place = Place::at_offset(Path::new("c"), &text, span.start);
    format!("{place}: {problem}")
}

#[test]
fn the_poses_are_those_of_the_camera_that_the_truth_is_of() {
    let depth = parse(KINECT).ok().unwrap();
    assert_eq!(depth.body, Body::Depth);
    let robot_from_depth = depth.rig.robot_from_colour * depth.rig.colour_from_depth;
    assert!((robot_from_depth.to_homogeneous() - nalgebra::Matrix4::identity()).norm() < 1e-12);

    let colour = parse(&KINECT.replace("camera = \"depth\"", "camera = \"colour\"")).ok().unwrap();
    assert_eq!((colour.body, colour.rig.robot_from_colour), (Body::Colour, Isometry3::identity()));
    let unsaid = parse(KINECT.split("[truth]").next().unwrap()).ok().unwrap();
    assert_eq!(unsaid, colour);
}

#[test]
fn a_mount_makes_the_poses_the_robots() {
    let mount =
        "[mount]\nrobot_from_colour = { translation_m = [0.1, 0.0, 0.6], rotation_xyzw = [-0.5, 0.5, -0.5, 0.5] }";
    let text = format!("{}{mount}", KINECT.split("[truth]").next().unwrap());
    let calibration = parse(&text).ok().unwrap();
    assert_eq!(calibration.body, Body::Robot);
    // What lies ahead of the camera (z) lies ahead of the robot (x).
    let ahead = calibration.rig.robot_from_colour * nalgebra::Point3::new(0.0, 0.0, 1.0);
    assert!((ahead - nalgebra::Point3::new(1.1, 0.0, 0.6)).norm() < 1e-12);
    assert!(fault_after("[truth]", &format!("{mount}\n[truth]")).contains("exclude each other"));
}

#[test]
fn raw_disparity_takes_the_place_of_linear_depth() {
    let raw = KINECT.replace("units_per_m = 5000.0", "raw_offset = 1090.0\nbaseline_m = 0.075");
    let encoding = parse(&raw).ok().unwrap().rig.depth.encoding;
    assert_eq!(encoding, DepthEncoding::KinectDisparity { offset: 1090.0, baseline: 0.075 });
    for wrong in ["", "raw_offset = 1090.0", "units_per_m = 5000.0\nbaseline_m = 0.075"] {
        assert!(fault_after("units_per_m = 5000.0", wrong).starts_with("c:13:1: [depth] does not say"));
    }
}

#[test]
fn faults_are_pointed_at() {
    for (from, to, expected) in [
        ("fx_px = 527.8\n", "", "c:4:1: [colour] has no fx_px; write fx_px = 525.0"),
        ("fx_px = 585.0", "fx_px = 0", "c:16:9: fx_px is 0; write a positive number, such as 525.0"),
        ("fy_px = 585.0", "fy_px = -585.0", "c:17:9: fy_px is -585"),
        ("cx_px = 320.0", "cx_px = nan", "c:9:9: cx_px is NaN; write a finite number, such as 319.5"),
        ("width_px = 640", "width_px = 0", "c:5:12: width_px is 0"),
        ("width_px = 640", "width_px = -640", "c:5:12: "),
        ("distortion = [0.0,", "distortion = [inf,", "c:11:14: distortion must hold 5 finite numbers"),
        ("distortion = [0.0,", "distortion = [", "c:11:14: "),
        ("units_per_m = 5000.0", "units_per_m = 0.0", "c:21:15: units_per_m is 0"),
        (
            "rotation_xyzw = [0.0, 0.0, 0.0, 1.0]",
            "rotation_xyzw = [0, 0, 0, 2]",
            "c:25:17: rotation_xyzw has length 2.0000, not 1; write [0.000000, 0.000000, 0.000000, 1.000000]",
        ),
        ("rotation_xyzw = [0.0, 0.0, 0.0, 1.0]", "rotation_xyzw = [0, 0, 0, 0]", "c:25:17: "),
        ("translation_m = [-0.0208", "translation_m = [nan", "c:24:17: translation_m must hold 3"),
        (
            "camera = \"depth\"",
            "camera = \"infrared\"",
            "c:28:10: unknown variant `infrared`, expected `colour` or `depth`",
        ),
        ("fx_px = 527.8", "fx = 527.8", "c:7:1: unknown field `fx`, expected one of `width_px`"),
        ("fx_px = 527.8", "fx_px = 527.8\nunits_per_m = 5000.0", "c:8:15: this belongs into [depth]"),
        ("registered = false", "registered = true\n[", "c:3:2: "),
        (
            "registered = false",
            "registered = false\nalignment_sigma_px = -1",
            "c:3:22: alignment_sigma_px is -1; write 0 to 50",
        ),
    ] {
        let found = fault_after(from, to);
        assert!(found.starts_with(expected), "{to:?}:\n  found    {found}\n  expected {expected}");
        assert!(!found.contains('\n'), "one line: {found}");
    }
}

#[test]
fn registered_depth_has_the_colour_images_size() {
    let text = KINECT.replacen("height_px = 480", "height_px = 479", 1);
    assert!(parse(&text).is_ok());
    let text = text.replace("registered = false", "registered = true");
    assert!(parse(&text).err().unwrap().problem.contains("write registered = false"));
}

/// A robot whose every number has as many digits as a number can have.
fn robot() -> Calibration {
    let mut rig = parse(KINECT).ok().unwrap().rig;
    rig.depth.encoding = DepthEncoding::KinectDisparity { offset: 1090.1, baseline: 0.1 + 0.2 };
    rig.colour_from_depth =
        Isometry3::new(nalgebra::Vector3::new(-0.1, 1e-7, 1.0 / 3.0), nalgebra::Vector3::new(0.1, 0.2, 0.3));
    rig.robot_from_colour =
        Isometry3::new(nalgebra::Vector3::new(0.1, 0.0, 0.6), nalgebra::Vector3::new(-1.2, 1.1, -1.3));
    rig.alignment_sigma = 0.1 + 0.2;
    rig.drive = Some(Drive { ticks_per_metre: 138_000.7, effective_track: 0.588 });
    let latency = Latency::default().with(Sensor::Depth, 2.0 / 30.0).with(Sensor::Wheels, 1e-9);
    Calibration { rig, body: Body::Robot, latency }
}

#[test]
fn what_is_written_is_read_bit_for_bit() {
    let camera = parse(KINECT).ok().unwrap();
    for calibration in [robot(), Calibration::kinect_default(), camera] {
        let read = parse(&calibration.to_string()).ok().unwrap();
        assert_eq!(read, calibration, "{calibration}");
        let bits = |calibration: &Calibration| {
            let transforms = [calibration.rig.colour_from_depth, calibration.rig.robot_from_colour];
            transforms.map(|transform| transform.rotation.coords.map(f64::to_bits))
        };
        assert_eq!(bits(&read), bits(&calibration));
    }
}

#[test]
fn wheels_and_latencies_are_checked() {
    let text = robot().to_string();
    for (from, to, expected) in [
        ("ticks_per_m = 138000.7", "ticks_per_m = 0", "ticks_per_m is 0; write a positive number, such as 138000.0"),
        ("effective_track_m = 0.588", "effective_track_m = 1e300", "drive: effective_track_m is 1"),
        ("effective_track_m = 0.588", "", "missing field `effective_track_m`"),
        ("odometry_s = 1e-9", "odometry_s = -1.0", "odometry_s is -1; write 0 to 60 s"),
        ("odometry_s = 1e-9", "wheels_s = 1.0", "unknown variant `wheels_s`, expected one of `gyro_s`"),
        ("[mount]\nrobot_from_colour", "#", "[drive] needs to know where the camera sits on the robot; write [mount]"),
    ] {
        assert!(text.contains(from), "{from} in {text}");
        let Fault { span, problem } = parse(&text.replacen(from, to, 1)).expect_err("a fault");
        assert!(problem.starts_with(expected), "{to:?}: {problem}");
        assert!(span.start > text.find("[colour_from_depth]").unwrap(), "{to:?} at {span:?}");
    }
}
