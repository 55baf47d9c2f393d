//! The laboratory, the yard before its door and a tunnel behind the yard's garages, one continuous world of some
//! 26 × 40 m: from office light through a doorway into daylight, into the dark and back.
//!
//! ```text
//! y = 34 ┌───────────────────────────────┐
//!        │   laboratory    │   office    │
//!        ├── door ─────────┴── door ─────┤
//!        │          corridor             │
//! y = 20 └── door ───────────────────────┴────┐
//!        │                                    │
//!        │              yard                  │
//!        │                                    │
//! y = 2  ├─ portal ──────────── portal ─┬─────┘
//!        │    │                    │    │
//!        │    └────── tunnel ──────┘    │
//! y = −6 └──────────────────────────────┘
//!      x = 0                                25
//! ```

mod tunnel;

use glam::{Vec3, vec3};

use super::ground::{CoveredArea, Ground};
use super::laboratory::{self, OUTER_DOOR, OuterDoor};
use super::material::Surface;
use super::scene::{Kind, Scene};
use super::shape::{Place, cuts_no_longer_than};
use super::way::rounded_loop;
use super::yard::{self, Doors, HOUSE, HOUSE_DOOR, HOUSE_DOOR_HEIGHT};
use super::{Mesh, World};

/// Thickness of the wall between the corridor and the yard, metres.
const OUTER_WALL: f32 = 0.3;
/// The laboratory's own origin: its outer door meets the brick house's.
const LABORATORY: [f32; 2] = [HOUSE_DOOR[0] - OUTER_DOOR[0], HOUSE + OUTER_WALL];
/// All that is driven on: south-west and north-east corner, metres.
const GROUND: [[f64; 2]; 2] = [[-1.0, -7.0], [26.0, 31.0]];
/// The brick house's outer walls behind its façade: west, east and north, and their height, metres.
const SHELL: [f32; 4] = [0.0, 25.0, HOUSE + 15.0, 7.2];

/// Builds the campus; `seed` decides on textures, on what fills shelves and on how plants grow. Light is yet to be baked.
pub fn campus(seed: u64) -> World {
    let mut scene = Scene::default();
    yard::build(&mut scene, seed, Doors::Open);
    let [x, y] = LABORATORY;
    scene.within(Place::new(x, y, 0.0, 0.0), |scene| laboratory::build(scene, seed, OuterDoor::Open));
    doorway(&mut scene);
    shell(&mut scene);
    tunnel::build(&mut scene);
    let mut world = scene.finish("campus", seed);
    laboratory::tessellate(&mut world);
    laboratory::hidden::remove(&mut world);
    world.ground = ground();
    world.open_sky = true;
    world
}

/// What is driven on, indoors and outdoors.
fn ground() -> Ground {
    let mut ground = yard::ground_within(GROUND[0], GROUND[1]);
    let moved = |at: [f64; 2]| [0, 1].map(|axis| at[axis] + f64::from(LABORATORY[axis]));
    let indoors = laboratory::floors().into_iter();
    ground.areas.extend(indoors.map(|area| CoveredArea { min: moved(area.min), max: moved(area.max), ..area }));
    ground
}

/// Sill, jambs and lintel between the corridor and the yard, and the door that stands open.
fn doorway(scene: &mut Scene) {
    let [left, right] = HOUSE_DOOR;
    let (into, width) = (vec3(0.0, OUTER_WALL, 0.0), vec3(right - left, 0.0, 0.0));
    let (up, down) = (vec3(0.0, 0.0, HOUSE_DOOR_HEIGHT), vec3(0.0, 0.0, -HOUSE_DOOR_HEIGHT));
    scene.piece("outer door, jambs", Kind::Solid, Place::new(0.0, HOUSE, 0.0, 0.0), |piece| {
        let (left, right) = (vec3(left, 0.0, 0.0), vec3(right, 0.0, 0.0));
        piece.face(Surface::Enamel, left + up, into, down);
        piece.face(Surface::Enamel, right + up + into, -into, down);
        piece.face(Surface::Enamel, left + up, width, into);
    });
    scene.piece("outer door, sill", Kind::Decor, Place::new(0.0, HOUSE, 0.0, 0.0), |piece| {
        piece.face(Surface::Pavers, vec3(left, 0.0, 0.0) + into, width, -into);
    });
    scene.piece("outer door, leaf", Kind::Solid, Place::new(left - 1.16, HOUSE - 0.1, 0.0, 0.0), |piece| {
        piece.block(Surface::GreenCoat, [0.0, -0.03, 0.01], [1.14, 0.03, HOUSE_DOOR_HEIGHT - 0.02]);
        piece.front(Surface::HouseDoor, [0.0, 1.14], [0.01, HOUSE_DOOR_HEIGHT - 0.02], -0.03);
    });
}

/// The brick house's other sides and an attic's floor: behind its façade no daylight but what windows let in.
fn shell(scene: &mut Scene) {
    let [west, east, north, top] = SHELL;
    scene.piece("brick house, shell", Kind::Decor, Place::default(), |piece| {
        let mut sheet = |corner: Vec3, right: Vec3, down: Vec3| {
            let [columns, rows] = [right, down].map(|edge| cuts_no_longer_than(3.0, &[0.0, edge.length()]));
            let mapping = piece.mapping(Surface::Brick);
            piece.mesh(Surface::Brick, &Mesh::grid(corner, right, down, [&columns, &rows], |_, _| false, mapping));
        };
        let (width, depth, height) = (vec3(east - west, 0.0, 0.0), vec3(0.0, north - HOUSE, 0.0), vec3(0.0, 0.0, -top));
        sheet(vec3(east, north, top), -width, height);
        sheet(vec3(west, north, top), -depth, height);
        sheet(vec3(east, HOUSE, top), depth, height);
        // Below the roof's slope.
        let eaves = vec3(0.0, 1.3, 0.0);
        sheet(vec3(west, north, top), width, eaves - depth);
    });
}

/// A closed way through all of it: corridor, office and laboratory, out of the door, down the drive, through the tunnel,
/// over gravel and lawn, and in again. x, y in metres, at most 10 cm apart, the last point the first; corners are arcs.
pub fn loop_waypoints() -> Vec<[f64; 2]> {
    let [east, west, door] = [15.6, 8.6, 8.6];
    rounded_loop(
        [11.0, 21.5],
        &[
            [east, 21.5],
            [east, 25.9],
            [west, 25.9],
            [door, 17.65],
            [4.6, 17.65],
            [4.6, 4.2],
            [3.7, 2.4],
            [3.7, -4.8],
            [13.5, -4.8],
            [13.5, 4.75],
            [16.7, 4.75],
            [16.7, 17.65],
            [door, 17.65],
            [door, 21.5],
        ],
        0.7,
    )
}

#[cfg(test)]
mod tests;
