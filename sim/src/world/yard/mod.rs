//! A yard between houses, 25 × 20 m: an asphalt drive with a parked car, a path of slabs along a brick house, a lawn with a
//! bank, a gravel strip before garages; with a loop to drive over all of it.
//!
//! ```text
//! y = 20 ┌─────────────────── brick house ─────────────────────┐
//!        │ roller │ door │ flower bed                          │
//!        │ door   └──────────────── path of slabs ─────────────│
//! plaster│  ↓   ←────────────────────────────────┐             │ stone
//!  house │  │ car │ hedge    lawn, bank          │ hedge  shed │ wall
//!        │  │ bins│          trees               │             │
//!  stone │  └────── gravel strip ─────────────→  ┘   trees     │
//!  wall  │         ── low wall ────                            │
//!        │ gate    garages                       hedge         │
//! y = 0  └─────────────────────────────────────────────────────┘
//!      x = 0       6                         18                25
//! ```

mod houses;
mod land;
mod plants;
mod street;
mod things;

use super::World;
use super::ground::Ground;
use super::material::Surface;
use super::scene::{Kind, Scene};
use super::shape::Place;
use super::way::rounded_loop;
use houses::{Facade, Fill, Opening, fence, wall};
use land::on_ground;
use plants::{conifer, flowers, hedge, shrub, tree};
use things::{
    barrel, bench, bicycle, bicycle_stand, bollard, car, grate, kerb, manhole, picnic_table, raised_bed, shed, sign,
    street_lamp, tub, wheeled_bin,
};

/// The brick house's façade, y in metres, and its door, along x and its height.
pub(super) const HOUSE: f32 = 20.0;
pub(super) const HOUSE_DOOR: [f32; 2] = [8.0, 9.2];
pub(super) const HOUSE_DOOR_HEIGHT: f32 = 2.1;
/// The garages' façade, y in metres, their doors' height, and those of them that open for a way through, along x.
pub(super) const GARAGES: f32 = 1.5;
pub(super) const GARAGE_DOOR_HEIGHT: f32 = 2.2;
pub(super) const GARAGE_DOORS: [[f32; 2]; 2] = [[2.4, 5.0], [12.2, 14.8]];
/// How far back the garages reach, y in metres, and their roof's underside.
pub(super) const GARAGES_BACK: f32 = -6.6;
pub(super) const GARAGES_TOP: f32 = 2.7;

/// Builds the yard; `seed` decides on textures and on how plants grow. Light is yet to be baked.
pub fn yard(seed: u64) -> World {
    let mut scene = Scene::default();
    build(&mut scene, seed, Doors::Shut);
    let mut world = scene.finish("yard", seed);
    world.ground = ground();
    world.open_sky = true;
    world
}

/// What is driven on in the yard: drive, gravel, lawn and path, with their heights.
pub fn ground() -> Ground {
    ground_within([0.0, 0.0], [25.0, 20.0])
}

/// The same, with heights from one corner of the plan to another, metres: around the yard it is level.
pub(super) fn ground_within(min: [f64; 2], max: [f64; 2]) -> Ground {
    land::ground(min, max)
}

/// Whether one can leave the yard: through the brick house's door and two of the garages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Doors {
    Shut,
    /// What is behind them builds floors and cheeks.
    Open,
}

pub(super) fn build(scene: &mut Scene, seed: u64, doors: Doors) {
    land::build(scene);
    houses_around(scene, doors);
    walls_around(scene, seed);
    beside_the_drive(scene, seed);
    beside_the_gravel(scene, seed);
    on_the_lawn(scene, seed);
    beside_the_path(scene, seed);
}

