//! What is seen where nothing is.

use glam::{DVec3, Vec3};
use sunblind_sim::light::{Beam, LightState, Sky, daylight, towards};
use sunblind_sim::world::World;

use crate::outdoors::{Camera, MIDDLE};
use sunblind_sim::validation::scene::{self, Light, even, object, panel};

/// Numbers of the infrared camera for a radiance, W m⁻² sr⁻¹ nm⁻¹: from a plate lit by hand.
fn numbers_per_radiance() -> f64 {
    let light = Light { lux: 0.0, near_infrared: 0.1 };
    let plate = panel(Vec3::new(-3.0, 3.0, -2.0), [6.0 * Vec3::X, 4.0 * Vec3::Z], 1, light);
    let world = scene::world("plate", vec![object("plate", plate, 0)], vec![even("paint", [128; 3], 0.4)]);
    let seen = Camera::new(&world).look(&LightState::default(), DVec3::ZERO, DVec3::Y);
    seen.infrared_at(MIDDLE) / (0.1 * 102.0 / 255.0 / std::f64::consts::PI)
}

fn nothing() -> World {
    // A speck, far below: an empty world is none.
    let speck = panel(Vec3::new(0.0, 0.0, -50.0), [0.1 * Vec3::X, 0.1 * Vec3::Y], 1, Light::NONE);
    World {
        open_sky: true,
        ..scene::world("nothing", vec![object("speck", speck, 0)], vec![even("paint", [128; 3], 0.4)])
    }
}

#[test]
fn the_sky_that_is_seen_adds_up_to_what_it_gives_the_ground() {
    let scale = numbers_per_radiance();
    let mut camera = Camera::new(&nothing());
    let beam = daylight(0.6, 3.0, 0.0).beam;
    let unlit = Beam { normal: [0.0; 4], ..beam };
    for (name, sky) in
        [("overcast", Sky::overcast([9000.0, 9000.0, 9000.0, 0.06])), ("clear", daylight(0.6, 3.0, 0.0).sky)]
    {
        let light = LightState { sky, beam: unlit, ..LightState::default() };
        let (rows, columns) = (4, 8);
        let mut sum = 0.0;
        for row in 0..rows {
            // Rings of equal weight for the ground: sin² of the elevation in equal steps.
            let elevation = ((f64::from(row) + 0.5) / f64::from(rows)).sqrt().asin();
            for column in 0..columns {
                let azimuth = (f64::from(column) + 0.5) / f64::from(columns) * std::f64::consts::TAU;
                let way = towards(elevation, azimuth).as_dvec3();
                sum += camera.look(&light, DVec3::ZERO, way).infrared_at(MIDDLE) / scale;
            }
        }
        let found = std::f64::consts::PI * sum / f64::from(rows * columns);
        let expected = f64::from(sky.horizontal()[3]);
        assert!((found / expected - 1.0).abs() < 0.1, "{name}: {found} seen, {expected} given");
    }
}

#[test]
fn the_sun_saturates_and_the_sky_about_it_does_not() {
    let light = daylight(0.5, std::f64::consts::PI, 0.0);
    let mut camera = Camera::new(&nothing());
    let sun = light.beam.towards.as_dvec3();
    let aside = (sun + 0.15 * DVec3::X).normalize();
    let seen = camera.look(&light, DVec3::ZERO, aside);
    let brightest = seen.infrared.iter().fold(0.0_f64, |most, &value| most.max(value));
    let disc = seen.infrared.iter().filter(|&&value| value > 0.99 * brightest).count();
    // Radius 0.267° at 580 pixels a radian.
    let expected = std::f64::consts::PI * (580.0 * 0.267_f64.to_radians()).powi(2);
    assert!((0.6 * expected..2.5 * expected).contains(&(disc as f64)), "{disc} pixels, {expected} by geometry");
    assert!(seen.infrared_at(MIDDLE) < 0.9 * brightest);
    let away = camera.look(&light, DVec3::ZERO, DVec3::new(0.0, 1.0, 0.6));
    assert!(seen.infrared_at(MIDDLE) > 1.5 * away.infrared_at(MIDDLE), "brighter near the sun");
}

#[test]
fn a_world_without_a_sky_does_not_change_with_it() {
    let closed = World { open_sky: false, ..nothing() };
    let mut camera = Camera::new(&closed);
    let seen = camera.look(&daylight(0.5, 3.0, 0.0), DVec3::ZERO, DVec3::Y);
    assert!(seen.infrared_at(MIDDLE) == 0.0);
}
