//! The laboratory: whole, light enough, and its loop free and full of structure.

use std::sync::LazyLock;

use glam::Vec3;

use super::*;
use crate::light::LightState;
use crate::world::Object;
use crate::world::bake::{Effort, bake};

static WORLD: LazyLock<World> = LazyLock::new(|| laboratory(1));

/// The height that a robot takes up, metres: floor clearance to the camera's top.
const ROBOT: [f32; 2] = [0.03, 0.75];

#[test]
fn every_object_is_whole() {
    for Object { name, mesh, material, .. } in &WORLD.objects {
        assert!(*material < WORLD.materials.len(), "{name}: no material");
        assert!(!mesh.triangles.is_empty(), "{name}: empty");
        assert_eq!((mesh.normals.len(), mesh.uvs.len()), (mesh.positions.len(), mesh.positions.len()), "{name}");
        assert!(
            mesh.uvs.iter().flatten().chain(mesh.positions.as_flattened()).all(|value| value.is_finite()),
            "{name}"
        );
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
    let triangles: usize = WORLD.objects.iter().map(|object| object.mesh.triangles.len()).sum();
    assert!((15_000..60_000).contains(&triangles), "{triangles} triangles");
    for Object { name, mesh, .. } in WORLD.objects.iter().filter(|object| !object.name.starts_with("outlook")) {
        let [min, max] = mesh.bounds();
        assert!(
            (max - min).truncate().max_element() <= 12.0 && mesh.triangles.len() < 4000,
            "{name} is too large to cull"
        );
    }
}

#[test]
fn a_view_along_the_loop_shows_5_to_20_thousand_triangles() {
    // Of all objects whose box reaches into the Kinect's wider view, the colour camera's 63° × 49°, hidden ones too.
    let (wide, high) = (0.61, 0.46);
    let boxes: Vec<([Vec3; 2], usize)> =
        WORLD.objects.iter().map(|object| (object.mesh.bounds(), object.mesh.triangles.len())).collect();
    let points = loop_waypoints();
    let counts: Vec<usize> = points
        .windows(2)
        .map(|pair| {
            let [from, to] = [pair[0], pair[1]].map(|[x, y]| vec2(x as f32, y as f32));
            let (eye, ahead) = (from.extend(0.6), (to - from).normalize().extend(0.0));
            let (left, up) = (Vec3::Z.cross(ahead), Vec3::Z);
            let planes = [left, -left].map(|side| side + wide * ahead).into_iter();
            let planes: Vec<Vec3> = planes.chain([up, -up].map(|side| side + high * ahead)).collect();
            let reaches = |[low, high]: [Vec3; 2], plane: &Vec3| {
                plane.dot(Vec3::select(plane.cmpge(Vec3::ZERO), high, low) - eye) >= 0.0
            };
            let seen = boxes.iter().filter(|(bounds, _)| planes.iter().all(|plane| reaches(*bounds, plane)));
            seen.map(|(_, triangles)| triangles).sum()
        })
        .collect();
    let (least, most) = (counts.iter().min().expect("points"), counts.iter().max().expect("points"));
    let mean = counts.iter().sum::<usize>() / counts.len();
    println!("{least} to {most} triangles a view, mean {mean}");
    assert!(*most <= 20_000 && (5_000..20_000).contains(&mean), "{least} to {most} triangles a view, mean {mean}");
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
fn the_seed_decides() {
    let shape = |world: &World| world.objects.iter().map(|object| object.mesh.positions.clone()).collect::<Vec<_>>();
    assert!(shape(&laboratory(1)) == shape(&WORLD));
    assert!(shape(&laboratory(2)) != shape(&WORLD));
}

#[test]
fn the_loop_is_closed_and_of_good_length() {
    let points = loop_waypoints();
    let steps: Vec<f64> =
        points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).collect();
    assert!((15.0..=25.0).contains(&steps.iter().sum::<f64>()));
    assert!(steps.iter().all(|&step| step > 0.01 && step < 0.12));
    assert_eq!(points.first(), points.last());
}

#[test]
fn the_loop_keeps_half_a_metre_off_everything_that_collides() {
    for [x, y] in loop_waypoints() {
        let at = vec2(x as f32, y as f32);
        for Object { name, mesh, .. } in WORLD.objects.iter().filter(|object| object.collides) {
            let [min, max] = mesh.bounds();
            let near = at.clamp(min.truncate(), max.truncate());
            if max.z < ROBOT[0] || min.z > ROBOT[1] || near.distance(at) >= 0.5 {
                continue;
            }
            for &triangle in &mesh.triangles {
                let corners = mesh.corners(triangle);
                let low = corners.iter().all(|corner| corner.z < ROBOT[0]);
                let high = corners.iter().all(|corner| corner.z > ROBOT[1]);
                if !low && !high {
                    let clearance = distance_in_plan(at, corners.map(Vec3::truncate));
                    assert!(clearance >= 0.5, "{clearance} m from {name} at {at}");
                }
            }
        }
    }
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

#[test]
fn a_kinect_sees_structure_in_its_range_nearly_all_the_way() {
    let rays = Rays::new(&WORLD.objects).expect("triangles");
    let points = loop_waypoints();
    let mut poor = 0;
    for pair in points.windows(2).step_by(3) {
        let [from, to] = [pair[0], pair[1]].map(glam::DVec2::from);
        let (ahead, eye) = ((to - from).normalize(), from.extend(0.6));
        let left = ahead.perp();
        let mut near = 0;
        let mut above_floor = 0;
        for row in -5..=5 {
            for column in -7..=7 {
                // 15 × 11 rays over the Kinect's 58° × 45°.
                let (u, v) = (0.55 * f64::from(column) / 7.0, 0.41 * f64::from(row) / 5.0);
                let way = (ahead + u * left).extend(v);
                let Some(hit) = rays.first(eye, way, f64::MAX) else { continue };
                near += i32::from(hit.distance <= 3.5);
                above_floor += i32::from(hit.distance <= 3.5 && eye.z + hit.distance * v > 0.05);
            }
        }
        // Of 165: a good part in range, and not the floor alone.
        poor += i32::from(near < 66 || above_floor < 33);
    }
    let all = points.len() as i32 / 3;
    assert!(poor * 10 <= all, "{poor} of {all} places show too little");
}

#[test]
fn desks_have_office_light_and_only_windows_bring_830_nm() {
    let mut world = WORLD.clone();
    bake(&mut world, &Effort { rays: 24, bounces: 3, lamp_step: 0.6 }, &|_| ());
    let mut light = world.transfer.irradiance(&world.transfer.weights(&LightState::default())).into_iter();
    for object in &mut world.objects {
        object.mesh.irradiance = light.by_ref().take(object.mesh.positions.len()).collect();
    }
    for Object { name, mesh, .. } in &world.objects {
        assert!(mesh.irradiance.iter().flatten().all(|&value| value.is_finite() && value >= 0.0), "{name}");
    }
    let on_top = |name: &str, band: usize| {
        let mesh = &world.objects.iter().find(|object| object.name == name).expect("it is there").mesh;
        let top = (0..mesh.positions.len()).filter(|&index| mesh.normals[index][2] > 0.9);
        let light: Vec<f32> = top.map(|index| mesh.irradiance[index][band]).filter(|&value| value > 0.0).collect();
        light.iter().sum::<f32>() / light.len() as f32
    };
    for desk in ["laboratory desk, Oak", "east desk, Walnut", "island bench 1, Resin"] {
        assert!((300.0..550.0).contains(&on_top(desk, 1)), "{desk}: {} lx", on_top(desk, 1));
    }
    // One has its back to the windows, the other stands below one.
    assert!(on_top("north desk, Walnut", 3) > 5.0 * on_top("laboratory desk, Oak", 3));
}
