//! How much of each source's light arrives at each vertex. Light adds up, so that any state of the light is a weighted
//! sum.

use glam::Vec3;
use half::f16;
use half::slice::HalfFloatSliceExt;

use super::sun_directions::{self, COUNT};
use super::{WINDOWS, World};
use crate::light::{Bands, LightState, each};

/// What shines apart from others.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The lamps of a group at full brightness; windows by an overcast day.
    Lamps(String),
    /// A sky with a luminance of 1 at its horizon, and everywhere.
    SkyLevel,
    /// A sky whose luminance is the sine of the elevation.
    SkyRise,
    /// What surfaces pass on of a sun, from one of a few directions, that gives 1 to a surface facing it. What comes
    /// straight from it is not among it.
    Sun(usize),
}

/// Half floats of one source's light, by vertex and channel, and what to multiply each channel with: a power of two.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Share {
    pub scale: Bands,
    pub light: Vec<[f16; 4]>,
}

/// Largest half float to be used, a power of two.
const LARGEST: f32 = 16_384.0;

impl Share {
    pub fn of(light: &[Bands]) -> Self {
        let scale = each(|band| {
            let largest = light.iter().fold(0.0_f32, |largest, light| largest.max(light[band]));
            if largest > 0.0 { (largest / LARGEST).log2().ceil().exp2() } else { 1.0 }
        });
        let half = |light: &Bands| std::array::from_fn(|band| f16::from_f32(light[band] / scale[band]));
        Self { scale, light: light.iter().map(half).collect() }
    }
}

/// From every source to every vertex, in the order of the world's objects.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transfer {
    pub(super) sources: Vec<Source>,
    pub(super) shares: Vec<Share>,
}

/// A state of the light as factors of a transfer's sources, rounded to 1/512: what is too little to be seen is no
/// reason to add it all up again.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(Vec<Bands>);

impl Transfer {
    /// The sources that a world has.
    pub(super) fn sources_of(world: &World) -> Vec<Source> {
        let lamps = world.lamp_groups().into_iter().map(|group| Source::Lamps(group.to_owned()));
        let outdoors = [Source::SkyLevel, Source::SkyRise].into_iter().chain((0..COUNT).map(Source::Sun));
        lamps.chain(outdoors.filter(|_| world.open_sky)).collect()
    }

    /// How much of each source there is.
    pub fn weights(&self, light: &LightState) -> Weights {
        // A direction that has hardly a share needs no finer steps than the others.
        let suns = sun_directions::weights(light.beam.towards).map(|share| (512.0 * share).round() / 512.0);
        let weight = |source: &Source| match source {
            Source::Lamps(group) if group == WINDOWS => {
                let dimmed = light.lamps_of(group);
                light.windows.map(|brightness| dimmed * brightness)
            }
            Source::Lamps(group) => [light.lamps_of(group); 4],
            Source::SkyLevel => light.sky.level,
            Source::SkyRise => light.sky.rise,
            Source::Sun(direction) if light.beam.shines() => light.beam.normal.map(|light| suns[*direction] * light),
            Source::Sun(_) => [0.0; 4],
        };
        Weights(self.sources.iter().map(|source| weight(source).map(rounded)).collect())
    }

    /// The irradiance on every vertex, but for what comes straight from the sun: lux, W m⁻² nm⁻¹. Empty if nothing was
    /// baked.
    pub fn irradiance(&self, weights: &Weights) -> Vec<Bands> {
        let vertices = self.shares.first().map_or(0, |share| share.light.len());
        let mut sum = vec![[0.0; 4]; vertices];
        let mut light = vec![0.0; 4 * vertices];
        for (share, weight) in self.shares.iter().zip(&weights.0) {
            if weight.iter().all(|&weight| weight == 0.0) {
                continue;
            }
            let factor = each(|band| weight[band] * share.scale[band]);
            share.light.as_flattened().convert_to_f32_slice(&mut light);
            for (sum, light) in sum.iter_mut().zip(light.as_chunks::<4>().0) {
                for band in 0..4 {
                    sum[band] += factor[band] * light[band];
                }
            }
        }
        // The rise of a clear sky is negative; rounding may leave less than nothing.
        sum.iter_mut().flatten().for_each(|light| *light = light.max(0.0));
        sum
    }

    /// The directions of the suns among its sources.
    pub fn sun_directions() -> Vec<Vec3> {
        sun_directions::directions().to_vec()
    }
}

/// To a relative 1/512.
fn rounded(value: f32) -> f32 {
    // Nine bits of the fraction stay.
    f32::from_bits((value.to_bits() + (1 << 13)) & !((1 << 14) - 1))
}
