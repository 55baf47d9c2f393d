//! Dark surfaces, bright windows, and what the exposures make of them.

use glam::Vec3;
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::{Imaging, InfraredExposure, Kinect};
use sunblind_sim::render::Sweep;
use sunblind_sim::validation::bench::{Bench, Wall, gallery};
use sunblind_sim::validation::scene::{Light, even, looking_north, object, panel, wall_world, world};

#[test]
fn a_darker_surface_never_has_more_depth() {
    let albedos = [0.8, 0.2, 0.1, 0.05, 0.02];
    // The same patch of the image each time: tiles differ in brightness. No sun: the exposure must not decide.
    let walls = albedos.map(|albedo| Wall { albedo, ..Wall::at(4.0) });
    let seen = Bench::look_at_all(&walls).expect("a graphics adapter");
    let valid: Vec<f64> = seen.iter().map(|seen| seen.about(4.0).valid).collect();
    println!("valid share at 4 m by albedo: {:.3?}", std::iter::zip(albedos, &valid).collect::<Vec<_>>());
    assert!(valid.windows(2).all(|pair| pair[1] <= pair[0] + 0.01), "{valid:.3?}");
    assert!(valid[0] > 0.95, "white paint at 4 m is within a Kinect's range: {}", valid[0]);
}

#[test]
fn a_bright_window_does_not_blind_the_room() {
    // A wall at 3 m in the dark of an office, a tenth of the view a window's overcast sky.
    let sky = Light::overcast(5.0 * 3.1);
    let wall = panel(Vec3::new(-5.0, 3.0, -4.0), [10.0 * Vec3::X, 8.0 * Vec3::Z], 4, Light::LED);
    let window = panel(Vec3::new(0.5, 2.99, 0.0), [1.0 * Vec3::X, 1.0 * Vec3::Z], 4, sky);
    let objects = vec![object("wall", wall, 0), object("window", window, 1)];
    let materials = vec![even("paint", [220, 220, 220], 0.7), even("sky", [250, 250, 250], 0.98)];
    let mut bench = Bench::new(&world("window", objects, materials)).expect("a graphics adapter");
    let seen = bench.look().expect("a frame");
    let left = (100..380).flat_map(|y| (40..280).map(move |x| (x, y)));
    let valid = left.clone().filter(|&(x, y)| seen.depth(x, y).is_some()).count() as f64 / left.count() as f64;
    println!("saturated {:.3}, valid {:.3}, beside the window {valid:.3}", seen.saturated(), seen.valid());
    assert!(valid > 0.9, "{valid}");
}

#[test]
fn what_the_exposure_may_do_decides_whether_the_infrared_image_survives_the_sun() {
    let facade = Wall { albedo: 0.4, light: Light::sun(100.0), ..Wall::at(3.0) };
    let saturated = |infrared_exposure| {
        let imaging = Imaging { infrared_exposure, ..Imaging::default() };
        Bench::with(&gallery(&[facade]), imaging).expect("a graphics adapter").look().expect("a frame").saturated()
    };
    use InfraredExposure::{Free, GainOnly, LimitedExposure};
    let shares = [Free, LimitedExposure, GainOnly].map(saturated);
    println!("full scale in 100 klx, free, limited, gain only: {shares:.3?}");
    assert!(shares[0] < 0.02 && shares[1] < 0.02, "{shares:?}");
    assert!(shares[2] > 0.98, "30 ms are too long: {shares:?}");
}

#[test]
fn exposure_is_as_much_longer_as_it_is_darker() {
    let product = |lux| {
        let world = wall_world(2.0, 0.8, Light::led(lux));
        let mut kinect =
            Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1).expect("a graphics adapter");
        kinect.capture(&Sweep::still(looking_north()), 0).expect("a frame");
        let [colour, _] = kinect.exposures();
        colour.time * colour.gain
    };
    let ratio = product(40.0) / product(500.0);
    assert!((ratio / 12.5 - 1.0).abs() < 0.1, "{ratio}");
}
