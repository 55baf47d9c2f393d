//! What the sun lights, and what it does not.

use glam::{DVec3, Vec3};
use sunblind_sim::light::{Beam, LightState, towards};
use sunblind_sim::world::World;

use crate::outdoors::{Camera, MIDDLE};
use sunblind_sim::validation::scene::{self, Light, block, even, object, panel};

/// A plate in the world's y-z plane's south, facing the camera that looks north, half of it lit by hand.
fn plate_under_the_sun(by_hand: Light) -> World {
    let half = |x: f32, light| panel(Vec3::new(x, 3.0, -2.0), [2.5 * Vec3::X, 4.0 * Vec3::Z], 1, light);
    let objects = vec![object("sunlit", half(-2.5, Light::NONE), 0), object("by hand", half(0.0, by_hand), 1)];
    let materials = vec![even("paint", [128; 3], 0.3), even("paint", [128; 3], 0.3)];
    World { open_sky: true, ..scene::world("plate", objects, materials) }
}

#[test]
fn a_sunlit_plane_gets_what_faces_the_sun_times_the_cosine() {
    for (elevation, azimuth) in [(30.0_f64, 180.0_f64), (10.0, 230.0), (65.0, 120.0)] {
        let towards = towards(elevation.to_radians(), azimuth.to_radians());
        let beam = Beam { towards, normal: [50_000.0, 50_000.0, 50_000.0, 0.5] };
        let cosine = towards.dot(Vec3::NEG_Y);
        let by_hand = Light { lux: 50_000.0 * cosine, near_infrared: 0.5 * cosine };
        let mut camera = Camera::new(&plate_under_the_sun(by_hand));
        let left = [MIDDLE[0] - 120, MIDDLE[1]];
        let right = [MIDDLE[0] + 120, MIDDLE[1]];
        let sun = LightState { beam, ..LightState::default() };
        let lit = camera.look(&sun, DVec3::ZERO, DVec3::Y);
        let dark = camera.look(&LightState::default(), DVec3::ZERO, DVec3::Y);
        // By hand: as much without the sun as the sun adds to both.
        let (of_sun, of_hand) = (lit.infrared_at(left), dark.infrared_at(right));
        assert!((of_sun / of_hand - 1.0).abs() < 0.03, "{elevation}°: 830 nm {of_sun} {of_hand}");
        let (of_sun, of_hand) = (lit.green_at(left), dark.green_at(right));
        assert!((of_sun / of_hand - 1.0).abs() < 0.05, "{elevation}°: green {of_sun} {of_hand}");
    }
}

/// Ground with a wall across it, 1 m high and 0.2 m thick, its northern face at y = 0.
fn ground_with_a_wall() -> World {
    // Light in the shade, without which it would be exposed for the sun to saturate.
    let shade = Light { lux: 2000.0, near_infrared: 0.02 };
    let ground = panel(Vec3::new(-20.0, -20.0, 0.0), [40.0 * Vec3::X, 40.0 * Vec3::Y], 8, shade);
    let wall = block(Vec3::new(0.0, -0.1, 0.5), Vec3::new(30.0, 0.2, 1.0), shade);
    let objects = vec![object("ground", ground, 0), object("wall", wall, 0)];
    World { open_sky: true, ..scene::world("wall", objects, vec![even("paint", [150; 3], 0.3)]) }
}

#[test]
fn a_shadows_edge_lies_where_geometry_puts_it_and_sunlit_ground_has_no_spots() {
    let mut camera = Camera::new(&ground_with_a_wall());
    for elevation in [60.0_f64, 35.0, 20.0] {
        let beam = Beam {
            towards: towards(elevation.to_radians(), 180_f64.to_radians()),
            normal: [5_000.0, 5_000.0, 5_000.0, 0.05],
        };
        let light = LightState { beam, ..LightState::default() };
        // From above, north of the wall, right is east and down is south.
        let (height, y) = (5.0, 2.0);
        let seen = camera.look(&light, DVec3::new(0.0, y, height), DVec3::new(0.0, 1e-3, -1.0));
        // Down the image's middle column: the row where brightness passes the middle between shade and sun.
        let column: Vec<f64> = (10..470).map(|row| seen.infrared[640 * row + 320]).collect();
        let (low, high) =
            column.iter().fold((f64::MAX, 0.0_f64), |(low, high), &value| (low.min(value), high.max(value)));
        let half = 0.5 * (low + high);
        let edge = 10.0 + column.iter().position(|&value| value < half).expect("a shadow") as f64;
        let found = y - height * (edge - 239.5) / 580.0;
        let expected = 1.0 / elevation.to_radians().tan();
        assert!((found - expected).abs() < 0.03, "{elevation}°: shadow to {found} m, {expected} by geometry");
        // No acne: north of the shadow all is lit evenly, but for the lens's falling off.
        let lit = &column[..(edge as usize - 10).saturating_sub(8)];
        assert!(lit.windows(2).all(|pair| (pair[1] / pair[0] - 1.0).abs() < 0.02), "{elevation}°: spots");
        // No light between the wall's foot and its shadow: south of the edge all is dark until the wall's top comes.
        let foot = 10.0_f64.max(239.5 + (y - 0.05) / height * 580.0) as usize;
        let shade = &column[(edge as usize - 10 + 8)..foot.min(470) - 10];
        assert!(shade.iter().all(|&value| value < low + 0.25 * (high - low)), "{elevation}°: light leaks");
    }
}

#[test]
fn a_low_sun_leaves_no_stripes_on_ground_or_wall() {
    let mut camera = Camera::new(&ground_with_a_wall());
    for elevation in [3.0_f64, 6.0] {
        let beam = Beam {
            // From the north-west, on to the wall's northern face and the ground before it.
            towards: towards(elevation.to_radians(), -20_f64.to_radians()),
            normal: [10_000.0, 10_000.0, 10_000.0, 0.3],
        };
        let light = LightState { beam, ..LightState::default() };
        let seen = camera.look(&light, DVec3::new(0.0, 4.0, 0.6), DVec3::NEG_Y);
        for row in [240_usize, 255, 330, 400, 450] {
            let row: Vec<f64> = (60..580).map(|column| seen.infrared[640 * row + column]).collect();
            assert!(row.windows(2).all(|pair| (pair[1] / pair[0] - 1.0).abs() < 0.04), "{elevation}°: stripes");
        }
    }
}
