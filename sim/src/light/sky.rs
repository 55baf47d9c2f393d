//! How bright the sky is in a direction.

use std::f32::consts::PI;
use std::ops::Add;

use super::{Bands, each};

/// A sky whose brightness changes with height alone: level + rise · sin(elevation), so that two numbers a channel make
/// the overcast sky (CIE standard, three times brighter above than at the horizon) and, nearly, the clear one (CIE:
/// brighter at the horizon). In cd/m² and W m⁻² sr⁻¹ nm⁻¹.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sky {
    /// At the horizon.
    pub level: Bands,
    /// From there to the zenith.
    pub rise: Bands,
    /// Of its light, the share that is seen gathered about the sun. Surfaces are lit as if it were not: it moves with
    /// the sun.
    pub glow: f32,
}

/// Brightness of the clear sky's zenith, of its horizon's: CIE's standard has 0.27 on a curve.
const CLEAR_ZENITH: f32 = 0.25;
/// Share of a clear sky's light about the sun. A guess; Hay's and Perez's models have a third to two thirds there, part
/// of which is counted as the beam's in the tables used here.
const CLEAR_GLOW: f32 = 0.35;

impl Sky {
    /// Black.
    pub const NONE: Self = Self { level: [0.0; 4], rise: [0.0; 4], glow: 0.0 };

    /// The CIE's standard overcast sky that gives the ground so much.
    pub fn overcast(horizontal: Bands) -> Self {
        Self::with_zenith(horizontal, 3.0, 0.0)
    }

    /// A clear sky likewise.
    pub fn clear(horizontal: Bands) -> Self {
        Self::with_zenith(horizontal, CLEAR_ZENITH, CLEAR_GLOW)
    }

    /// Equally bright everywhere.
    pub fn uniform(horizontal: Bands) -> Self {
        Self::with_zenith(horizontal, 1.0, 0.0)
    }

    /// What open, level ground gets of it: ∫ L sin(elevation) dω.
    pub fn horizontal(&self) -> Bands {
        each(|band| PI * self.level[band] + 2.0 / 3.0 * PI * self.rise[band])
    }

    /// `zenith`: of the horizon's brightness.
    fn with_zenith(horizontal: Bands, zenith: f32, glow: f32) -> Self {
        let level = horizontal.map(|light| light / (PI * (1.0 + 2.0 / 3.0 * (zenith - 1.0))));
        Self { level, rise: level.map(|level| level * (zenith - 1.0)), glow }
    }
}

impl Add for Sky {
    type Output = Self;

    /// Both at once.
    fn add(self, other: Self) -> Self {
        let [mine, others] = [self.horizontal()[1], other.horizontal()[1]];
        let sum = mine + others;
        Self {
            level: each(|band| self.level[band] + other.level[band]),
            rise: each(|band| self.rise[band] + other.rise[band]),
            glow: if sum > 0.0 { (self.glow * mine + other.glow * others) / sum } else { 0.0 },
        }
    }
}
