//! Lamps by kind: their colour, and how much they have at 830 nm.

use super::{Bands, coloured};

/// Groups whose names begin so are a passing car's headlights at one place after another: dark unless they are named.
pub const HEADLIGHTS: &str = "headlights";
/// At how many places.
pub const CAR_PLACES: usize = 4;

/// The group of the lamps that a car has at the `index`th place.
pub fn headlights(index: usize) -> String {
    format!("{HEADLIGHTS} {index}")
}

/// What a lamp makes light with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LampKind {
    /// A filament at 2700 K.
    Incandescent,
    /// A filament at 3000 K: floodlights, headlights.
    Halogen,
    /// A white LED, 4000 K.
    Led,
    /// A fluorescent tube, 4000 K.
    Fluorescent,
    /// A high-pressure sodium street lamp, 2000 K.
    Sodium,
}

impl LampKind {
    /// What a lamp of this kind sheds that sheds so many lux.
    pub fn exitance(self, lux: f32) -> Bands {
        let kilolux = f64::from(lux) / 1000.0;
        coloured(lux.into(), self.mix(), kilolux * self.near_infrared())
    }

    /// At 830 nm, W m⁻² nm⁻¹ for a kilolux. Filaments: black bodies. Sodium: by the lines at 818 and 819.5 nm, on the
    /// band's edge, about as halogen. LED and tube: below 0.0003, next to nothing.
    pub fn near_infrared(self) -> f64 {
        match self {
            Self::Incandescent => 0.042,
            Self::Halogen | Self::Sodium => 0.031,
            Self::Led | Self::Fluorescent => 0.0,
        }
    }

    /// Linear sRGB of a black body of the kind's colour temperature (Charity's table).
    fn mix(self) -> [f32; 3] {
        match self {
            Self::Incandescent => [1.0, 0.397, 0.095],
            Self::Halogen => [1.0, 0.456, 0.147],
            Self::Led | Self::Fluorescent => [1.0, 0.617, 0.381],
            Self::Sodium => [1.0, 0.25, 0.006],
        }
    }
}
