//! Desks, chairs, shelves, cabinets, benches. Each stands on its place's origin, its front towards −y.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::things::{carton_part, crate_part, input_devices, monitor, papers};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::Place;

/// Height of desks, metres (DIN EN 527: 0.74 ± 0.02).
pub(super) const DESK: f32 = 0.74;
/// Height of laboratory benches, to work at standing, metres.
pub(super) const BENCH: f32 = 0.90;

/// A desk of 1.6 × 0.8 m with a drawer pedestal.
pub(super) fn desk(scene: &mut Scene, name: &str, place: Place, top: Surface) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(top, [-0.8, -0.4, DESK - 0.028], [0.8, 0.4, DESK]);
        for x in [-0.76, 0.71] {
            piece.cuboid(Surface::DarkCoat, [x, -0.36, 0.03], [x + 0.05, -0.31, DESK - 0.028]);
            piece.cuboid(Surface::DarkCoat, [x, 0.31, 0.03], [x + 0.05, 0.36, DESK - 0.028]);
            piece.cuboid(Surface::DarkCoat, [x, -0.38, 0.0], [x + 0.05, 0.38, 0.03]);
        }
        piece.cuboid(Surface::GreyCoat, [-0.71, 0.33, 0.3], [0.71, 0.345, DESK - 0.03]);
        piece.cuboid(Surface::GreyCoat, [0.26, -0.33, 0.05], [0.68, 0.25, 0.65]);
        piece.front(Surface::DrawerFront, [0.26, 0.68], [0.05, 0.65], -0.33);
    });
}

/// A desk with screens, input devices, papers and a chair.
pub(super) fn workplace(scene: &mut Scene, name: &str, place: Place, top: Surface, screens: &[Surface]) {
    desk(scene, name, place, top);
    let on = |x: f32, y: f32, yaw_deg: f32| place.then(Place::new(x, y, DESK, yaw_deg));
    for (index, &screen) in screens.iter().enumerate() {
        let x = 0.6 * (index as f32 - 0.5 * (screens.len() as f32 - 1.0)) - 0.1;
        monitor(scene, &format!("{name}, screen {index}"), on(x, 0.15, -20.0 * x), screen);
    }
    input_devices(scene, &format!("{name}, input devices"), on(-0.1, -0.2, 4.0));
    papers(scene, &format!("{name}, papers"), on(0.55, -0.15, 10.0));
    office_chair(scene, &format!("{name}, chair"), place.then(Place::new(-0.15, -0.62, 0.0, 165.0)));
}

/// A swivel chair on five castors.
pub(super) fn office_chair(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        let (cloth, black) = (Surface::BlueFabric, Surface::BlackPlastic);
        piece.cuboid(cloth, [-0.24, -0.24, 0.44], [0.24, 0.22, 0.52]);
        piece.cuboid(cloth, [-0.22, 0.22, 0.6], [0.22, 0.28, 1.08]);
        piece.cuboid(black, [-0.04, 0.2, 0.42], [0.04, 0.25, 0.7]);
        piece.bar(Surface::Steel, [0.0, 0.0, 0.1], [0.0, 0.0, 0.44], 0.03);
        for x in [-0.28, 0.24] {
            piece.cuboid(black, [x, -0.15, 0.66], [x + 0.04, 0.12, 0.69]);
            piece.cuboid(black, [x, -0.03, 0.44], [x + 0.04, 0.03, 0.66]);
        }
        for leg in 0..5 {
            let (sin, cos) = (1.256_637 * leg as f32 + 0.3).sin_cos();
            piece.bar(black, [0.0, 0.0, 0.1], [0.28 * cos, 0.28 * sin, 0.075], 0.022);
            piece.bar(black, [0.29 * cos - 0.02, 0.29 * sin, 0.03], [0.29 * cos + 0.02, 0.29 * sin, 0.03], 0.03);
        }
    });
}

