//! The campus: whole, light enough, and its loop free and closed.

use std::sync::LazyLock;

use glam::{DVec3, vec2};

use super::*;
use crate::light::{daylight, illuminance};
use crate::world::bake::{Effort, bake_cached, cache_folder};
use crate::world::rays::Rays;
use crate::world::yard::clearance;

static WORLD: LazyLock<World> = LazyLock::new(|| campus(1));

#[test]
fn its_names_are_unique_its_materials_few_and_its_vertices_as_many_as_can_be_baked() {
    let mut names: Vec<&str> = WORLD.objects.iter().map(|object| object.name.as_str()).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
    let sum = |of: fn(&Mesh) -> usize| WORLD.objects.iter().map(|object| of(&object.mesh)).sum::<usize>();
    let (vertices, triangles) = (sum(|mesh| mesh.positions.len()), sum(|mesh| mesh.triangles.len()));
    println!("{vertices} vertices, {triangles} triangles, {} materials", WORLD.materials.len());
    assert!(vertices < 120_000, "{vertices}");
    assert!(WORLD.materials.len() < 100);
}

#[test]
fn the_loop_is_free_and_closed() {
    let points = loop_waypoints();
    assert_eq!(points.first(), points.last());
    for &[x, y] in &points {
        let at = vec2(x as f32, y as f32);
        clearance(&WORLD, at, 0.5, |name, off| assert!(off >= 0.5, "{off} m from {name} at {at}"));
    }
}

#[test]
fn most_of_the_way_structure_is_near() {
    let points = loop_waypoints();
    let near = points.iter().filter(|[x, y]| {
        let mut near = false;
        clearance(&WORLD, vec2(*x as f32, *y as f32), 2.4, |_, off| near |= off < 2.4);
        near
    });
    let share = near.count() as f64 / points.len() as f64;
    let length: f64 = points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum();
    println!("{length:.1} m, structure within 2.4 m on {:.0} % of it", 100.0 * share);
    assert!(share > 0.9, "{share}");
}

/// Directions all over the sphere.
fn directions() -> impl Iterator<Item = DVec3> {
    (0..4000).map(|index| {
        let z = 1.0 - (2.0 * f64::from(index) + 1.0) / 4000.0;
        let (sin, cos) = (2.399_963 * f64::from(index)).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        DVec3::new(flat * cos, flat * sin, z)
    })
}

#[test]
fn indoors_and_in_the_tunnel_nothing_is_seen_of_the_sky() {
    let rays = Rays::new(&WORLD.objects).unwrap();
    // Laboratory, office, the corridor's east, both bends of the tunnel and its middle.
    for [x, y] in [[11.0, 26.0], [15.6, 24.5], [14.0, 21.5], [3.7, -4.8], [8.6, -4.8], [13.5, -4.8]] {
        let eye = DVec3::new(x, y, 1.0);
        for way in directions() {
            let Some(hit) = rays.first(eye, way, 100.0) else { panic!("from {x}, {y} one looks out along {way}") };
            let seen = &WORLD.objects[rays.source(&hit).object].name;
            let is_wall = ["brick house", "garages", "wall"].iter().any(|name| seen.contains(name));
            assert!(hit.front || !is_wall, "from {x}, {y} along {way}: the back of {seen}");
        }
    }
}

#[test]
fn in_the_middle_of_the_tunnel_it_is_dark_at_noon_unless_its_lamps_are_on() {
    let mut world = WORLD.clone();
    // As a run computes it, and from the same cache.
    let _ = bake_cached(&mut world, &Effort::default(), &cache_folder(), &|_| {});
    let mean_lux = |tunnel_lamps: f32| {
        let mut light = daylight(60_f64.to_radians(), std::f64::consts::PI, 0.0);
        light.lamps.insert("tunnel".to_owned(), tunnel_lamps);
        let irradiance = world.transfer.irradiance(&world.transfer.weights(&light));
        let vertices = world.objects.iter().flat_map(|object| object.mesh.positions.iter().map(move |at| (object, at)));
        let lux: Vec<f32> = vertices
            .zip(&irradiance)
            .filter(|((object, [x, ..]), _)| object.name.starts_with("tunnel, ") && (7.0..10.0).contains(x))
            .map(|(_, light)| illuminance(light))
            .collect();
        lux.iter().sum::<f32>() / lux.len() as f32
    };
    let (dark, lit) = (mean_lux(0.0), mean_lux(1.0));
    println!("{dark} lx without lamps, {lit} lx with them");
    assert!(dark < 0.5 && lit > 30.0, "{dark} lx without lamps, {lit} lx with them");
}

#[test]
fn a_robot_walks_out_of_the_door_into_daylight() {
    let rays = Rays::new(&WORLD.objects).unwrap();
    // Share of the sky that a level surface sees.
    let sky = |x: f64, y: f64| {
        let up = || directions().filter(|way| way.z > 0.0);
        let open = up().filter(|way| rays.first(DVec3::new(x, y, 0.3), *way, 100.0).is_none());
        open.map(|way| way.z).sum::<f64>() / up().map(|way| way.z).sum::<f64>()
    };
    let (inside, outside) = (sky(8.6, 21.5), sky(8.6, 19.4));
    println!(
        "of the sky {:.1} % is seen from the corridor, {:.0} % half a metre outside",
        100.0 * inside,
        100.0 * outside
    );
    assert!(inside < 0.06 && outside > 0.3, "{inside}, {outside}");
}

#[test]
fn the_floor_is_flat_indoors_and_in_the_tunnel() {
    for [x, y] in loop_waypoints() {
        if !(1.5..20.0).contains(&y) {
            assert_eq!(WORLD.ground.height(x, y), 0.0, "{x}, {y}");
        }
    }
}
