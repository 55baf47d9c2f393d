//! Depth of a furnished place: the laboratory as a robot drives through it.

use glam::{DAffine3, DMat3, DVec3};

use super::bench::Bench;
use super::statistics::mean;
use super::{Effort, Finding, Findings};
use crate::world::bake::{self, bake_cached, cache_folder};
use crate::world::laboratory::{laboratory, loop_waypoints};

/// Of the lenses, metres.
const HEIGHT: f64 = 0.6;

/// V8: 25 % of a desk scene's interior pixels had none in the TUM benchmark's frames.
pub(super) fn holes(effort: Effort) -> Findings {
    let mut world = laboratory(1);
    // Where nothing can be kept the light is computed each time, and is the same.
    let _ = bake_cached(&mut world, &bake::Effort::default(), &cache_folder(), &|_| {});
    let mut bench = Bench::new(&world)?;
    let way = loop_waypoints();
    let views = if effort == Effort::Full { 24 } else { 8 };
    let mut invalid = vec![];
    for view in 0..views {
        let at = view * (way.len() - 1) / views;
        let [x, y] = way[at];
        let ahead = DVec3::new(way[at + 1][0] - x, way[at + 1][1] - y, 0.0).normalize();
        // The camera's right, down and forward.
        let axes = DMat3::from_cols(ahead.cross(DVec3::Z), DVec3::NEG_Z, ahead);
        let place = DAffine3::from_mat3_translation(axes, DVec3::new(x, y, HEIGHT));
        invalid.push(1.0 - bench.look_from(place)?.valid());
    }
    Ok(vec![Finding::new("interior pixels without depth on the way, share", 0.25, 0.1..=0.35, mean(&invalid))])
}
