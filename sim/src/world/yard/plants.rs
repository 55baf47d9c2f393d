//! Trees, hedges, shrubs, flowers. Textures have no holes, so what is leafy is so in shape: lumps with loose sprays of
//! leaves all over them.

use std::f32::consts::TAU;

use glam::{Vec3, vec3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::land::on_ground;
use crate::world::Mesh;
use crate::world::material::{BLOSSOM_COLOURS, Surface};
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::{Mapping, Place, cuts_no_longer_than};

/// How many sprays a square metre of crown or hedge has.
const SPRAYS: f32 = 11.0;

fn random(seed: u64, name: &str) -> ChaCha8Rng {
    // FNV-1a (Fowler, Noll, Vo).
    let hash = name
        .bytes()
        .fold(0xCBF2_9CE4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3));
    ChaCha8Rng::seed_from_u64(seed ^ hash)
}

/// Unit vectors from the middles of faces, weighted by area, at the corners: of a lump as it is, not as it was meant.
fn smoothed(mut mesh: Mesh) -> Mesh {
    let mut sums = vec![Vec3::ZERO; mesh.positions.len()];
    for &triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(triangle);
        for index in triangle {
            sums[index as usize] += (b - a).cross(c - a);
        }
    }
    mesh.normals = sums.into_iter().map(|sum| sum.normalize_or(Vec3::Z).to_array()).collect();
    mesh
}

/// A lump: an ellipsoid, dented at random by `rough` of its radius.
fn lump(centre: Vec3, radii: Vec3, [sides, rings]: [u32; 2], rough: f32, mapping: Mapping, rng: &mut impl Rng) -> Mesh {
    let mut mesh = Mesh::default();
    let girth = TAU * radii.truncate().max_element();
    let dent = |rng: &mut dyn FnMut() -> f32| 1.0 + rough * (rng() - 0.5);
    let mut draw = || rng.random::<f32>();
    let dents: Vec<f32> = (0..sides * (rings - 1)).map(|_| dent(&mut draw)).collect();
    let poles = [dent(&mut draw), dent(&mut draw)];
    let mut vertex = |direction: Vec3, dent: f32, uv: [f32; 2]| {
        mesh.positions.push((centre + dent * direction * radii).to_array());
        mesh.uvs.push(mapping.uv_at(uv));
    };
    for ring in 1..rings {
        let (sin, cos) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
        for side in 0..=sides {
            let turn = TAU * side as f32 / sides as f32;
            let (s, c) = turn.sin_cos();
            let dent = dents[((ring - 1) * sides + side % sides) as usize];
            let across = girth * side as f32 / sides as f32;
            vertex(vec3(sin * c, sin * s, cos), dent, [across, 2.0 * radii.z * ring as f32 / rings as f32]);
        }
    }
    let row = sides + 1;
    let (top, bottom) = (row * (rings - 1), row * (rings - 1) + 1);
    vertex(Vec3::Z, poles[0], [0.5 * girth, 0.0]);
    vertex(Vec3::NEG_Z, poles[1], [0.5 * girth, 2.0 * radii.z]);
    for side in 0..sides {
        mesh.triangles.push([top, side, side + 1]);
        for ring in 0..rings - 2 {
            let (here, below) = (ring * row + side, (ring + 1) * row + side);
            mesh.triangles.extend([[here, below, below + 1], [here, below + 1, here + 1]]);
        }
        let last = (rings - 2) * row + side;
        mesh.triangles.push([bottom, last + 1, last]);
    }
    smoothed(mesh)
}

/// A spray of leaves: a bent diamond that shows its texture outwards, along `out`, more or less.
fn spray(piece: &mut Piece, surface: Surface, at: Vec3, out: Vec3, size: f32, rng: &mut impl Rng) {
    let mut draw = || rng.random::<f32>() - 0.5;
    let facing = (out + 1.5 * vec3(draw(), draw(), draw())).normalize_or(out);
    let (across, beside) = facing.any_orthonormal_pair();
    let (sin, cos) = (TAU * draw()).sin_cos();
    let (along, aside) = (cos * across + sin * beside, cos * beside - sin * across);
    let (long, wide) = (size * (0.8 + 0.5 * draw()), size * (0.42 + 0.2 * draw()));
    let corner = [0.37 * draw(), 0.61 * draw()];
    let mapping = piece.mapping(surface);
    let uv = |u: f32, v: f32| mapping.uv_at([corner[0] + u, corner[1] + v]);
    let mesh = Mesh {
        positions: [-long * along, wide * aside + 0.16 * size * facing, long * along, -wide * aside]
            .map(|offset| (at + offset).to_array())
            .to_vec(),
        uvs: vec![uv(-long, 0.0), uv(0.0, wide), uv(long, 0.0), uv(0.0, -wide)],
        triangles: vec![[0, 3, 1], [3, 2, 1]],
        ..Mesh::default()
    };
    // Its light is that of the crown's outside, whichever way it hangs.
    let mut mesh = smoothed(mesh);
    let facets: Vec<Vec3> = mesh
        .triangles
        .iter()
        .map(|&triangle| {
            let [a, b, c] = mesh.corners(triangle);
            (b - a).cross(c - a)
        })
        .collect();
    if facets.iter().any(|facet| facet.dot(facing) < 0.0) {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        mesh = smoothed(mesh);
    }
    piece.mesh(surface, &mesh);
}

