//! Inverse depths of scenes whose depth is known everywhere.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::*;
use crate::camera::{DepthCamera, DepthEncoding, Distortion};
use crate::dark_room::{DarkRoom, Wall};

/// A Kinect whose cameras differ as real ones do.
fn rig() -> Rig {
    let mut rig = Rig::kinect_default();
    rig.colour.distortion = Distortion { k1: 0.231222, k2: -0.784899, p1: -0.003257, p2: -0.000105, k3: 0.917205 };
    let mut infrared = Rig::kinect_default().colour;
    (infrared.fx, infrared.fy, infrared.cx, infrared.cy) = (577.0, 578.0, 325.0, 233.0);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.006, -0.01, 0.004));
    rig.depth = DepthCamera {
        model: infrared,
        encoding: DepthEncoding::KinectDisparity { offset: 1090.0, baseline: 0.075 },
        registered_to_colour: false,
    };
    rig.colour_from_depth = Isometry3::from_parts(Translation3::new(-0.025, 0.0, 0.0), turn);
    rig
}

#[test]
fn a_slanted_walls_depth_is_found_without_the_projector_and_as_well_as_is_said() {
    let rig = rig();
    let normal = Vector3::new(0.45, 0.1, 1.0).normalize();
    let room = DarkRoom { walls: vec![Wall { normal, distance: 2.2, is_textured: true }], ambient: 0.0 };
    let seen = |camera: &CameraModel, world_from_camera: &Isometry3<f64>| room.albedo(camera, world_from_camera);
    let colour = seen(&rig.colour, &Isometry3::identity());
    let luma = colour.pixels().iter().map(|&albedo| (20.0 + 220.0 * albedo) as u8).collect();
    let luma = GrayImage::from_pixels(640, 480, luma).unwrap();
    // Dark where colour is bright, and in few of the levels.
    let infrared = seen(&rig.depth.model, &rig.colour_from_depth);
    let values = infrared.pixels().iter().map(|&albedo| (90.0 - 60.0 * albedo) as u16).collect();
    let infrared = InfraredImage::from_pixels(640, 480, values).unwrap();

    let places: Vec<(f32, f32)> =
        (0..300).map(|k| (60.3 + 26.0 * (k % 20) as f32, 50.7 + 25.0 * (k / 20) as f32)).collect();
    let mut stereo = Stereo::new(&rig).unwrap();
    let found = stereo.inverse_depths(&places, &luma, &infrared);
    let errors: Vec<(f64, f64)> = places
        .iter()
        .zip(&found)
        .filter_map(|(&(x, y), found)| {
            let ray = rig.colour.ray(&Point2::new(f64::from(x), f64::from(y)));
            let expected = normal.dot(&ray) / 2.2;
            found.map(|found| (found.value - expected, found.sigma))
        })
        .collect();
    let within = errors.iter().filter(|(error, sigma)| error.abs() < 2.0 * sigma).count();
    let mut sizes: Vec<f64> = errors.iter().map(|(error, _)| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let mean = errors.iter().map(|(error, _)| error).sum::<f64>() / errors.len() as f64;
    assert!(errors.len() > 200, "{} of 300", errors.len());
    // A tenth of a pixel is 0.0076/m: 3 cm at 2 m.
    assert!(mean.abs() < 0.003, "{mean}");
    assert!(sizes[sizes.len() / 2] < 0.01, "{}", sizes[sizes.len() / 2]);
    assert!(within * 10 > errors.len() * 8, "{within} of {}", errors.len());
}

#[test]
fn the_infrared_image_gets_the_colour_images_grey_levels() {
    let stereo = Stereo::new(&rig()).unwrap();
    let ramp = |index: usize| ((index % 640) / 8) as u16;
    let infrared = InfraredImage::from_pixels(640, 480, (0..640 * 480).map(ramp).collect()).unwrap();
    let luma = GrayImage::from_pixels(640, 480, (0..640 * 480).map(|index| (index / 640 / 2) as u8).collect()).unwrap();
    let aligned = stereo.aligned(&infrared, &luma);
    let mean = |image: &GrayImage| {
        let inside = image.pixels().iter().zip(&stereo.places).filter(|(_, place)| place.is_some());
        let values: Vec<f64> = inside.map(|(&grey, _)| f64::from(grey)).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    assert!((mean(&aligned) - mean(&luma)).abs() < 2.0, "{} {}", mean(&aligned), mean(&luma));
    // Brighter stays brighter.
    assert!(aligned.row(240)[100..540].is_sorted());
}

#[test]
fn a_rig_that_says_nothing_of_its_infrared_camera_has_no_stereo() {
    assert!(Stereo::new(&Rig::kinect_default()).is_none());
    let mut coincident = rig();
    coincident.colour_from_depth = Isometry3::identity();
    assert!(Stereo::new(&coincident).is_none());
}
