//! What stands about in the yard. Each stands on its place's origin, its front towards −y.

use std::f32::consts::TAU;

use glam::{Vec3, vec3};

use crate::light::LampKind;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::Place;
use crate::world::{Lamp, Mesh};

/// Exitance of a street lamp's glass, lux: a 35 W sodium lamp of 2300 lm, of which three quarters leave the lantern by
/// 0.09 m². That is 40 lx below it, as much as paths get.
const STREET_LAMP: f32 = 19_000.0;

/// A flat face with four corners, anticlockwise from its lower left as seen; shows a texture's share of `u` and `v`.
fn sheet(piece: &mut Piece, surface: Surface, corners: [Vec3; 4], [[left, top], [right, bottom]]: [[f32; 2]; 2]) {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize().to_array();
    piece.mesh(
        surface,
        &Mesh {
            positions: corners.map(|corner| corner.to_array()).to_vec(),
            normals: vec![normal; 4],
            uvs: vec![[left, bottom], [right, bottom], [right, top], [left, top]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        },
    );
}

const WHOLE: [[f32; 2]; 2] = [[0.0; 2], [1.0; 2]];

/// A small car, its nose to the right.
pub(super) fn car(scene: &mut Scene, name: &str, place: Place) {
    const LENGTH: f32 = 4.0;
    const HEIGHT: f32 = 1.45;
    let (low, belt, roof) = (0.82, 0.82, 0.62);
    // Of each side's outline, x and z, anticlockwise from the tail's foot.
    let body = [[-2.0, 0.2], [2.0, 0.2], [1.97, 0.66], [1.85, 0.76], [1.05, 0.92], [-1.92, 0.95]];
    let cabin = [[-1.55, 0.94], [1.05, 0.92], [0.28, 1.44], [-1.2, 1.43]];
    scene.piece(name, Kind::Solid, place, |piece| {
        for side in [-1.0f32, 1.0] {
            let mut outline = |points: &[[f32; 2]], half: &dyn Fn(usize) -> f32| {
                let positions: Vec<Vec3> =
                    points.iter().enumerate().map(|(index, &[x, z])| vec3(x, side * half(index), z)).collect();
                let facing = (positions[1] - positions[0]).cross(positions[2] - positions[0]).normalize();
                let out = if facing.y * side > 0.0 { facing } else { -facing };
                let corners = 1..points.len() as u32 - 1;
                let mesh = Mesh {
                    positions: positions.iter().map(|position| position.to_array()).collect(),
                    normals: vec![out.to_array(); points.len()],
                    uvs: points.iter().map(|[x, z]| [x / LENGTH + 0.5, 1.0 - z / HEIGHT]).collect(),
                    triangles: corners.map(|i| if side < 0.0 { [0, i, i + 1] } else { [0, i + 1, i] }).collect(),
                    ..Mesh::default()
                };
                piece.mesh(Surface::CarSide, &mesh);
            };
            outline(&body, &|_| low);
            outline(&cabin, &|index| if index < 2 { belt } else { roof });
        }
        let mut across = |surface: Surface, from: ([f32; 2], f32), to: ([f32; 2], f32)| {
            let corner = |([x, z], half): ([f32; 2], f32), side: f32| vec3(x, side * half, z);
            // Going from tail to nose over the top, the right side is on the right.
            let corners = [corner(from, 1.0), corner(from, -1.0), corner(to, -1.0), corner(to, 1.0)];
            sheet(piece, surface, corners, WHOLE);
        };
        across(Surface::CarRear, (body[0], low), (body[5], low));
        across(Surface::CarPaint, (body[5], low), (cabin[0], belt));
        across(Surface::Pane, (cabin[0], belt), (cabin[3], roof));
        across(Surface::CarPaint, (cabin[3], roof), (cabin[2], roof));
        across(Surface::Pane, (cabin[2], roof), (cabin[1], belt));
        across(Surface::CarPaint, (body[4], low), (body[3], low));
        across(Surface::CarPaint, (body[3], low), (body[2], low));
        let nose = [vec3(2.0, -low, 0.2), vec3(2.0, low, 0.2), vec3(1.97, low, 0.66), vec3(1.97, -low, 0.66)];
        sheet(piece, Surface::CarFront, nose, WHOLE);
        for x in [-1.28, 1.2] {
            for side in [-1.0, 1.0] {
                piece.bar(Surface::BlackPlastic, [x, side * 0.62, 0.3], [x, side * 0.825, 0.3], 0.3);
                piece.bar(Surface::Wheel, [x, side * 0.825, 0.3], [x, side * 0.835, 0.3], 0.295);
            }
        }
        for side in [-1.0f32, 1.0] {
            let [near, far] = if side < 0.0 { [-0.98, -0.8] } else { [0.8, 0.98] };
            piece.block(Surface::BlackPlastic, [0.72, near, 0.92], [0.82, far, 1.05]);
        }
    });
}

/// A bench of slats on concrete feet.
pub(super) fn bench(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        for x in [-0.65, 0.57] {
            piece.block(Surface::Concrete, [x, -0.22, -0.05], [x + 0.08, 0.26, 0.4]);
            piece.block(Surface::Concrete, [x, 0.18, 0.4], [x + 0.08, 0.26, 0.82]);
        }
        for slat in 0..4 {
            let y = -0.24 + 0.115 * slat as f32;
            piece.block(Surface::Timber, [-0.8, y, 0.4], [0.8, y + 0.09, 0.44]);
        }
        for z in [0.52, 0.65, 0.78] {
            piece.block(Surface::Timber, [-0.8, 0.15, z], [0.8, 0.18, z + 0.09]);
        }
    });
}

