//! Moonlight.

use super::{LightState, daylight};

/// The full moon's light, of the sun's at the same height: 0.26 lx on the ground where the sun gives 105 klx (tables have
/// 0.05 to 0.3 lx).
const FULL_MOON: f32 = 2.5e-6;
/// The half moon has a tenth of the full moon's light, not a half: rough ground seen from its lit side.
const PHASE: f32 = 3.3;

/// The moon as a very weak sun. Elevation and azimuth (clockwise from north) in radians; `lit_share` of its disc: 1 for a
/// full moon.
pub fn moonlight(elevation: f64, azimuth: f64, lit_share: f64, cloud_cover: f64) -> LightState {
    let share = FULL_MOON * (lit_share as f32).powf(PHASE);
    // Below the horizon there is no twilight of the moon's worth its name.
    let share = if elevation > 0.0 { share } else { 0.0 };
    let mut light = daylight(elevation, azimuth, cloud_cover);
    for value in [&mut light.windows, &mut light.sky.level, &mut light.sky.rise, &mut light.beam.normal] {
        *value = value.map(|value| share * value);
    }
    light
}
