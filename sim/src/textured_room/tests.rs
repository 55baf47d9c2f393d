//! The recording against its own truth.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use glam::Vec3;
use nalgebra::{Isometry3, Point3};

use super::colour::ColourCamera;
use super::depth::{DepthSensor, STEPS_PER_PIXEL};
use super::layout::{ROOM, furnished_room};
use super::lit_scene::{LitScene, Pose};
use super::material::Material;
use super::scene::Scene;
use super::solid::{Shape, Solid};
use super::{BASELINE, Scenario, record, rig, world_from_camera};
use crate::random::stream;

fn sensor() -> DepthSensor {
    DepthSensor::new(&rig().depth.model)
}

/// Disparity of a depth, in the steps the device has.
fn steps(depth: f64) -> f64 {
    f64::from(STEPS_PER_PIXEL) * rig().depth.model.fx * BASELINE / depth
}

fn empty_room(things: Vec<Solid>) -> Scene {
    Scene::new(Solid::new(Shape::Hollow, ROOM / 2.0, ROOM, Material::Plain(0x10_10_10)), things)
}

#[test]
fn depth_lies_where_the_truth_says() {
    let (scene, rig) = (furnished_room(), rig());
    // The table's top, the bare wall, the whiteboard.
    let known = [(0.0, [3.1, 3.05, 0.74]), (4.5, [0.0, 2.75, 0.8]), (0.5, [4.9, 4.976, 1.5])];
    for (time, [x, y, z]) in known {
        let world_from_depth = world_from_camera(time);
        let point = world_from_depth.inverse() * Point3::new(x, y, z);
        let pixel = rig.depth.model.project(&point).unwrap();
        let image = sensor().shoot(&scene, &Pose::from(&world_from_depth), None);
        let seen = rig.depth.depth_of(image.at(pixel.x.round() as usize, pixel.y.round() as usize)).unwrap();
        // Half a pixel off the point, and half a step of disparity.
        assert!((steps(seen) - steps(point.z)).abs() < 1.5, "({x}, {y}, {z}): {seen} m for {} m", point.z);
    }
}

#[test]
fn the_colour_camera_sees_a_point_where_the_rig_puts_it() {
    let rig = rig();
    let world_from_depth = world_from_camera(2.5);
    let (x, y, z) = (2.9, 3.9, 0.9);
    let bulb = Solid::new(Shape::Ellipsoid, Vec3::new(x, y, z), Vec3::splat(0.06), Material::Lamp(0xff_ff_ff));
    let scene = LitScene::new(empty_room(vec![bulb]));
    let world_from_colour = world_from_depth * rig.colour_from_depth.inverse();
    let image = ColourCamera::new(&rig.colour).shoot(&scene, &[Pose::from(&world_from_colour); 4], None);
    let point = Point3::new(x, y, z).cast::<f64>();
    let expected = rig.colour.project(&(rig.colour_from_depth * (world_from_depth.inverse() * point))).unwrap();
    let bright: Vec<_> = (0..image.width() * image.height())
        .filter(|pixel| image.pixels()[*pixel][1] > 200)
        .map(|pixel| ((pixel % image.width()) as f64, (pixel / image.width()) as f64))
        .collect();
    let count = bright.len() as f64;
    let centre = bright.iter().fold((0.0, 0.0), |sum, at| (sum.0 + at.0 / count, sum.1 + at.1 / count));
    assert!((centre.0 - expected.x).hypot(centre.1 - expected.y) < 0.3, "{centre:?} for {expected}");
}

#[test]
fn disparity_comes_in_eighths_of_a_pixel() {
    let noise = stream(1, "depth noise", 0);
    let image = sensor().shoot(&furnished_room(), &Pose::from(&world_from_camera(0.0)), Some(noise));
    let mut far = 0;
    for &value in image.pixels().iter().filter(|value| **value != 0) {
        let depth = f64::from(value) / 5000.0;
        assert!((0.45..8.01).contains(&depth));
        // Nearer than that a file's unit is too coarse to tell a step.
        if depth > 1.0 {
            assert!((steps(depth) - steps(depth).round()).abs() < 0.05, "{depth} m");
            far += 1;
        }
    }
    assert!(far > 200_000);
}

#[test]
fn a_near_thing_throws_its_shadow_to_the_left_and_nowhere_else() {
    // The camera looks north at a wall 2 m away; a box 1 m away covers a part of it.
    let camera = Isometry3::translation(3.0, 3.0, 1.3) * world_from_camera(0.0).rotation;
    let level = Isometry3::from_parts(
        camera.translation,
        nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Vector3::x_axis(), -std::f64::consts::FRAC_PI_2),
    );
    let thing = Solid::between(Vec3::new(2.9, 4.0, 1.1), Vec3::new(3.1, 4.01, 1.5), Material::Plain(0x80_80_80));
    let image = sensor().shoot(&empty_room(vec![thing]), &Pose::from(&level), None);
    let row = image.row(240);
    let middle = 317;
    let left = (0..middle).rev().find(|x| row[*x] == 0 || row[*x] > 7500).unwrap();
    let lit = (0..left).rev().find(|x| row[*x] != 0).unwrap();
    let right = (middle..640).find(|x| row[*x] == 0 || row[*x] > 7500).unwrap();
    let published = rig().depth.model.fx * BASELINE * (1.0 / 1.0 - 1.0 / 2.0);
    assert!(((left - lit) as f64 - published).abs() <= 1.0, "{} px for {published:.1}", left - lit);
    assert!(row[right] > 7500, "a shadow on the right");
}

#[test]
fn equal_scenarios_give_equal_bytes_for_any_number_of_threads() {
    let text = "seed = 3\nduration_s = 0.1\nrate_hz = 30.0\n[world]\nname = \"textured_room\"\n";
    let scenario: Scenario = toml::from_str(text).unwrap();
    let scratch = tempfile::tempdir().unwrap();
    let files = [1, 2].map(|threads| {
        let out = scratch.path().join(threads.to_string());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| record(&scenario, &out, |_, _| ())).unwrap();
        bytes_of(&out)
    });
    assert_eq!(files[0].len(), 4 + 2 * 3);
    assert!(files[0] == files[1], "the bytes depend on the threads");
}

/// Every file below a recording, by its name within.
fn bytes_of(recording: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let folders = [recording.to_owned(), recording.join("rgb"), recording.join("depth")];
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap());
    let files = entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    files.map(|path| (path.strip_prefix(recording).unwrap().to_owned(), fs::read(&path).unwrap())).collect()
}