fn houses_around(scene: &mut Scene, doors: Doors) {
    let passage = |shut: Fill| if doors == Doors::Open { Fill::Open } else { shut };
    let window = |left: f32, bottom: f32| Opening {
        along: [left, left + 1.2],
        height: [bottom, bottom + 1.5],
        fill: Fill::Window,
    };
    let mut openings: Vec<Opening> =
        [1.6, 4.2, 10.6, 13.2, 15.8, 19.4, 22.2].into_iter().map(|left| window(left, 1.0)).collect();
    openings.extend([1.6, 4.2, 8.0, 10.6, 13.2, 15.8, 19.4, 22.2].into_iter().map(|left| window(left, 3.9)));
    openings.push(Opening { along: HOUSE_DOOR, height: [0.0, HOUSE_DOOR_HEIGHT], fill: passage(Fill::Door) });
    let north = Facade {
        name: "brick house",
        from: [0.0, HOUSE],
        to: [25.0, HOUSE],
        height: 6.2,
        surface: Surface::Brick,
        pieces: &[6.5, 12.4, 18.2],
        openings: &openings,
    };
    north.build(scene);
    north.roof(scene, 2.6);
    for along in [6.5, 18.2] {
        north.downpipe(scene, along);
    }
    let mut openings: Vec<Opening> = [0.9, 2.9, 5.3, 7.3].into_iter().map(|left| window(left, 1.0)).collect();
    openings.extend([1.9, 6.3, 9.2, 11.6].into_iter().map(|left| window(left, 3.2)));
    openings.push(Opening { along: [9.3, 11.9], height: [0.0, 2.2], fill: Fill::Roller });
    let west = Facade {
        name: "plaster house",
        from: [0.0, 6.5],
        to: [0.0, HOUSE],
        height: 5.2,
        surface: Surface::Plaster,
        pieces: &[4.6, 8.9],
        openings: &openings,
    };
    west.build(scene);
    west.roof(scene, 2.2);
    west.downpipe(scene, 4.6);
    let garage = |along: [f32; 2], fill: Fill| Opening { along, height: [0.0, GARAGE_DOOR_HEIGHT], fill };
    let [west_door, east_door] = GARAGE_DOORS.map(|[from, to]| garage([16.0 - to, 16.0 - from], passage(Fill::Roller)));
    let openings = [east_door, garage([4.6, 7.2], Fill::Roller), garage([8.0, 10.6], Fill::Roller), west_door];
    let side = |name, from, to, pieces: &'static [f32], openings| Facade {
        name,
        from,
        to,
        height: GARAGES_TOP,
        surface: Surface::Concrete,
        pieces,
        openings,
    };
    side("garages", [16.0, GARAGES], [1.0, GARAGES], &[4.2, 7.6, 10.8], &openings).build(scene);
    side("garages, west side", [1.0, GARAGES], [1.0, GARAGES_BACK], &[], &[]).build(scene);
    side("garages, east side", [16.0, GARAGES_BACK], [16.0, GARAGES], &[], &[]).build(scene);
    side("garages, back", [1.0, GARAGES_BACK], [16.0, GARAGES_BACK], &[], &[]).build(scene);
    scene.piece("garages, roof", Kind::Decor, Place::new(0.0, GARAGES, 0.0, 0.0), |piece| {
        let back = GARAGES_BACK - GARAGES;
        piece.block(Surface::Concrete, [0.85, back - 0.15, GARAGES_TOP], [16.15, 0.15, GARAGES_TOP + 0.25]);
    });
    let number = Place::new(0.0, HOUSE, 0.0, 0.0);
    scene.piece("house number", Kind::Decor, number, |piece| {
        piece.front(Surface::HouseNumber, [9.5, 9.8], [1.7, 1.94], -0.01);
    });
}

fn walls_around(scene: &mut Scene, seed: u64) {
    wall(scene, "east wall", Surface::Stone, [[24.85, 6.0], [24.85, 20.0]], 0.3, 2.1);
    wall(scene, "west wall, south of the gate", Surface::Stone, [[0.15, 1.5], [0.15, 2.2]], 0.3, 2.1);
    wall(scene, "west wall, north of the gate", Surface::Stone, [[0.15, 5.6], [0.15, 6.5]], 0.3, 2.1);
    street::gate(scene, [[0.1, 2.2], [0.1, 5.6]]);
    hedge(scene, "south hedge, west part", [[16.0, 0.6], [20.6, 0.6]], 0.9, 2.3, seed);
    hedge(scene, "south hedge, east part", [[20.6, 0.6], [25.0, 0.6]], 0.9, 2.2, seed);
    hedge(scene, "east hedge", [[24.5, 1.0], [24.5, 6.0]], 0.9, 2.2, seed);
    street::passing_car(scene);
    // Beyond: what closes the view above the walls.
    tree(scene, "lime beyond the garages", [5.0, -9.5], 9.5, seed);
    tree(scene, "second lime beyond the garages", [13.0, -10.0], 10.0, seed);
    tree(scene, "lime in the south-east", [21.5, -2.5], 7.5, seed);
    tree(scene, "lime beyond the gate", [-3.5, 3.0], 7.5, seed);
    tree(scene, "lime beyond the wall", [27.5, 9.0], 8.0, seed);
    tree(scene, "second lime beyond the wall", [27.5, 16.0], 7.0, seed);
}

