//! A tunnel without windows, in a U from one garage door to another; lamps of its own, dark without them.

use glam::{Vec3, vec3};

use crate::light::LampKind;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::{Place, cuts_no_longer_than};
use crate::world::yard::{GARAGE_DOOR_HEIGHT, GARAGE_DOORS, GARAGES};
use crate::world::{Lamp, Mesh};

/// Outer side of the U's bottom, y in metres.
const SOUTH: f32 = -6.1;
/// Its inner side.
const INNER: f32 = -3.5;
const CEILING: f32 = GARAGE_DOOR_HEIGHT;
/// Longest edge of its walls' triangles, metres.
const EDGE: f32 = 0.55;
/// How high its roller doors leave it open, metres.
const HALF_SHUT: f32 = 0.95;
/// How far its buttresses stand out, metres.
const BUTTRESS: f32 = 0.7;
/// Exitance of a lamp's cover, lux: a fluorescent tube, some 3000 lm out of 0.14 m².
const TUBE: f32 = 21_000.0;

pub(super) fn build(scene: &mut Scene) {
    let [[west, west_inner], [east_inner, east]] = GARAGE_DOORS;
    // Each from left to right for who sees it.
    for (name, from, to) in [
        ("west wall", [west, SOUTH], [west, GARAGES]),
        ("west inner wall", [west_inner, GARAGES], [west_inner, INNER]),
        ("inner wall", [west_inner, INNER], [east_inner, INNER]),
        ("east inner wall", [east_inner, INNER], [east_inner, GARAGES]),
        ("east wall", [east, GARAGES], [east, SOUTH]),
        ("south wall", [east, SOUTH], [west, SOUTH]),
    ] {
        wall(scene, name, from, to);
    }
    for (name, min, max) in [
        ("west arm", [west, INNER], [west_inner, GARAGES]),
        ("east arm", [east_inner, INNER], [east, GARAGES]),
        ("western bottom", [west, SOUTH], [0.5 * (west + east), INNER]),
        ("eastern bottom", [0.5 * (west + east), SOUTH], [east, INNER]),
    ] {
        slabs(scene, name, min, max);
    }
    let middles = [0.5 * (west + west_inner), 0.5 * (east_inner + east), 0.5 * (SOUTH + INNER)];
    for (index, [x, y]) in
        [[middles[0], -1.0], [5.6, middles[2]], [8.6, middles[2]], [11.6, middles[2]], [middles[1], -1.0]]
            .into_iter()
            .enumerate()
    {
        lamp(scene, index, [x, y], (1..4).contains(&index));
    }
    half_shut(scene, "west roller door", [west, west_inner]);
    half_shut(scene, "east roller door", [east_inner, east]);
    buttress(scene, "west buttress", [west, west + BUTTRESS]);
    buttress(scene, "east buttress", [east - BUTTRESS, east]);
    fittings(scene, [west, west_inner, east_inner, east]);
}

/// A roller door, pulled down half-way: robots fit below it, most of the daylight does not.
fn half_shut(scene: &mut Scene, name: &str, [left, right]: [f32; 2]) {
    let place = Place::new(0.5 * (left + right), GARAGES - 0.1, 0.0, 180.0);
    scene.piece(&format!("tunnel, {name}"), Kind::Solid, place, |piece| {
        let half = 0.5 * (right - left);
        piece.cuboid(Surface::GreyCoat, [-half, 0.0, HALF_SHUT], [half, 0.04, CEILING]);
        piece.front(Surface::RollerDoor, [-half, half], [HALF_SHUT, CEILING], -0.002);
    });
}

