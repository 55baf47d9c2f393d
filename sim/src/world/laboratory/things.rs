//! What lies and stands on tables and floors.

use glam::{Vec3, vec3};

use crate::world::Mesh;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::Place;

/// A flat screen on its foot.
pub(super) fn monitor(scene: &mut Scene, name: &str, place: Place, picture: Surface) {
    scene.piece(name, Kind::Decor, place, |piece| {
        let black = Surface::BlackPlastic;
        piece.cuboid(black, [-0.28, -0.02, 0.13], [0.28, 0.02, 0.46]);
        piece.cuboid(black, [-0.18, 0.02, 0.18], [0.18, 0.05, 0.38]);
        piece.cuboid(Surface::Steel, [-0.03, 0.05, 0.0], [0.03, 0.07, 0.32]);
        piece.cuboid(Surface::Steel, [-0.12, -0.08, 0.0], [0.12, 0.12, 0.012]);
        piece.front(picture, [-0.265, 0.265], [0.148, 0.448], -0.02);
        // The back's label and sockets.
        let corner = vec3(0.06, 0.0525, 0.32);
        piece.face(Surface::Paper, corner, vec3(-0.12, 0.0, 0.0), vec3(0.0, 0.0, -0.06));
    });
}

/// Keyboard, mouse and a mug.
pub(super) fn input_devices(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        piece.cuboid(Surface::BlackPlastic, [-0.22, -0.07, 0.0], [0.22, 0.07, 0.02]);
        piece.top(Surface::Keyboard, [-0.22, 0.22], [-0.07, 0.07], 0.02);
        piece.cuboid(Surface::BlackPlastic, [0.29, -0.05, 0.0], [0.35, 0.05, 0.03]);
        piece.cone(Surface::RedCoat, [-0.38, 0.12, 0.0], [-0.38, 0.12, 0.1], [0.038, 0.042]);
    });
}

/// Loose sheets.
pub(super) fn papers(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        for (index, angle) in [-0.3f32, 0.15, 0.5].into_iter().enumerate() {
            let (sin, cos) = angle.sin_cos();
            let (right, down) = (0.21 * vec3(cos, sin, 0.0), 0.3 * vec3(sin, -cos, 0.0));
            let corner = vec3(0.14 * index as f32 - 0.2, 0.15, 0.002 + 0.002 * index as f32);
            piece.face(Surface::Paper, corner, right, down);
        }
    });
}

/// A parcel.
pub(super) fn carton(scene: &mut Scene, name: &str, kind: Kind, place: Place, size: [f32; 3]) {
    scene.piece(name, kind, place, |piece| carton_part(piece, [0.0; 3], size));
}

/// A parcel as part of something: its bottom's middle and size.
pub(super) fn carton_part(piece: &mut Piece, [x, y, z]: [f32; 3], [width, depth, height]: [f32; 3]) {
    let (w, d) = (0.5 * width, 0.5 * depth);
    piece.cuboid(Surface::Cardboard, [x - w, y - d, z], [x + w, y + d, z + height]);
    piece.front(Surface::BoxSide, [x - w, x + w], [z, z + height], y - d);
    let corner = vec3(x + w + 0.002, y - d, z + height);
    piece.face(Surface::BoxSide, corner, vec3(0.0, depth, 0.0), vec3(0.0, 0.0, -height));
}

/// A stackable crate, without its lid's detail.
pub(super) fn crate_part(piece: &mut Piece, surface: Surface, [x, y, z]: [f32; 3], [width, depth, height]: [f32; 3]) {
    let (w, d) = (0.5 * width, 0.5 * depth);
    piece.cuboid(surface, [x - w + 0.01, y - d + 0.01, z], [x + w - 0.01, y + d - 0.01, z + height - 0.03]);
    piece.cuboid(surface, [x - w, y - d, z + height - 0.03], [x + w, y + d, z + height]);
    piece.front(Surface::Paper, [x - 0.05, x + 0.05], [z + 0.3 * height, z + 0.6 * height], y - d + 0.01);
}

