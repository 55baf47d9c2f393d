//! What shines at an instant, in physical units and in both bands: lamps by their groups, the sky, the sun or the moon.
//! Knows no world: how much of it reaches a surface is the business of [`world`](crate::world) and
//! [`render`](crate::render).

mod daylight;
mod lamp;
mod moon;
mod sky;
mod sun;

use std::collections::BTreeMap;

use glam::Vec3;

pub use daylight::daylight;
pub use lamp::{CAR_PLACES, HEADLIGHTS, LampKind, headlights};
pub use moon::moonlight;
pub use sky::Sky;
pub use sun::{BadDate, Clock, Place};

/// A quantity in the four channels. Visible: linear R, G, B of sRGB's primaries, so that 0.2126 R + 0.7152 G + 0.0722 B
/// is in lux (or cd/m²). Fourth: 830 nm, W m⁻² nm⁻¹ (or W m⁻² sr⁻¹ nm⁻¹).
pub type Bands = [f32; 4];

/// Luminance of linear sRGB.
const LUMA: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Outdoors on an overcast day, lux and W m⁻² nm⁻¹ on the ground: what a world's windows are made for. A vertical pane
/// of clear glass (0.85) gets 0.40 of it from the sky and some 0.1 from the ground, and sheds the 3,000 lx that the
/// laboratory's windows do.
const OVERCAST_DAY: Bands = [6750.0, 7100.0, 7570.0, 0.05];
/// Albedo of what lies before a window, and beyond the horizon. A guess between grass and paving.
const GROUND_ALBEDO: Bands = [0.12, 0.13, 0.09, 0.3];

/// What shines at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct LightState {
    /// Brightness of a group's lamps, in multiples of their exitance; groups that are not named have 1, a passing car's
    /// [`HEADLIGHTS`] 0.
    pub lamps: BTreeMap<String, f32>,
    /// What comes through a building's windows, by channel, in multiples of an overcast day.
    pub windows: Bands,
    /// What an open world has above it.
    pub sky: Sky,
    /// The one thing that casts sharp shadows outdoors: the sun, at night the moon.
    pub beam: Beam,
}

/// Parallel light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Unit vector to where it comes from, world frame; may lie below the horizon, where it has no light left.
    pub towards: Vec3,
    /// What a surface gets that faces it: lux, W m⁻² nm⁻¹.
    pub normal: Bands,
}

impl Default for LightState {
    /// All lamps, an overcast day behind windows; an open world has night.
    fn default() -> Self {
        Self { lamps: BTreeMap::new(), windows: [1.0; 4], sky: Sky::NONE, beam: Beam::NONE }
    }
}

impl LightState {
    /// Under a sky and its sun: windows, too, let in what that sky has.
    pub fn under(sky: Sky, beam: Beam) -> Self {
        let mut light = Self { sky, beam, ..Self::default() };
        light.windows = each(|band| light.seen_by_windows(band) / OVERCAST_DAY[band]);
        light
    }

    /// A day without a sun, `scale` times as bright as [`OVERCAST_DAY`].
    pub fn overcast_day(scale: f32) -> Self {
        Self { windows: [scale; 4], sky: Sky::overcast(OVERCAST_DAY.map(|light| scale * light)), ..Self::default() }
    }

    /// Another source of daylight beside this one, as the moon beside a sun that has set. The stronger beam stays; the
    /// other is too weak to be seen beside it.
    pub fn and(self, other: &Self) -> Self {
        let beam = if other.beam.normal[1] > self.beam.normal[1] { other.beam } else { self.beam };
        let windows = each(|band| self.windows[band] + other.windows[band]);
        Self { sky: self.sky + other.sky, beam, windows, ..self }
    }

    /// Brightness of a group of lamps.
    pub fn lamps_of(&self, group: &str) -> f32 {
        self.lamps.get(group).copied().unwrap_or(if group.starts_with(HEADLIGHTS) { 0.0 } else { 1.0 })
    }

    /// The ground at the horizon where a world ends: luminance, radiance.
    pub fn far_ground(&self) -> Bands {
        let lit = self.on_the_ground();
        each(|band| GROUND_ALBEDO[band] * lit[band] / std::f32::consts::PI)
    }

    /// On open, level ground, from sky and beam.
    pub fn on_the_ground(&self) -> Bands {
        let (sky, height) = (self.sky.horizontal(), self.beam.towards.z.max(0.0));
        each(|band| sky[band] + height * self.beam.normal[band])
    }

    /// What counts of the outdoors before a window, as if it were the sky's on the ground. The sun itself does not shine
    /// in: what it lights outside does.
    fn seen_by_windows(&self, band: usize) -> f32 {
        let height = self.beam.towards.z.max(0.0);
        self.sky.horizontal()[band] + GROUND_ALBEDO[band] * height * self.beam.normal[band]
    }
}

impl Beam {
    /// No light; from the zenith, as it must come from somewhere.
    pub const NONE: Self = Self { towards: Vec3::Z, normal: [0.0; 4] };

    /// Whether it lights anything.
    pub fn shines(&self) -> bool {
        self.towards.z > -0.01 && self.normal.iter().any(|&light| light > 0.0)
    }
}

/// Unit vector to a place in the sky, world frame. Elevation above the horizon, azimuth clockwise from north; radians.
pub fn towards(elevation: f64, azimuth: f64) -> Vec3 {
    let (height, reach) = elevation.sin_cos();
    let (east, north) = azimuth.sin_cos();
    glam::DVec3::new(reach * east, reach * north, height).as_vec3()
}

/// Illuminance of light of a colour (its mix need not be normalised), and what it has at 830 nm.
fn coloured(lux: f64, mix: [f32; 3], near_infrared: f64) -> Bands {
    let luma: f32 = (0..3).map(|channel| LUMA[channel] * mix[channel]).sum();
    let [r, g, b] = mix.map(|share| lux as f32 * share / luma);
    [r, g, b, near_infrared as f32]
}

/// Illuminance of light in the three visible channels, lux.
pub fn illuminance(light: &Bands) -> f32 {
    (0..3).map(|channel| LUMA[channel] * light[channel]).sum()
}

/// A value for each channel.
pub(crate) fn each(of: impl FnMut(usize) -> f32) -> Bands {
    std::array::from_fn(of)
}

#[cfg(test)]
mod tests;
