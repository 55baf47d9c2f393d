//! What lacquer, and glass before it, do to the dots.

use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::matcher::NO_DEPTH;
use sunblind_sim::kinect::{Imaging, Kinect, KinectFrame};
use sunblind_sim::render::Sweep;
use sunblind_sim::validation::scene::{Light, even, looking_north, object, turned_wall, world};
use sunblind_sim::world::{Gloss, Material};

/// A wall in the dark, turned by an angle in degrees, and the exposure (seconds × gain) of its infrared image.
fn wall(distance: f32, angle: f32, gloss: Gloss) -> (KinectFrame, f64) {
    let mesh = turned_wall(distance, angle.to_radians(), Light::NONE);
    let paint = Material { gloss, ..even("paint", [200; 3], 0.6) };
    let imaging = Imaging { noise: false, ..Imaging::default() };
    let world = world("wall", vec![object("wall", mesh, 0)], vec![paint]);
    let mut kinect = Kinect::new(&world, Calibration::nominal(), imaging, 1).expect("a graphics adapter");
    kinect.capture(&Sweep::still(looking_north()), 0).expect("a frame");
    let [_, exposure] = kinect.exposures();
    (kinect.capture(&Sweep::still(looking_north()), 1).expect("a frame"), exposure.time * exposure.gain)
}

/// Mean number about a column, for a unit of exposure.
fn light((frame, exposure): &(KinectFrame, f64), column: usize) -> f64 {
    let patch = (160..320).flat_map(|y| frame.infrared.row(y)[column - 8..column + 8].iter());
    patch.map(|&number| f64::from(number)).sum::<f64>() / exposure
}

#[test]
fn dots_fade_at_grazing_angles_as_fresnel_says() {
    for angle in [0.0_f32, 60.0, 78.0] {
        let [matt, lacquered] = [Gloss::MATT, Gloss::VARNISH].map(|gloss| wall(2.0, angle, gloss));
        // Off the mirrored projector, where there is one.
        let column = if angle == 0.0 { 520 } else { 320 };
        // Cosines at which the camera, and the projector to its right, look onto the wall, which is 2 m deep there.
        let cosine = |tangent: f32| (angle.to_radians() + tangent.atan()).cos();
        let tangent = (column as f32 - 319.5) / 580.0;
        let entering = |cosine: f32| 1.0 - (0.04 + 0.96 * (1.0 - cosine).powi(5));
        let passed = entering(cosine(tangent)) * entering(cosine(tangent - 0.075 / 2.0));
        let expected = f64::from(passed / (1.0 - 0.04 - 0.96 / 21.0));
        let found = light(&lacquered, column) / light(&matt, column);
        println!("{angle}°: {found:.3} of a matt wall's light comes back, {expected:.3} expected");
        assert!((found / expected - 1.0).abs() < 0.06, "{angle}°: {found} instead of {expected}");
    }
}

#[test]
fn glass_shows_the_projector_and_loses_depth_about_it() {
    let [(matt, _), (glass, _)] = [Gloss::MATT, Gloss::GLASS].map(|gloss| wall(1.0, 0.0, gloss));
    // Half way between camera and projector.
    let middle = (319.5 + 580.0 * 0.0375, 239.5);
    let within = |least: f64, most: f64| {
        let distance = move |x: usize, y: usize| f64::hypot(x as f64 - middle.0, y as f64 - middle.1);
        let near = (0..480).flat_map(|y| (0..640).map(move |x| (x, y)));
        near.filter(move |&(x, y)| (least..most).contains(&distance(x, y))).collect::<Vec<_>>()
    };
    let share = |places: &[(usize, usize)], holds: &dyn Fn(usize, usize) -> bool| {
        places.iter().filter(|&&(x, y)| holds(x, y)).count() as f64 / places.len() as f64
    };
    let (blob, around) = (within(0.0, 6.0), within(40.0, 120.0));
    let saturated = |x, y| glass.infrared.at(x, y) == 1023;
    println!("saturated: {:.2} in the blob, {:.2} around", share(&blob, &saturated), share(&around, &saturated));
    assert!(share(&blob, &saturated) > 0.99 && share(&around, &saturated) < 0.1);
    assert!(share(&blob, &|x, y| matt.infrared.at(x, y) == 1023) < 0.1);
    let has_depth = |x, y| glass.depth_raw.at(x, y) != NO_DEPTH;
    assert!(share(&blob, &has_depth) < 0.05 && share(&around, &has_depth) > 0.95);
}
