//! The corridor: lockers all alike, bare wall, notices, a window at its end.

use super::building::{Opening, Wall, door_frame, panel, picture, slab, window};
use super::furniture::{lockers, plain_chair};
use super::instruments::cable_tray;
use super::things::{bin, carton, extinguisher, ladder, plant};
use super::{BETWEEN, CEILING, CHEEK, CORRIDOR, DOOR, EAST, LABORATORY_DOOR, OFFICE_DOOR, PARTITION, ROOMS};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

pub(super) fn build(scene: &mut Scene, _seed: u64) {
    shell(scene);
    fittings(scene);
    things(scene);
}

fn shell(scene: &mut Scene) {
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
    extinguisher(scene, east_part.place().then(Place::new(1.72, 0.0, 0.0, 0.0)));

    let south_east = Wall { name: "corridor, south-east wall", from: [EAST, 0.0], to: [6.0, 0.0] };
    let south_west = Wall { name: "corridor, south-west wall", from: [6.0, 0.0], to: [0.0, 0.0] };
    south_east.build(scene, &[]);
    south_west.build(scene, &[]);
    door_frame(scene, &south_east, [0.75, 1.75], DOOR, true);
    door_frame(scene, &south_west, [2.9, 3.9], DOOR, true);
    picture(scene, &south_east, Surface::Noticeboard, [2.4, 0.75], [1.5, 1.0]);
    picture(scene, &south_west, Surface::SafetyPoster, [4.3, 0.7], [0.6, 0.84]);

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
}

fn things(scene: &mut Scene) {
    // Fronts face north.
    lockers(scene, Place::new(8.0, 0.215, 0.0, 180.0), 8);
    ladder(scene, Place::new(0.62, 1.75, 0.0, 90.0));
    bin(scene, "corridor, bin", Place::new(9.9, 0.2, 0.0, 0.0), Surface::BluePlastic);
    plant(scene, "corridor, plant", Kind::Solid, Place::new(11.65, 0.35, 0.0, 0.0), 1.2);
    carton(scene, "corridor, carton", Kind::Solid, Place::new(11.5, 1.75, 0.0, -75.0), [0.5, 0.45, 0.42]);
    carton(scene, "corridor, carton above", Kind::Solid, Place::new(11.52, 1.77, 0.42, -60.0), [0.42, 0.35, 0.3]);
    carton(scene, "corridor, carton beside", Kind::Solid, Place::new(11.0, 1.85, 0.0, -8.0), [0.38, 0.3, 0.34]);
    plain_chair(scene, "corridor, chair", Place::new(1.3, 0.32, 0.0, 180.0));
    plain_chair(scene, "corridor, second chair", Place::new(0.75, 0.32, 0.0, 175.0));
}