/// A waste bin.
pub(super) fn bin(scene: &mut Scene, name: &str, place: Place, surface: Surface) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cone(surface, [0.0, 0.0, 0.0], [0.0, 0.0, 0.36], [0.11, 0.15]);
        piece.cone(Surface::BlackPlastic, [0.0, 0.0, 0.36], [0.0, 0.0, 0.375], [0.155, 0.155]);
    });
}

/// A plant in a clay pot: blades that arch outwards.
pub(super) fn plant(scene: &mut Scene, name: &str, kind: Kind, place: Place, scale: f32) {
    scene.piece(name, kind, place, |piece| {
        let pot = 0.32 * scale;
        piece.cone(Surface::Clay, [0.0; 3], [0.0, 0.0, pot], [0.12 * scale, 0.17 * scale]);
        piece.cone(Surface::Soil, [0.0, 0.0, pot], [0.0, 0.0, pot + 0.01], [0.15 * scale; 2]);
        piece.bar(Surface::Oak, [0.0, 0.0, pot], [0.0, 0.0, pot + 0.5 * scale], 0.015 * scale);
        for blade in 0..26 {
            // The golden angle spreads them evenly.
            let (sin, cos) = (2.399_963 * blade as f32).sin_cos();
            let out = vec3(cos, sin, 0.0);
            let beside = 0.045 * scale * vec3(-sin, cos, 0.0);
            let rise = (0.12 + 0.55 * (blade as f32 / 26.0)) * scale;
            let root = vec3(0.0, 0.0, pot + 0.7 * rise);
            let knee = root + scale * (0.16 * out + vec3(0.0, 0.0, 0.22));
            let tip = knee + scale * (0.2 * out + vec3(0.0, 0.0, 0.16 - 0.012 * (26 - blade) as f32));
            for (from, to, wide) in [(root, knee, 1.0), (knee, tip, 0.75)] {
                let mapping = piece.mapping(Surface::Leaf);
                piece.mesh(Surface::Leaf, &Mesh::leaf(to - wide * beside, 2.0 * wide * beside, from - to, mapping));
            }
        }
    });
}

/// A hand-held extinguisher on its hook.
pub(super) fn extinguisher(scene: &mut Scene, place: Place) {
    scene.piece("fire extinguisher", Kind::Solid, place, |piece| {
        let y = -0.1;
        piece.bar(Surface::RedCoat, [0.0, y, 0.25], [0.0, y, 0.72], 0.08);
        piece.cone(Surface::RedCoat, [0.0, y, 0.72], [0.0, y, 0.8], [0.08, 0.025]);
        piece.bar(Surface::BlackPlastic, [0.0, y, 0.8], [0.0, y, 0.86], 0.02);
        piece.cuboid(Surface::BlackPlastic, [-0.02, y - 0.09, 0.86], [0.02, y + 0.02, 0.88]);
        piece.bar(Surface::BlackPlastic, [0.05, y - 0.06, 0.4], [0.02, y - 0.03, 0.84], 0.012);
        piece.front(Surface::Paper, [-0.05, 0.05], [0.42, 0.62], y - 0.081);
        piece.cuboid(Surface::DarkCoat, [-0.04, -0.02, 0.6], [0.04, 0.0, 0.7]);
    });
}

/// A leaning ladder, its foot at the origin, its top against what is behind.
pub(super) fn ladder(scene: &mut Scene, place: Place) {
    scene.piece("ladder", Kind::Solid, place, |piece| {
        let lean = |mesh: Mesh| mesh.tilted(Vec3::X, -0.22);
        let mapping = piece.mapping(Surface::Steel);
        for x in [-0.22, 0.18] {
            let rail = Mesh::cuboid(vec3(x, -0.03, 0.0), vec3(x + 0.04, 0.03, 2.3), mapping);
            piece.mesh(Surface::Steel, &lean(rail));
        }
        for rung in 0..8 {
            let z = 0.25 + 0.27 * rung as f32;
            let rung = Mesh::cylinder(vec3(-0.18, 0.0, z), vec3(0.18, 0.0, z), [0.016; 2], 6, mapping);
            piece.mesh(Surface::Steel, &lean(rung));
        }
    });
}