fn beside_the_drive(scene: &mut Scene, seed: u64) {
    car(scene, "car", on_ground(2.9, 12.6, 90.0));
    kerb(scene, "drive, kerb", [6.0, 6.4], [6.14, 16.4], -0.1, 0.11);
    hedge(scene, "low hedge, south part", [[6.6, 7.4], [6.6, 11.6]], 0.6, 0.95, seed);
    hedge(scene, "low hedge, north part", [[6.6, 12.6], [6.6, 16.0]], 0.6, 0.95, seed);
    street_lamp(scene, "drive, lamp", on_ground(6.55, 12.1, -90.0));
    fence(scene, "bins, back", [[2.75, 9.4], [2.75, 6.2]], 0.05, 1.35);
    fence(scene, "bins, north", [[3.65, 9.4], [2.75, 9.4]], 0.05, 1.35);
    fence(scene, "bins, south", [[2.75, 6.2], [3.65, 6.2]], 0.05, 1.35);
    for (index, (y, lid)) in
        [(6.8, Surface::BluePlastic), (7.8, Surface::GreenCoat), (8.75, Surface::BlackPlastic)].into_iter().enumerate()
    {
        wheeled_bin(scene, &format!("bin {index}"), on_ground(3.25, y, 90.0 - 4.0 * index as f32), lid);
    }
    sign(scene, "parking sign", on_ground(0.6, 14.9, 60.0));
    bollard(scene, "bollard", on_ground(6.3, 3.0, 0.0));
    bollard(scene, "second bollard", on_ground(6.3, 2.0, 0.0));
    manhole(scene, "drive, manhole", on_ground(4.9, 15.6, 20.0));
    manhole(scene, "drive, second manhole", on_ground(4.3, 4.2, 70.0));
    grate(scene, "drive, gully", on_ground(5.4, 9.2, 0.0));
    grate(scene, "drive, second gully", on_ground(1.2, 5.4, 0.0));
    tub(scene, "gate, tub", on_ground(1.0, 6.2, 0.0));
    shrub(scene, "gate, tub's shrub", [1.0, 6.2], [0.7, 1.1], Surface::Needles, seed);
    barrel(scene, "rain barrel", on_ground(0.45, 10.9, 0.0));
    for (index, y) in [8.3, 10.9, 13.7].into_iter().enumerate() {
        tub(scene, &format!("kerb, tub {index}"), on_ground(5.6, y, 4.0 * index as f32 - 4.0));
        shrub(scene, &format!("kerb, tub's shrub {index}"), [5.6, y], [0.6, 0.95], Surface::Foliage, seed);
    }
    tub(scene, "drive, tub", on_ground(3.2, 16.3, 8.0));
    shrub(scene, "drive, tub's shrub", [3.2, 16.3], [0.7, 1.3], Surface::Foliage, seed);
}

fn beside_the_gravel(scene: &mut Scene, seed: u64) {
    wall(scene, "low wall, west part", Surface::Stone, [[6.6, 3.65], [12.1, 3.65]], 0.3, 0.6);
    wall(scene, "low wall, east part", Surface::Stone, [[14.9, 3.65], [17.4, 3.65]], 0.3, 0.6);
    kerb(scene, "lawn, southern edging", [6.4, 6.2], [15.7, 6.27], -0.1, 0.06);
    bench(scene, "gravel, bench", on_ground(10.2, 6.75, 0.0));
    for (index, (x, wide, tall, surface)) in [
        (7.6, 0.9, 0.8, Surface::Foliage),
        (8.7, 0.7, 0.6, Surface::Needles),
        (12.0, 0.9, 0.75, Surface::Hedge),
        (13.2, 0.8, 0.9, Surface::Foliage),
        (14.4, 0.9, 0.7, Surface::Needles),
    ]
    .into_iter()
    .enumerate()
    {
        shrub(scene, &format!("gravel, shrub {index}"), [x, 6.9], [wide, tall], surface, seed);
    }
    street_lamp(scene, "gravel, lamp", on_ground(11.2, 3.4, 180.0));
    tub(scene, "gravel, tub", on_ground(17.45, 4.25, 12.0));
    shrub(scene, "gravel, tub's shrub", [17.45, 4.25], [0.7, 1.2], Surface::Foliage, seed);
    conifer(scene, "corner conifer", [18.6, 3.4], 4.2, seed);
    shrub(scene, "corner shrub", [17.9, 5.6], [1.0, 0.9], Surface::Hedge, seed);
    tree(scene, "corner cherry", [21.4, 4.0], 4.6, seed);
}

