//! What makes it a laboratory: instruments, a robot arm, a fume hood, a rack, pipes and trays.

use super::furniture::BENCH;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

/// An oscilloscope.
pub(super) fn oscilloscope(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        piece.cuboid(Surface::GreyPlastic, [-0.19, -0.1, 0.02], [0.19, 0.1, 0.22]);
        piece.front(Surface::Oscilloscope, [-0.19, 0.19], [0.02, 0.22], -0.1);
        for x in [-0.15, 0.11] {
            piece.cuboid(Surface::BlackPlastic, [x, -0.08, 0.0], [x + 0.04, 0.08, 0.02]);
        }
    });
}

/// Two power supplies, one on the other.
pub(super) fn power_supplies(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        for z in [0.0, 0.17] {
            piece.cuboid(Surface::GreyPlastic, [-0.12, -0.12, z], [0.12, 0.15, z + 0.165]);
            piece.front(Surface::PowerSupply, [-0.12, 0.12], [z, z + 0.165], -0.12);
        }
    });
}

/// A stereo microscope on its stand.
pub(super) fn microscope(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        piece.cuboid(Surface::GreyPlastic, [-0.1, -0.14, 0.0], [0.1, 0.14, 0.03]);
        piece.bar(Surface::Steel, [0.0, 0.1, 0.03], [0.0, 0.1, 0.38], 0.018);
        piece.cuboid(Surface::GreyPlastic, [-0.04, -0.06, 0.22], [0.04, 0.13, 0.30]);
        piece.cone(Surface::BlackPlastic, [0.0, -0.03, 0.1], [0.0, -0.03, 0.22], [0.03, 0.045]);
        for x in [-0.035, 0.035] {
            piece.bar(Surface::BlackPlastic, [x, -0.04, 0.28], [x, -0.13, 0.37], 0.02);
        }
        piece.bar(Surface::Steel, [0.0, -0.03, 0.03], [0.0, -0.03, 0.036], 0.045);
    });
}

/// A jointed arm on a pedestal, arrested in mid-reach.
pub(super) fn robot_arm(scene: &mut Scene, place: Place) {
    scene.piece("robot arm", Kind::Solid, place, |piece| {
        let (shell, joint) = (Surface::GreyPlastic, Surface::BluePlastic);
        piece.cuboid(Surface::DarkCoat, [-0.25, -0.25, 0.0], [0.25, 0.25, 0.55]);
        piece.cuboid(Surface::Steel, [-0.28, -0.28, 0.55], [0.28, 0.28, 0.57]);
        piece.front(Surface::SafetyPoster, [-0.12, 0.12], [0.15, 0.48], -0.25);
        piece.bar(shell, [0.0, 0.0, 0.57], [0.0, 0.0, 0.72], 0.085);
        piece.bar(joint, [-0.11, 0.0, 0.76], [0.11, 0.0, 0.76], 0.075);
        piece.bar(shell, [0.0, 0.0, 0.76], [0.0, 0.16, 1.2], 0.055);
        piece.bar(joint, [-0.09, 0.16, 1.2], [0.09, 0.16, 1.2], 0.065);
        piece.bar(shell, [0.0, 0.16, 1.2], [0.0, -0.24, 1.34], 0.045);
        piece.bar(joint, [-0.07, -0.24, 1.34], [0.07, -0.24, 1.34], 0.05);
        piece.bar(shell, [0.0, -0.24, 1.34], [0.0, -0.28, 1.14], 0.035);
        piece.cuboid(Surface::BlackPlastic, [-0.06, -0.31, 1.1], [0.06, -0.25, 1.14]);
        for x in [-0.05, 0.03] {
            piece.cuboid(Surface::Steel, [x, -0.29, 1.0], [x + 0.02, -0.27, 1.1]);
        }
    });
}

