//! Depth in darkness, lamplight and sun, on bright and dark surfaces.

use crate::bench::{Bench, Report, Wall, gallery};
use crate::scene::{Light, even, object, panel, world};
use glam::Vec3;

#[test]
fn lamps_without_infrared_and_darkness_leave_depth_as_it_is() {
    let light = |lux: f32| Light { lux, near_infrared: 0.0 };
    let lights = [light(500.0), light(1000.0), light(0.0), Light::sun(0.2)];
    let mut bench = Bench::new(&gallery(&lights.map(|light| Wall { light, angle: 5.0, ..Wall::at(2.0) })));
    let [office, bright, dark, dusk] = [0, 1, 2, 3].map(|number| bench.look_at(number).about(2.0));
    let mut report = Report::default();
    for (what, other) in [("1000 lx LED", &bright), ("darkness", &dark), ("200 lx of daylight", &dusk)] {
        report.expect(
            &format!("V5, V6 valid at 2 m in {what}"),
            office.valid,
            office.valid - 0.02..=office.valid + 0.02,
            other.valid,
        );
        let noise = office.noise();
        report.expect(&format!("V5, V6 noise at 2 m in {what}, mm"), noise, 0.9 * noise..=1.1 * noise, other.noise());
    }
    report.finish();
}

#[test]
fn a_darker_surface_never_has_more_depth() {
    let albedos = [0.8, 0.4, 0.2, 0.1, 0.05, 0.02];
    // The same patch of the image each time: tiles differ in brightness. No sun: the exposure must not decide.
    let mut bench = Bench::new(&gallery(&albedos.map(|albedo| Wall { albedo, ..Wall::at(4.0) })));
    let valid = [0, 1, 2, 3, 4, 5].map(|number| bench.look_at(number).about(4.0).valid);
    println!("valid share at 4 m by albedo: {:.3?}", std::iter::zip(albedos, valid).collect::<Vec<_>>());
    assert!(valid.windows(2).all(|pair| pair[1] <= pair[0] + 0.01), "{valid:.3?}");
    assert!(valid[0] > 0.95, "white paint at 4 m is within a Kinect's range: {}", valid[0]);
}

#[test]
fn the_sun_takes_depth_away_as_published() {
    let overcast = |kilolux: f32| Light { lux: 1000.0 * kilolux, near_infrared: 0.007 * kilolux };
    let wall = |distance, light| Wall { light, albedo: 0.4, ..Wall::at(distance) };
    let walls = [
        wall(2.0, overcast(5.0)),
        wall(3.0, overcast(5.0)),
        wall(1.5, Light::sun(100.0)),
        wall(3.0, Light::sun(100.0)),
        wall(2.5, Light::sun(50.0)),
        // A sun 5° high: 18 klx with 0.42 W m⁻² nm⁻¹, facing the wall.
        wall(3.0, Light { lux: 18e3, near_infrared: 0.42 }),
    ];
    let mut bench = Bench::new(&gallery(&walls));
    let seen: Vec<_> = (0..walls.len()).map(|number| bench.look_at(number)).collect();
    let valid = |number: usize| seen[number].about(f64::from(walls[number].distance)).valid;
    let mut report = Report::default();
    report.expect("V10 valid at 2 m, 5 klx overcast", 1.0, 0.8..=1.0, valid(0));
    report.expect("V10 valid at 3 m, 5 klx overcast", 0.8, 0.5..=1.0, valid(1));
    report.expect("V11 valid at 1.5 m, 100 klx sun", 0.0, 0.0..=0.2, valid(2));
    report.expect("V11 valid at 3 m, 100 klx sun", 0.0, 0.0..=0.01, valid(3));
    report.expect("V11 saturated at 3 m, 100 klx sun", 0.0, 0.0..=0.02, seen[3].saturated());
    report.expect("V11 valid at 2.5 m, 50 klx sun", 0.0, 0.0..=0.2, valid(4));
    report.expect("V13 valid at 3 m, sun 5° high", 0.0, 0.0..=0.2, valid(5));
    report.finish();
}

#[test]
fn depth_drops_out_within_a_factor_of_ambient_light() {
    // From 0.25 klx in factors of 2 at 3 m.
    let lights: Vec<Light> = (0..10).map(|step| Light::sun(0.25 * 2_f32.powi(step))).collect();
    let walls: Vec<Wall> = lights.iter().map(|&light| Wall { light, albedo: 0.4, ..Wall::at(3.0) }).collect();
    let mut bench = Bench::new(&gallery(&walls));
    let valid: Vec<f64> = (0..walls.len()).map(|number| bench.look_at(number).about(3.0).valid).collect();
    println!("valid share at 3 m from 0.25 klx in factors of 2: {valid:.3?}");
    assert!(valid.windows(2).all(|pair| pair[1] <= pair[0] + 0.02), "more sun never gives more depth: {valid:.3?}");
    // Logarithm of the light at which a share is crossed.
    let crossed = |share: f64| {
        let at = valid.windows(2).position(|pair| pair[0] >= share && pair[1] < share).expect("drops out");
        at as f64 + (valid[at] - share) / (valid[at] - valid[at + 1])
    };
    let mut report = Report::default();
    report.expect(
        "V12 factor of ambient from 90 % to 20 % valid",
        3.6,
        2.0..=13.0,
        (crossed(0.2) - crossed(0.9)).exp2(),
    );
    report.finish();
}

#[test]
fn a_bright_window_does_not_blind_the_room() {
    // A wall at 3 m in the dark of an office, a tenth of the view a window's overcast sky.
    let sky = Light { lux: 5000.0 * 3.1, near_infrared: 0.007 * 5.0 * 3.1 };
    let wall = panel(Vec3::new(-5.0, 3.0, -4.0), [10.0 * Vec3::X, 8.0 * Vec3::Z], 4, Light::LED);
    let window = panel(Vec3::new(0.5, 2.99, 0.0), [1.0 * Vec3::X, 1.0 * Vec3::Z], 4, sky);
    let objects = vec![object("wall", wall, 0), object("window", window, 1)];
    let materials = vec![even("paint", [220, 220, 220], 0.7), even("sky", [250, 250, 250], 0.98)];
    let seen = Bench::new(&world("window", objects, materials)).look();
    let left = (100..380).flat_map(|y| (40..280).map(move |x| (x, y)));
    let valid = left.clone().filter(|&(x, y)| seen.depth(x, y).is_some()).count() as f64 / left.count() as f64;
    let mut report = Report::default();
    report.expect("valid beside a window, wall at 3 m", 1.0, 0.9..=1.0, valid);
    println!("saturated {:.3}, valid {:.3}", seen.saturated(), seen.valid());
    report.finish();
}
