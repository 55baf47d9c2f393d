//! Where a laboratory keeps its things: open steel racks, stacks on the floor, what crowds worktops.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::things::{carton_part, crate_part};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::Place;

/// From board to board of a steel rack, metres.
const PITCH: f32 = 0.42;

/// An open steel rack, `width` × 0.45 m, filled as chance would have it.
pub(super) fn steel_rack(scene: &mut Scene, name: &str, place: Place, width: f32, boards: u32, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    scene.piece(name, Kind::Solid, place, |piece| {
        let (half, depth) = (0.5 * width, 0.225);
        let height = PITCH * boards as f32 + 0.12;
        for (x, y) in [(-half, -depth), (half - 0.035, -depth), (-half, depth - 0.035), (half - 0.035, depth - 0.035)] {
            piece.cuboid(Surface::BluePlastic, [x, y, 0.0], [x + 0.035, y + 0.035, height]);
        }
        for board in 0..=boards {
            let z = 0.06 + PITCH * board as f32;
            piece.cuboid(Surface::GreyCoat, [-half + 0.035, -depth, z], [half - 0.035, depth, z + 0.03]);
            let room = if board < boards { PITCH - 0.06 } else { 0.45 };
            stock(piece, [-half + 0.05, half - 0.05], z + 0.03, room, &mut random);
        }
    });
}

/// Things side by side from `left` to `right` on a board at height `z`, no taller than `room`.
fn stock(piece: &mut Piece, [left, right]: [f32; 2], z: f32, room: f32, random: &mut impl Rng) {
    let mut x = left;
    while x < right - 0.12 {
        let free = right - x;
        let height = room * random.random_range(0.55..0.95);
        let y = random.random_range(-0.05..0.03);
        let wide = match random.random_range(0..8) {
            0 => {
                let wide = 0.44_f32.min(free);
                printed_box_part(piece, [x + 0.5 * wide, y, z], [wide, 0.34, 0.8 * height]);
                wide
            }
            1 | 2 => {
                let wide = random.random_range(0.24..0.4_f32).min(free);
                carton_part(piece, [x + 0.5 * wide, y, z], [wide, 0.34, height]);
                wide
            }
            3 => {
                let wide = 0.3_f32.min(free);
                let hue = [Surface::RedCoat, Surface::GreyPlastic, Surface::GreenCoat, Surface::BluePlastic];
                crate_part(piece, hue[random.random_range(0..4)], [x + 0.5 * wide, y, z], [wide, 0.36, 0.7 * height]);
                wide
            }
            4 | 5 => {
                let wide = 0.4_f32.min(free);
                let (near, tall) = (-0.14, room.min(0.36));
                piece.cuboid(Surface::DarkCoat, [x, near, z], [x + wide, 0.1, z + tall]);
                piece.front(Surface::PartsDrawers, [x, x + wide], [z, z + tall], near);
                wide
            }
            6 => {
                let wide = 0.5_f32.min(free);
                let (near, tall) = (-0.16, room.min(0.3));
                piece.cuboid(Surface::Cardboard, [x + 0.01, near, z], [x + wide - 0.01, 0.1, z + 0.9 * tall]);
                piece.front(Surface::BoxFiles, [x, x + wide], [z, z + tall], near);
                wide
            }
            _ => {
                let count = ((free / 0.13) as u32).min(3);
                for bottle in 0..count {
                    let at = [x + 0.065 + 0.13 * bottle as f32, -0.1 + 0.05 * (bottle % 2) as f32, z];
                    bottle_part(piece, [Surface::AmberBottle, Surface::WhiteBottle][bottle as usize % 2], at, 0.24);
                }
                0.13 * count as f32
            }
        };
        x += wide + random.random_range(0.01..0.07);
    }
}

/// A maker's box as part of something: its bottom's middle and size.
pub(super) fn printed_box_part(piece: &mut Piece, [x, y, z]: [f32; 3], [width, depth, height]: [f32; 3]) {
    let (w, d) = (0.5 * width, 0.5 * depth);
    piece.cuboid(Surface::Paper, [x - w, y - d, z], [x + w, y + d, z + height]);
    piece.front(Surface::PrintedBox, [x - w, x + w], [z, z + height], y - d);
}

/// A bottle as part of something: its bottom's middle and its height with the cap.
pub(super) fn bottle_part(piece: &mut Piece, surface: Surface, [x, y, z]: [f32; 3], height: f32) {
    let radius = 0.2 * height;
    let at = |share: f32| [x, y, z + share * height];
    piece.bar(surface, at(0.0), at(0.68), radius);
    piece.cone(Surface::GreyPlastic, at(0.68), at(0.84), [radius, 0.35 * radius]);
    piece.bar(Surface::RedCoat, at(0.84), at(1.0), 0.42 * radius);
}

