//! The laboratory room: benches with instruments, a fume hood, a robot arm, cabinets all alike; tiled.

use super::building::{Opening, Wall, door_frame, open_leaf, panel, picture, slab, window};
use super::furniture::{BENCH, bench, cabinet, radiator, shelf, stool, workplace};
use super::instruments::{
    cable_tray, fume_hood, gantry, gas_bottles, microscope, oscilloscope, power_supplies, rack, robot_arm, rover,
    trolley,
};
use super::things::{bin, carton, input_devices, monitor, papers};
use super::{BETWEEN, CEILING, CHEEK, DOOR, INNER_DOOR, LABORATORY_DOOR, NORTH, PARTITION, ROOMS};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

pub(super) fn build(scene: &mut Scene, seed: u64) {
    shell(scene);
    benches(scene);
    rest(scene, seed);
}

fn shell(scene: &mut Scene) {
    let north = Wall { name: "laboratory, north wall", from: [0.0, NORTH], to: [BETWEEN, NORTH] };
    let openings = [[0.7, 2.5], [3.2, 5.0]].map(|along| Opening { along, height: [1.2, 2.25], cheeks: CHEEK });
    north.build(scene, &openings);
    for opening in &openings {
        window(scene, &north, opening);
    }
    let east = Wall { name: "laboratory, east wall", from: [BETWEEN, NORTH], to: [BETWEEN, ROOMS] };
    let inner_door = [NORTH - INNER_DOOR[1], NORTH - INNER_DOOR[0]];
    east.build(scene, &[Opening { along: inner_door, height: [0.0, DOOR], cheeks: PARTITION }]);
    door_frame(scene, &east, inner_door, DOOR, false);
    picture(scene, &east, Surface::SciencePoster, [1.5, 0.7], [0.84, 1.19]);

    let south = Wall { name: "laboratory, south wall", from: [BETWEEN, ROOMS], to: [0.0, ROOMS] };
    let corridor_door = [BETWEEN - LABORATORY_DOOR[1], BETWEEN - LABORATORY_DOOR[0]];
    south.build(scene, &[Opening { along: corridor_door, height: [0.0, DOOR], cheeks: 0.0 }]);
    door_frame(scene, &south, corridor_door, DOOR, false);
    open_leaf(scene, &south, [corridor_door[0] - 1.15, corridor_door[0] - 0.02]);
    picture(scene, &south, Surface::Clock, [3.1, 2.2], [0.3, 0.3]);
    picture(scene, &south, Surface::SafetyPoster, [5.1, 0.85], [0.5, 0.7]);

    let west = Wall { name: "laboratory, west wall", from: [0.0, ROOMS], to: [0.0, NORTH] };
    west.build(scene, &[]);
    picture(scene, &west, Surface::Whiteboard, [2.25, 0.65], [2.0, 1.2]);

    slab(scene, "floor, laboratory south", Surface::FloorTile, [0.0, ROOMS], [BETWEEN, 5.6], 0.0);
    slab(scene, "floor, laboratory north", Surface::FloorTile, [0.0, 5.6], [BETWEEN, NORTH], 0.0);
    slab(scene, "ceiling, laboratory", Surface::CeilingTile, [0.0, ROOMS], [BETWEEN, NORTH], CEILING);
    for (index, (x, y)) in
        [(1.8, 3.9), (3.6, 3.9), (5.4, 3.9), (1.8, 7.5), (3.6, 7.5), (5.4, 7.5)].into_iter().enumerate()
    {
        panel(scene, &format!("laboratory, lamp {index}"), [x, y], [1.2, 0.6]);
    }
    cable_tray(scene, "laboratory, cable tray", [0.0, BETWEEN], 5.5, 2.42);
}