/// A four-legged chair for visitors.
pub(super) fn plain_chair(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::Oak, [-0.21, -0.21, 0.44], [0.21, 0.21, 0.46]);
        piece.cuboid(Surface::Oak, [-0.2, 0.2, 0.62], [0.2, 0.22, 0.86]);
        for x in [-0.19, 0.19] {
            piece.bar(Surface::Steel, [x, -0.19, 0.0], [x, -0.19, 0.44], 0.012);
            piece.bar(Surface::Steel, [x, 0.2, 0.0], [x, 0.2, 0.86], 0.012);
        }
    });
}

/// A round stool.
pub(super) fn stool(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.bar(Surface::BlackPlastic, [0.0, 0.0, 0.58], [0.0, 0.0, 0.64], 0.17);
        piece.bar(Surface::Steel, [0.0, 0.0, 0.04], [0.0, 0.0, 0.58], 0.025);
        piece.cone(Surface::Steel, [0.0, 0.0, 0.0], [0.0, 0.0, 0.04], [0.2, 0.17]);
    });
}

/// A round table.
pub(super) fn round_table(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.bar(Surface::Walnut, [0.0, 0.0, DESK - 0.03], [0.0, 0.0, DESK], 0.45);
        piece.bar(Surface::Steel, [0.0, 0.0, 0.03], [0.0, 0.0, DESK - 0.03], 0.04);
        piece.cone(Surface::DarkCoat, [0.0, 0.0, 0.0], [0.0, 0.0, 0.03], [0.28, 0.26]);
    });
}

/// An open shelf of 0.9 × 0.34 m, filled as chance would have it.
pub(super) fn shelf(scene: &mut Scene, name: &str, place: Place, boards: u32, frame: Surface, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    scene.piece(name, Kind::Solid, place, |piece| {
        let (pitch, [left, right], [near, far]) = (0.38, [-0.45, 0.45], [-0.17, 0.17]);
        let height = pitch * boards as f32 + 0.06;
        for x in [left, right - 0.02] {
            piece.cuboid(frame, [x, near, 0.0], [x + 0.02, far, height]);
        }
        piece.cuboid(frame, [left + 0.02, far - 0.01, 0.0], [right - 0.02, far, height]);
        for board in 0..=boards {
            let z = 0.04 + pitch * board as f32;
            piece.cuboid(frame, [left + 0.02, near, z], [right - 0.02, far - 0.01, z + 0.02]);
            if board < boards {
                fill_board(piece, z + 0.02, &mut random);
            }
        }
    });
}

/// Something for a shelf board at height `z`.
fn fill_board(piece: &mut Piece, z: f32, random: &mut impl Rng) {
    let row = |piece: &mut Piece, surface: Surface, [left, right]: [f32; 2], height: f32| {
        piece.cuboid(Surface::Cardboard, [left, -0.1, z], [right, 0.12, z + 0.96 * height]);
        piece.front(surface, [left, right], [z, z + height], -0.1);
    };
    match random.random_range(0..7) {
        0 => row(piece, Surface::Books, [-0.42, 0.42], 0.28),
        1 => row(piece, Surface::OldBooks, [-0.42, 0.30], 0.27),
        2 => row(piece, Surface::Binders, [-0.42, 0.42], 0.31),
        3 => {
            row(piece, Surface::Books, [-0.1, 0.42], 0.27);
            carton_part(piece, [-0.27, 0.0, z], [0.28, 0.26, 0.2]);
        }
        4 => {
            for (index, x) in [-0.28, 0.0, 0.28].into_iter().enumerate() {
                let surface = [Surface::BluePlastic, Surface::RedCoat, Surface::GreyPlastic][index];
                crate_part(piece, surface, [x, 0.0, z], [0.26, 0.28, random.random_range(0.14..0.24)]);
            }
        }
        5 => {
            carton_part(piece, [-0.2, 0.0, z], [0.38, 0.28, 0.26]);
            carton_part(piece, [0.22, -0.01, z], [0.3, 0.26, 0.17]);
            carton_part(piece, [0.2, 0.0, z + 0.17], [0.22, 0.2, 0.1]);
        }
        _ => {
            row(piece, Surface::OldBooks, [0.05, 0.42], 0.26);
            piece.bar(Surface::Steel, [-0.3, 0.0, z], [-0.3, 0.0, z + 0.22], 0.07);
            piece.bar(Surface::GreenCoat, [-0.12, 0.02, z], [-0.12, 0.02, z + 0.15], 0.05);
        }
    }
}

