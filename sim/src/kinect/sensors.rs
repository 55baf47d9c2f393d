//! The two camera chips and their lenses: from light to electrons to numbers.

use std::f64::consts::PI;

use crate::render::{ColourSensor, InfraredSensor};

/// Exposure time (seconds) and amplification of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposure {
    /// Seconds.
    pub time: f64,
    /// Amplification before the converter, at least 1.
    pub gain: f64,
}

/// Share of the light on its way to the chip that a lens lets through. A guess.
const LENS_TRANSMISSION: f64 = 0.8;

/// Irradiance on the chip for a radiance of 1 in front of the lens: π·T/(4·N²), N being the f-number.
fn chip_irradiance_per_radiance(f_number: f64) -> f64 {
    PI * LENS_TRANSMISSION / (4.0 * f_number * f_number)
}

/// The colour camera: MT9M112; its noise is that of the sibling MT9V112's data sheet.
pub mod colour {
    use super::{ColourSensor, Exposure, chip_irradiance_per_radiance};

    /// A guess; with it noise dominates below some 10 lx, as seen on the device.
    const F_NUMBER: f64 = 2.8;
    /// Electrons a pixel holds, from a highest signal-to-noise ratio of 44 dB.
    const FULL_WELL: f64 = 25_000.0;
    /// Light that fills it, lux seconds: 1.0 V/(lux s) and a swing of 1 V.
    const FULL_WELL_EXPOSURE: f64 = 1.0;
    /// Electrons, from a dynamic range of 71 dB.
    const READ_NOISE: f64 = 7.0;
    /// Of the converter: 10 bits.
    const LARGEST_NUMBER: f64 = 1023.0;
    /// Brightness lost in the corners after the chip's own correction, share. A guess.
    pub const VIGNETTING: f32 = 0.25;
    /// First row's exposure to the last row's, seconds: 480 rows of 54.21 µs (libfreenect).
    pub const READOUT: f64 = 0.026;
    /// Seconds; one row, and a frame at 30 Hz (libfreenect).
    pub const SHORTEST: f64 = 54.21e-6;
    /// Seconds.
    pub const LONGEST: f64 = 0.0333;
    /// A guess.
    pub const HIGHEST_GAIN: f64 = 8.0;

    /// What the chip does with an exposure, and with the gains of R, G, B by which it balances white.
    pub fn sensor(exposure: Exposure, balance: [f64; 3], noise: bool, noise_key: u32) -> ColourSensor {
        let electrons_per_lux_second = FULL_WELL / FULL_WELL_EXPOSURE;
        let electrons = electrons_per_lux_second * exposure.time * chip_irradiance_per_radiance(F_NUMBER);
        // The converter rounds; uniform errors have a variance of 1/12.
        let step = FULL_WELL / LARGEST_NUMBER / exposure.gain;
        let on = f64::from(u8::from(noise));
        ColourSensor {
            electrons_per_luminance: electrons as f32,
            read_variance: (on * (READ_NOISE * READ_NOISE + step * step / 12.0)) as f32,
            shot_noise: on as f32,
            noise_key,
            level_per_electron: balance.map(|gain| (gain * exposure.gain / FULL_WELL) as f32).into(),
            padding: 0,
        }
    }
}

/// The infrared camera: MT9M001, 2×2 pixels read as one.
pub mod infrared {
    use super::{Exposure, InfraredSensor, chip_irradiance_per_radiance};

    /// A guess.
    const F_NUMBER: f64 = 2.0;
    /// Edge of a pixel, metres (data sheet); four make one of the image.
    const PIXEL_EDGE: f64 = 5.2e-6;
    const BINNED: f64 = 4.0;
    /// Electrons a photon of 830 nm frees; 0.15 to 0.3 are said.
    const QUANTUM_EFFICIENCY: f64 = 0.2;
    /// Of a photon of 830 nm, joules: h·c/λ.
    const PHOTON_ENERGY: f64 = 2.393e-19;
    /// Electrons a pixel holds, from a highest signal-to-noise ratio of 45 dB.
    const FULL_WELL: f64 = 31_600.0;
    const LARGEST_NUMBER: f64 = 1023.0;
    /// Electrons, from a dynamic range of 68.2 dB.
    const READ_NOISE: f64 = 12.0;
    /// Full width of the filter at half its height, nm. A guess within 15 to 60; nobody published it.
    const BANDWIDTH: f64 = 30.0;
    /// Speckle of the dots, share: a grain is 2 µm wide (830 nm at f/2), so some 27 of them average in a pixel of
    /// 10.4 µm, in two polarisations. Estimate.
    const SPECKLE_CONTRAST: f64 = 0.14;
    /// Brightness lost in the corners, share. A guess.
    pub const VIGNETTING: f32 = 0.25;
    /// First row's exposure to the last row's, seconds: 960 rows of about 32 µs.
    pub const READOUT: f64 = 0.031;
    /// Seconds; one row, and nearly a frame.
    pub const SHORTEST: f64 = 32e-6;
    /// Seconds.
    pub const LONGEST: f64 = 0.030;
    /// Data sheet.
    pub const HIGHEST_GAIN: f64 = 15.0;

    /// What the chip does with an exposure.
    pub fn sensor(exposure: Exposure, noise: bool, noise_key: u32, speckle_key: u32) -> InfraredSensor {
        let area = BINNED * PIXEL_EDGE * PIXEL_EDGE;
        let photons_per_radiance = chip_irradiance_per_radiance(F_NUMBER) * area * exposure.time / PHOTON_ENERGY;
        let electrons_per_number = FULL_WELL / LARGEST_NUMBER;
        // The converter rounds before four pixels are averaged; uniform errors have a variance of 1/12.
        let step = electrons_per_number / exposure.gain;
        let read_variance = BINNED * (READ_NOISE * READ_NOISE + step * step / 12.0);
        let on = f64::from(u8::from(noise));
        InfraredSensor {
            bandwidth: BANDWIDTH as f32,
            electrons_per_radiance: (QUANTUM_EFFICIENCY * photons_per_radiance) as f32,
            read_variance: (on * read_variance) as f32,
            shot_noise: on as f32,
            numbers_per_electron: (exposure.gain / (BINNED * electrons_per_number)) as f32,
            speckle_contrast: (on * SPECKLE_CONTRAST) as f32,
            noise_key,
            speckle_key,
            stray_electrons: 0.0,
        }
    }
}
