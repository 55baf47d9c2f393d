//! The sun in glass.

use glam::{DVec3, Vec3};
use sunblind_sim::light::daylight;
use sunblind_sim::validation::scene::{self, Light, even, object, panel};
use sunblind_sim::world::{Gloss, Material, World};

use crate::outdoors::Camera;

/// Ground of glass or of something matt, 0.6 m below.
fn ground(gloss: Gloss) -> World {
    let ground = panel(Vec3::new(-15.0, -15.0, -0.6), [30.0 * Vec3::X, 30.0 * Vec3::Y], 2, Light::NONE);
    let material = Material { gloss, ..even("ground", [90; 3], 0.3) };
    World { open_sky: true, ..scene::world("ground", vec![object("ground", ground, 0)], vec![material]) }
}

#[test]
fn the_suns_glint_lies_where_a_mirror_has_it_and_saturates_a_few_pixels() {
    let light = daylight(0.6, 0.0, 0.0);
    let sun = light.beam.towards.as_dvec3();
    // A little beside the mirrored sun.
    let towards = (DVec3::new(sun.x, sun.y, -sun.z) + 0.1 * DVec3::X).normalize();
    let [glass, matt] =
        [Gloss::GLASS, Gloss::MATT].map(|gloss| Camera::new(&ground(gloss)).look(&light, DVec3::ZERO, towards));
    let full = glass.infrared.iter().fold(0.0, |most: f64, &light| most.max(light));
    let glint: Vec<[f64; 2]> = (glass.infrared.iter().enumerate())
        .filter(|(_, light)| **light > 0.999 * full)
        .map(|(index, _)| [(index % 640) as f64, (index / 640) as f64])
        .collect();
    println!("{} pixels saturated", glint.len());
    assert!((10..9000).contains(&glint.len()), "three in a hundred are {}", glint.len());
    let middle = [0, 1].map(|axis| glint.iter().map(|at| at[axis]).sum::<f64>() / glint.len() as f64);
    // The sun in the mirror, in the camera's frame: right, down, ahead.
    let right = towards.cross(DVec3::Z).normalize();
    let mirrored = DVec3::new(sun.x, sun.y, -sun.z);
    let [x, y, z] = [right, towards.cross(right), towards].map(|axis| axis.dot(mirrored));
    let expected = [319.5 + 580.0 * x / z, 239.5 + 580.0 * y / z];
    assert!(f64::hypot(middle[0] - expected[0], middle[1] - expected[1]) < 3.0, "{middle:?} instead of {expected:?}");
    let brightest = matt.infrared.iter().fold(0.0, |most: f64, &light| most.max(light));
    assert!(full > 1.5 * brightest, "glass {full}, matt {brightest}");
}
