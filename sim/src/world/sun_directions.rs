//! The directions that the sun's indirect light is computed for, and how any other is made of them.

use std::f32::consts::TAU;

use glam::Vec3;

use crate::light::towards;

/// Elevation (degrees) and number of azimuths, the first of them north: two rings and the zenith. The lower one lies
/// where the sun's light turns from the ground to the walls.
const RINGS: [(f64, usize); 3] = [(4.0, 8), (30.0, 6), (90.0, 1)];
/// Of directions in all.
pub(super) const COUNT: usize = 15;

/// Unit vectors towards the sun, ring after ring from the lowest.
pub(super) fn directions() -> [Vec3; COUNT] {
    let mut all = RINGS.iter().flat_map(|&(elevation, azimuths)| {
        (0..azimuths)
            .map(move |index| towards(elevation.to_radians(), std::f64::consts::TAU * index as f64 / azimuths as f64))
    });
    std::array::from_fn(|_| all.next().expect("the rings have as many"))
}

/// How much of each direction's light makes up another's, without a jump: the directions beside it, weighted so that their
/// sum is the direction. Surfaces that all of them reach then get just what the cosine gives. Below the lowest ring, as on
/// it.
pub(super) fn weights(towards_sun: Vec3) -> [f32; COUNT] {
    let (reach, height) = (towards_sun.x.hypot(towards_sun.y), towards_sun.z);
    let turn = (towards_sun.x.atan2(towards_sun.y) / TAU).rem_euclid(1.0);
    let rings = RINGS.map(|(elevation, azimuths)| Ring::at(elevation.to_radians() as f32, azimuths, turn));
    let mut ring_weights = [0.0; RINGS.len()];
    let above = (1..RINGS.len() - 1).find(|&ring| height * rings[ring].reach < rings[ring].height * reach);
    let above = above.unwrap_or(RINGS.len() - 1);
    let [low, high] = [&rings[above - 1], &rings[above]];
    // low · a + high · b = the sun, across and up.
    let area = low.reach * high.height - high.reach * low.height;
    let b = (low.reach * height - low.height * reach) / area;
    if above == 1 && b < 0.0 {
        ring_weights[0] = reach / low.reach;
    } else {
        ring_weights[above - 1] = (reach * high.height - height * high.reach) / area;
        ring_weights[above] = b.max(0.0);
    }
    let mut weights = [0.0; COUNT];
    let mut first = 0;
    for ((ring, weight), (_, azimuths)) in rings.iter().zip(ring_weights).zip(RINGS) {
        for (index, share) in ring.beside {
            weights[first + index] += weight * share;
        }
        first += azimuths;
    }
    weights
}

/// The two directions of a ring beside an azimuth, which a turn of 0 to 1 says.
struct Ring {
    /// Index in the ring, and weight: their sum has the azimuth, and the length of one of them along the ground.
    beside: [(usize, f32); 2],
    /// That sum along the ground, and up.
    reach: f32,
    height: f32,
}

impl Ring {
    fn at(elevation: f32, azimuths: usize, turn: f32) -> Self {
        let at = turn * azimuths as f32;
        let (before, beside) = (at.floor() as usize % azimuths, at.fract());
        let step = TAU / azimuths as f32;
        let shares = match azimuths {
            1 => [1.0, 0.0],
            _ => [1.0 - beside, beside].map(|share| (share * step).sin() / step.sin()),
        };
        let beside = [(before, shares[0]), ((before + 1) % azimuths, shares[1])];
        Self { beside, reach: elevation.cos(), height: (shares[0] + shares[1]) * elevation.sin() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_is_made_of_its_neighbours_and_one_of_the_dozen_of_itself() {
        for (index, direction) in directions().into_iter().enumerate() {
            let weights = weights(direction);
            assert!(weights[index] > 0.999, "{direction}: {weights:?}");
        }
    }

    #[test]
    fn weights_make_up_the_direction_and_never_jump() {
        let mut before: Option<[f32; COUNT]> = None;
        for step in 0..4000 {
            let share = f64::from(step) / 4000.0;
            let sun = towards(share * 1.6 - 0.05, share * 13.0);
            let weights = weights(sun);
            assert!(weights.iter().all(|weight| (-1e-5..1.2).contains(weight)), "step {step}: {weights:?}");
            let sum: Vec3 = directions().iter().zip(weights).map(|(&direction, weight)| weight * direction).sum();
            if sun.z > 0.08 {
                assert!((sum - sun).length() < 1e-3, "step {step}: {sum} for {sun}");
            }
            if let Some(before) = before {
                assert!(weights.iter().zip(before).all(|(now, before)| (now - before).abs() < 0.02), "step {step}");
            }
            before = Some(weights);
        }
    }
}
