//! What a wall, a texture or a corner says of a motion, in rooms whose depth and shade are known.

use super::*;
use crate::dark_room::{self, DarkRoom, Wall};
use crate::geometry::log_se3;
use crate::structure::{ALBEDO_NOISE, AlbedoCamera, ViewMaker};

/// Two views of a room, one from where `reference_from_camera` says.
fn views(walls: Vec<Wall>, reference_from_camera: &Isometry3<f64>) -> [DenseView; 2] {
    let room = DarkRoom { walls, ambient: 0.0 };
    let depth_camera = dark_room::rig().depth;
    let views = ViewMaker::new(&depth_camera.model, ALBEDO_NOISE);
    let mut camera = AlbedoCamera::new(&depth_camera);
    let mut see = |pose: &Isometry3<f64>, seed| {
        let seen = room.seen_from(pose, seed);
        let albedo = camera.recover(&seen.infrared, &seen.depth);
        camera.learn();
        views.view(&albedo.levels, &albedo.depth)
    };
    // The dots are learnt a little first.
    for step in 1..6 {
        see(&Isometry3::translation(0.1 * f64::from(step), 0.05, 0.0), 100 + step as u64);
    }
    [see(&Isometry3::identity(), 1), see(reference_from_camera, 2)]
}

fn wall(x: f64, y: f64, z: f64, distance: f64, is_textured: bool) -> Wall {
    Wall { normal: Vector3::new(x, y, z).normalize(), distance, is_textured }
}

/// A step forward and aside with a turn of 1°.
fn motion() -> Isometry3<f64> {
    exp_se3(&Vector6::new(0.02, -0.01, 0.04, 0.004, 0.017, -0.003))
}

const MAX_SIGMA: f64 = 0.05;

#[test]
fn a_bare_flat_wall_says_only_how_far_it_is() {
    let [reference, camera] = views(vec![wall(0.1, 0.0, 1.0, 2.5, false)], &motion());
    let found = align(&reference, &camera, &motion().inverse(), MAX_SIGMA);
    assert!(matches!(found, Err(MotionFailure::DegenerateGeometry { .. })), "{found:?}");
}

#[test]
fn texture_on_a_flat_wall_says_where_along_it() {
    let [reference, camera] = views(vec![wall(0.1, 0.0, 1.0, 2.5, true)], &motion());
    let found = align(&reference, &camera, &Isometry3::identity(), MAX_SIGMA).unwrap();
    let error = log_se3(&(found.camera_from_reference * motion()));
    assert!(error.norm() < 0.01, "{error}");
}

#[test]
fn what_the_dots_leave_is_no_texture() {
    let texture = |is_textured| {
        let [view, _] = views(vec![wall(0.1, 0.0, 1.0, 2.5, is_textured)], &motion());
        let (width, height) = view.shade.size();
        let places = (1..height - 1).flat_map(|y| (1..width - 1).map(move |x| (x, y)));
        places.filter(|&(x, y)| view.steepness(x, y) >= STEEP * view.shade_noise).count()
    };
    let (bare, textured) = (texture(false), texture(true));
    assert!(bare == 0 && textured > 5000, "{bare} {textured}");
}

#[test]
fn a_bare_corner_is_enough() {
    let corner =
        || vec![wall(1.0, 0.2, 0.8, 2.0, false), wall(-1.0, 0.3, 0.9, 2.0, false), wall(0.0, 1.0, 0.2, 1.0, false)];
    let [reference, camera] = views(corner(), &motion());
    let found = align(&reference, &camera, &Isometry3::identity(), MAX_SIGMA).unwrap();
    let error = log_se3(&(found.camera_from_reference * motion()));
    assert!(error.norm() < 0.01, "{error}");
    // Sure of itself, but no more than it may be.
    let surprise = error.dot(&(found.covariance.try_inverse().unwrap() * error));
    assert!(surprise < 30.0, "{surprise}");
    assert!((found.camera_from_reference.rotation.coords.norm() - 1.0).abs() < 1e-15);
    assert!(misfit(&reference, &camera, &motion().inverse()) < misfit(&reference, &camera, &Isometry3::identity()));
}
