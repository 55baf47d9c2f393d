//! The yard: whole, its ground as it is driven on, and its loop free.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use glam::{DVec3, Vec2, Vec3, vec2};

use super::*;
use crate::world::Object;
use crate::world::rays::Rays;

static WORLD: LazyLock<World> = LazyLock::new(|| yard(1));

/// The height above the ground that a robot takes up, metres: floor clearance to the camera's top.
const ROBOT: [f32; 2] = [0.03, 0.75];
/// Height of the lens above the ground, metres.
const LENS: f64 = 0.6;

fn count(world: &World) -> [usize; 2] {
    let sum = |of: &dyn Fn(&Object) -> usize| world.objects.iter().map(of).sum();
    [sum(&|object| object.mesh.positions.len()), sum(&|object| object.mesh.triangles.len())]
}

#[test]
fn every_object_is_whole() {
    for Object { name, mesh, material, .. } in &WORLD.objects {
        assert!(*material < WORLD.materials.len(), "{name}: no material");
        assert!(!mesh.triangles.is_empty(), "{name}: empty");
        assert_eq!((mesh.normals.len(), mesh.uvs.len()), (mesh.positions.len(), mesh.positions.len()), "{name}");
        let values = mesh.uvs.as_flattened().iter().chain(mesh.positions.as_flattened());
        assert!(values.into_iter().all(|value| value.is_finite()), "{name}");
        for &triangle in &mesh.triangles {
            let [a, b, c] = mesh.corners(triangle);
            let facing = (b - a).cross(c - a);
            assert!(facing.length() > 1e-9, "{name}: a triangle without area");
            for index in triangle {
                let normal = Vec3::from(mesh.normals[index as usize]);
                assert!((normal.length() - 1.0).abs() < 1e-4 && normal.dot(facing) > 0.0, "{name}: a normal is off");
            }
        }
    }
}

#[test]
fn it_is_light_enough_to_render() {
    let mut by_thing: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for object in &WORLD.objects {
        let surface = object.name.rsplit(", ").next().unwrap();
        let sums = by_thing.entry(surface).or_default();
        sums[0] += object.mesh.positions.len();
        sums[1] += object.mesh.triangles.len();
    }
    println!("{by_thing:#?}");
    let [vertices, triangles] = count(&WORLD);
    assert!(vertices < 60_000, "{vertices} vertices, {triangles} triangles");
    for Object { name, mesh, .. } in &WORLD.objects {
        let [min, max] = mesh.bounds();
        let size = (max - min).truncate().max_element();
        assert!(size <= 16.0 && mesh.triangles.len() < 3000, "{name} is too large to cull: {size} m");
    }
    // What a view may show, by boxes as the renderer does it: 58° wide, as far as one sees.
    let points = loop_waypoints();
    let worst = points.windows(2).step_by(5).map(|pair| {
        let [from, to] = [pair[0], pair[1]].map(|[x, y]| vec2(x as f32, y as f32));
        let ahead = (to - from).normalize();
        let sides = [0.507f32, -0.507].map(|half| Vec2::from_angle(half).rotate(ahead).perp() * half.signum());
        let reaches = |mesh: &crate::world::Mesh| {
            let [min, max] = mesh.bounds().map(|corner| corner.truncate() - from);
            sides.iter().all(|side| {
                let inner = -*side;
                inner.max(Vec2::ZERO).dot(max) + inner.min(Vec2::ZERO).dot(min) >= 0.0
            })
        };
        let seen = WORLD.objects.iter().filter(|object| reaches(&object.mesh));
        (seen.map(|object| object.mesh.triangles.len()).sum::<usize>(), from)
    });
    let (most, at) = worst.max_by_key(|(triangles, _)| *triangles).unwrap();
    println!("{vertices} vertices, {triangles} triangles; at most {most} in a view, at {at}");
    assert!(most < 30_000);
}