/// Stands out from a wall before the bend: without it the wall's end, which lights the bottom, would see the entrance.
fn buttress(scene: &mut Scene, name: &str, [left, right]: [f32; 2]) {
    scene.piece(&format!("tunnel, {name}"), Kind::Solid, Place::default(), |piece| {
        // In courses, as light is kept at corners.
        for course in 0..4 {
            let [bottom, top] = [course, course + 1].map(|edge| CEILING * edge as f32 / 4.0);
            piece.block(Surface::SootyConcrete, [left, INNER + 0.1, bottom], [right, INNER + 0.4, top]);
        }
    });
}

fn wall(scene: &mut Scene, name: &str, from: [f32; 2], to: [f32; 2]) {
    let [from, to] = [from, to].map(glam::Vec2::from);
    scene.piece(&format!("tunnel, {name}"), Kind::Solid, Place::along(from, to), |piece| {
        let [columns, rows] = [from.distance(to), CEILING].map(|end| cuts_no_longer_than(EDGE, &[0.0, end]));
        let mapping = piece.mapping(Surface::SootyConcrete);
        let corner = vec3(0.0, 0.0, CEILING);
        piece.mesh(
            Surface::SootyConcrete,
            &Mesh::grid(corner, Vec3::X, -Vec3::Z, [&columns, &rows], |_, _| false, mapping),
        );
    });
}

/// Floor and ceiling. The yard's ground reaches in as far as y = 0.
fn slabs(scene: &mut Scene, name: &str, min: [f32; 2], max: [f32; 2]) {
    let grid = |corner: Vec3, down: Vec3, surface: Surface| {
        let cuts = [max[0] - min[0], down.length()].map(|edge| cuts_no_longer_than(EDGE, &[0.0, edge]));
        let mapping = surface.mapping_from([min[0], -max[1]]);
        Mesh::grid(corner, Vec3::X, down, [&cuts[0], &cuts[1]], |_, _| false, mapping)
    };
    let north = max[1].min(0.0);
    let (floor, ceiling) = (vec3(0.0, min[1] - north, 0.0), vec3(0.0, max[1] - min[1], 0.0));
    scene.piece(&format!("tunnel, {name}"), Kind::Decor, Place::default(), |piece| {
        piece.mesh(Surface::Asphalt, &grid(vec3(min[0], north, 0.0), floor, Surface::Asphalt));
        piece.mesh(Surface::SootyConcrete, &grid(vec3(min[0], min[1], CEILING), ceiling, Surface::SootyConcrete));
    });
}

fn lamp(scene: &mut Scene, index: usize, [x, y]: [f32; 2], along_x: bool) {
    let name = format!("tunnel, lamp {index}");
    let place = Place::new(x, y, CEILING, if along_x { 0.0 } else { 90.0 });
    scene.piece(&name, Kind::Decor, place, |piece| {
        piece.cuboid(Surface::Enamel, [-0.62, -0.08, -0.09], [0.62, 0.08, 0.0]);
        piece.face(Surface::Opal, vec3(-0.6, -0.06, -0.092), vec3(1.2, 0.0, 0.0), vec3(0.0, 0.12, 0.0));
    });
    let edge = |local: Vec3| (place.point(local) - place.at).to_array();
    scene.lamp(Lamp {
        name,
        centre: [x, y, CEILING - 0.096],
        half_edges: [edge(vec3(0.0, 0.06, 0.0)), edge(vec3(0.6, 0.0, 0.0))],
        exitance: LampKind::Fluorescent.exitance(TUBE),
        group: "tunnel".to_owned(),
    });
}