/// Sprays over an ellipsoid, but for those that others of a group hide.
fn leafy(
    piece: &mut Piece,
    surface: Surface,
    [centre, radii]: [Vec3; 2],
    size: f32,
    group: &[[Vec3; 2]],
    rng: &mut impl Rng,
) {
    let area = 2.0 * TAU * ((radii.x * radii.y + radii.x * radii.z + radii.y * radii.z) / 3.0);
    let count = (area * SPRAYS * (0.22 / size).powi(2)).clamp(10.0, 60.0) as u32;
    for index in 0..count {
        // A Fibonacci spiral covers a sphere evenly.
        let z = 1.0 - 2.0 * (index as f32 + 0.5) / count as f32;
        let (sin, cos) = (2.399_963 * index as f32).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        let direction = vec3(flat * cos, flat * sin, z);
        let at = centre + (0.9 + 0.2 * rng.random::<f32>()) * direction * radii;
        if !group.iter().any(|[centre, radii]| ((at - centre) / radii).length() < 0.9) {
            spray(piece, surface, at, direction, size, rng);
        }
    }
}

/// A broad-leaved tree, `tall` metres.
pub(super) fn tree(scene: &mut Scene, name: &str, [x, y]: [f32; 2], tall: f32, seed: u64) {
    let mut rng = random(seed, name);
    let (place, girth) = (on_ground(x, y, 360.0 * rng.random::<f32>()), 0.028 * tall);
    let fork = 0.36 * tall;
    scene.piece(&format!("{name}, trunk"), Kind::Solid, place, |piece| {
        piece.tube(Surface::Bark, [0.0, 0.0, -0.1], [0.0, 0.0, 0.25], [1.5 * girth, girth]);
        piece.tube(Surface::Bark, [0.0, 0.0, 0.25], [0.03, 0.02, fork + 0.3], [girth, 0.75 * girth]);
    });
    let lumps: Vec<[Vec3; 2]> = (0..6)
        .map(|index| {
            let (sin, cos) = (TAU * index as f32 / 5.0 + rng.random::<f32>()).sin_cos();
            let mut scale = || tall * (0.9 + 0.25 * rng.random::<f32>());
            let (off, up) = if index < 5 { (0.19, 0.56) } else { (0.0, 0.8) };
            let centre = vec3(off * scale() * cos, off * scale() * sin, up * scale());
            [centre, vec3(0.2 * scale(), 0.2 * scale(), 0.17 * scale())]
        })
        .collect();
    scene.piece(&format!("{name}, branches"), Kind::Decor, place, |piece| {
        for [centre, _] in &lumps {
            let end = vec3(0.0, 0.0, fork).lerp(*centre, 0.8);
            piece.tube(Surface::Bark, [0.02, 0.01, fork], end.to_array(), [0.5 * girth, 0.2 * girth]);
        }
    });
    scene.piece(&format!("{name}, crown"), Kind::Decor, place, |piece| {
        for &[centre, radii] in &lumps {
            let mapping = piece.mapping(Surface::Foliage);
            piece.mesh(Surface::Foliage, &lump(centre, radii, [9, 5], 0.3, mapping, &mut rng));
            leafy(piece, Surface::Foliage, [centre, radii], 0.06 * tall, &lumps, &mut rng);
        }
    });
}

