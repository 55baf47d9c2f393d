//! The lie of the land: heights, and what covers it.

use crate::world::Mesh;
use crate::world::ground::{Cover, CoveredArea, Ground, Terrain};
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

/// Distance of the terrain's points, metres: a tyre of 22 cm feels no facet of it.
const PITCH: f64 = 0.1;
/// Distance of the points that are drawn, metres, on what is bumpy and on what is even.
const DRAWN: [f32; 2] = [0.25, 0.5];
/// Largest piece that is drawn, metres: what is out of view is left out.
const PIECE: f32 = 4.0;

/// A rectangle of ground: how it looks, and how it is driven on.
struct Patch {
    name: &'static str,
    min: [f32; 2],
    max: [f32; 2],
    surface: Surface,
    cover: Cover,
}

const fn patch(name: &'static str, min: [f32; 2], max: [f32; 2], surface: Surface, cover: Cover) -> Patch {
    Patch { name, min, max, surface, cover }
}

/// All of the ground; no two overlap. Corners are on the drawn grid.
const PATCHES: [Patch; 11] = [
    patch("drive", [0.0, 1.5], [6.0, 20.0], Surface::Asphalt, Cover::Asphalt),
    patch("lane", [6.0, 1.5], [16.0, 3.5], Surface::Asphalt, Cover::Asphalt),
    patch("apron", [0.0, 0.0], [16.0, 1.5], Surface::Asphalt, Cover::Asphalt),
    patch("gravel strip", [6.0, 3.5], [18.0, 6.25], Surface::Gravel, Cover::Gravel),
    patch("path", [6.0, 16.5], [25.0, 18.5], Surface::Pavers, Cover::Concrete),
    patch("forecourt", [6.0, 18.5], [10.0, 20.0], Surface::Pavers, Cover::Concrete),
    patch("bed", [10.0, 18.5], [25.0, 20.0], Surface::Earth, Cover::Grass),
    patch("lawn", [6.0, 6.25], [18.0, 16.5], Surface::Lawn, Cover::Grass),
    patch("east lawn", [18.0, 6.25], [25.0, 16.5], Surface::Lawn, Cover::Grass),
    patch("south-east lawn", [18.0, 0.0], [25.0, 6.25], Surface::Lawn, Cover::Grass),
    patch("corner lawn", [16.0, 0.0], [18.0, 3.5], Surface::Lawn, Cover::Grass),
];

/// From 0 at `from` to 1 at `to`, level at both ends; steepest in the middle, 1.5 over their distance.
fn ramp(from: f64, to: f64, at: f64) -> f64 {
    let t = ((at - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Rises from 0 to 1 and falls back.
fn hump([from, full]: [f64; 2], [fall, to]: [f64; 2], at: f64) -> f64 {
    ramp(from, full, at) * (1.0 - ramp(fall, to, at))
}

/// Height of the ground, metres; nowhere below 0, and 0 at the houses.
pub(super) fn height(x: f64, y: f64) -> f64 {
    // The drive sheds water to its sides and towards its gully: 2.5 %.
    let camber = 0.045 * hump([0.3, 3.0], [3.4, 6.0], x) * hump([1.5, 4.0], [16.0, 19.0], y);
    // A bank in the lawn, 8° at its steepest along y.
    let bank = 0.47 * hump([6.4, 11.4], [11.6, 16.4], y) * hump([9.5, 15.5], [19.0, 24.5], x);
    let lawn = hump([6.2, 7.6], [15.0, 16.5], y) * hump([6.2, 7.6], [23.6, 25.0], x);
    let south_east = hump([0.6, 2.0], [5.0, 6.2], y) * hump([17.0, 18.6], [23.6, 25.0], x);
    let gravel = 0.4 * hump([3.6, 4.4], [5.4, 6.2], y) * hump([6.2, 7.2], [16.0, 17.8], x);
    // Mole runs, hollows, what mowers leave: waves of 1.5 to 3 m that no two places share.
    let waves = (2.1 * x + 0.9 * y).sin() + (2.6 * y - 1.3 * x + 1.0).sin() + 0.8 * (3.1 * x - 2.3 * y + 2.0).sin();
    let bumps = 0.025 * (1.0 + waves / 2.8) * (lawn.max(south_east) + gravel);
    camber + bank + bumps
}

/// What is driven on, with the heights between two corners of the plan, metres: all that is driven on must be there.
pub(super) fn ground(min: [f64; 2], max: [f64; 2]) -> Ground {
    let area = |&Patch { min, max, cover, .. }: &Patch| CoveredArea {
        min: min.map(f64::from),
        max: max.map(f64::from),
        cover,
    };
    Ground {
        elsewhere: Cover::Concrete,
        areas: PATCHES.iter().map(area).collect(),
        terrain: Some(Terrain::sampled(min, max, PITCH, height)),
    }
}

/// The place for a thing that stands on the ground.
pub(super) fn on_ground(x: f32, y: f32, yaw_deg: f32) -> Place {
    Place::new(x, y, height(x.into(), y.into()) as f32, yaw_deg)
}

/// Everything that shows the ground.
pub(super) fn build(scene: &mut Scene) {
    for patch in &PATCHES {
        let even = matches!(patch.cover, Cover::Asphalt | Cover::Concrete);
        let step = DRAWN[usize::from(even)];
        let size = [0, 1].map(|axis| patch.max[axis] - patch.min[axis]);
        let count = size.map(|size| (size / PIECE).ceil());
        let edge = |axis: usize, index: f32| {
            // On the drawn grid, so that pieces share their edges' points.
            patch.min[axis] + ((size[axis] * index / count[axis]) / step).round() * step
        };
        for row in 0..count[1] as u32 {
            for column in 0..count[0] as u32 {
                let [column, row] = [column as f32, row as f32];
                let (min, max) = ([edge(0, column), edge(1, row)], [edge(0, column + 1.0), edge(1, row + 1.0)]);
                let mesh = relief(patch.surface, min, max, step);
                let name = format!("{}, {column} {row}", patch.name);
                scene.piece(&name, Kind::Decor, Place::new(0.0, 0.0, 0.0, 0.0), |piece| {
                    piece.mesh(patch.surface, &mesh);
                });
            }
        }
    }
}

/// A piece of ground, at most `step` between its points.
fn relief(surface: Surface, min: [f32; 2], max: [f32; 2], step: f32) -> Mesh {
    use glam::{Vec3, vec3};
    let cuts = |axis: usize| -> Vec<f32> {
        let count = ((max[axis] - min[axis]) / step).round().max(1.0) as u32;
        (0..=count).map(|cut| (max[axis] - min[axis]) * cut as f32 / count as f32).collect()
    };
    // Textures run on from piece to piece.
    let mapping = surface.mapping_from([min[0], -max[1]]);
    let corner = vec3(min[0], max[1], 0.0);
    let mut mesh = Mesh::grid(corner, Vec3::X, -Vec3::Y, [&cuts(0), &cuts(1)], |_, _| false, mapping);
    for (position, normal) in mesh.positions.iter_mut().zip(&mut mesh.normals) {
        let [x, y] = [position[0], position[1]].map(f64::from);
        position[2] = height(x, y) as f32;
        let slope = |dx: f64, dy: f64| ((height(x + dx, y + dy) - height(x - dx, y - dy)) / 0.02) as f32;
        *normal = vec3(-slope(0.01, 0.0), -slope(0.0, 0.01), 1.0).normalize().to_array();
    }
    mesh
}