fn on_the_lawn(scene: &mut Scene, seed: u64) {
    tree(scene, "apple tree", [11.2, 12.2], 4.8, seed);
    tree(scene, "pear tree", [15.15, 8.0], 4.4, seed);
    tree(scene, "plum tree", [9.4, 9.0], 4.0, seed);
    tree(scene, "cherry tree", [21.5, 9.4], 5.0, seed);
    conifer(scene, "spruce", [20.0, 12.6], 5.2, seed);
    hedge(scene, "lawn hedge, south part", [[17.9, 7.0], [17.9, 10.6]], 0.7, 1.15, seed);
    hedge(scene, "lawn hedge, north part", [[17.9, 12.2], [17.9, 15.6]], 0.7, 1.1, seed);
    raised_bed(scene, "raised bed 0", on_ground(15.5, 9.7, 90.0), [2.4, 0.85]);
    raised_bed(scene, "raised bed 1", on_ground(15.5, 13.0, 90.0), [2.4, 0.85]);
    for (index, y) in [9.1, 9.9, 10.5, 12.4, 13.1, 13.7].into_iter().enumerate() {
        let kind = if index % 2 == 0 { Surface::Foliage } else { Surface::Hedge };
        shrub(scene, &format!("raised bed, vegetables {index}"), [15.5, y], [0.55, 0.75], kind, seed);
    }
    shrub(scene, "lawn, shrub 0", [15.1, 11.4], [0.9, 0.9], Surface::Foliage, seed);
    shrub(scene, "lawn, shrub 2", [15.2, 15.2], [0.9, 1.0], Surface::Needles, seed);
    shrub(scene, "lawn, shrub 3", [17.7, 11.4], [0.8, 0.8], Surface::Foliage, seed);
    picnic_table(scene, "picnic table", on_ground(11.6, 9.4, 15.0));
    shed(scene, "shed", on_ground(22.6, 12.6, 0.0), [3.0, 2.4]);
}

fn beside_the_path(scene: &mut Scene, seed: u64) {
    kerb(scene, "bed, edging", [10.0, 18.42], [24.6, 18.5], -0.1, 0.09);
    kerb(scene, "bed, western edging", [9.96, 18.5], [10.04, 20.0], -0.1, 0.09);
    kerb(scene, "lawn, northern edging", [6.6, 16.44], [15.6, 16.52], -0.1, 0.05);
    for (index, (x, wide, tall, surface)) in [
        (10.8, 0.9, 1.0, Surface::Foliage),
        (13.4, 0.8, 0.7, Surface::Hedge),
        (15.9, 0.9, 0.9, Surface::Needles),
        (18.6, 1.0, 1.1, Surface::Foliage),
        (21.2, 0.9, 0.8, Surface::Hedge),
        (23.6, 0.9, 1.0, Surface::Foliage),
    ]
    .into_iter()
    .enumerate()
    {
        shrub(scene, &format!("bed, shrub {index}"), [x, 19.15], [wide, tall], surface, seed);
    }
    for (index, [left, right]) in [[10.5, 12.9], [14.0, 16.4]].into_iter().enumerate() {
        hedge(scene, &format!("bed, box hedge {index}"), [[left, 18.72], [right, 18.72]], 0.3, 0.42, seed);
    }
    for (index, x) in [12.0, 14.6, 17.2, 19.8, 22.4].into_iter().enumerate() {
        flowers(scene, &format!("bed, flowers {index}"), [x, 19.2], [1.3, 0.9], index as u32, 0.0, seed);
    }
    for (index, x) in [7.45, 9.65].into_iter().enumerate() {
        tub(scene, &format!("door, tub {index}"), on_ground(x, 19.5, 0.0));
        shrub(scene, &format!("door, tub's shrub {index}"), [x, 19.5], [0.7, 1.25], Surface::Needles, seed);
    }
    for (index, x) in [6.6, 14.9].into_iter().enumerate() {
        tub(scene, &format!("path, tub {index}"), on_ground(x, 16.74, 5.0));
        flowers(scene, &format!("path, tub's flowers {index}"), [x, 16.74], [0.5, 0.5], 4, 0.5, seed);
    }
    for (index, x) in [8.0, 11.6, 14.6].into_iter().enumerate() {
        tub(scene, &format!("gravel strip, tub {index}"), on_ground(x, 5.72, 7.0 * index as f32));
        flowers(scene, &format!("gravel strip, tub's flowers {index}"), [x, 5.72], [0.5, 0.5], index as u32, 0.5, seed);
    }
    bench(scene, "path, bench", on_ground(8.2, 16.2, 180.0));
    bicycle_stand(scene, "bicycle stand", on_ground(12.6, 16.1, 0.0));
    bicycle(scene, "bicycle", on_ground(12.7, 16.05, 0.0), Surface::BluePlastic);
    bicycle(scene, "second bicycle", on_ground(11.9, 16.1, 180.0), Surface::RedCoat);
    street_lamp(scene, "path, lamp", on_ground(10.2, 16.3, 180.0));
    manhole(scene, "path, manhole", on_ground(18.0, 17.4, 0.0));
}

/// A closed way over drive, gravel, lawn and path, anticlockwise: x, y in metres, at most 10 cm apart, the last point the
/// first. Its corners are arcs.
pub fn loop_waypoints() -> Vec<[f64; 2]> {
    rounded_loop([10.65, 17.65], &[[4.6, 17.65], [4.6, 4.75], [16.7, 4.75], [16.7, 17.65]], 0.9)
}

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(super) use tests::clearance;
