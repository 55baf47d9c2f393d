//! A laboratory: a tiled laboratory room, a carpeted office and the corridor that joins them, 12 × 9 m, with a loop to
//! drive through all three.
//!
//! ```text
//! y = 9.00 ┌───────window──window───┬────────window────────┐
//!          │ bench            hood  │  desks               │
//!          │     island bench       │   low shelves        │
//!          │   ←───────────────────  door ←────────┐       │ window
//!          │   │  shelves           │              │ desks │
//! y = 2.25 ├── door ────────────────┴──────────── door ────┤
//!          │   └───────────────→ corridor ─────────┘       │ window
//! y = 0.00 └───────────────────────────────────────────────┘
//!        x = 0                     7                      12
//! ```

mod building;
mod corridor;
mod fittings;
mod furniture;
pub(super) mod hidden;
mod instruments;
mod laboratory_room;
mod office;
mod storage;
mod things;

use glam::{Vec2, vec2};

use super::ground::{Cover, CoveredArea, Ground};
use super::rays::Rays;
use super::refine::refine;
use super::scene::Scene;
use super::{Object, World};

/// Height of rooms, metres.
const CEILING: f32 = 2.7;
/// Height of doorways, metres.
const DOOR: f32 = 2.1;
/// Thickness of inner walls, metres.
const PARTITION: f32 = 0.15;
/// Depth of a window's cheeks, metres.
const CHEEK: f32 = 0.2;

/// The plan: outer corners, then the inner walls' faces. Metres.
const EAST: f32 = 12.0;
const NORTH: f32 = 9.0;
/// The corridor's wall to the rooms, its southern face.
const CORRIDOR: f32 = 2.1;
/// The same wall's northern face.
const ROOMS: f32 = CORRIDOR + PARTITION;
/// The wall between the rooms, its western face.
const BETWEEN: f32 = 7.0;
/// The same wall's eastern face.
const OFFICE: f32 = BETWEEN + PARTITION;

/// Doorways, 1.2 m wide: from and to, along x (to the corridor) or y (between the rooms).
const LABORATORY_DOOR: [f32; 2] = [2.0, 3.2];
const OFFICE_DOOR: [f32; 2] = [9.0, 10.2];
const INNER_DOOR: [f32; 2] = [5.0, 6.2];

/// Longest edge of a triangle on floors where something stands, and on worktops, metres: shadows' edges are about as
/// soft as that. Elsewhere the shapes' own cuts do.
const EDGE_AT_CONTACTS: f32 = 0.2;
const EDGE_ON_WORKTOPS: f32 = 0.3;

/// Builds the laboratory; `seed` decides on textures and on what fills the shelves. Light is yet to be baked.
pub fn laboratory(seed: u64) -> World {
    let mut scene = Scene::default();
    build(&mut scene, seed, OuterDoor::Shut);
    let mut world = scene.finish("laboratory", seed);
    tessellate(&mut world);
    world.ground = Ground { elsewhere: Cover::Tile, areas: floors(), terrain: None };
    hidden::remove(&mut world);
    world
}

/// Whether one can leave the corridor through the door in its southern wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OuterDoor {
    Shut,
    /// Something else stands south of the laboratory: nothing is to be seen of the outlook there.
    Open,
}

/// The outer door, along x, metres.
pub(super) const OUTER_DOOR: [f32; 2] = LABORATORY_DOOR;

/// Builds the rooms and what their windows look out on.
pub(super) fn build(scene: &mut Scene, seed: u64, outer_door: OuterDoor) {
    corridor::build(scene, seed, outer_door);
    laboratory_room::build(scene, seed);
    office::build(scene, seed);
    building::outlook(scene, "outlook north", [-5.0, 14.0], [17.0, 14.0]);
    match outer_door {
        OuterDoor::Shut => building::outlook(scene, "outlook east", [17.0, 14.0], [17.0, -5.0]),
        OuterDoor::Open => {
            building::outlook(scene, "outlook east", [17.0, 14.0], [17.0, 0.0]);
            building::outlook(scene, "outlook south", [17.0, 0.0], [EAST, 0.0]);
            building::outlook(scene, "outlook west", [-5.0, NORTH], [-5.0, 14.0]);
        }
    }
}

/// What lies on the floor: tile all over, carpet in the office.
pub(super) fn floors() -> Vec<CoveredArea> {
    let area =
        |min: [f32; 2], max: [f32; 2], cover| CoveredArea { min: min.map(f64::from), max: max.map(f64::from), cover };
    vec![area([0.0; 2], [EAST, NORTH], Cover::Tile), area([BETWEEN, ROOMS], [EAST, NORTH], Cover::Carpet)]
}

/// Cuts triangles further for the light's sake: worktops, and floors near what stands on them.
pub(super) fn tessellate(world: &mut World) {
    let is_floor = |name: &str| name.starts_with("floor");
    let is_worktop =
        |name: &str| ["Resin", "desk, Walnut", "desk, Oak", "table, Walnut"].iter().any(|end| name.ends_with(end));
    // Not what is stuck to it.
    let stands = |object: &&Object| !is_floor(&object.name) && object.mesh.bounds()[1].z > EDGE_AT_CONTACTS;
    let standing = Rays::new(world.objects.iter().filter(stands));
    for object in &mut world.objects {
        match &standing {
            Some(standing) if is_floor(&object.name) => {
                refine(&mut object.mesh, |at| EDGE_AT_CONTACTS + 2.5 * standing.distance(at.as_dvec3()) as f32);
            }
            _ if is_worktop(&object.name) => refine(&mut object.mesh, |_| EDGE_ON_WORKTOPS),
            _ => (),
        }
    }
}

/// A closed way through the corridor, the office and the laboratory room, anticlockwise: x, y in metres, about 10 cm
/// apart, the last point the first. Its corners are arcs.
pub fn loop_waypoints() -> Vec<[f64; 2]> {
    const RADIUS: f32 = 0.7;
    const STEP: f32 = 0.1;
    // In the middle of doorways, and of the corridor's free width.
    let (south, north) = (1.2, 0.5 * (INNER_DOOR[0] + INNER_DOOR[1]));
    let (west, east) = (0.5 * (LABORATORY_DOOR[0] + LABORATORY_DOOR[1]), 0.5 * (OFFICE_DOOR[0] + OFFICE_DOOR[1]));
    let start = vec2(4.0, south);
    let corners = [vec2(east, south), vec2(east, north), vec2(west, north), vec2(west, south)];
    let mut points = vec![start];
    let walk = |points: &mut Vec<Vec2>, to: Vec2| {
        let from = points[points.len() - 1];
        let steps = (from.distance(to) / STEP).ceil().max(1.0);
        points.extend((1..=steps as u32).map(|step| from.lerp(to, step as f32 / steps)));
    };
    for (index, &corner) in corners.iter().enumerate() {
        let before = if index == 0 { start } else { corners[index - 1] };
        let after = corners.get(index + 1).copied().unwrap_or(start);
        let (arrive, leave) = ((corner - before).normalize(), (after - corner).normalize());
        let centre = corner + RADIUS * (leave - arrive);
        walk(&mut points, corner - RADIUS * arrive);
        let steps = (RADIUS * std::f32::consts::FRAC_PI_2 / STEP).ceil();
        for step in 1..=steps as u32 {
            let (sin, cos) = (std::f32::consts::FRAC_PI_2 * step as f32 / steps).sin_cos();
            points.push(centre + RADIUS * (sin * arrive - cos * leave));
        }
    }
    walk(&mut points, start);
    points.into_iter().map(|point| point.as_dvec2().to_array()).collect()
}

#[cfg(test)]
mod tests;
