//! Depth of a furnished place: the laboratory as a hand holds the device before its desks, and as a robot drives through.

use glam::{DAffine3, DVec3, Vec3};

use super::bench::Bench;
use super::scene::looking;
use super::statistics::mean;
use super::{Effort, Finding, Findings};
use crate::render::RenderError;
use crate::world::bake::{self, bake_cached, cache_folder};
use crate::world::laboratory::{laboratory, loop_waypoints};
use crate::world::rays::Rays;
use crate::world::{Object, World};

/// Of the robot's lenses, metres.
const MOUNTED: f64 = 0.6;
/// Of a device in someone's hands, metres.
const HELD: f64 = 1.2;
/// From the edge of a desk to the device in someone's hands, metres.
const BEFORE_DESKS: [f64; 2] = [0.7, 1.4];
/// What is looked at lies so far above the middle of a desk, metres: in the midst of what stands on it.
const ABOVE_DESKS: f64 = 0.1;
/// Room that someone takes, from the device outwards, metres.
const ELBOWS: f64 = 0.3;

/// V8: 25 % of the interior pixels had no depth in the TUM benchmark's frames of desks, the device held in the hand.
///
/// Every desk, bench and table of the laboratory is looked at from each of its sides where one can stand. On the way at
/// a robot's height less casts shadows: 8.3 % of the same pixels in 300 frames of a kitchen (7-Scenes).
pub(super) fn holes(effort: Effort) -> Findings {
    let mut world = laboratory(1);
    // Where nothing can be kept the light is computed each time, and is the same.
    let _ = bake_cached(&mut world, &bake::Effort::default(), &cache_folder(), &|_| {});
    let mut bench = Bench::new(&world)?;
    let every = if effort == Effort::Full { 1 } else { 3 };
    let mut share = |places: Vec<DAffine3>| -> Result<f64, RenderError> {
        let invalid = places.into_iter().step_by(every).map(|place| Ok(1.0 - bench.look_from(place)?.valid()));
        Ok(mean(&invalid.collect::<Result<Vec<_>, RenderError>>()?))
    };
    let (desks, way) = (share(before_desks(&world))?, share(on_the_way())?);
    Ok(vec![
        Finding::new("interior pixels without depth before desks, share", 0.25, 0.1..=0.35, desks),
        Finding::new("interior pixels without depth on the way, share", 0.083, 0.042..=0.125, way),
    ])
}

/// As [`laboratory`] names them.
fn is_worktop(object: &Object) -> bool {
    let endings = ["desk, Walnut", "desk, Oak", "table, Walnut", ", Resin"];
    endings.iter().any(|ending| object.name.ends_with(ending))
}

/// `world_from_infrared` before each worktop's four sides, as far as one can stand there and sees it.
fn before_desks(world: &World) -> Vec<DAffine3> {
    let Some(things) = Rays::new(&world.objects) else { return vec![] };
    let mut places = vec![];
    for worktop in world.objects.iter().filter(|object| is_worktop(object)) {
        let [min, max] = worktop.mesh.bounds().map(Vec3::as_dvec3);
        let (middle, half) = ((min + max) / 2.0, (max - min) / 2.0);
        for side in [DVec3::NEG_Y, DVec3::X, DVec3::Y, DVec3::NEG_X] {
            for distance in BEFORE_DESKS {
                let edge = (middle + side * half).with_z(HELD);
                let eye = edge + distance * side;
                let stands_on = things.first(eye, DVec3::NEG_Z, 2.0 * HELD).map(|hit| HELD - hit.distance);
                let is_free = things.distance(eye) > ELBOWS && !things.blocked(eye, edge);
                if is_free && stands_on.is_some_and(|height| height.abs() < 0.05) {
                    places.push(looking(eye, middle.with_z(max.z + ABOVE_DESKS) - eye));
                }
            }
        }
    }
    places
}

/// Two dozen places of the robot's loop.
fn on_the_way() -> Vec<DAffine3> {
    let way = loop_waypoints();
    let view = |number: usize| {
        let at = number * (way.len() - 1) / 24;
        let [from, to] = [way[at], way[at + 1]].map(|[x, y]| DVec3::new(x, y, MOUNTED));
        looking(from, to - from)
    };
    (0..24).map(view).collect()
}