/// A small four-wheeled robot, out of service.
pub(super) fn rover(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::RedCoat, [-0.14, -0.22, 0.08], [0.14, 0.22, 0.22]);
        piece.cuboid(Surface::BlackPlastic, [-0.18, -0.24, 0.22], [0.18, 0.24, 0.24]);
        piece.bar(Surface::Steel, [0.0, 0.05, 0.24], [0.0, 0.05, 0.48], 0.02);
        piece.cuboid(Surface::BlackPlastic, [-0.14, 0.0, 0.48], [0.14, 0.07, 0.52]);
        piece.cuboid(Surface::GreyPlastic, [-0.1, -0.14, 0.24], [0.1, -0.02, 0.32]);
        for (x, y) in [(-0.2, -0.14), (0.2, -0.14), (-0.2, 0.14), (0.2, 0.14)] {
            piece.bar(Surface::BlackPlastic, [x - 0.04, y, 0.11], [x + 0.04, y, 0.11], 0.11);
            piece.bar(Surface::Steel, [x - 0.045, y, 0.11], [x + 0.045, y, 0.11], 0.05);
        }
        for x in [-0.09, 0.0, 0.09] {
            piece.bar(Surface::Steel, [x, -0.225, 0.16], [x, -0.22, 0.16], 0.025);
        }
    });
}

/// A fume hood of 1.3 × 0.8 × 2.3 m with its sash half open.
pub(super) fn fume_hood(scene: &mut Scene, place: Place) {
    scene.piece("fume hood", Kind::Solid, place, |piece| {
        let (case, [left, right]) = (Surface::Enamel, [-0.65, 0.65]);
        piece.cuboid(Surface::GreyCoat, [left, -0.36, 0.0], [right, 0.38, BENCH - 0.05]);
        piece.cuboid(Surface::Resin, [left, -0.4, BENCH - 0.05], [right, 0.4, BENCH]);
        piece.cuboid(case, [left, -0.4, BENCH], [left + 0.1, 0.4, 2.3]);
        piece.cuboid(case, [right - 0.1, -0.4, BENCH], [right, 0.4, 2.3]);
        piece.cuboid(case, [left + 0.1, 0.34, BENCH], [right - 0.1, 0.4, 2.3]);
        piece.cuboid(case, [left + 0.1, -0.4, 1.95], [right - 0.1, 0.34, 2.3]);
        piece.cuboid(Surface::DarkCoat, [left + 0.1, -0.37, 1.45], [right - 0.1, -0.35, 1.5]);
        for unit in 0..2 {
            let x = left + 0.02 + 0.63 * unit as f32;
            piece.front(Surface::DrawerFront, [x, x + 0.62], [0.1, BENCH - 0.07], -0.36);
        }
        piece.front(Surface::SafetyPoster, [-0.2, 0.05], [1.98, 2.28], -0.4);
        for (index, x) in [-0.35, -0.15, 0.1, 0.3].into_iter().enumerate() {
            let surface = [Surface::Walnut, Surface::GreenCoat, Surface::Steel, Surface::BluePlastic][index];
            let height = BENCH + 0.16 + 0.05 * index as f32;
            piece.bar(surface, [x, 0.0, BENCH], [x, 0.0, height], 0.05);
            piece.cone(surface, [x, 0.0, height], [x, 0.0, height + 0.07], [0.05, 0.015]);
        }
    });
}

/// A rack of servers, 0.6 × 0.8 × 1.85 m.
pub(super) fn rack(scene: &mut Scene, place: Place) {
    scene.piece("rack", Kind::Solid, place, |piece| {
        piece.cuboid(Surface::DarkCoat, [-0.3, -0.4, 0.05], [0.3, 0.4, 1.85]);
        piece.front(Surface::RackFront, [-0.3, 0.3], [0.05, 1.85], -0.4);
        for x in [-0.28, 0.22] {
            piece.cuboid(Surface::BlackPlastic, [x, -0.36, 0.0], [x + 0.06, 0.36, 0.05]);
        }
    });
}

/// Two gas bottles chained to a wall at y = 0.
pub(super) fn gas_bottles(scene: &mut Scene, place: Place) {
    scene.piece("gas bottles", Kind::Solid, place, |piece| {
        for (x, shoulder) in [(-0.15, Surface::RedCoat), (0.15, Surface::GreenCoat)] {
            let y = -0.17;
            piece.bar(Surface::GreyCoat, [x, y, 0.0], [x, y, 1.25], 0.115);
            piece.cone(shoulder, [x, y, 1.25], [x, y, 1.42], [0.115, 0.04]);
            piece.bar(Surface::Steel, [x, y, 1.42], [x, y, 1.52], 0.025);
            piece.bar(Surface::Steel, [x - 0.05, y, 1.5], [x + 0.05, y, 1.5], 0.015);
            piece.front(Surface::Paper, [x - 0.05, x + 0.05], [0.8, 1.0], y - 0.116);
        }
        piece.cuboid(Surface::Steel, [-0.3, -0.3, 0.95], [0.3, -0.29, 0.99]);
        piece.cuboid(Surface::Steel, [-0.3, -0.3, 0.95], [-0.29, 0.0, 0.99]);
        piece.cuboid(Surface::Steel, [0.29, -0.3, 0.95], [0.3, 0.0, 0.99]);
    });
}

