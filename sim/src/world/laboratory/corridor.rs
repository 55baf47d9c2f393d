//! The corridor: lockers all alike, bare wall, notices, a window at its end.

use super::building::{Opening, Wall, door_frame, panel, picture, slab, window};
use super::fittings::{copier, floor_plates, hose_cabinet, low_sockets, tape, water_cooler};
use super::furniture::{lockers, plain_chair};
use super::instruments::cable_tray;
use super::storage::{sack_truck, steel_rack};
use super::things::{bin, carton, extinguisher, ladder, plant};
use super::{
    BETWEEN, CEILING, CHEEK, CORRIDOR, DOOR, EAST, LABORATORY_DOOR, OFFICE_DOOR, OUTER_DOOR, OuterDoor, PARTITION,
    ROOMS,
};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

pub(super) fn build(scene: &mut Scene, seed: u64, outer_door: OuterDoor) {
    shell(scene, outer_door);
    fittings(scene);
    things(scene, seed);
}

fn shell(scene: &mut Scene, outer_door: OuterDoor) {
    let doorway = |along: [f32; 2]| Opening { along, height: [0.0, DOOR], cheeks: PARTITION };
    let west_part = Wall { name: "corridor, north-west wall", from: [0.0, CORRIDOR], to: [BETWEEN, CORRIDOR] };
    west_part.build(scene, &[doorway(LABORATORY_DOOR)]);
    door_frame(scene, &west_part, LABORATORY_DOOR, DOOR, false);
    let east_part = Wall { name: "corridor, north-east wall", from: [BETWEEN, CORRIDOR], to: [EAST, CORRIDOR] };
    let office_door = OFFICE_DOOR.map(|x| x - BETWEEN);
    east_part.build(scene, &[doorway(office_door)]);
    door_frame(scene, &east_part, office_door, DOOR, false);
    picture(scene, &west_part, Surface::SciencePoster, [5.35, 0.5], [0.84, 1.19]);
    picture(scene, &west_part, Surface::ExitSign, [3.5, 1.9], [0.4, 0.2]);
    picture(scene, &east_part, Surface::ContourMap, [0.25, 0.7], [1.19, 0.84]);
    picture(scene, &east_part, Surface::Flyer, [1.5, 1.1], [0.21, 0.3]);
    picture(scene, &east_part, Surface::Notice, [3.35, 1.15], [0.21, 0.3]);
    picture(scene, &east_part, Surface::Flyer, [3.62, 1.1], [0.21, 0.3]);
    picture(scene, &east_part, Surface::PeriodicTable, [3.95, 1.05], [1.0, 0.71]);
    extinguisher(scene, east_part.place().then(Place::new(1.72, 0.0, 0.0, 0.0)));
    hose_cabinet(scene, west_part.place().then(Place::new(6.62, 0.0, 0.0, 0.0)));
    low_sockets(scene, &west_part, 5.1);

    let south_east = Wall { name: "corridor, south-east wall", from: [EAST, 0.0], to: [6.0, 0.0] };
    let south_west = Wall { name: "corridor, south-west wall", from: [6.0, 0.0], to: [0.0, 0.0] };
    south_east.build(scene, &[]);
    let leaves = outer_door == OuterDoor::Open;
    let way_out = OUTER_DOOR.map(|x| 6.0 - x);
    let way_out = Opening { along: [way_out[1], way_out[0]], height: [0.0, DOOR], cheeks: 0.0 };
    south_west.build(scene, if leaves { std::slice::from_ref(&way_out) } else { &[] });
    door_frame(scene, &south_east, [0.75, 1.75], DOOR, true);
    door_frame(scene, &south_west, if leaves { way_out.along } else { [2.9, 3.9] }, DOOR, !leaves);
    picture(scene, &south_east, Surface::Noticeboard, [2.4, 0.75], [1.5, 1.0]);
    picture(scene, &south_east, Surface::Notice, [1.95, 1.25], [0.21, 0.3]);
    low_sockets(scene, &south_east, 2.05);
    picture(scene, &south_west, Surface::SafetyPoster, [4.3, 0.7], [0.6, 0.84]);
    picture(scene, &south_west, Surface::Notice, [2.58, 1.2], [0.21, 0.3]);
    picture(scene, &south_west, Surface::Flyer, [4.02, 1.1], [0.21, 0.3]);
    picture(scene, &south_west, Surface::Flyer, [5.0, 0.85], [0.21, 0.3]);
    picture(scene, &south_west, Surface::RobotPoster, [5.3, 0.55], [0.6, 0.85]);
    low_sockets(scene, &south_west, 4.1);

    let east = Wall { name: "corridor, east wall", from: [EAST, CORRIDOR], to: [EAST, 0.0] };
    let opening = Opening { along: [0.55, 1.55], height: [0.85, 2.15], cheeks: CHEEK };
    east.build(scene, &[opening]);
    window(scene, &east, &opening);
    let west = Wall { name: "corridor, west wall", from: [0.0, 0.0], to: [0.0, CORRIDOR] };
    west.build(scene, &[]);
    picture(scene, &west, Surface::ArtPrint, [0.5, 0.9], [0.9, 0.9]);

    slab(scene, "floor, corridor west", Surface::FloorTile, [0.0, 0.0], [6.0, CORRIDOR], 0.0);
    slab(scene, "floor, corridor east", Surface::FloorTile, [6.0, 0.0], [EAST, CORRIDOR], 0.0);
    for (name, [from, to]) in [("laboratory", LABORATORY_DOOR), ("office", OFFICE_DOOR)] {
        slab(scene, &format!("floor, {name} threshold"), Surface::FloorTile, [from, CORRIDOR], [to, ROOMS], 0.0);
    }
    slab(scene, "ceiling, corridor", Surface::CeilingTile, [0.0, 0.0], [EAST, CORRIDOR], CEILING);
}

