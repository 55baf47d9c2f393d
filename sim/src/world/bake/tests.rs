use std::fs;

use glam::{Vec3, vec3};

use super::*;
use crate::world::material::mean_albedo;
use crate::world::refine::refine;
use crate::world::shape::Mapping;
use crate::world::{Brightness, LightSource, Material, Mesh, Object, TEXTURE_SIZE};

const QUICK: Effort = Effort { rays: 128, bounces: 4, lamp_step: 0.3 };
const METRIC: Mapping = Mapping::Fitted;

fn grey(level: u8) -> Material {
    Material { name: "grey".into(), albedo: vec![[level, level, level, 128]; TEXTURE_SIZE * TEXTURE_SIZE] }
}

fn object(name: &str, mut mesh: Mesh) -> Object {
    refine(&mut mesh, |_| 0.5);
    Object { name: name.into(), mesh, material: 0, collides: true }
}

/// A box seen from inside: a room of 4 × 4 × 3 m.
fn room(level: u8) -> World {
    let mut mesh = Mesh::cuboid(Vec3::ZERO, vec3(4.0, 4.0, 3.0), METRIC);
    mesh.normals.iter_mut().flatten().for_each(|value| *value = -*value);
    mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    let lamp = Lamp {
        name: "lamp".into(),
        centre: [2.0, 2.0, 2.9],
        half_edges: [[0.0, 0.5, 0.0], [0.5, 0.0, 0.0]],
        exitance: [1000.0, 500.0, 250.0, 2.0],
        source: LightSource::Electric,
    };
    World {
        name: "room".into(),
        objects: vec![object("walls", mesh)],
        materials: vec![grey(level)],
        lamps: vec![lamp],
        ..World::default()
    }
}

/// ∫ irradiance dA by channel.
fn flux(object: &Object) -> [f32; 4] {
    let mesh = &object.mesh;
    mesh.triangles.iter().fold([0.0; 4], |sum, &triangle| {
        let [a, b, c] = mesh.corners(triangle);
        let area = 0.5 * (b - a).cross(c - a).length();
        let share = |band: usize| triangle.iter().map(|&i| mesh.irradiance[i as usize][band]).sum::<f32>() / 3.0;
        std::array::from_fn(|band| sum[band] + area * share(band))
    })
}

#[test]
fn a_closed_box_receives_what_its_lamp_sheds_and_again_what_its_walls_return() {
    let mut world = room(188);
    bake(&mut world, &QUICK, Brightness::FULL, &|_| ());
    let albedo = mean_albedo(&world.materials[0]);
    let received = flux(&world.objects[0]);
    for band in 0..4 {
        // Lamp of 1 m²; a geometric series over the bounces.
        let series: f32 = (0..=QUICK.bounces).map(|bounce| albedo[band].powi(bounce as i32)).sum();
        let shed = world.lamps[0].exitance[band] * series;
        assert!((received[band] / shed - 1.0).abs() < 0.06, "band {band}: {} of {shed}", received[band]);
    }
}

#[test]
fn a_wall_keeps_the_light_out() {
    let mut world = room(230);
    world.lamps[0].centre = [3.0, 3.0, 2.9];
    // A closed cell in a corner of the room, with walls 10 cm thick and a table of its own.
    for (min, max) in [((0.0, 2.0, 0.0), (2.1, 2.1, 3.0)), ((2.0, 0.0, 0.0), (2.1, 2.0, 3.0))] {
        world.objects.push(object("partition", Mesh::cuboid(min.into(), max.into(), METRIC)));
    }
    world.objects.push(object("table", Mesh::cuboid(vec3(0.6, 0.6, 0.6), vec3(1.4, 1.4, 0.7), METRIC)));
    bake(&mut world, &QUICK, Brightness::FULL, &|_| ());
    let table = &world.objects[3].mesh;
    // Of some 50 lx outside. A floor triangle that reaches under the partition takes the mean of its corners with it.
    assert!(table.irradiance.iter().all(|light| light[0] < 0.1));
    // The room's own surfaces inside the cell, away from the partitions' feet.
    let walls = &world.objects[0].mesh;
    for (at, light) in walls.positions.iter().zip(&walls.irradiance) {
        if at[0] < 1.6 && at[1] < 1.6 {
            assert!(light[0] < 0.1, "a leak at {at:?}: {light:?}");
        }
    }
}

#[test]
fn the_back_of_a_lamp_is_dark() {
    let mut world = room(128);
    world.lamps[0].centre = [2.0, 2.0, 1.5];
    bake(&mut world, &Effort { bounces: 0, ..QUICK }, Brightness::FULL, &|_| ());
    let walls = &world.objects[0].mesh;
    for (at, light) in walls.positions.iter().zip(&walls.irradiance) {
        assert!(if at[2] > 1.5 { light[0] == 0.0 } else { light[0] >= 0.0 }, "{at:?}: {light:?}");
    }
}

