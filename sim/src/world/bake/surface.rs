//! A world's vertices and triangles in one list each, as the light's computation wants them.

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};

use super::add;
use super::gather::{COVER_DEPTH, Gathered};
use crate::light::Bands;
use crate::world::material::mean_albedo;
use crate::world::{Lamp, World};

/// Samples stay this far off their surface, metres: a ray must not meet what it starts from.
const LIFT: f64 = 1e-3;
/// And at most this far from their vertex towards the middle of its triangles, metres: a vertex in a corner lies on two
/// walls at once and would look through one of them.
const INSET: f32 = 0.02;

/// All vertices and triangles, object after object.
pub(super) struct Points {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// Where light is sampled for a vertex.
    samples: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Mean albedo of each vertex's material.
    albedos: Vec<Bands>,
}

impl Points {
    pub fn of(world: &World) -> Self {
        let means: Vec<Bands> = world.materials.iter().map(mean_albedo).collect();
        let (mut positions, mut normals, mut triangles, mut albedos) = (vec![], vec![], vec![], vec![]);
        for object in &world.objects {
            let first = positions.len() as u32;
            positions.extend(object.mesh.positions.iter().copied().map(Vec3::from));
            normals.extend(object.mesh.normals.iter().copied().map(Vec3::from));
            triangles.extend(object.mesh.triangles.iter().map(|corners| corners.map(|index| first + index)));
            albedos.extend(object.mesh.positions.iter().map(|_| means[object.material]));
        }
        let mut inward = vec![(Vec3::ZERO, 0.0f32); positions.len()];
        for corners in &triangles {
            let middle = corners.iter().map(|&index| positions[index as usize]).sum::<Vec3>() / 3.0;
            for &index in corners {
                let (sum, count) = &mut inward[index as usize];
                *sum += middle - positions[index as usize];
                *count += 1.0;
            }
        }
        let samples = (0..positions.len())
            .map(|index| {
                let (sum, count) = inward[index];
                // Along the surface only: on a round one, inward would be into the body.
                let inset = (0.5 * sum / count.max(1.0)).reject_from(normals[index]);
                positions[index] + inset.clamp_length_max(INSET)
            })
            .collect();
        Self { positions, normals, samples, triangles, albedos }
    }

    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Where a vertex's light is sampled, and the way it faces.
    pub fn sample(&self, vertex: usize) -> (DVec3, DVec3) {
        let normal = self.normals[vertex].as_dvec3().normalize();
        (self.samples[vertex].as_dvec3() + LIFT * normal, normal)
    }

    /// What each triangle sheds, given the irradiance on each vertex.
    pub fn triangle_radiosity(&self, light: &[Bands]) -> Vec<Bands> {
        let corner = |index: u32| light[index as usize];
        self.triangles
            .iter()
            .map(|&[a, b, c]| {
                let (sum, albedo) = (add(add(corner(a), corner(b)), corner(c)), self.albedos[a as usize]);
                std::array::from_fn(|band| sum[band] / 3.0 * albedo[band])
            })
            .collect()
    }

    /// A lamp's cover shines: it gets the irradiance that makes it shed the lamp's exitance.
    pub fn add_glow<'a>(&self, light: &mut [Bands], lamps: impl Iterator<Item = &'a Lamp> + Clone) {
        for (vertex, light) in light.iter_mut().enumerate() {
            for lamp in lamps.clone().filter(|lamp| covers(lamp, self.positions[vertex], self.normals[vertex])) {
                let glow = std::array::from_fn(|band| lamp.exitance[band] / self.albedos[vertex][band]);
                *light = add(*light, glow);
            }
        }
    }
}

/// Whether a point of a surface lies just behind a lamp's panel and faces as it does.
fn covers(lamp: &Lamp, at: Vec3, normal: Vec3) -> bool {
    let [a, b] = lamp.half_edges.map(Vec3::from);
    let facing = a.cross(b).normalize();
    let off = at - Vec3::from(lamp.centre);
    normal.dot(facing) > 0.99
        && (-COVER_DEPTH as f32..=0.0).contains(&off.dot(facing))
        && [a, b].iter().all(|half| off.dot(*half).abs() <= 1.01 * half.length_squared())
}

/// Each buried vertex with the neighbours to take light from, nearest to the open first. Where all is buried there is
/// nothing to take.
pub(super) fn buried_neighbours(points: &Points, gathered: &[Gathered]) -> Vec<(usize, Vec<usize>)> {
    let mut known: Vec<bool> = gathered.iter().map(|gathered| !gathered.buried()).collect();
    let mut neighbours = vec![BTreeSet::new(); points.len()];
    for &[a, b, c] in &points.triangles {
        for (from, to) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
            neighbours[from as usize].insert(to as usize);
        }
    }
    let mut refills = Vec::new();
    loop {
        let round: Vec<(usize, Vec<usize>)> = (0..points.len())
            .filter(|&vertex| !known[vertex])
            .map(|vertex| (vertex, neighbours[vertex].iter().copied().filter(|&other| known[other]).collect()))
            .filter(|(_, from): &(usize, Vec<usize>)| !from.is_empty())
            .collect();
        if round.is_empty() {
            return refills;
        }
        for (vertex, _) in &round {
            known[*vertex] = true;
        }
        refills.extend(round);
    }
}
