//! Cuts large triangles into small ones, so that light kept at vertices shows shadows.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::Mesh;

/// An edge by its two vertices, the lesser first.
type Edge = (u32, u32);

/// Bisects triangles at their longest edge until none is longer than `longest` (metres) allows at its middle. Both
/// triangles beside an edge are cut together (Rivara's conforming bisection), so no cracks and no seams in the light.
pub fn refine(mesh: &mut Mesh, longest: impl Fn(Vec3) -> f32) {
    loop {
        let mut cut: BTreeSet<Edge> = mesh
            .triangles
            .iter()
            .map(|&triangle| longest_edge(mesh, triangle))
            .filter(|&edge| {
                let [a, b] = ends(mesh, edge);
                a.distance(b) > longest(a.midpoint(b))
            })
            .collect();
        if cut.is_empty() {
            return;
        }
        while propagate(mesh, &mut cut) {}
        split(mesh, &cut);
    }
}

fn ends(mesh: &Mesh, (a, b): Edge) -> [Vec3; 2] {
    [a, b].map(|index| Vec3::from(mesh.positions[index as usize]))
}

fn edges([a, b, c]: [u32; 3]) -> [Edge; 3] {
    [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b)))
}

/// Of equally long ones the one with the greatest indices, so that neighbours agree.
fn longest_edge(mesh: &Mesh, triangle: [u32; 3]) -> Edge {
    let length = |&edge: &Edge| {
        let [a, b] = ends(mesh, edge);
        a.distance_squared(b)
    };
    edges(triangle).into_iter().max_by(|a, b| length(a).total_cmp(&length(b)).then(a.cmp(b))).expect("three edges")
}

/// A triangle with any edge cut has its longest cut too. Returns whether that added one.
fn propagate(mesh: &Mesh, cut: &mut BTreeSet<Edge>) -> bool {
    let before = cut.len();
    for &triangle in &mesh.triangles {
        if edges(triangle).iter().any(|edge| cut.contains(edge)) {
            cut.insert(longest_edge(mesh, triangle));
        }
    }
    cut.len() > before
}

fn split(mesh: &mut Mesh, cut: &BTreeSet<Edge>) {
    let middles: BTreeMap<Edge, u32> = cut.iter().map(|&edge| (edge, add_middle(mesh, edge))).collect();
    let mut pending: Vec<[u32; 3]> = std::mem::take(&mut mesh.triangles);
    pending.reverse();
    let mut done = Vec::with_capacity(2 * pending.len());
    while let Some(triangle) = pending.pop() {
        // The longest edge first; what is left of the triangle still has its other cut edges.
        let by_length = {
            let longest = longest_edge(mesh, triangle);
            let sides = edges(triangle);
            let first = sides.iter().position(|&edge| edge == longest).expect("one of its edges");
            [0, 1, 2].map(|i| (first + i) % 3)
        };
        let sides = edges(triangle);
        match by_length.into_iter().find_map(|i| middles.get(&sides[i]).map(|&middle| (i, middle))) {
            Some((i, middle)) => {
                let [a, b, c] = [0, 1, 2].map(|j| triangle[(i + j) % 3]);
                pending.extend([[middle, b, c], [a, middle, c]]);
            }
            None => done.push(triangle),
        }
    }
    mesh.triangles = done;
}

fn add_middle(mesh: &mut Mesh, (a, b): Edge) -> u32 {
    let (a, b) = (a as usize, b as usize);
    let mean = |x: f32, y: f32| 0.5 * (x + y);
    let position = [0, 1, 2].map(|i| mean(mesh.positions[a][i], mesh.positions[b][i]));
    let normal = Vec3::from(mesh.normals[a]) + Vec3::from(mesh.normals[b]);
    let uv = [0, 1].map(|i| mean(mesh.uvs[a][i], mesh.uvs[b][i]));
    mesh.positions.push(position);
    mesh.normals.push(normal.normalize().to_array());
    mesh.uvs.push(uv);
    mesh.positions.len() as u32 - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::shape::Mapping;

    fn area(mesh: &Mesh) -> f32 {
        mesh.triangles
            .iter()
            .map(|&triangle| mesh.corners(triangle))
            .map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length())
            .sum()
    }

    #[test]
    fn no_edge_stays_too_long_the_area_stays_and_neighbours_share_their_edges() {
        let mut mesh = Mesh::quad(Vec3::ZERO, 4.0 * Vec3::X, 3.0 * Vec3::Y, Mapping::Fitted);
        let allowed = |at: Vec3| if at.x < 1.0 { 0.1 } else { 0.5 };
        refine(&mut mesh, allowed);
        assert!((area(&mesh) - 12.0).abs() < 1e-3);
        let mut uses: BTreeMap<Edge, usize> = BTreeMap::new();
        for &triangle in &mesh.triangles {
            for edge in edges(triangle) {
                let [a, b] = ends(&mesh, edge);
                let outline = |i: usize, side: f32| (a[i] - side).abs() < 1e-5 && (b[i] - side).abs() < 1e-5;
                let once = outline(0, 0.0) || outline(0, 4.0) || outline(1, 0.0) || outline(1, 3.0);
                *uses.entry(edge).or_default() += if once { 2 } else { 1 };
            }
            let [a, b] = ends(&mesh, longest_edge(&mesh, triangle));
            assert!(a.distance(b) <= allowed(a.midpoint(b)));
        }
        assert!(uses.values().all(|&count| count == 2), "a crack");
    }
}