/// A conifer: tiers of drooping sprays about a trunk.
pub(super) fn conifer(scene: &mut Scene, name: &str, [x, y]: [f32; 2], tall: f32, seed: u64) {
    let mut rng = random(seed, name);
    let place = on_ground(x, y, 0.0);
    scene.piece(&format!("{name}, trunk"), Kind::Solid, place, |piece| {
        piece.tube(Surface::Bark, [0.0, 0.0, -0.1], [0.0, 0.0, 0.9], [0.12, 0.09]);
    });
    scene.piece(&format!("{name}, boughs"), Kind::Decor, place, |piece| {
        for tier in 0..7 {
            let up = tier as f32 / 7.0;
            let (z, radius) = (tall * (0.12 + 0.8 * up), 0.24 * tall * (1.0 - 0.88 * up));
            let mapping = piece.mapping(Surface::Needles);
            let height = 0.2 * tall * (1.0 - 0.3 * up);
            let sides = 9;
            let mut skirt = Mesh::default();
            for side in 0..=sides {
                let turn = TAU * (side % sides) as f32 / sides as f32 + 0.7 * tier as f32;
                let reach = radius * if side % 2 == 0 { 1.08 } else { 0.86 };
                let drop = if side % 2 == 0 { -0.06 * tall } else { 0.0 };
                let at = vec3(reach * turn.cos(), reach * turn.sin(), z + drop);
                let across = radius * TAU * side as f32 / sides as f32;
                skirt.positions.extend([at.to_array(), [0.0, 0.0, z + height]]);
                skirt.uvs.extend([mapping.uv_at([across, height]), mapping.uv_at([across + 0.1, 0.0])]);
            }
            for side in 0..sides {
                skirt.triangles.push([2 * side, 2 * side + 2, 2 * side + 1]);
            }
            piece.mesh(Surface::Needles, &smoothed(skirt));
            for index in 0..22 {
                let turn = TAU * (index as f32 + rng.random::<f32>()) / 22.0;
                let (sin, cos) = turn.sin_cos();
                let share = 0.5 + 0.5 * rng.random::<f32>();
                let at = vec3(radius * share * cos, radius * share * sin, z + height * (1.0 - share) * 0.9);
                spray(piece, Surface::Needles, at, vec3(cos, sin, 0.5).normalize(), 0.2, &mut rng);
            }
        }
    });
}

/// A rounded shrub that stands in the way; `size`: width and height, metres.
pub(super) fn shrub(
    scene: &mut Scene,
    name: &str,
    [x, y]: [f32; 2],
    [wide, tall]: [f32; 2],
    surface: Surface,
    seed: u64,
) {
    let mut rng = random(seed, name);
    let place = on_ground(x, y, 360.0 * rng.random::<f32>());
    let (centre, radii) = (vec3(0.0, 0.0, 0.45 * tall), vec3(0.43 * wide, 0.43 * wide, 0.52 * tall));
    scene.piece(name, Kind::Solid, place, |piece| {
        let mapping = piece.mapping(surface);
        piece.mesh(surface, &lump(centre, radii, [9, 5], 0.3, mapping, &mut rng));
    });
    scene.piece(&format!("{name}, leaves"), Kind::Decor, place, |piece| {
        leafy(piece, surface, [centre, radii], 0.15, &[], &mut rng);
    });
}

/// A clipped hedge along a line, at most some 8 m long.
pub(super) fn hedge(scene: &mut Scene, name: &str, [from, to]: [[f32; 2]; 2], thick: f32, tall: f32, seed: u64) {
    let mut rng = random(seed, name);
    let [from, to] = [from, to].map(glam::Vec2::from);
    let along = to - from;
    let base = on_ground(from.x, from.y, 0.0).at.z.min(on_ground(to.x, to.y, 0.0).at.z);
    let place = Place { at: from.extend(base - 0.1), ..Place::along(from, to) };
    let (length, half) = (along.length(), 0.5 * thick);
    let mapping = surface_mapping(Surface::Hedge);
    // Round its cross-section from foot to foot, and along it; the ends are closed by the same net.
    let outline: Vec<[f32; 2]> = {
        let rows = cuts_no_longer_than(0.55, &[0.0, tall]);
        let front = rows.iter().map(|&z| [-half, z]);
        let back = rows.iter().rev().map(|&z| [half, z]);
        front.chain([[0.0, tall + 0.09]]).chain(back).collect()
    };
    let stations = cuts_no_longer_than(0.6, &[0.0, length]);
    let mut net = Mesh::default();
    for &x in &stations {
        let mut girth = 0.0;
        for (index, &[y, z]) in outline.iter().enumerate() {
            if index > 0 {
                let [before_y, before_z] = outline[index - 1];
                girth += (y - before_y).hypot(z - before_z);
            }
            let mut off = || 0.1 * (rng.random::<f32>() - 0.5);
            let still = if z < 0.01 { 0.0 } else { 1.0 };
            // Its ends are upright.
            let sway = if x == 0.0 || x == length { 0.0 } else { still * off() };
            net.positions.push([x + sway, y + off(), z + still * off()]);
            net.uvs.push(mapping.uv_at([x, girth]));
        }
    }
    let rows = outline.len() as u32;
    for (station, row) in
        (0..stations.len() as u32 - 1).flat_map(|station| (0..rows - 1).map(move |row| (station, row)))
    {
        let (here, next) = (station * rows + row, (station + 1) * rows + row);
        net.triangles.extend([[here, next, next + 1], [here, next + 1, here + 1]]);
    }
    let top = (rows - 1) / 2;
    for (station, flip) in [(0, false), (stations.len() as u32 - 1, true)] {
        let first = net.positions.len() as u32;
        for (index, &[y, z]) in outline.iter().enumerate() {
            net.positions.push(net.positions[(station * rows) as usize + index]);
            net.uvs.push(mapping.uv_at([y, tall - z]));
        }
        let mut close = |corners: [u32; 3]| {
            let [a, b, c] = corners.map(|corner| first + corner);
            net.triangles.push(if flip { [a, c, b] } else { [a, b, c] });
        };
        for row in 0..top - 1 {
            let (front, back) = (row, rows - 1 - row);
            close([front, front + 1, back - 1]);
            close([front, back - 1, back]);
        }
        close([top - 1, top, top + 1]);
    }
    let net = smoothed(net);
    scene.piece(name, Kind::Solid, place, |piece| piece.mesh(Surface::Hedge, &net));
    scene.piece(&format!("{name}, leaves"), Kind::Decor, place, |piece| {
        let count = (length * (2.0 * tall + thick) * SPRAYS) as u32;
        for index in 0..count {
            let x = length * (index as f32 + rng.random::<f32>()) / count as f32;
            let around = rng.random::<f32>() * (2.0 * tall + thick);
            let (at, out) = if around < tall {
                (vec3(x, -half, around), Vec3::NEG_Y)
            } else if around < tall + thick {
                (vec3(x, around - tall - half, tall), Vec3::Z)
            } else {
                (vec3(x, half, around - tall - thick), Vec3::Y)
            };
            spray(piece, Surface::Hedge, at, (out + vec3(0.0, 0.0, 0.3)).normalize(), 0.14, &mut rng);
        }
        for _ in 0..(12.0 * tall * thick) as u32 {
            for (x, out) in [(0.0, Vec3::NEG_X), (length, Vec3::X)] {
                let at = vec3(x, half * (2.0 * rng.random::<f32>() - 1.0), tall * rng.random::<f32>());
                spray(piece, Surface::Hedge, at, out, 0.14, &mut rng);
            }
        }
    });
}