fn fittings(scene: &mut Scene) {
    for (index, x) in [1.8, 4.8, 7.8, 10.8].into_iter().enumerate() {
        panel(scene, &format!("corridor, lamp {index}"), [x, 1.05], [1.2, 0.3]);
    }
    cable_tray(scene, "corridor, cable tray", [0.0, EAST], 0.35, 2.3);
    // The lane that is to be kept free.
    for (name, y) in [("south", 0.58), ("north", 1.82)] {
        tape(scene, &format!("corridor, lane {name}"), Surface::LaneTape, &[[3.4, y], [8.9, y]], 0.06);
    }
    floor_plates(scene, "corridor, floor plate", &[[3.9, 1.25], [7.4, 1.0], [2.5, 0.75]]);
}

fn things(scene: &mut Scene, seed: u64) {
    // Fronts face north.
    lockers(scene, Place::new(8.0, 0.215, 0.0, 180.0), 8);
    for (index, (x, what)) in
        [(5.4, Surface::Flyer), (6.55, Surface::Notice), (7.42, Surface::Paper)].into_iter().enumerate()
    {
        scene.piece(&format!("locker, note {index}"), Kind::Decor, Place::new(x, 0.428, 0.0, 180.0), |piece| {
            piece.front(what, [-0.1, 0.1], [0.85, 1.14], 0.0);
        });
    }
    carton(scene, "lockers, carton", Kind::Decor, Place::new(5.5, 0.22, 1.88, 172.0), [0.42, 0.32, 0.26]);
    carton(scene, "lockers, second carton", Kind::Decor, Place::new(7.5, 0.22, 1.88, 185.0), [0.36, 0.3, 0.3]);
    copier(scene, Place::new(10.5, 0.32, 0.0, 180.0));
    water_cooler(scene, Place::new(11.1, 0.2, 0.0, 180.0));
    steel_rack(scene, "corridor, rack", Place::new(11.7, 1.02, 0.0, -90.0), 0.9, 3, seed.wrapping_add(30));
    sack_truck(scene, Place::new(10.45, 1.7, 0.0, -20.0));
    ladder(scene, Place::new(0.62, 1.75, 0.0, 90.0));
    bin(scene, "corridor, bin", Place::new(9.9, 0.2, 0.0, 0.0), Surface::BluePlastic);
    plant(scene, "corridor, plant", Kind::Solid, Place::new(11.62, 0.3, 0.0, 0.0), 0.9);
    carton(scene, "corridor, carton", Kind::Solid, Place::new(11.5, 1.75, 0.0, -75.0), [0.5, 0.45, 0.42]);
    carton(scene, "corridor, carton above", Kind::Solid, Place::new(11.52, 1.77, 0.42, -60.0), [0.42, 0.35, 0.3]);
    carton(scene, "corridor, carton beside", Kind::Solid, Place::new(11.0, 1.85, 0.0, -8.0), [0.38, 0.3, 0.34]);
    plain_chair(scene, "corridor, chair", Place::new(1.3, 0.32, 0.0, 180.0));
    plain_chair(scene, "corridor, second chair", Place::new(0.75, 0.32, 0.0, 175.0));
}
