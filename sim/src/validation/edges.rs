//! A block before a wall: where its edges are seen, and the shadow that the projector's light leaves beside it.

use glam::Vec3;

use super::bench::{BASELINE_FOCAL, Bench, Seen};
use super::scene::{self, Light, block, even, facing_wall, object};
use super::statistics::{mean, spread};
use super::{Effort, Finding, Findings};
use crate::render::RenderError;

/// Half the width of the block, metres.
const HALF_WIDTH: f32 = 0.25;
/// How far the block and the wall are, metres.
const PAIRS: [(f32, f32); 4] = [(1.0, 2.0), (2.0, 4.0), (1.5, 3.0), (1.0, 4.0)];

/// A block's front at `near` metres, a wall at `far`.
fn block_before_wall(near: f32, far: f32) -> Result<Seen, RenderError> {
    let middle = Vec3::new(0.0, near + 0.05, 0.0);
    let front = block(middle, Vec3::new(2.0 * HALF_WIDTH, 0.1, 0.8), Light::LED);
    let objects = vec![object("block", front, 0), object("wall", facing_wall(far, Light::LED), 0)];
    Bench::new(&scene::world("block", objects, vec![even("paint", [200, 200, 200], 0.8)]))?.look()
}

/// Of each row across the block: the first and last columns with its depth, and those of the wall's beside them.
#[derive(Default)]
struct Edges {
    wall_ends: Vec<f64>,
    block_begins: Vec<f64>,
    block_ends: Vec<f64>,
    wall_begins: Vec<f64>,
}

impl Edges {
    fn of(near: f32, far: f32) -> Result<Self, RenderError> {
        let seen = block_before_wall(near, far)?;
        let mut edges = Self::default();
        let half = (580.0 * HALF_WIDTH / near) as usize;
        for y in 180..300 {
            let is =
                |x: &usize, z: f32| seen.depth(*x, y).is_some_and(|depth| (depth / f64::from(z) - 1.0).abs() < 0.1);
            let about = |edge: usize| edge - 40..edge + 40;
            let (left, right) = (about(320 - half), about(320 + half));
            let column = |found: Option<usize>| found.map_or(f64::NAN, |column| column as f64);
            edges.wall_ends.push(column(left.clone().rev().find(|x| is(x, far))));
            edges.block_begins.push(column(left.clone().find(|x| is(x, near))));
            edges.block_ends.push(column(right.clone().rev().find(|x| is(x, near))));
            edges.wall_begins.push(column(right.clone().find(|x| is(x, far))));
        }
        Ok(edges)
    }
}

/// V4. Nguyen et al.: 0.8 px from both edges of a target, at all distances together.
pub(super) fn jitter(effort: Effort) -> Findings {
    let mut variances = vec![];
    for &(near, far) in effort.of(&PAIRS[..3], 1) {
        let edges = Edges::of(near, far)?;
        variances.extend([&edges.block_begins, &edges.block_ends].map(|edge| spread(edge).powi(2)));
    }
    Ok(vec![Finding::new("lateral noise, px", 0.8, 0.5..=1.2, mean(&variances).sqrt())])
}

/// V7: b·f·(1/near − 1/far), and only to the left, where the projector is not.
pub(super) fn shadows(effort: Effort) -> Findings {
    let mut findings = vec![];
    for &(near, far) in effort.of(&PAIRS, 1) {
        let edges = Edges::of(near, far)?;
        let gap = |from: &[f64], to: &[f64]| mean(to) - mean(from) - 1.0;
        let target = BASELINE_FOCAL * f64::from(1.0 / near - 1.0 / far);
        let left = gap(&edges.wall_ends, &edges.block_begins);
        let what = format!("shadow of {near} m on {far} m, px");
        findings.push(Finding::new(what, target, target - 2.0..=target + 2.0, left));
        let right = gap(&edges.block_ends, &edges.wall_begins);
        findings.push(Finding::new(format!("gap at its right, {near} m on {far} m, px"), 0.0, 0.0..=2.0, right));
    }
    Ok(findings)
}