/// A table with a bench on both sides, all of one frame.
pub(super) fn picnic_table(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        for board in 0..5 {
            let y = -0.37 + 0.15 * board as f32;
            piece.block(Surface::Timber, [-0.9, y, 0.72], [0.9, y + 0.13, 0.76]);
        }
        for y in [-0.78, -0.63, 0.5, 0.65] {
            piece.block(Surface::Timber, [-0.9, y, 0.43], [0.9, y + 0.13, 0.47]);
        }
        for x in [-0.66, 0.58] {
            piece.block(Surface::Timber, [x, -0.75, 0.36], [x + 0.08, 0.75, 0.43]);
            for y in [-0.4, 0.3] {
                piece.block(Surface::Timber, [x, y, -0.05], [x + 0.08, y + 0.1, 0.72]);
            }
        }
    });
}

/// A wheeled bin with a lid of its own colour.
pub(super) fn wheeled_bin(scene: &mut Scene, name: &str, place: Place, lid: Surface) {
    scene.piece(name, Kind::Solid, place, |piece| {
        let grey = Surface::DarkCoat;
        piece.block(grey, [-0.26, -0.27, 0.12], [0.26, 0.25, 0.98]);
        piece.block(grey, [-0.29, -0.3, 0.9], [0.29, 0.28, 0.98]);
        piece.block(lid, [-0.3, -0.34, 0.98], [0.3, 0.3, 1.05]);
        piece.bar(grey, [-0.24, 0.33, 0.96], [0.24, 0.33, 0.96], 0.016);
        sheet(
            piece,
            Surface::BinFront,
            [vec3(-0.25, -0.273, 0.13), vec3(0.25, -0.273, 0.13), vec3(0.25, -0.273, 0.89), vec3(-0.25, -0.273, 0.89)],
            WHOLE,
        );
        for x in [-0.3, 0.26] {
            piece.bar(Surface::BlackPlastic, [x, 0.2, 0.1], [x + 0.04, 0.2, 0.1], 0.1);
        }
    });
}

/// Three hoops of tube to lean bicycles against.
pub(super) fn bicycle_stand(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        for x in [-0.8, 0.0, 0.8] {
            for y in [-0.35, 0.35] {
                piece.bar(Surface::Steel, [x, y, -0.05], [x, y, 0.72], 0.024);
                piece.bar(Surface::Steel, [x, y, 0.72], [x, 0.72 * y, 0.8], 0.024);
            }
            piece.bar(Surface::Steel, [x, -0.25, 0.8], [x, 0.25, 0.8], 0.024);
        }
    });
}

