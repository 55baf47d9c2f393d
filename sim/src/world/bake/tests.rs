//! Light that is passed on, in boxes and corners with closed forms.

use std::fs;

use glam::{Vec3, vec3};

use super::*;
use crate::light::{Beam, LightState, Sky, illuminance};
use crate::world::material::mean_albedo;
use crate::world::refine::refine;
use crate::world::shape::Mapping;
use crate::world::{Gloss, Material, Mesh, Object, TEXTURE_SIZE, WINDOWS};

const QUICK: Effort = Effort { rays: 128, bounces: 4, lamp_step: 0.3 };
const METRIC: Mapping = Mapping::Fitted;

fn grey(level: u8) -> Material {
    Material {
        name: "grey".into(),
        albedo: vec![[level, level, level, 128]; TEXTURE_SIZE * TEXTURE_SIZE],
        gloss: Gloss::MATT,
    }
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
        group: "ceiling".into(),
    };
    World { lamps: vec![lamp], ..world(vec![object("walls", mesh)], level) }
}

fn world(objects: Vec<Object>, level: u8) -> World {
    World { name: "test".into(), objects, materials: vec![grey(level)], ..World::default() }
}

/// The irradiance on every vertex, object after object.
fn lit(world: &World, light: &LightState) -> Vec<Vec<Bands>> {
    let mut all = world.transfer.irradiance(&world.transfer.weights(light)).into_iter();
    world.objects.iter().map(|object| all.by_ref().take(object.mesh.positions.len()).collect()).collect()
}

/// The same, with all lamps and windows.
fn baked(world: &mut World, effort: &Effort) -> Vec<Vec<Bands>> {
    bake(world, effort, &|_| ());
    lit(world, &LightState::default())
}

/// ∫ irradiance dA by channel.
fn flux(Object { mesh, .. }: &Object, irradiance: &[Bands]) -> Bands {
    mesh.triangles.iter().fold([0.0; 4], |sum, &triangle| {
        let [a, b, c] = mesh.corners(triangle);
        let area = 0.5 * (b - a).cross(c - a).length();
        let share = |band: usize| triangle.iter().map(|&i| irradiance[i as usize][band]).sum::<f32>() / 3.0;
        std::array::from_fn(|band| sum[band] + area * share(band))
    })
}

#[test]
fn a_closed_box_receives_what_its_lamp_sheds_and_again_what_its_walls_return() {
    let mut world = room(188);
    let light = baked(&mut world, &QUICK);
    let albedo = mean_albedo(&world.materials[0]);
    let received = flux(&world.objects[0], &light[0]);
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
    let light = baked(&mut world, &QUICK);
    // Of some 50 lx outside. A floor triangle that reaches under the partition takes the mean of its corners with it.
    assert!(light[3].iter().all(|light| light[0] < 0.1));
    // The room's own surfaces inside the cell, away from the partitions' feet.
    let walls = &world.objects[0].mesh;
    for (at, light) in walls.positions.iter().zip(&light[0]) {
        if at[0] < 1.6 && at[1] < 1.6 {
            assert!(light[0] < 0.1, "a leak at {at:?}: {light:?}");
        }
    }
}

#[test]
fn the_back_of_a_lamp_is_dark() {
    let mut world = room(128);
    world.lamps[0].centre = [2.0, 2.0, 1.5];
    let light = baked(&mut world, &Effort { bounces: 0, ..QUICK });
    let walls = &world.objects[0].mesh;
    for (at, light) in walls.positions.iter().zip(&light[0]) {
        assert!(if at[2] > 1.5 { light[0] == 0.0 } else { light[0] >= 0.0 }, "{at:?}: {light:?}");
    }
}

#[test]
fn a_thing_on_the_floor_darkens_the_floor_beside_it() {
    let mut world = room(200);
    world.objects.push(object("chest", Mesh::cuboid(vec3(1.0, 1.0, 0.0), vec3(2.0, 1.5, 1.5), METRIC)));
    let light = baked(&mut world, &QUICK);
    let walls = &world.objects[0].mesh;
    let nearest = |x: f32, y: f32| {
        let far = |at: &[f32; 3]| vec3(x, y, 0.0).distance((*at).into());
        let index = (0..walls.positions.len())
            .filter(|&index| walls.normals[index][2] > 0.9)
            .min_by(|&a, &b| far(&walls.positions[a]).total_cmp(&far(&walls.positions[b])));
        light[0][index.expect("a floor")][0]
    };
    assert!(nearest(1.5, 0.9) < 0.75 * nearest(2.5, 2.0));
}