/// What tells one place in it from another: pipes, cabinets, doors, signs, things left there.
fn fittings(scene: &mut Scene, [west, west_inner, east_inner, east]: [f32; 4]) {
    scene.piece("tunnel, pipes", Kind::Decor, Place::default(), |piece| {
        for (surface, off, z, radius) in [
            (Surface::RedCoat, 0.09, 1.95, 0.045),
            (Surface::Steel, 0.08, 1.78, 0.03),
            (Surface::GreyCoat, 0.06, 0.3, 0.04),
        ] {
            let ends = [
                [west + off, GARAGES - 0.1, z],
                [west + off, SOUTH + off, z],
                [east - off, SOUTH + off, z],
                [east - off, GARAGES - 0.1, z],
            ];
            for pair in ends.windows(2) {
                piece.tube(surface, pair[0], pair[1], [radius; 2]);
            }
        }
    });
    // On which wall, as that wall's place along x from its left end, and the way it faces.
    let on = |x: f32, y: f32, yaw_deg: f32| Place::new(x, y, 0.0, yaw_deg);
    let (facing_east, facing_west, facing_north, facing_south) = (90.0, -90.0, 180.0, 0.0);
    let mut panel = |name: &str, place: Place, surface: Surface, [width, height]: [f32; 2], bottom: f32, deep: f32| {
        scene.piece(&format!("tunnel, {name}"), Kind::Solid, place, |piece| {
            let half = 0.5 * width;
            if deep > 0.01 {
                piece.block(Surface::GreyCoat, [-half, -deep, bottom], [half, -0.001, bottom + height]);
            }
            piece.front(surface, [-half, half], [bottom, bottom + height], -deep - 0.002);
        });
    };
    panel("switch cabinet", on(west_inner, -0.4, facing_west), Surface::CabinetFront, [0.8, 1.7], 0.1, 0.3);
    panel("locker", on(west, -2.2, facing_east), Surface::LockerFront, [0.5, 1.6], 0.05, 0.3);
    panel("west safety poster", on(west, -0.3, facing_east), Surface::SciencePoster, [0.84, 1.19], 0.5, 0.0);
    panel("exit sign", on(west, -4.6, facing_east), Surface::ExitSign, [0.4, 0.2], 1.3, 0.0);
    panel("bend sign", on(3.6, SOUTH, facing_north), Surface::SafetyPoster, [0.6, 0.84], 0.7, 0.0);
    panel("service door", on(7.0, INNER, facing_south), Surface::DoorLeaf, [0.9, 2.0], 0.0, 0.02);
    panel("drawers", on(5.9, SOUTH, facing_north), Surface::DrawerFront, [0.5, 0.7], 0.0, 0.4);
    panel("map", on(8.9, SOUTH, facing_north), Surface::ContourMap, [1.19, 0.84], 0.6, 0.0);
    panel("second switch cabinet", on(9.9, INNER, facing_south), Surface::RackFront, [0.6, 1.8], 0.0, 0.35);
    panel("second service door", on(11.4, SOUTH, facing_north), Surface::DoorLeaf, [0.9, 2.0], 0.0, 0.02);
    panel("second exit sign", on(13.4, SOUTH, facing_north), Surface::ExitSign, [0.4, 0.2], 1.3, 0.0);
    panel("poster in the bend", on(east, -4.5, facing_west), Surface::RobotPoster, [0.84, 1.19], 0.5, 0.0);
    panel("house number", on(east_inner, -2.4, facing_east), Surface::HouseNumber, [0.4, 0.32], 1.0, 0.0);
    panel("fuse box", on(east, -1.6, facing_west), Surface::PowerSupply, [0.5, 0.35], 0.8, 0.15);
    panel("notice", on(east_inner, -0.2, facing_east), Surface::Noticeboard, [1.2, 0.8], 0.6, 0.0);
    for (index, (x, y)) in [(9.6, SOUTH + 0.35), (12.0, INNER - 0.35)].into_iter().enumerate() {
        scene.piece(&format!("tunnel, crate {index}"), Kind::Solid, on(x, y, 12.0 - 30.0 * index as f32), |piece| {
            piece.block(Surface::Planks, [-0.3, -0.22, 0.0], [0.3, 0.22, 0.42]);
            piece.block(Surface::Cardboard, [-0.2, -0.18, 0.42], [0.18, 0.16, 0.7]);
            piece.front(Surface::BoxSide, [-0.2, 0.18], [0.42, 0.7], -0.18);
        });
    }
}