/// A bicycle, its front wheel towards −y.
pub(super) fn bicycle(scene: &mut Scene, name: &str, place: Place, paint: Surface) {
    scene.piece(name, Kind::Solid, place, |piece| {
        let hub = |y: f32| vec3(0.0, y, 0.34);
        for y in [-0.52, 0.52] {
            let rim = |index: u32| {
                let (sin, cos) = (TAU * index as f32 / 14.0).sin_cos();
                (hub(y) + 0.33 * vec3(0.0, cos, sin)).to_array()
            };
            for index in 0..14 {
                piece.tube(Surface::BlackPlastic, rim(index), rim(index + 1), [0.017; 2]);
            }
            for index in [0, 2, 5, 7, 9, 12] {
                piece.tube(Surface::Steel, hub(y).to_array(), rim(index), [0.003; 2]);
            }
        }
        let (crank, saddle, head, fork) = ([0.0, 0.1, 0.3], [0.0, 0.24, 0.82], [0.0, -0.33, 0.88], [0.0, -0.37, 0.72]);
        for (from, to) in [
            (crank, saddle),
            (crank, fork),
            ([0.0, 0.22, 0.74], head),
            (crank, [0.0, 0.52, 0.34]),
            ([0.0, 0.22, 0.74], [0.0, 0.52, 0.34]),
            (head, [0.0, -0.52, 0.34]),
        ] {
            piece.tube(paint, from, to, [0.018; 2]);
        }
        piece.bar(paint, head, [0.0, -0.3, 1.02], 0.014);
        piece.bar(Surface::BlackPlastic, [-0.28, -0.25, 1.03], [0.28, -0.25, 1.03], 0.014);
        piece.block(Surface::BlackPlastic, [-0.07, 0.12, 0.88], [0.07, 0.38, 0.93]);
        piece.bar(Surface::Steel, saddle, [0.0, 0.25, 0.9], 0.012);
        piece.block(Surface::Steel, [-0.08, 0.36, 0.72], [0.08, 0.7, 0.735]);
        piece.bar(Surface::BlackPlastic, [-0.02, 0.1, 0.3], [0.02, 0.1, 0.3], 0.09);
    });
}

/// A street lamp, 3.6 m, its arm towards −y.
pub(super) fn street_lamp(scene: &mut Scene, name: &str, place: Place) {
    let (height, reach) = (3.6, 0.75);
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.tube(Surface::GreyCoat, [0.0, 0.0, -0.05], [0.0, 0.0, 0.9], [0.085, 0.08]);
        piece.tube(Surface::GreyCoat, [0.0, 0.0, 0.9], [0.0, 0.0, height + 0.12], [0.05, 0.035]);
        piece.tube(Surface::GreyCoat, [0.0, 0.0, height + 0.1], [0.0, -reach + 0.2, height + 0.16], [0.028; 2]);
        piece.cuboid(Surface::DarkCoat, [-0.13, -reach - 0.26, height], [0.13, -reach + 0.26, height + 0.14]);
        piece.face(
            Surface::Opal,
            vec3(-0.1, -reach - 0.225, height - 0.002),
            vec3(0.2, 0.0, 0.0),
            vec3(0.0, 0.45, 0.0),
        );
        piece.front(Surface::Paper, [-0.04, 0.04], [0.5, 0.62], -0.084);
    });
    let along = |local: Vec3| place.point(local) - place.at;
    scene.lamp(Lamp {
        name: name.to_owned(),
        centre: place.point(vec3(0.0, -reach, height - 0.006)).to_array(),
        half_edges: [along(vec3(0.0, 0.225, 0.0)), along(vec3(0.1, 0.0, 0.0))].map(|edge| edge.to_array()),
        exitance: LampKind::Sodium.exitance(STREET_LAMP),
        group: "street".to_owned(),
    });
}

/// A post that keeps cars off.
pub(super) fn bollard(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.bar(Surface::DarkCoat, [0.0, 0.0, -0.05], [0.0, 0.0, 0.86], 0.05);
        piece.bar(Surface::Enamel, [0.0, 0.0, 0.66], [0.0, 0.0, 0.74], 0.053);
        piece.bar(Surface::RedCoat, [0.0, 0.0, 0.74], [0.0, 0.0, 0.80], 0.053);
    });
}

/// A sign on a pole.
pub(super) fn sign(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.bar(Surface::Steel, [0.0, 0.02, -0.05], [0.0, 0.02, 1.75], 0.025);
        piece.block(Surface::Steel, [-0.22, -0.012, 1.1], [0.22, -0.006, 1.72]);
        piece.front(Surface::ParkingSign, [-0.21, 0.21], [1.11, 1.71], -0.013);
    });
}

/// A tub of cast concrete, filled with soil.
pub(super) fn tub(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.block(Surface::Concrete, [-0.35, -0.35, 0.0], [0.35, 0.35, 0.46]);
        piece.block(Surface::Earth, [-0.28, -0.28, 0.46], [0.28, 0.28, 0.48]);
    });
}