/// A shelf over a bench, on posts, `width` metres, with things on it.
pub(super) fn gantry(scene: &mut Scene, name: &str, place: Place, width: f32) {
    let half = 0.5 * width;
    scene.piece(name, Kind::Solid, place, |piece| {
        for x in [-half, -0.02, half - 0.04] {
            piece.cuboid(Surface::Steel, [x, -0.02, BENCH], [x + 0.04, 0.02, 1.75]);
        }
        for z in [1.32, 1.65] {
            piece.cuboid(Surface::Oak, [-half, -0.15, z], [half, 0.15, z + 0.025]);
        }
        piece.cuboid(Surface::GreyCoat, [-half, -0.03, 1.0], [half, 0.03, 1.08]);
        piece.front(Surface::Binders, [-half + 0.1, -half + 0.9], [1.345, 1.635], -0.08);
        piece.cuboid(Surface::Cardboard, [-half + 0.1, -0.08, 1.345], [-half + 0.9, 0.1, 1.62]);
        for (index, x) in [0.2f32, 0.55, 0.95].into_iter().enumerate() {
            let x = x.min(half - 0.2);
            let surface = [Surface::BluePlastic, Surface::GreyPlastic, Surface::RedCoat][index];
            super::things::crate_part(piece, surface, [x, 0.0, 1.345], [0.28, 0.26, 0.16 + 0.04 * index as f32]);
        }
    });
}

/// A wheeled trolley with a crate and an instrument.
pub(super) fn trolley(scene: &mut Scene, place: Place) {
    scene.piece("trolley", Kind::Solid, place, |piece| {
        for z in [0.15, 0.5, 0.85] {
            piece.cuboid(Surface::Steel, [-0.4, -0.25, z], [0.4, 0.25, z + 0.025]);
        }
        for (x, y) in [(-0.38, -0.23), (0.38, -0.23), (-0.38, 0.23), (0.38, 0.23)] {
            piece.bar(Surface::Steel, [x, y, 0.08], [x, y, 0.95], 0.015);
            piece.bar(Surface::BlackPlastic, [x - 0.015, y, 0.045], [x + 0.015, y, 0.045], 0.045);
        }
        super::things::crate_part(piece, Surface::BluePlastic, [-0.15, 0.0, 0.175], [0.4, 0.35, 0.22]);
        super::things::carton_part(piece, [0.1, 0.0, 0.525], [0.45, 0.36, 0.26]);
    });
    oscilloscope(scene, "trolley, oscilloscope", place.then(Place::new(-0.1, 0.0, 0.875, 0.0)));
}

/// A ladder-like tray with cables, from `from` to `to` along x at height `z`; and two pipes beside it.
pub(super) fn cable_tray(scene: &mut Scene, name: &str, [from, to]: [f32; 2], y: f32, z: f32) {
    scene.piece(name, Kind::Decor, Place::new(0.0, y, z, 0.0), |piece| {
        for side in [-0.15, 0.13] {
            piece.cuboid(Surface::Steel, [from, side, 0.0], [to, side + 0.02, 0.06]);
        }
        let mut x = from + 0.2;
        while x < to {
            piece.cuboid(Surface::Steel, [x, -0.13, 0.0], [x + 0.03, 0.13, 0.015]);
            x += 0.5;
        }
        for (cable, surface) in [Surface::BlackPlastic, Surface::BluePlastic, Surface::RedCoat].into_iter().enumerate()
        {
            let offset = 0.06 * cable as f32 - 0.06;
            piece.bar(surface, [from, offset, 0.03], [to, offset, 0.03], 0.012);
        }
        piece.bar(Surface::Enamel, [from, 0.32, 0.02], [to, 0.32, 0.02], 0.035);
        piece.bar(Surface::RedCoat, [from, 0.43, 0.03], [to, 0.43, 0.03], 0.022);
    });
}
