//! What is fixed to a building or stands in it for everybody: ducts, trunking, sockets, floor markings, a copier.

use super::building::{Wall, picture};
use crate::world::Mesh;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

/// A spiral duct under the ceiling from one point to another, on hangers.
pub(super) fn duct(scene: &mut Scene, name: &str, from: [f32; 3], to: [f32; 3], radius: f32) {
    scene.piece(name, Kind::Decor, Place::new(0.0, 0.0, 0.0, 0.0), |piece| {
        let mapping = piece.mapping(Surface::Duct);
        piece.mesh(Surface::Duct, &Mesh::cylinder(from.into(), to.into(), [radius; 2], 10, mapping));
        for share in [0.15, 0.5, 0.85] {
            let [x, y, z] = [0, 1, 2].map(|axis| from[axis] + share * (to[axis] - from[axis]));
            piece.bar(Surface::Steel, [x, y, z + radius], [x, y, super::CEILING], 0.008);
        }
    });
}

/// Trunking along a wall at the height of desks, with sockets; `along`: from and to, metres.
pub(super) fn trunking(scene: &mut Scene, wall: &Wall, [from, to]: [f32; 2], z: f32) {
    scene.piece(&format!("{}, trunking at {from}", wall.name), Kind::Decor, wall.place(), |piece| {
        piece.cuboid(Surface::Enamel, [from, -0.045, z], [to, 0.0, z + 0.12]);
        piece.cuboid(Surface::GreyCoat, [from, -0.048, z + 0.055], [to, -0.045, z + 0.065]);
        let mut x = from + 0.2;
        while x < to - 0.2 {
            piece.front(Surface::Sockets, [x, x + 0.14], [z + 0.025, z + 0.095], -0.049);
            x += 0.75;
        }
    });
}

/// Sockets low on a wall and the pipe that feeds them.
pub(super) fn low_sockets(scene: &mut Scene, wall: &Wall, along: f32) {
    picture(scene, wall, Surface::Sockets, [along, 0.28], [0.16, 0.08]);
    scene.piece(&format!("{}, conduit at {along}", wall.name), Kind::Decor, wall.place(), |piece| {
        piece.bar(Surface::Enamel, [along + 0.08, -0.012, 0.36], [along + 0.08, -0.012, super::CEILING], 0.011);
    });
}

/// Tape on a floor from corner to corner, `width` metres; straight along x or y.
pub(super) fn tape(scene: &mut Scene, name: &str, surface: Surface, points: &[[f32; 2]], width: f32) {
    for (index, pair) in points.windows(2).enumerate() {
        let [from, to] = [pair[0], pair[1]].map(glam::Vec2::from);
        let (along, middle) = (to - from, from.midpoint(to));
        let yaw_deg = along.y.atan2(along.x).to_degrees();
        let place = Place::new(middle.x, middle.y, 0.0, yaw_deg);
        // Corners are closed.
        let half = 0.5 * (along.length() + width);
        scene.piece(&format!("{name} {index}"), Kind::Decor, place, |piece| {
            piece.top(surface, [-half, half], [-0.5 * width, 0.5 * width], 1e-4 * index as f32);
        });
    }
}

/// Plates over ducts in the floor.
pub(super) fn floor_plates(scene: &mut Scene, name: &str, middles: &[[f32; 2]]) {
    for (index, &[x, y]) in middles.iter().enumerate() {
        scene.piece(&format!("{name} {index}"), Kind::Decor, Place::new(x, y, 0.0, 0.0), |piece| {
            piece.top(Surface::FloorPlate, [-0.2, 0.2], [-0.2, 0.2], 0.0);
        });
    }
}

/// A copier of 0.6 × 0.6 × 1.08 m.
pub(super) fn copier(scene: &mut Scene, place: Place) {
    scene.piece("copier", Kind::Solid, place, |piece| {
        piece.cuboid(Surface::GreyPlastic, [-0.3, -0.29, 0.04], [0.3, 0.29, 1.0]);
        piece.cuboid(Surface::DarkCoat, [-0.27, -0.26, 0.0], [0.27, 0.26, 0.04]);
        piece.front(Surface::Copier, [-0.3, 0.3], [0.04, 1.0], -0.29);
        piece.cuboid(Surface::GreyPlastic, [-0.29, -0.2, 1.0], [0.29, 0.28, 1.08]);
        piece.cuboid(Surface::Paper, [0.3, -0.15, 0.62], [0.5, 0.15, 0.68]);
    });
}

