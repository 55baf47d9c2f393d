//! The P3-AT's file beside its published figures, and files that are refused.

use super::*;

const P3AT: &str = include_str!("../../../../assets/robots/p3at.urdf");

fn p3at() -> RobotModel {
    load(P3AT, &CameraMount::default()).unwrap()
}

fn refused(text: &str) -> String {
    load(text, &CameraMount::default()).unwrap_err().to_string()
}

#[test]
fn the_p3at_has_its_published_figures() {
    let robot = p3at();
    assert_eq!(robot.name, "p3at");
    assert_eq!(robot.wheels.len(), 4);
    assert!((robot.track() - 0.394).abs() < 1e-12);
    assert!((robot.wheelbase() - 0.269).abs() < 1e-12);
    assert!((robot.wheel_radius() - 0.111).abs() < 1e-12);
    // Chassis, mast and Kinect are one body; the wheels are not in it.
    assert!((robot.chassis.inertial.mass - 21.1).abs() < 1e-12);
    assert_eq!(robot.chassis.shapes.len(), 6);
}

#[test]
fn the_camera_looks_ahead_from_its_height() {
    let camera = p3at().robot_from_camera;
    assert!((camera.translation.z - 0.60).abs() < 1e-12);
    assert!((camera.rotation * Vector3::z() - Vector3::x()).norm() < 1e-12);
    assert!((camera.rotation * Vector3::x() + Vector3::y()).norm() < 1e-12);
}

#[test]
fn the_mount_moves_the_camera_and_its_mass() {
    let mount = CameraMount { height: Some(1.0), tilt: Some(0.2) };
    let robot = load(P3AT, &mount).unwrap();
    let forward = robot.robot_from_camera.rotation * Vector3::z();
    assert!((robot.robot_from_camera.translation.z - 1.0).abs() < 1e-12);
    assert!((forward - Vector3::new(0.2_f64.cos(), 0.0, 0.2_f64.sin())).norm() < 1e-12, "looks along {forward}");
    assert!(robot.chassis.inertial.centre.z > p3at().chassis.inertial.centre.z);
    assert_eq!(robot.chassis.inertial.mass, p3at().chassis.inertial.mass);
}

#[test]
fn what_no_robot_is_made_of_is_refused_by_name() {
    let arm = P3AT.replace(r#"<joint name="mast_mount" type="fixed">"#, r#"<joint name="mast_mount" type="revolute">"#);
    assert!(refused(&arm).contains("mast_mount"));
    let leaning = P3AT.replacen(r#"<axis xyz="0 1 0"/>"#, r#"<axis xyz="1 0 0"/>"#, 1);
    assert!(refused(&leaning).contains("front_left_wheel"));
    let blind = P3AT.replace("kinect_optical_frame", "elsewhere");
    assert!(refused(&blind).contains("kinect_optical_frame"));
    let loops = P3AT.replace(r#"<child link="mast"/>"#, r#"<child link="chassis"/>"#);
    assert!(load(&loops, &CameraMount::default()).is_err());
    let feather = P3AT.replace(r#"<mass value="1.2"/>"#, r#"<mass value="0"/>"#);
    assert!(refused(&feather).contains("0 kg"));
    assert!(refused("<robot").contains("not a robot description"));
}
