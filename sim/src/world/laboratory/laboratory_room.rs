//! The laboratory room: benches with instruments, a fume hood, a robot arm, cabinets all alike; tiled.

use super::building::{Opening, Wall, door_frame, open_leaf, panel, picture, slab, window};
use super::fittings::{computer, duct, floor_plates, printer_table, tape, trunking};
use super::furniture::{BENCH, bench, cabinet, radiator, shelf, stool, workplace};
use super::instruments::{
    cable_tray, fume_hood, gantry, gas_bottles, microscope, oscilloscope, power_supplies, rack, robot_arm, rover,
    trolley,
};
use super::storage::{bottles, pallet, steel_rack, worktop_things};
use super::things::{bin, carton, input_devices, monitor, papers};
use super::{BETWEEN, CEILING, CHEEK, DOOR, INNER_DOOR, LABORATORY_DOOR, NORTH, PARTITION, ROOMS};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

pub(super) fn build(scene: &mut Scene, seed: u64) {
    shell(scene);
    benches(scene, seed);
    rest(scene, seed);
    markings(scene);
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
    picture(scene, &east, Surface::PeriodicTable, [5.1, 0.95], [1.4, 1.0]);
    picture(scene, &east, Surface::Flyer, [2.5, 1.1], [0.21, 0.3]);
    picture(scene, &east, Surface::Notice, [4.15, 1.25], [0.21, 0.3]);

    let south = Wall { name: "laboratory, south wall", from: [BETWEEN, ROOMS], to: [0.0, ROOMS] };
    let corridor_door = [BETWEEN - LABORATORY_DOOR[1], BETWEEN - LABORATORY_DOOR[0]];
    south.build(scene, &[Opening { along: corridor_door, height: [0.0, DOOR], cheeks: 0.0 }]);
    door_frame(scene, &south, corridor_door, DOOR, false);
    open_leaf(scene, &south, [corridor_door[0] - 1.15, corridor_door[0] - 0.02]);
    picture(scene, &south, Surface::Clock, [3.1, 2.2], [0.3, 0.3]);
    picture(scene, &south, Surface::SafetyPoster, [5.1, 0.85], [0.5, 0.7]);
    picture(scene, &south, Surface::ToolBoard, [1.4, 1.15], [1.2, 0.8]);
    picture(scene, &south, Surface::Notice, [3.5, 1.35], [0.21, 0.3]);
    picture(scene, &south, Surface::ExitSign, [4.2, 2.25], [0.4, 0.2]);
    trunking(scene, &south, [0.1, 2.6], 0.95);

    let west = Wall { name: "laboratory, west wall", from: [0.0, ROOMS], to: [0.0, NORTH] };
    west.build(scene, &[]);
    picture(scene, &west, Surface::Whiteboard, [2.62, 0.95], [2.0, 1.2]);
    trunking(scene, &west, [2.4, 4.6], 0.78);

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

fn benches(scene: &mut Scene, seed: u64) {
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
    for (index, [from, to]) in [[0.86, 0.9], [2.92, 3.0], [4.35, 4.4]].into_iter().enumerate() {
        let name = format!("north bench, things {index}");
        worktop_things(
            scene,
            &name,
            Place::new(0.0, 8.55, BENCH, 0.0),
            [from, to],
            seed.wrapping_add(40 + index as u64),
        );
    }
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
    for (index, (x, heights)) in
        [(3.26, &[0.2, 0.26][..]), (3.86, &[0.24, 0.18]), (5.65, &[0.26, 0.22])].into_iter().enumerate()
    {
        bottles(scene, &format!("island, bottles {index}"), Place::new(x, 6.42, BENCH, 0.0), heights);
    }
    // On the gantries' upper boards.
    for (index, along) in [[3.3, 4.5], [4.9, 6.1]].into_iter().enumerate() {
        let (name, place) = (format!("island, things {index}"), Place::new(0.0, 6.85, 1.675, 0.0));
        worktop_things(scene, &name, place, along, seed.wrapping_add(50 + index as u64));
    }
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
    steel_rack(scene, "west rack", Place::new(0.26, 4.54, 0.0, 90.0), 0.84, 4, seed.wrapping_add(31));
    steel_rack(scene, "low west rack", Place::new(0.26, 5.8, 0.0, 90.0), 1.3, 1, seed.wrapping_add(32));
    printer_table(scene, Place::new(4.45, 3.75, 0.0, -90.0));
    pallet(scene, "laboratory, pallet", Place::new(4.55, 2.75, 0.0, -80.0));
    computer(scene, "laboratory desk, computer", Place::new(6.85, 2.95, 0.0, 180.0));
    computer(scene, "robot arm, controller", Place::new(0.95, 6.75, 0.0, 70.0));
    radiator(scene, "laboratory, radiator", Place::new(0.0, 8.25, 0.0, 90.0), 0.8);
}

fn markings(scene: &mut Scene) {
    duct(scene, "laboratory, duct", [0.6, 2.35, 2.45], [0.6, 8.9, 2.45], 0.14);
    // Where the arm reaches.
    let arm = [[0.95, 6.0], [2.0, 6.0], [2.0, 7.1], [0.95, 7.1], [0.95, 6.0]];
    tape(scene, "laboratory, hazard tape", Surface::HazardTape, &arm, 0.08);
    tape(scene, "laboratory, lane south", Surface::LaneTape, &[[3.4, 5.1], [6.9, 5.1]], 0.06);
    tape(scene, "laboratory, lane north", Surface::LaneTape, &[[3.4, 6.1], [6.9, 6.1]], 0.06);
    tape(scene, "laboratory, parking", Surface::LaneTape, &[[0.8, 3.55], [1.8, 3.55], [1.8, 4.5], [0.8, 4.5]], 0.06);
    floor_plates(scene, "laboratory, floor plate", &[[3.5, 4.2], [5.2, 5.6], [2.2, 6.9], [2.75, 3.0]]);
}