/// A bed for vegetables in a box of boards; `size`: along and across, metres.
pub(super) fn raised_bed(scene: &mut Scene, name: &str, place: Place, [long, deep]: [f32; 2]) {
    scene.piece(name, Kind::Solid, place, |piece| {
        let (x, y, top) = (0.5 * long, 0.5 * deep, 0.48);
        for (min, max) in [([-x, -y], [x, 0.05 - y]), ([-x, y - 0.05], [x, y])] {
            piece.block(Surface::Timber, [min[0], min[1], -0.3], [max[0], max[1], top]);
        }
        for left in [-x, x - 0.05] {
            piece.block(Surface::Timber, [left, 0.05 - y, -0.3], [left + 0.05, y - 0.05, top]);
        }
        piece.block(Surface::Earth, [0.05 - x, 0.05 - y, 0.0], [x - 0.05, y - 0.05, top - 0.06]);
    });
}

/// A round cover in the ground.
pub(super) fn manhole(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        piece.bar(Surface::Manhole, [0.0, 0.0, -0.03], [0.0, 0.0, 0.006], 0.36);
    });
}

/// A gully's grate.
pub(super) fn grate(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Decor, place, |piece| {
        piece.block(Surface::Concrete, [-0.32, -0.32, -0.05], [0.32, 0.32, 0.004]);
        piece.top(Surface::Grate, [-0.25, 0.25], [-0.25, 0.25], 0.004);
    });
}

/// A kerb or an edging, `tall` metres proud of the ground, along x or y.
pub(super) fn kerb(scene: &mut Scene, name: &str, min: [f32; 2], max: [f32; 2], bottom: f32, top: f32) {
    scene.piece(name, Kind::Solid, Place::new(0.0, 0.0, 0.0, 0.0), |piece| {
        piece.block(Surface::Concrete, [min[0], min[1], bottom], [max[0], max[1], top]);
    });
}

/// A rain barrel.
pub(super) fn barrel(scene: &mut Scene, name: &str, place: Place) {
    scene.piece(name, Kind::Solid, place, |piece| {
        piece.cone(Surface::GreenCoat, [0.0, 0.0, -0.03], [0.0, 0.0, 0.45], [0.24, 0.3]);
        piece.cone(Surface::GreenCoat, [0.0, 0.0, 0.45], [0.0, 0.0, 0.92], [0.3, 0.26]);
        piece.bar(Surface::BlackPlastic, [0.0, 0.0, 0.92], [0.0, 0.0, 0.95], 0.28);
    });
}

/// A garden shed of planks with a tiled roof; `size`: width and depth, metres; its door towards −y.
pub(super) fn shed(scene: &mut Scene, name: &str, place: Place, [width, depth]: [f32; 2]) {
    scene.piece(name, Kind::Solid, place, |piece| {
        let (w, eaves, ridge) = (0.5 * width, 2.1, 3.1);
        piece.block(Surface::Planks, [-w, 0.0, -0.1], [w, depth, eaves]);
        for (y, out) in [(0.0, -1.0), (depth, 1.0)] {
            let mut corners = [vec3(-w, y, eaves), vec3(w, y, eaves), vec3(0.0, y, ridge)];
            if out > 0.0 {
                corners.swap(0, 1);
            }
            let mapping = piece.mapping(Surface::Planks);
            piece.mesh(
                Surface::Planks,
                &Mesh {
                    positions: corners.map(|corner| corner.to_array()).to_vec(),
                    normals: vec![[0.0, out, 0.0]; 3],
                    uvs: corners.iter().map(|corner| mapping.uv_at([corner.x + w, eaves - corner.z])).collect(),
                    triangles: vec![[0, 1, 2]],
                    ..Mesh::default()
                },
            );
        }
        let (out, front, back) = (0.25, -0.3, depth + 0.3);
        let drop = (ridge - eaves) / w;
        for side in [-1.0f32, 1.0] {
            let low = vec3(side * (w + out), 0.0, eaves - drop * out + 0.05);
            let top = vec3(0.0, 0.0, ridge + 0.05);
            let at = |edge: Vec3, y: f32| edge + vec3(0.0, y, 0.0);
            let corners = if side > 0.0 {
                [at(low, front), at(low, back), at(top, back), at(top, front)]
            } else {
                [at(low, back), at(low, front), at(top, front), at(top, back)]
            };
            sheet(piece, Surface::RoofTile, corners, [[0.0, 0.0], [depth / 2.0, w / 1.6]]);
            let under = [corners[3], corners[2], corners[1], corners[0]].map(|corner| corner - vec3(0.0, 0.0, 0.05));
            sheet(piece, Surface::Planks, under, [[0.0, 0.0], [depth / 1.44, w / 1.6]]);
        }
        piece.front(Surface::DoorLeaf, [-0.45, 0.45], [0.0, 1.95], -0.01);
        piece.front(Surface::HouseWindow, [w - 0.95, w - 0.25], [1.0, 1.75], -0.01);
    });
}