fn benches(scene: &mut Scene) {
    for (index, x) in [1.1, 2.7, 4.3].into_iter().enumerate() {
        bench(scene, &format!("north bench {index}"), Place::new(x, 8.6, 0.0, 0.0), 1.6);
    }
    let north = |x: f32, yaw_deg: f32| Place::new(x, 8.6, BENCH, yaw_deg);
    microscope(scene, "north bench, microscope", north(0.7, 15.0));
    power_supplies(scene, "north bench, power supplies", north(1.3, 0.0));
    oscilloscope(scene, "north bench, oscilloscope", north(1.75, -8.0));
    monitor(scene, "north bench, screen", north(2.6, 5.0), Surface::PlotScreen);
    input_devices(scene, "north bench, input devices", Place::new(2.6, 8.35, BENCH, 5.0));
    carton(scene, "north bench, carton", Kind::Decor, north(3.5, 20.0), [0.4, 0.3, 0.28]);
    oscilloscope(scene, "north bench, second oscilloscope", north(4.1, 6.0));
    microscope(scene, "north bench, second microscope", north(4.75, -20.0));
    fume_hood(scene, Place::new(6.2, 8.58, 0.0, 0.0));
    stool(scene, "north stool", Place::new(2.2, 7.95, 0.0, 0.0));
    stool(scene, "second north stool", Place::new(4.0, 7.9, 0.0, 40.0));

    // The island's front looks at the path, to its south.
    for (index, x) in [4.0, 5.6].into_iter().enumerate() {
        bench(scene, &format!("island bench {index}"), Place::new(x, 6.65, 0.0, 0.0), 1.6);
    }
    gantry(scene, "island gantry", Place::new(4.0, 6.85, 0.0, 0.0), 1.5);
    gantry(scene, "second island gantry", Place::new(5.6, 6.85, 0.0, 0.0), 1.5);
    let island = |x: f32, yaw_deg: f32| Place::new(x, 6.55, BENCH, yaw_deg);
    oscilloscope(scene, "island, oscilloscope", island(3.6, 12.0));
    power_supplies(scene, "island, power supplies", island(4.2, -6.0));
    papers(scene, "island, papers", island(4.65, 20.0));
    monitor(scene, "island, screen", island(5.3, -10.0), Surface::CodeScreen);
    microscope(scene, "island, microscope", island(5.9, 0.0));
    carton(scene, "island, carton", Kind::Decor, island(6.2, -15.0), [0.26, 0.22, 0.18]);
}

fn rest(scene: &mut Scene, seed: u64) {
    // Low shelves between path and desks; they show their books to the path.
    for (index, x) in [4.2, 5.12, 6.04].into_iter().enumerate() {
        let place = Place::new(x, 4.72, 0.0, 180.0);
        shelf(scene, &format!("low shelf {index}"), place, 3, Surface::Oak, seed.wrapping_add(index as u64));
    }
    carton(scene, "shelf, carton", Kind::Decor, Place::new(4.3, 4.72, 1.2, 170.0), [0.36, 0.28, 0.24]);
    carton(scene, "shelf, second carton", Kind::Decor, Place::new(5.9, 4.74, 1.2, 192.0), [0.3, 0.26, 0.3]);
    let screens = [Surface::CodeScreen, Surface::PlotScreen];
    workplace(scene, "laboratory desk", Place::new(5.9, 2.85, 0.0, 180.0), Surface::Oak, &screens);
    bin(scene, "laboratory, bin", Place::new(6.75, 3.75, 0.0, 0.0), Surface::GreyPlastic);

    // All alike, along the west wall, beside the whiteboard.
    for (index, y) in [2.72, 3.64, 7.3].into_iter().enumerate() {
        cabinet(scene, &format!("west cabinet {index}"), Place::new(0.24, y, 0.0, 90.0));
    }
    robot_arm(scene, Place::new(1.45, 6.5, 0.0, 60.0));
    trolley(scene, Place::new(1.2, 5.1, 0.0, 100.0));
    rover(scene, "parked rover", Place::new(1.3, 4.05, 0.0, 140.0));
    rack(scene, Place::new(1.25, 2.68, 0.0, 180.0));
    gas_bottles(scene, Place::new(6.99, 4.5, 0.0, -90.0));
    radiator(scene, "laboratory, radiator", Place::new(0.0, 8.25, 0.0, 90.0), 0.8);
}