/// A cabinet with a hose and a sign, its back against a wall at y = 0.
pub(super) fn hose_cabinet(scene: &mut Scene, place: Place) {
    scene.piece("hose cabinet", Kind::Solid, place, |piece| {
        piece.cuboid(Surface::RedCoat, [-0.33, -0.2, 0.75], [0.33, 0.0, 1.45]);
        piece.cuboid(Surface::Enamel, [-0.29, -0.205, 0.79], [0.29, -0.2, 1.41]);
        piece.cuboid(Surface::RedCoat, [-0.27, -0.21, 0.81], [0.27, -0.205, 1.39]);
        piece.front(Surface::ExitSign, [-0.16, 0.0], [1.2, 1.36], -0.21);
        piece.front(Surface::Paper, [0.05, 0.2], [1.12, 1.34], -0.21);
        piece.cuboid(Surface::Steel, [0.2, -0.235, 1.0], [0.22, -0.21, 1.12]);
    });
}

/// A water cooler with its bottle.
pub(super) fn water_cooler(scene: &mut Scene, place: Place) {
    scene.piece("water cooler", Kind::Solid, place, |piece| {
        piece.cuboid(Surface::Enamel, [-0.16, -0.16, 0.0], [0.16, 0.16, 0.95]);
        piece.cuboid(Surface::DarkCoat, [-0.13, -0.165, 0.55], [0.13, -0.16, 0.85]);
        for (x, tap) in [(-0.05, Surface::BluePlastic), (0.05, Surface::RedCoat)] {
            piece.cuboid(tap, [x - 0.015, -0.2, 0.76], [x + 0.015, -0.165, 0.8]);
        }
        piece.front(Surface::Flyer, [-0.1, 0.06], [0.2, 0.44], -0.16);
        piece.cone(Surface::BluePlastic, [0.0, 0.0, 0.95], [0.0, 0.0, 1.02], [0.05, 0.13]);
        piece.bar(Surface::BluePlastic, [0.0, 0.0, 1.02], [0.0, 0.0, 1.33], 0.135);
    });
}

/// A flip chart on three legs with a drawing on it.
pub(super) fn flip_chart(scene: &mut Scene, place: Place) {
    scene.piece("flip chart", Kind::Solid, place, |piece| {
        piece.cuboid(Surface::Paper, [-0.35, -0.02, 0.8], [0.35, 0.02, 1.75]);
        piece.front(Surface::Whiteboard, [-0.33, 0.33], [1.1, 1.68], -0.02);
        piece.cuboid(Surface::Steel, [-0.36, -0.05, 0.76], [0.36, 0.03, 0.8]);
        for (x, y) in [(-0.38, -0.2), (0.38, -0.2), (0.0, 0.35)] {
            piece.bar(Surface::DarkCoat, [x, y, 0.0], [0.3 * x, 0.02, 1.74], 0.014);
        }
    });
}

/// A 3D printer on a table of its own, half-way through a part.
pub(super) fn printer_table(scene: &mut Scene, place: Place) {
    scene.piece("printer table", Kind::Solid, place, |piece| {
        let top = 0.7;
        piece.cuboid(Surface::Oak, [-0.35, -0.3, top - 0.03], [0.35, 0.3, top]);
        for (x, y) in [(-0.33, -0.28), (0.29, -0.28), (-0.33, 0.24), (0.29, 0.24)] {
            piece.cuboid(Surface::Steel, [x, y, 0.0], [x + 0.04, y + 0.04, top - 0.03]);
        }
        piece.cuboid(Surface::Oak, [-0.31, -0.26, 0.2], [0.31, 0.26, 0.22]);
        super::things::carton_part(piece, [-0.1, 0.0, 0.22], [0.36, 0.3, 0.24]);
        for (x, y) in [(-0.22, -0.2), (0.18, -0.2), (-0.22, 0.16), (0.18, 0.16)] {
            piece.cuboid(Surface::DarkCoat, [x, y, top], [x + 0.04, y + 0.04, top + 0.5]);
        }
        piece.cuboid(Surface::DarkCoat, [-0.22, -0.2, top], [0.22, 0.2, top + 0.08]);
        piece.cuboid(Surface::DarkCoat, [-0.22, -0.2, top + 0.5], [0.22, 0.2, top + 0.54]);
        piece.cuboid(Surface::Steel, [-0.15, -0.14, top + 0.14], [0.15, 0.14, top + 0.15]);
        piece.cone(Surface::RedCoat, [0.0, 0.0, top + 0.15], [0.0, 0.0, top + 0.26], [0.07, 0.04]);
        piece.bar(Surface::Steel, [-0.18, 0.0, top + 0.36], [0.18, 0.0, top + 0.36], 0.012);
        piece.cuboid(Surface::BlackPlastic, [-0.04, -0.04, top + 0.28], [0.04, 0.04, top + 0.38]);
        piece.front(Surface::PlotScreen, [0.02, 0.17], [top + 0.01, top + 0.07], -0.2);
        piece.bar(Surface::BluePlastic, [-0.22, 0.26, top + 0.3], [-0.05, 0.26, top + 0.3], 0.09);
    });
}

/// A computer that stands on the floor or a board.
pub(super) fn computer(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::DarkCoat, [-0.095, -0.21, 0.0], [0.095, 0.21, 0.44]);
        piece.front(Surface::Computer, [-0.095, 0.095], [0.0, 0.44], -0.21);
    });
}