#[test]
fn a_lamps_cover_sheds_its_exitance() {
    let mut world = room(255);
    let cover = Mesh::quad(vec3(1.5, 1.5, 2.905), Vec3::X, Vec3::Y, METRIC);
    world.objects.push(object("cover", cover));
    let light = baked(&mut world, &QUICK);
    assert!(light[1].iter().all(|light| light[0] >= 1000.0));
}

/// The room with a window's panel beside its lamp.
fn room_with_window() -> World {
    let mut world = room(200);
    let daylight = Lamp { centre: [1.0, 1.0, 2.5], group: WINDOWS.into(), ..world.lamps[0].clone() };
    world.lamps.push(daylight);
    world
}

#[test]
fn each_group_is_dimmed_for_itself_and_all_add_up() {
    let mut world = room_with_window();
    bake(&mut world, &QUICK, &|_| ());
    let with = |electric: f32, daylight: f32| {
        let lamps = [("ceiling".to_owned(), electric)].into();
        lit(&world, &LightState { lamps, windows: [daylight; 4], ..LightState::default() }).remove(0)
    };
    let (lamp, window, both) = (with(1.0, 0.0), with(0.0, 1.0), with(0.5, 2.0));
    assert!(lamp != window && with(0.0, 0.0).as_flattened().iter().all(|&light| light == 0.0));
    for vertex in 0..both.len() {
        for band in 0..4 {
            let sum = 0.5 * lamp[vertex][band] + 2.0 * window[vertex][band];
            assert!((both[vertex][band] - sum).abs() <= 1e-5 * sum.abs(), "vertex {vertex}");
        }
    }
    // By its name, too: the group of windows is one like others.
    let shut = LightState { lamps: [(WINDOWS.to_owned(), 0.0)].into(), ..LightState::default() };
    assert_eq!(lit(&world, &shut)[0], lamp);
}

/// Level ground under the open sky, with or without things on it.
fn outdoors(level: u8, things: Vec<Object>) -> World {
    let ground = Mesh::quad(vec3(-20.0, 20.0, 0.0), 40.0 * Vec3::X, -40.0 * Vec3::Y, METRIC);
    let objects = std::iter::once(object("ground", ground)).chain(things).collect();
    World { open_sky: true, ..world(objects, level) }
}

/// A wall from south to north that faces east, at x = 0.
fn wall(height: f32) -> Object {
    object("wall", Mesh::cuboid(vec3(-0.2, -20.0, 0.0), vec3(0.0, 20.0, height), METRIC))
}

/// Of the vertex nearest to a point.
fn at(world: &World, light: &[Vec<Bands>], object: usize, point: Vec3) -> Bands {
    let positions = &world.objects[object].mesh.positions;
    let far = |index: &usize| point.distance(positions[*index].into());
    let index = (0..positions.len()).min_by(|a, b| far(a).total_cmp(&far(b))).expect("a vertex");
    light[object][index]
}

#[test]
fn open_ground_gets_all_of_the_sky_and_a_wall_what_its_half_has() {
    // Black surfaces: nothing but the sky.
    let mut world = outdoors(0, vec![wall(2.0)]);
    bake(&mut world, &QUICK, &|_| ());
    for (sky, share) in
        [(Sky::uniform([1000.0; 4]), 0.5), (Sky::overcast([1000.0; 4]), 0.396), (Sky::clear([1000.0; 4]), 0.682)]
    {
        let light = lit(&world, &LightState::under(sky, Beam::NONE));
        let ground = at(&world, &light, 0, vec3(-15.0, 0.0, 0.0))[0];
        assert!((ground / 1000.0 - 1.0).abs() < 0.03, "{ground} lx on the ground");
        let wall = at(&world, &light, 1, vec3(0.0, 0.0, 1.0))[0];
        assert!((wall / 1000.0 - share).abs() < 0.03, "{wall} lx on the wall, {share}");
    }
}

