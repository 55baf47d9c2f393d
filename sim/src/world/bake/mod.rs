//! Light, computed once and kept at the vertices: from each lamp with soft shadows, then from surface to surface.
//!
//! Diffuse surfaces only, so irradiance says all. What a lamp sheds directly is summed over points on its panel; what
//! comes from other surfaces is gathered along cosine-weighted rays, which are cast once and serve every bounce.

mod cache;
mod gather;
mod surface;

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::rays::Rays;
use super::{Brightness, Lamp, LightSource, World};
use gather::Gathered;
use surface::{Points, buried_neighbours};

pub use cache::{Origin, bake_cached, cache_folder};

/// A quantity in the four channels: R, G, B, 830 nm.
type Bands = [f32; 4];

/// The irradiance on every vertex, in the objects' order, by each of [`LightSource::ALL`] alone at full brightness.
/// Light adds up, so any brightness is had from it.
type BySource = [Vec<Bands>; LightSource::ALL.len()];

/// How much work the light is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Gathering rays a vertex.
    pub rays: u32,
    /// How often light is passed on from surface to surface.
    pub bounces: u32,
    /// Largest distance between two points that stand for a lamp, metres; at least 3 × 3 points, at most 8 × 8.
    pub lamp_step: f32,
}

impl Default for Effort {
    /// Chosen by looking: with half the rays, walls show blotches; bounces cost next to nothing.
    fn default() -> Self {
        Self { rays: 256, bounces: 5, lamp_step: 0.3 }
    }
}

/// Fills in every vertex's irradiance. Equal bytes whatever the number of threads. `progress` is told the share done,
/// 0 to 1, from any thread.
pub fn bake(world: &mut World, effort: &Effort, brightness: Brightness, progress: &(dyn Fn(f32) + Sync)) {
    let light = by_source(world, effort, progress);
    write(world, &light, brightness);
    progress(1.0);
}

fn by_source(world: &World, effort: &Effort, progress: &(dyn Fn(f32) + Sync)) -> BySource {
    let Some(rays) = Rays::new(&world.objects) else { return BySource::default() };
    let points = Points::of(world);
    let done = AtomicUsize::new(0);
    let (direct, gathered): (Vec<[Bands; 2]>, Vec<Gathered>) = (0..points.len())
        .into_par_iter()
        .map(|vertex| {
            let (at, normal) = points.sample(vertex);
            let gathered = Gathered::cast(&rays, &world.lamps, at, normal, effort.rays);
            let direct = LightSource::ALL.map(|source| match gathered.buried() {
                true => [0.0; 4],
                false => direct(&rays, lamps_of(world, source), at, normal, effort),
            });
            let count = 1 + done.fetch_add(1, Ordering::Relaxed);
            if count.is_multiple_of(256) {
                progress(count as f32 / points.len() as f32);
            }
            (direct, gathered)
        })
        .unzip();
    let refills = buried_neighbours(&points, &gathered);
    LightSource::ALL.map(|source| {
        let direct: Vec<Bands> = direct.iter().map(|by_source| by_source[source as usize]).collect();
        let mut light = direct.clone();
        for _ in 0..effort.bounces {
            refill(&mut light, &refills);
            let radiosity = points.triangle_radiosity(&light);
            light = direct
                .par_iter()
                .zip(&gathered)
                .map(|(&direct, gathered)| add(direct, gathered.mean(&radiosity)))
                .collect();
        }
        refill(&mut light, &refills);
        points.add_glow(&mut light, lamps_of(world, source));
        light
    })
}

fn lamps_of(world: &World, source: LightSource) -> impl Iterator<Item = &Lamp> + Clone {
    world.lamps.iter().filter(move |lamp| lamp.source == source)
}

fn add(a: Bands, b: Bands) -> Bands {
    std::array::from_fn(|band| a[band] + b[band])
}

/// Irradiance on a point straight from the lamps, each a grid of small discs.
fn direct<'a>(rays: &Rays, lamps: impl Iterator<Item = &'a Lamp>, at: DVec3, normal: DVec3, effort: &Effort) -> Bands {
    let mut sum = [0.0; 4];
    for lamp in lamps {
        let [centre, a, b] = [lamp.centre, lamp.half_edges[0], lamp.half_edges[1]].map(|v| Vec3::from(v).as_dvec3());
        let facing = a.cross(b).normalize();
        let count = |half: DVec3| (2.0 * half.length() / f64::from(effort.lamp_step)).ceil().clamp(3.0, 8.0) as u32;
        let (columns, rows) = (count(a), count(b));
        let area = 4.0 * a.cross(b).length() / f64::from(columns * rows);
        let along = |i: u32, count: u32| (f64::from(2 * i + 1) / f64::from(count)) - 1.0;
        let mut form_factor = 0.0;
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let point = centre + along(column, columns) * a + along(row, rows) * b;
            let way = point - at;
            let squared = way.length_squared();
            let (leaving, arriving) = (-way.dot(facing), way.dot(normal));
            if leaving <= 0.0 || arriving <= 0.0 || rays.blocked(at, point) {
                continue;
            }
            // Of a small disc: bounded, however near the point.
            form_factor += leaving * arriving / squared * area / (std::f64::consts::PI * squared + area);
        }
        for (sum, exitance) in sum.iter_mut().zip(lamp.exitance) {
            *sum += form_factor as f32 * exitance;
        }
    }
    sum
}

/// Points inside a body see nothing, but their triangles reach into the open: they take their neighbours' light.
fn refill(light: &mut [Bands], refills: &[(usize, Vec<usize>)]) {
    for (vertex, neighbours) in refills {
        let sum = neighbours.iter().fold([0.0; 4], |sum, &neighbour| add(sum, light[neighbour]));
        light[*vertex] = sum.map(|sum| sum / neighbours.len() as f32);
    }
}

/// Hands the irradiance of all vertices to the meshes.
fn write(world: &mut World, light: &BySource, brightness: Brightness) {
    let shares = LightSource::ALL.map(|source| brightness.of(source));
    let mut vertex = 0;
    for object in &mut world.objects {
        let count = object.mesh.positions.len();
        let sum = |vertex: usize| -> Bands {
            std::array::from_fn(|band| light.iter().zip(shares).map(|(light, share)| share * light[vertex][band]).sum())
        };
        object.mesh.irradiance = (vertex..vertex + count).map(sum).collect();
        vertex += count;
    }
}

#[cfg(test)]
mod tests;
