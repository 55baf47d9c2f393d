//! Sun and sky by the sun's height and the clouds.

use super::{Bands, Beam, LightState, Sky, coloured, each, towards};

/// A clear sky at one elevation of the sun.
struct Row {
    /// Degrees.
    elevation: f64,
    /// Facing the sun: klx, W m⁻² nm⁻¹ at 830 nm.
    direct: [f64; 2],
    /// On the ground from the sky alone: klx, W m⁻² nm⁻¹.
    diffuse: [f64; 2],
}

const fn row(elevation: f64, direct: [f64; 2], diffuse: [f64; 2]) -> Row {
    Row { elevation, direct, diffuse }
}

/// SPECTRL2 (Bird & Riordan) with an aerosol optical depth of 0.084, 1.42 cm of water, albedo 0.2. Zenith: extrapolated
/// over the air mass.
const CLEAR: [Row; 8] = [
    row(3.0, [7.8, 0.29], [2.0, 0.011]),
    row(5.0, [18.0, 0.42], [3.3, 0.016]),
    row(10.0, [44.0, 0.61], [5.9, 0.025]),
    row(20.0, [74.0, 0.77], [9.1, 0.034]),
    row(30.0, [89.0, 0.83], [11.0, 0.039]),
    row(45.0, [100.0, 0.88], [13.0, 0.044]),
    row(60.0, [105.0, 0.90], [14.0, 0.047]),
    row(90.0, [108.0, 0.91], [14.4, 0.048]),
];
/// Facing the sun as it touches the horizon, klx and W m⁻² nm⁻¹. A guess: the table's fall goes on.
const DIRECT_AT_HORIZON: [f64; 2] = [0.6, 0.06];
/// Radius of the sun's disc, degrees.
const DISC: f64 = 0.267;
/// On the ground from the sky, klx, by the sun's elevation in degrees: sunset, the ends of civil, nautical and
/// astronomical twilight (standard tables), then stars.
const TWILIGHT: [[f64; 2]; 5] = [[-18.0, 1e-6], [-12.0, 8e-6], [-6.0, 3.4e-3], [0.0, 0.4], [3.0, 2.0]];
/// At 830 nm in twilight, W m⁻² nm⁻¹ for a kilolux. A guess: as the lowest sun's sky.
const TWILIGHT_AT_830: f64 = 0.0055;
/// Of an overcast sky, W m⁻² nm⁻¹ for a kilolux; 0.006 to 0.008 (estimate): cloud is nearly grey.
const OVERCAST_AT_830: f64 = 0.007;

/// Colour of the blue sky: a black body of 12,000 K, and of cloud: white.
const BLUE: [f32; 3] = [0.546, 0.638, 1.0];
const WHITE: [f32; 3] = [1.0; 3];
/// Colour of the sun above the air: a black body of 5,800 K.
const SUN: [f32; 3] = [1.0, 0.871, 0.814];
/// Optical depth of the air at sRGB's primaries (612, 549, 464 nm): Rayleigh (0.0088 λ^−4.09), aerosol (0.084 at
/// 500 nm, exponent 1.3), ozone.
const OPTICAL_DEPTH: [f64; 3] = [0.16, 0.2, 0.3];

/// The light of a sun at an elevation and azimuth (clockwise from north; radians), 0 to 1 of the sky being cloud.
pub fn daylight(elevation: f64, azimuth: f64, cloud_cover: f64) -> LightState {
    let degrees = elevation.to_degrees();
    let (direct, diffuse) = (clear_direct(degrees), clear_diffuse(degrees));
    let height = elevation.sin().max(0.0);
    // Kasten and Czeplak (1980), as remembered: clouds take three quarters of what comes down; how much of the rest is
    // diffuse rises with their square.
    let clear_global = direct[0] * height + diffuse[0];
    let global = clear_global * (1.0 - 0.75 * cloud_cover.powf(3.4));
    let clear_share = diffuse[0] / clear_global;
    let all_diffuse = global * (clear_share + (1.0 - clear_share) * cloud_cover * cloud_cover);
    // What is not diffuse is the beam's, which has lost as much in both bands.
    let passed = global / clear_global * (1.0 - cloud_cover * cloud_cover);
    let blue = (diffuse[0] * (1.0 - cloud_cover)).min(all_diffuse);
    let grey = all_diffuse - blue;

    let lux = |kilolux: f64| 1000.0 * kilolux;
    let clear = coloured(lux(blue), BLUE, blue * diffuse[1] / diffuse[0]);
    let overcast = coloured(lux(grey), WHITE, grey * OVERCAST_AT_830);
    let normal = coloured(lux(direct[0]), sun_mix(degrees), direct[1]).map(|light| light * passed as f32);
    let beam = Beam { towards: towards(elevation, azimuth), normal };
    LightState::under(Sky::clear(clear) + Sky::overcast(overcast), beam)
}

/// klx and W m⁻² nm⁻¹ facing the sun.
fn clear_direct(degrees: f64) -> [f64; 2] {
    let lowest = &CLEAR[0];
    let seen = ((degrees + DISC) / (2.0 * DISC)).clamp(0.0, 1.0);
    [0, 1].map(|band| match degrees {
        ..3.0 => {
            let share = (degrees / lowest.elevation).max(0.0);
            seen * geometric(DIRECT_AT_HORIZON[band], lowest.direct[band], share)
        }
        _ => from_table(degrees, |row| row.direct[band]),
    })
}

/// klx and W m⁻² nm⁻¹ on the ground from a clear sky.
fn clear_diffuse(degrees: f64) -> [f64; 2] {
    if degrees >= CLEAR[0].elevation {
        return [0, 1].map(|band| from_table(degrees, |row| row.diffuse[band]));
    }
    let above = TWILIGHT.iter().position(|[elevation, _]| *elevation > degrees).expect("below 3°");
    let [[low, dark], [high, bright]] = [TWILIGHT[above.saturating_sub(1)], TWILIGHT[above]];
    let kilolux = if above == 0 { dark } else { geometric(dark, bright, (degrees - low) / (high - low)) };
    [kilolux, kilolux * TWILIGHT_AT_830]
}

fn from_table(degrees: f64, value: impl Fn(&Row) -> f64) -> f64 {
    let above = CLEAR.iter().position(|row| row.elevation >= degrees).unwrap_or(CLEAR.len() - 1).max(1);
    let [low, high] = [&CLEAR[above - 1], &CLEAR[above]];
    let share = (degrees - low.elevation) / (high.elevation - low.elevation);
    value(low) + share * (value(high) - value(low))
}

/// From one value to another in equal ratios.
fn geometric(from: f64, to: f64, share: f64) -> f64 {
    from * (to / from).powf(share)
}

/// Reddened by the air on its way (air mass of Kasten and Young, 1989).
fn sun_mix(degrees: f64) -> [f32; 3] {
    let above = degrees.max(0.0);
    let air_mass = 1.0 / (above.to_radians().sin() + 0.50572 * (above + 6.07995).powf(-1.6364));
    let left: Bands = each(|band| if band < 3 { (-OPTICAL_DEPTH[band] * air_mass).exp() as f32 } else { 0.0 });
    [0, 1, 2].map(|channel| SUN[channel] * left[channel])
}