#[test]
fn the_names_are_unique() {
    let mut names: Vec<&str> = WORLD.objects.iter().map(|object| object.name.as_str()).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn the_ground_that_is_seen_is_the_ground_that_is_driven_on() {
    let ground = WORLD.objects.iter().filter(|object| {
        ["Asphalt", "Gravel", "Pavers", "Lawn", "Earth"].iter().any(|end| object.name.ends_with(end))
            && !object.collides
    });
    let rays = Rays::new(ground).unwrap();
    let mut furthest = 0.0f64;
    for index in 0..40_000 {
        // A lattice that meets no other.
        let [x, y] = [25.0 * (0.754_877 * f64::from(index)).fract(), 20.0 * (0.569_84 * f64::from(index)).fract()];
        let hit = rays.first(DVec3::new(x, y, 5.0), -DVec3::Z, 10.0);
        let Some(hit) = hit else { panic!("a hole in the ground at {x}, {y}") };
        furthest = furthest.max((5.0 - hit.distance - WORLD.ground.height(x, y)).abs());
    }
    println!("seen and driven ground differ by up to {:.1} mm", 1e3 * furthest);
    assert!(furthest < 0.01, "{furthest} m");
}

#[test]
fn the_ground_is_as_uneven_as_it_says() {
    let slope = |[x, y]: [f64; 2]| {
        let rise = |dx: f64, dy: f64| (land::height(x + dx, y + dy) - land::height(x - dx, y - dy)) / 0.02;
        rise(0.01, 0.0).hypot(rise(0.0, 0.01)).atan().to_degrees()
    };
    let steepest = loop_waypoints().into_iter().map(slope).fold(0.0, f64::max);
    println!("steepest on the loop: {steepest:.1}°");
    assert!((6.0..11.0).contains(&steepest));
    for [x, y] in (0..250).flat_map(|i| (0..200).map(move |j| [f64::from(i) * 0.1, f64::from(j) * 0.1])) {
        let height = land::height(x, y);
        assert!((0.0..0.7).contains(&height), "{height} m at {x}, {y}");
        if x < 5.5 || (y > 16.6 && y < 20.0) {
            assert!(slope([x, y]) < 2.5, "{}° at {x}, {y}", slope([x, y]));
        }
    }
}

#[test]
fn the_loop_is_closed_and_of_good_length() {
    let points = loop_waypoints();
    let steps: Vec<f64> =
        points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).collect();
    println!("{:.1} m", steps.iter().sum::<f64>());
    assert!((40.0..=50.0).contains(&steps.iter().sum::<f64>()));
    assert!(steps.iter().all(|&step| step > 0.01 && step < 0.12));
    assert_eq!(points.first(), points.last());
}

/// Calls `with` for each thing that stands within reach of a robot at a place: its name and how far off it is in plan.
pub(in crate::world) fn clearance(world: &World, at: Vec2, reach: f32, mut with: impl FnMut(&str, f32)) {
    let ground = world.ground.height(at.x.into(), at.y.into()) as f32;
    for Object { name, mesh, .. } in world.objects.iter().filter(|object| object.collides) {
        let [min, max] = mesh.bounds();
        let near = at.clamp(min.truncate(), max.truncate());
        if max.z < ground + ROBOT[0] || min.z > ground + ROBOT[1] || near.distance(at) >= reach {
            continue;
        }
        for &triangle in &mesh.triangles {
            let corners = mesh.corners(triangle);
            let low = corners.iter().all(|corner| corner.z < ground + ROBOT[0]);
            let high = corners.iter().all(|corner| corner.z > ground + ROBOT[1]);
            if !low && !high {
                with(name, distance_in_plan(at, corners.map(Vec3::truncate)));
            }
        }
    }
}

#[test]
fn the_loop_keeps_half_a_metre_off_everything_that_collides() {
    for [x, y] in loop_waypoints() {
        let at = vec2(x as f32, y as f32);
        clearance(&WORLD, at, 0.5, |name, off| assert!(off >= 0.5, "{off} m from {name} at {at}"));
    }
}

#[test]
fn most_of_the_way_structure_is_near() {
    let rays = Rays::new(WORLD.objects.iter().filter(|object| object.name.contains(", "))).unwrap();
    let points = loop_waypoints();
    let (mut beside, mut seen, mut all) = (0, 0, 0);
    for pair in points.windows(2).step_by(3) {
        let [from, to] = [pair[0], pair[1]].map(glam::DVec2::from);
        let mut nearest = f32::INFINITY;
        clearance(&WORLD, from.as_vec2(), 2.4, |_, off| nearest = nearest.min(off));
        let ground = WORLD.ground.height(from.x, from.y);
        let (ahead, eye) = ((to - from).normalize(), from.extend(ground + LENS));
        let left = ahead.perp();
        let mut near = 0;
        for row in -5..=5 {
            for column in -7..=7 {
                // 15 × 11 rays over the Kinect's 58° × 45°.
                let (u, v) = (0.55 * f64::from(column) / 7.0, 0.41 * f64::from(row) / 5.0);
                let way = (ahead + u * left).extend(v);
                let Some(hit) = rays.first(eye, way, 2.4) else { continue };
                let at = eye + hit.distance * way;
                near += i32::from(at.z > WORLD.ground.height(at.x, at.y) + 0.06);
            }
        }
        all += 1;
        beside += i32::from(nearest < 2.4);
        // Of 165: at least a twentieth.
        seen += i32::from(near >= 8);
    }
    println!(
        "structure within 2.4 m on {:.0} % of the way, and in view on {:.0} %",
        percent(beside, all),
        percent(seen, all)
    );
    assert!(percent(beside, all) > 90.0 && percent(seen, all) > 50.0);
}

fn percent(part: i32, whole: i32) -> f64 {
    100.0 * f64::from(part) / f64::from(whole)
}

/// From a point to a triangle seen from above.
fn distance_in_plan(point: Vec2, [a, b, c]: [Vec2; 3]) -> f32 {
    let side = |a: Vec2, b: Vec2| (b - a).perp_dot(point - a);
    let sides = [side(a, b), side(b, c), side(c, a)];
    let inside = sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0);
    let to_edge = |a: Vec2, b: Vec2| {
        let along = (b - a) * ((point - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
        point.distance(a + along)
    };
    if inside { 0.0 } else { to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a)) }
}
