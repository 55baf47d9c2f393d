//! Light, computed once and kept at the vertices: from each group of lamps with soft shadows, from the open sky, from
//! sunlit surfaces; then from surface to surface.
//!
//! Diffuse surfaces only, so irradiance says all. What a lamp sheds directly is summed over points on its panel; what
//! comes from other surfaces and from the sky is gathered along cosine-weighted rays, which are cast once and serve every
//! source and every bounce.

mod cache;
mod gather;
mod surface;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::rays::Rays;
use super::transfer::{Share, Source, Transfer};
use super::{Lamp, World};
use crate::light::{Bands, each};
use gather::Gathered;
use surface::{Points, buried_neighbours};

pub use cache::{Origin, bake_cached, cache_folder};

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

/// Fills in the world's [`Transfer`]. Equal bytes whatever the number of threads. `progress` is told the share done, 0 to
/// 1, from any thread.
pub fn bake(world: &mut World, effort: &Effort, progress: &(dyn Fn(f32) + Sync)) {
    world.transfer = Arc::new(transfer(world, effort, progress));
    progress(1.0);
}

/// What a vertex gets straight from the sources, each of which [`Direct::of`] knows.
struct Direct {
    /// By group, at full brightness.
    lamps: Vec<Bands>,
    /// Of the sky's level and rise; 0 in worlds without a sky.
    sky: [f32; 2],
    /// Of each sun, facing it being 1.
    suns: Vec<f32>,
}

impl Direct {
    fn of(&self, source: &Source, groups: &[&str]) -> Bands {
        match source {
            Source::Lamps(name) => groups.iter().position(|group| group == name).map_or([0.0; 4], |at| self.lamps[at]),
            Source::SkyLevel => [self.sky[0]; 4],
            Source::SkyRise => [self.sky[1]; 4],
            Source::Sun(direction) => [self.suns[*direction]; 4],
        }
    }
}

/// Of the work, what the rays take; the rest is for the bounces. Measured, about.
const CASTING: f32 = 0.9;

fn transfer(world: &World, effort: &Effort, progress: &(dyn Fn(f32) + Sync)) -> Transfer {
    let Some(rays) = Rays::new(&world.objects) else { return Transfer::default() };
    let (points, sources, groups) = (Points::of(world), Transfer::sources_of(world), world.lamp_groups());
    let suns = if world.open_sky { Transfer::sun_directions() } else { Vec::new() };
    let done = AtomicUsize::new(0);
    let (direct, gathered): (Vec<Direct>, Vec<Gathered>) = (0..points.len())
        .into_par_iter()
        .map(|vertex| {
            let (at, normal) = points.sample(vertex);
            let gathered = Gathered::cast(&rays, &world.lamps, at, normal, effort.rays);
            let open = !gathered.buried();
            let of_group = |group: &&str| match open {
                true => from_lamps(&rays, lamps_of(world, group), at, normal, effort),
                false => [0.0; 4],
            };
            let direct = Direct {
                lamps: groups.iter().map(of_group).collect(),
                sky: if world.open_sky && open { gathered.sky() } else { [0.0; 2] },
                suns: suns
                    .iter()
                    .map(|sun| if open { from_sun(&rays, sun.as_dvec3(), at, normal) } else { 0.0 })
                    .collect(),
            };
            let count = 1 + done.fetch_add(1, Ordering::Relaxed);
            if count.is_multiple_of(256) {
                progress(CASTING * count as f32 / points.len() as f32);
            }
            (direct, gathered)
        })
        .unzip();
    let refills = buried_neighbours(&points, &gathered);
    let shares = sources.iter().enumerate().map(|(index, source)| {
        let direct: Vec<Bands> = direct.iter().map(|direct| direct.of(source, &groups)).collect();
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
        if let Source::Sun(_) = source {
            // Straight from the sun comes what the renderer adds, with sharp shadows.
            light.iter_mut().zip(&direct).for_each(|(light, direct)| *light = each(|band| light[band] - direct[band]));
        }
        refill(&mut light, &refills);
        if let Source::Lamps(group) = source {
            points.add_glow(&mut light, lamps_of(world, group));
        }
        progress(CASTING + (1.0 - CASTING) * (index + 1) as f32 / sources.len() as f32);
        Share::of(&light)
    });
    Transfer { shares: shares.collect(), sources }
}

fn lamps_of<'a>(world: &'a World, group: &'a str) -> impl Iterator<Item = &'a Lamp> + Clone {
    world.lamps.iter().filter(move |lamp| lamp.group == group)
}

fn add(a: Bands, b: Bands) -> Bands {
    std::array::from_fn(|band| a[band] + b[band])
}

/// What a point gets of a sun that gives 1 to a surface facing it.
fn from_sun(rays: &Rays, towards: DVec3, at: DVec3, normal: DVec3) -> f32 {
    let facing = normal.dot(towards);
    if facing > 0.0 && rays.first(at, towards, f64::MAX).is_none() { facing as f32 } else { 0.0 }
}

/// Irradiance on a point straight from the lamps, each a grid of small discs.
fn from_lamps<'a>(
    rays: &Rays,
    lamps: impl Iterator<Item = &'a Lamp>,
    at: DVec3,
    normal: DVec3,
    effort: &Effort,
) -> Bands {
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

#[cfg(test)]
mod tests;