#[test]
fn the_suns_light_comes_back_from_the_ground_to_a_wall_and_is_shared_in_a_corner() {
    let mut world = outdoors(188, vec![wall(4.0)]);
    bake(&mut world, &QUICK, &|_| ());
    let albedo = mean_albedo(&world.materials[0])[1];
    let sunlit = |towards: Vec3| {
        let beam = Beam { towards: towards.normalize(), normal: [1000.0; 4] };
        lit(&world, &LightState { beam, ..LightState::default() })
    };
    // From the zenith the wall gets none itself. What it sees of the ground, half of its hemisphere, gets all, and a
    // little of the wall's light back.
    let light = sunlit(Vec3::Z);
    let on_wall = at(&world, &light, 1, vec3(0.0, 0.0, 1.0))[1];
    let once = 0.5 * albedo * 1000.0;
    assert!((0.9 * once..1.2 * once).contains(&on_wall), "{on_wall} lx, {once} at the first bounce");
    // Open ground gets nothing indirect from level ground.
    assert!(at(&world, &light, 0, vec3(-15.0, 10.0, 0.0))[1] < 0.05 * on_wall);
    // A corner's two sides, both lit at 45°, exchange light: at the edge each sees the other with half its hemisphere.
    let light = sunlit(vec3(1.0, 0.0, 1.0));
    let direct = 1000.0 * std::f32::consts::FRAC_1_SQRT_2;
    let corner = at(&world, &light, 1, vec3(0.0, 0.0, 0.0))[1];
    let series = direct * (0.5 * albedo) / (1.0 - 0.5 * albedo);
    assert!((corner / series - 1.0).abs() < 0.25, "{corner} lx, {series} between endless halves");
    // The wall's back is turned to the sun: its ground lies in shadow near it.
    let behind = at(&world, &light, 0, vec3(-1.5, 0.0, 0.0))[1];
    assert!(behind < 0.1 * corner, "{behind} lx");
}

#[test]
fn what_is_overhead_takes_the_sky_away() {
    let roof = object("roof", Mesh::cuboid(vec3(-3.0, -3.0, 2.5), vec3(3.0, 3.0, 2.7), METRIC));
    let mut world = outdoors(0, vec![roof]);
    bake(&mut world, &QUICK, &|_| ());
    let light = lit(&world, &LightState::under(Sky::uniform([1000.0; 4]), Beam::NONE));
    // A square seen from below its middle: the sky's share past it.
    let x: f32 = 3.0 / 2.5;
    let slant = x / (1.0 + x * x).sqrt();
    let seen = 4.0 / std::f32::consts::TAU * 2.0 * slant * slant.atan();
    let below = at(&world, &light, 0, Vec3::ZERO)[0] / 1000.0;
    assert!((below - (1.0 - seen)).abs() < 0.04, "{below}, {}", 1.0 - seen);
    assert!(illuminance(&at(&world, &light, 1, vec3(0.0, 0.0, 2.7))) > 950.0, "on top of it");
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let transfer = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let mut world = outdoors(200, vec![wall(2.0)]);
        world.lamps = room(200).lamps;
        pool.install(|| bake(&mut world, &QUICK, &|_| ()));
        world.transfer
    };
    assert!(transfer(1) == transfer(2));
}

#[test]
fn the_cache_gives_the_same_light_and_survives_damage() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |effort: &Effort, open_sky: bool| {
        let mut world = World { open_sky, ..room(200) };
        let origin = bake_cached(&mut world, effort, folder.path(), &|_| ()).expect("writable");
        (origin, world.transfer)
    };
    let (first, light) = run(&QUICK, true);
    assert_eq!(first, Origin::Computed);
    assert!(light.sources.len() > 10);
    assert_eq!(run(&QUICK, true), (Origin::Cache, light.clone()));
    assert_eq!(run(&Effort { bounces: 1, ..QUICK }, true).0, Origin::Computed);
    assert_eq!(run(&QUICK, false).0, Origin::Computed);
    for entry in fs::read_dir(folder.path()).expect("readable") {
        let path = entry.expect("readable").path();
        let mut bytes = fs::read(&path).expect("readable");
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(&path, bytes).expect("writable");
    }
    assert_eq!(run(&QUICK, true), (Origin::Computed, light.clone()));
    assert_eq!(run(&QUICK, true), (Origin::Cache, light));
    for entry in fs::read_dir(folder.path()).expect("readable") {
        fs::write(entry.expect("readable").path(), b"short").expect("writable");
    }
    assert_eq!(run(&QUICK, true).0, Origin::Computed);
}

#[test]
fn what_cannot_be_seen_of_a_change_is_no_reason_to_sum_anew() {
    let mut world = outdoors(200, Vec::new());
    bake(&mut world, &Effort { rays: 8, ..QUICK }, &|_| ());
    let at = |elevation: f64| world.transfer.weights(&crate::light::daylight(elevation.to_radians(), 3.0, 0.2));
    assert!(at(30.0) != at(31.0));
    // The sun moves by 15° an hour: two seconds at 30 frames each.
    let frames: Vec<_> = (0..60).map(|frame| at(30.0 + 15.0 / 3600.0 / 30.0 * f64::from(frame))).collect();
    assert!(frames.windows(2).filter(|pair| pair[0] != pair[1]).count() < 12);
}