#[test]
fn a_thing_on_the_floor_darkens_the_floor_beside_it() {
    let mut world = room(200);
    world.objects.push(object("chest", Mesh::cuboid(vec3(1.0, 1.0, 0.0), vec3(2.0, 1.5, 1.5), METRIC)));
    bake(&mut world, &QUICK, Brightness::FULL, &|_| ());
    let walls = &world.objects[0].mesh;
    let nearest = |x: f32, y: f32| {
        let far = |at: &[f32; 3]| vec3(x, y, 0.0).distance((*at).into());
        let index = (0..walls.positions.len())
            .filter(|&index| walls.normals[index][2] > 0.9)
            .min_by(|&a, &b| far(&walls.positions[a]).total_cmp(&far(&walls.positions[b])));
        walls.irradiance[index.expect("a floor")][0]
    };
    assert!(nearest(1.5, 0.9) < 0.75 * nearest(2.5, 2.0));
}

#[test]
fn a_lamps_cover_sheds_its_exitance() {
    let mut world = room(255);
    let cover = Mesh::quad(vec3(1.5, 1.5, 2.905), Vec3::X, Vec3::Y, METRIC);
    world.objects.push(object("cover", cover));
    bake(&mut world, &QUICK, Brightness::FULL, &|_| ());
    assert!(world.objects[1].mesh.irradiance.iter().all(|light| light[0] >= 1000.0));
}

/// The room with a window's panel beside its lamp.
fn room_with_window() -> World {
    let mut world = room(200);
    let daylight = Lamp { centre: [1.0, 1.0, 2.5], source: LightSource::Daylight, ..world.lamps[0].clone() };
    world.lamps.push(daylight);
    world
}

#[test]
fn each_source_is_dimmed_for_itself_and_both_add_up() {
    let lit = |electric: f32, daylight: f32| {
        let mut world = room_with_window();
        bake(&mut world, &QUICK, Brightness { electric, daylight }, &|_| ());
        world.objects.remove(0).mesh.irradiance
    };
    let (lamp, window, both) = (lit(1.0, 0.0), lit(0.0, 1.0), lit(0.5, 2.0));
    assert!(lamp != window && lit(0.0, 0.0).as_flattened().iter().all(|&light| light == 0.0));
    for vertex in 0..both.len() {
        for band in 0..4 {
            let sum = 0.5 * lamp[vertex][band] + 2.0 * window[vertex][band];
            assert!((both[vertex][band] - sum).abs() <= 1e-5 * sum.abs(), "vertex {vertex}");
        }
    }
}

#[test]
fn another_brightness_is_served_from_the_same_cache() {
    let folder = tempfile::tempdir().expect("a folder");
    let night = Brightness { daylight: 0.0, ..Brightness::FULL };
    let lit = |brightness| {
        let mut world = room_with_window();
        let origin = bake_cached(&mut world, &QUICK, brightness, folder.path(), &|_| ()).expect("writable");
        (origin, world.objects.remove(0).mesh.irradiance)
    };
    assert_eq!(lit(Brightness::FULL).0, Origin::Computed);
    let mut alone = room_with_window();
    bake(&mut alone, &QUICK, night, &|_| ());
    assert_eq!(lit(night), (Origin::Cache, alone.objects.remove(0).mesh.irradiance));
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let baked = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut world = room(200);
        pool.install(|| bake(&mut world, &QUICK, Brightness::FULL, &|_| ()));
        world.objects.remove(0).mesh.irradiance
    };
    let bits = |light: Vec<[f32; 4]>| -> Vec<u32> { light.into_iter().flatten().map(f32::to_bits).collect() };
    assert!(bits(baked(1)) == bits(baked(2)));
}

#[test]
fn the_cache_gives_the_same_light_and_survives_damage() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |effort: &Effort| {
        let mut world = room(200);
        let origin = bake_cached(&mut world, effort, Brightness::FULL, folder.path(), &|_| ()).expect("writable");
        (origin, world.objects.remove(0).mesh.irradiance)
    };
    let (first, light) = run(&QUICK);
    assert_eq!(first, Origin::Computed);
    assert_eq!(run(&QUICK), (Origin::Cache, light.clone()));
    assert_eq!(run(&Effort { bounces: 1, ..QUICK }).0, Origin::Computed);
    for entry in fs::read_dir(folder.path()).expect("readable") {
        let path = entry.expect("readable").path();
        let mut bytes = fs::read(&path).expect("readable");
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(&path, bytes).expect("writable");
    }
    assert_eq!(run(&QUICK), (Origin::Computed, light.clone()));
    assert_eq!(run(&QUICK), (Origin::Cache, light));
    for entry in fs::read_dir(folder.path()).expect("readable") {
        fs::write(entry.expect("readable").path(), b"short").expect("writable");
    }
    assert_eq!(run(&QUICK).0, Origin::Computed);
}