/// A steel cabinet of 0.9 × 0.45 × 1.9 m with two doors.
pub(super) fn cabinet(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::GreyCoat, [-0.45, -0.22, 0.06], [0.45, 0.22, 1.9]);
        piece.cuboid(Surface::DarkCoat, [-0.44, -0.2, 0.0], [0.44, 0.2, 0.06]);
        piece.front(Surface::CabinetFront, [-0.449, 0.449], [0.062, 1.898], -0.22);
        piece.cuboid(Surface::DarkCoat, [-0.05, -0.25, 0.95], [-0.03, -0.22, 1.1]);
    });
}

/// A row of equal lockers of 0.4 × 0.42 × 1.8 m, from the origin to the right.
pub(super) fn lockers(scene: &mut Scene, place: Place, count: u32) {
    for locker in 0..count {
        let here = place.then(Place::new(0.4 * locker as f32 + 0.2, 0.0, 0.0, 0.0));
        scene.piece(&format!("locker {locker}"), Kind::Solid, here, |piece| {
            piece.cuboid(Surface::GreyCoat, [-0.2, -0.21, 0.08], [0.2, 0.21, 1.88]);
            piece.cuboid(Surface::DarkCoat, [-0.19, -0.18, 0.0], [0.19, 0.2, 0.08]);
            piece.front(Surface::LockerFront, [-0.199, 0.199], [0.082, 1.878], -0.21);
        });
    }
}

/// A laboratory bench, `width` × 0.75 m, with cupboards below.
pub(super) fn bench(scene: &mut Scene, name: &str, place: Place, width: f32) {
    let half = 0.5 * width;
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::Resin, [-half, -0.375, BENCH - 0.04], [half, 0.375, BENCH]);
        piece.cuboid(Surface::DarkCoat, [-half + 0.05, -0.3, 0.0], [half - 0.05, 0.36, 0.1]);
        piece.cuboid(Surface::GreyCoat, [-half + 0.02, -0.34, 0.1], [half - 0.02, 0.37, BENCH - 0.04]);
        let count = (width / 0.5).round();
        let wide = (width - 0.04) / count;
        for unit in 0..count as u32 {
            let left = -half + 0.02 + wide * unit as f32;
            piece.front(Surface::DrawerFront, [left + 0.005, left + wide - 0.005], [0.11, BENCH - 0.05], -0.34);
        }
    });
}

/// An upholstered screen of 1.3 m height between desks, `width` metres.
pub(super) fn partition(scene: &mut Scene, name: &str, place: Place, width: f32) {
    let half = 0.5 * width;
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::GreyFabric, [-half, -0.02, 0.08], [half, 0.02, 1.3]);
        for x in [-half, half - 0.03] {
            piece.cuboid(Surface::Steel, [x, -0.025, 0.05], [x + 0.03, 0.025, 1.32]);
            piece.cuboid(Surface::DarkCoat, [x, -0.2, 0.0], [x + 0.03, 0.2, 0.05]);
        }
        piece.front(Surface::Paper, [-0.3 * half, -0.3 * half + 0.21], [0.9, 1.2], -0.02);
        piece.front(Surface::ContourMap, [0.05 * half, 0.05 * half + 0.42], [0.88, 1.18], -0.02);
    });
}

/// A ribbed radiator below a window, `width` metres, its back against a wall at y = 0.
pub(super) fn radiator(scene: &mut Scene, name: &str, place: Place, width: f32) {
    let half = 0.5 * width;
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cuboid(Surface::Enamel, [-half, -0.13, 0.15], [half, -0.04, 0.75]);
        piece.front(Surface::Radiator, [-half, half], [0.15, 0.75], -0.13);
        piece.bar(Surface::Enamel, [half + 0.05, -0.08, 0.0], [half + 0.05, -0.08, 0.6], 0.012);
    });
}
