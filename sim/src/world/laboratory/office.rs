//! The office: desks, screens between them, books, a round table; carpeted.

use super::building::{Opening, Wall, door_frame, open_leaf, panel, picture, slab, window};
use super::fittings::{computer, flip_chart, low_sockets, trunking};
use super::furniture::{DESK, cabinet, partition, plain_chair, radiator, round_table, shelf, workplace};
use super::storage::{pallet, worktop_things};
use super::things::{bin, carton, papers, plant};
use super::{BETWEEN, CEILING, CHEEK, DOOR, EAST, INNER_DOOR, NORTH, OFFICE, OFFICE_DOOR, ROOMS};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

pub(super) fn build(scene: &mut Scene, seed: u64) {
    shell(scene);
    furnish(scene, seed);
}

fn shell(scene: &mut Scene) {
    let north = Wall { name: "office, north wall", from: [OFFICE, NORTH], to: [EAST, NORTH] };
    let opening = Opening { along: [1.2, 3.6], height: [0.95, 2.25], cheeks: CHEEK };
    north.build(scene, &[opening]);
    window(scene, &north, &opening);
    radiator(scene, "office, north radiator", north.place().then(Place::new(2.4, 0.0, 0.0, 0.0)), 1.6);

    let east = Wall { name: "office, east wall", from: [EAST, NORTH], to: [EAST, ROOMS] };
    let opening = Opening { along: [2.6, 4.6], height: [0.95, 2.25], cheeks: CHEEK };
    east.build(scene, &[opening]);
    window(scene, &east, &opening);
    picture(scene, &east, Surface::ArtPrint, [5.3, 1.0], [0.9, 0.9]);
    picture(scene, &east, Surface::Noticeboard, [0.3, 0.9], [1.5, 1.0]);
    trunking(scene, &east, [2.4, 6.2], 0.79);

    let south = Wall { name: "office, south wall", from: [EAST, ROOMS], to: [OFFICE, ROOMS] };
    let corridor_door = [EAST - OFFICE_DOOR[1], EAST - OFFICE_DOOR[0]];
    south.build(scene, &[Opening { along: corridor_door, height: [0.0, DOOR], cheeks: 0.0 }]);
    door_frame(scene, &south, corridor_door, DOOR, false);
    open_leaf(scene, &south, [corridor_door[0] - 1.15, corridor_door[0] - 0.02]);

    let west = Wall { name: "office, west wall", from: [OFFICE, ROOMS], to: [OFFICE, NORTH] };
    let inner_door = INNER_DOOR.map(|y| y - ROOMS);
    west.build(scene, &[Opening { along: inner_door, height: [0.0, DOOR], cheeks: 0.0 }]);
    door_frame(scene, &west, inner_door, DOOR, false);
    picture(scene, &west, Surface::RobotPoster, [4.15, 0.45], [0.84, 1.19]);
    picture(scene, &west, Surface::SafetyPoster, [2.05, 0.7], [0.5, 0.7]);
    picture(scene, &west, Surface::Clock, [3.2, 2.25], [0.3, 0.3]);
    picture(scene, &west, Surface::Notice, [2.5, 1.5], [0.21, 0.3]);
    picture(scene, &west, Surface::Flyer, [5.1, 1.2], [0.21, 0.3]);
    low_sockets(scene, &west, 4.2);
    picture(scene, &south, Surface::PeriodicTable, [0.2, 1.0], [1.2, 0.86]);

    slab(scene, "floor, office south", Surface::Carpet, [OFFICE, ROOMS], [EAST, 5.6], 0.0);
    slab(scene, "floor, office north", Surface::Carpet, [OFFICE, 5.6], [EAST, NORTH], 0.0);
    slab(scene, "floor, inner threshold", Surface::Carpet, [BETWEEN, INNER_DOOR[0]], [OFFICE, INNER_DOOR[1]], 0.0);
    slab(scene, "ceiling, office", Surface::CeilingTile, [OFFICE, ROOMS], [EAST, NORTH], CEILING);
    for (index, (x, y)) in [(8.4, 3.9), (10.8, 3.9), (8.4, 7.5), (10.8, 7.5)].into_iter().enumerate() {
        panel(scene, &format!("office, lamp {index}"), [x, y], [1.2, 0.6]);
    }
}

fn furnish(scene: &mut Scene, seed: u64) {
    let screens = [Surface::CodeScreen, Surface::PlotScreen];
    workplace(scene, "east desk", Place::new(11.55, 3.35, 0.0, -90.0), Surface::Walnut, &screens);
    workplace(scene, "second east desk", Place::new(11.55, 5.35, 0.0, -90.0), Surface::Walnut, &screens[..1]);
    partition(scene, "desk screen", Place::new(11.1, 4.35, 0.0, 0.0), 1.7);
    workplace(scene, "north desk", Place::new(10.4, 8.15, 0.0, 0.0), Surface::Walnut, &screens[1..]);
    cabinet(scene, "office cabinet", Place::new(11.7, 7.9, 0.0, -90.0));
    bin(scene, "office, bin", Place::new(10.95, 4.65, 0.0, 0.0), Surface::BlackPlastic);

    // Low shelves across the path's end, tall ones along the west wall.
    for (index, x) in [8.75, 9.67, 10.59].into_iter().enumerate() {
        let place = Place::new(x, 6.62, 0.0, 0.0);
        shelf(
            scene,
            &format!("office low shelf {index}"),
            place,
            3,
            Surface::Oak,
            seed.wrapping_add(10 + index as u64),
        );
    }
    for (index, y) in [2.75, 3.67].into_iter().enumerate() {
        let place = Place::new(7.35, y, 0.0, 90.0);
        shelf(
            scene,
            &format!("office tall shelf {index}"),
            place,
            5,
            Surface::Walnut,
            seed.wrapping_add(20 + index as u64),
        );
    }
    plant(scene, "shelf plant", Kind::Decor, Place::new(9.0, 6.6, 1.2, 0.0), 0.7);
    carton(scene, "office shelf, carton", Kind::Decor, Place::new(10.5, 6.6, 1.2, 12.0), [0.4, 0.28, 0.26]);
    carton(scene, "office shelf, second carton", Kind::Decor, Place::new(9.8, 6.62, 1.2, -8.0), [0.3, 0.24, 0.2]);

    worktop_things(scene, "office shelf, things", Place::new(0.0, 6.6, 1.2, 0.0), [10.1, 10.3], seed.wrapping_add(60));
    flip_chart(scene, Place::new(7.75, 6.75, 0.0, 25.0));
    pallet(scene, "office, parcels", Place::new(11.2, 6.05, 0.0, 160.0));
    computer(scene, "east desk, computer", Place::new(11.2, 2.55, 0.0, -90.0));
    computer(scene, "north desk, computer", Place::new(9.45, 8.3, 0.0, 0.0));
    round_table(scene, "round table", Place::new(8.55, 3.6, 0.0, 0.0));
    papers(scene, "round table, papers", Place::new(8.5, 3.6, DESK, 40.0));
    plain_chair(scene, "round table, chair", Place::new(8.65, 4.3, 0.0, -15.0));
    plain_chair(scene, "round table, second chair", Place::new(8.5, 2.85, 0.0, 170.0));
    plant(scene, "office plant", Kind::Solid, Place::new(7.6, 8.5, 0.0, 30.0), 1.5);
    cabinet(scene, "office west cabinet", Place::new(7.4, 7.75, 0.0, 90.0));
    plant(scene, "office corner plant", Kind::Solid, Place::new(11.65, 6.75, 0.0, 60.0), 1.1);
}