/// What stands about on a worktop or a board, things that begin from `left` to `right` metres along it; 0.3 m deep.
pub(super) fn worktop_things(scene: &mut Scene, name: &str, place: Place, [left, right]: [f32; 2], seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    scene.piece(name, Kind::Decor, place, |piece| {
        let mut x = left;
        while x < right {
            let y = random.random_range(-0.04..0.04);
            x += match random.random_range(0..6) {
                0 => {
                    bottle_part(piece, Surface::WhiteBottle, [x, y, 0.0], random.random_range(0.18..0.26));
                    bottle_part(piece, Surface::AmberBottle, [x + 0.12, y + 0.04, 0.0], 0.22);
                    0.26
                }
                1 => {
                    bottle_part(piece, Surface::AmberBottle, [x, y, 0.0], random.random_range(0.2..0.28));
                    0.16
                }
                2 => {
                    printed_box_part(piece, [x + 0.1, y, 0.0], [0.26, 0.2, 0.16]);
                    0.34
                }
                3 => {
                    // A rack of small tubes.
                    piece.cuboid(Surface::BluePlastic, [x, y - 0.05, 0.0], [x + 0.22, y + 0.05, 0.07]);
                    for tube in 0..5 {
                        let at = x + 0.03 + 0.04 * tube as f32;
                        piece.bar(Surface::RedCoat, [at, y, 0.07], [at, y, 0.11], 0.012);
                    }
                    0.3
                }
                4 => {
                    piece.top(Surface::Paper, [x, x + 0.21], [y - 0.15, y + 0.15], 0.0);
                    piece.cone(Surface::GreenCoat, [x + 0.27, y, 0.0], [x + 0.27, y, 0.1], [0.036, 0.04]);
                    0.36
                }
                _ => {
                    piece.cuboid(Surface::DarkCoat, [x, y - 0.1, 0.0], [x + 0.26, y + 0.1, 0.26]);
                    piece.front(Surface::PartsDrawers, [x, x + 0.26], [0.0, 0.26], y - 0.1);
                    0.34
                }
            } + random.random_range(0.02..0.14);
        }
    });
}

/// A few bottles on a worktop.
pub(super) fn bottles(scene: &mut Scene, name: &str, place: Place, heights: &[f32]) {
    scene.piece(name, Kind::Decor, place, |piece| {
        for (index, &height) in heights.iter().enumerate() {
            let surface = [Surface::WhiteBottle, Surface::AmberBottle][index % 2];
            bottle_part(piece, surface, [0.11 * index as f32, 0.05 * (index % 2) as f32, 0.0], height);
        }
    });
}

/// Parcels on a pallet, 0.8 × 0.6 m.
pub(super) fn pallet(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        for x in [-0.4, -0.07, 0.26] {
            piece.cuboid(Surface::Oak, [x, -0.3, 0.0], [x + 0.14, 0.3, 0.1]);
        }
        for y in [-0.3, -0.15, 0.0, 0.15] {
            piece.cuboid(Surface::Oak, [-0.4, y, 0.1], [0.4, y + 0.1, 0.122]);
        }
        carton_part(piece, [-0.18, 0.0, 0.122], [0.4, 0.5, 0.34]);
        printed_box_part(piece, [0.2, -0.02, 0.122], [0.34, 0.46, 0.4]);
        carton_part(piece, [-0.17, -0.03, 0.462], [0.36, 0.42, 0.28]);
        carton_part(piece, [0.2, 0.0, 0.522], [0.3, 0.36, 0.2]);
        printed_box_part(piece, [-0.15, -0.04, 0.742], [0.3, 0.3, 0.2]);
    });
}

/// A sack truck with crates on it, its back to +y.
pub(super) fn sack_truck(scene: &mut Scene, place: Place) {
    scene.piece("sack truck", Kind::Solid, place, |piece| {
        for x in [-0.2, 0.17] {
            piece.cuboid(Surface::RedCoat, [x, 0.2, 0.05], [x + 0.03, 0.23, 1.2]);
            piece.bar(Surface::BlackPlastic, [1.3 * x - 0.02, 0.28, 0.12], [1.3 * x + 0.06, 0.28, 0.12], 0.12);
        }
        for z in [0.3, 0.6, 0.9, 1.17] {
            piece.cuboid(Surface::RedCoat, [-0.17, 0.2, z], [0.17, 0.23, z + 0.03]);
        }
        piece.cuboid(Surface::Steel, [-0.22, -0.15, 0.03], [0.22, 0.23, 0.045]);
        crate_part(piece, Surface::GreenCoat, [0.0, 0.0, 0.045], [0.44, 0.36, 0.26]);
        crate_part(piece, Surface::GreyPlastic, [0.0, 0.0, 0.305], [0.44, 0.36, 0.26]);
        crate_part(piece, Surface::BluePlastic, [0.0, 0.01, 0.565], [0.4, 0.34, 0.22]);
    });
}