fn surface_mapping(surface: Surface) -> Mapping {
    surface.mapping_from([0.0; 2])
}

/// A group of flowers on `size` metres, `up` metres above the ground: leaves close to the soil, blossoms in one colour.
pub(super) fn flowers(
    scene: &mut Scene,
    name: &str,
    [x, y]: [f32; 2],
    size: [f32; 2],
    colour: u32,
    up: f32,
    seed: u64,
) {
    let mut rng = random(seed, name);
    let count = (26.0 * size[0] * size[1]) as u32;
    let bank = on_ground(x, y, 0.0);
    scene.piece(name, Kind::Decor, bank, |piece| {
        for _ in 0..count {
            let root = vec3(size[0] * (rng.random::<f32>() - 0.5), size[1] * (rng.random::<f32>() - 0.5), up - 0.01);
            let tall = 0.2 + 0.22 * rng.random::<f32>();
            for _ in 0..3 {
                let turn = TAU * rng.random::<f32>();
                let out = vec3(turn.cos(), turn.sin(), 0.9).normalize();
                let at = root + vec3(0.06 * out.x, 0.06 * out.y, 0.06 + 0.5 * tall * rng.random::<f32>());
                spray(piece, Surface::Foliage, at, out, 0.09, &mut rng);
            }
            let head = root + vec3(0.03, 0.02, tall);
            let u = (colour as f32 + 0.2 + 0.6 * rng.random::<f32>()) / BLOSSOM_COLOURS as f32;
            piece.mesh(Surface::Blossom, &bloom(head, 0.035 + 0.02 * rng.random::<f32>(), u));
        }
    });
}

/// A blossom: a small six-sided double pyramid.
fn bloom(at: Vec3, radius: f32, u: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for index in 0..6 {
        let (sin, cos) = (TAU * index as f32 / 6.0).sin_cos();
        let reach = radius * if index % 2 == 0 { 1.0 } else { 0.7 };
        mesh.positions.push((at + vec3(reach * cos, reach * sin, 0.3 * radius)).to_array());
    }
    mesh.positions
        .extend([(at + vec3(0.0, 0.0, 0.6 * radius)).to_array(), (at - vec3(0.0, 0.0, 0.6 * radius)).to_array()]);
    mesh.uvs = mesh.positions.iter().map(|position| [u, 0.1 + 8.0 * (position[2] - at.z)]).collect();
    for index in 0..6 {
        let next = (index + 1) % 6;
        mesh.triangles.extend([[6, index, next], [7, next, index]]);
    }
    smoothed(mesh)
}
