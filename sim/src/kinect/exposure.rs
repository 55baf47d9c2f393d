//! Automatic exposure: from the last image to the next one's exposure time and gain.

use super::matcher::NO_DEPTH;
use super::sensors::{Exposure, colour, infrared};

/// Seconds in which a step in brightness is made up for but for 1/e. Estimate, 0.2 to 1.5 are plausible.
const TIME_CONSTANT: f64 = 0.5;
/// Mean of the colour image's linear light that is aimed at, of full scale: a grey card.
const COLOUR_TARGET: f64 = 0.18;
/// Share of the infrared image's pixels that may exceed the target below; some 2 % are dots' peaks.
const INFRARED_ABOVE: f64 = 0.02;
/// Brightness aimed at for the brightest of the rest, of full scale. A guess, well below saturation.
const INFRARED_TARGET: f64 = 0.6;
/// Share of pixels with depth from which on only they are metered. A guess.
const LEAST_WITH_DEPTH: f64 = 0.05;
/// Most that one frame's metering is believed, in either direction: saturation hides how much too bright it was.
const LARGEST_CORRECTION: f64 = 8.0;
/// Every how many pixels the image is looked at.
const STRIDE: usize = 7;

/// What may be changed in the dark and in the sun. Which of the two the device does is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InfraredExposure {
    /// Exposure time, then gain: the image stays usable in full sun.
    #[default]
    TimeAndGain,
    /// Gain alone, at the longest exposure: the image saturates beyond some 10 klx of sun.
    GainOnly,
    /// Neither, at the longest exposure and a gain of 1.
    Fixed,
}

/// An exposure that follows the light.
#[derive(Clone, Copy, Debug)]
pub(super) struct AutoExposure {
    shortest: f64,
    longest: f64,
    highest_gain: f64,
    /// Exposure time × gain, seconds.
    product: f64,
}

impl AutoExposure {
    pub fn colour() -> Self {
        let (shortest, longest) = (colour::SHORTEST, colour::LONGEST);
        Self { shortest, longest, highest_gain: colour::HIGHEST_GAIN, product: longest }
    }

    pub fn infrared(policy: InfraredExposure) -> Self {
        let longest = infrared::LONGEST;
        let shortest = if policy == InfraredExposure::TimeAndGain { infrared::SHORTEST } else { longest };
        let highest_gain = if policy == InfraredExposure::Fixed { 1.0 } else { infrared::HIGHEST_GAIN };
        Self { shortest, longest, highest_gain, product: longest }
    }

    /// As long an exposure as there may be, then gain: least noise.
    pub fn exposure(&self) -> Exposure {
        let time = self.product.clamp(self.shortest, self.longest);
        Exposure { time, gain: (self.product / time).clamp(1.0, self.highest_gain) }
    }

    /// Follows a metering, `elapsed` seconds after the last one; infinitely long: at once. `brightness` is what was
    /// seen, relative to what was aimed at.
    pub fn follow(&mut self, brightness: f64, elapsed: f64) {
        let correction = brightness.recip().clamp(LARGEST_CORRECTION.recip(), LARGEST_CORRECTION);
        let share = 1.0 - (-elapsed / TIME_CONSTANT).exp();
        let product = self.product * correction.powf(share);
        self.product = product.clamp(self.shortest, self.longest * self.highest_gain);
    }
}

/// Mean light of a colour image, relative to the target.
pub(super) fn colour_brightness(pixels: &[[u8; 3]]) -> f64 {
    let linear = |encoded: u8| (f64::from(encoded) / 255.0).powf(2.2);
    let luma = |&[red, green, blue]: &[u8; 3]| 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
    let sum: f64 = pixels.iter().step_by(STRIDE).map(luma).sum();
    sum / pixels.len().div_ceil(STRIDE) as f64 / COLOUR_TARGET
}

/// Brightness of an infrared image but for its brightest pixels, relative to the target. Of the pixels that have depth,
/// as the device's control looks at some ranges of depth (its driver's settings name them): a window in the view must not
/// darken the dots. Of all pixels where too few have any.
pub(super) fn infrared_brightness(pixels: &[u16], depth: &[u16]) -> f64 {
    let sampled = || pixels.iter().zip(depth).step_by(STRIDE);
    let mut numbers: Vec<u16> = sampled().filter(|(_, depth)| **depth != NO_DEPTH).map(|(number, _)| *number).collect();
    if (numbers.len() as f64) < LEAST_WITH_DEPTH * sampled().len() as f64 {
        numbers = sampled().map(|(number, _)| *number).collect();
    }
    let rank = ((1.0 - INFRARED_ABOVE) * (numbers.len() - 1) as f64) as usize;
    let (_, number, _) = numbers.select_nth_unstable(rank);
    f64::from(*number) / 1023.0 / INFRARED_TARGET
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_is_used_up_before_gain_and_both_have_ends() {
        let mut exposure = AutoExposure::infrared(InfraredExposure::TimeAndGain);
        for _ in 0..20 {
            exposure.follow(0.0, f64::INFINITY);
        }
        assert_eq!(exposure.exposure().time, infrared::LONGEST);
        assert!((exposure.exposure().gain - infrared::HIGHEST_GAIN).abs() < 1e-9);
        exposure.follow(4.0, f64::INFINITY);
        assert_eq!(exposure.exposure().time, infrared::LONGEST);
        assert!((exposure.exposure().gain - infrared::HIGHEST_GAIN / 4.0).abs() < 1e-9);
        for _ in 0..20 {
            exposure.follow(100.0, f64::INFINITY);
        }
        assert_eq!(exposure.exposure(), Exposure { time: infrared::SHORTEST, gain: 1.0 });
    }

    #[test]
    fn a_window_does_not_darken_the_dots() {
        // A third of the view is a window without depth.
        let pixel = |index: usize| if index.is_multiple_of(3) { (1000, NO_DEPTH) } else { (200, 800) };
        let (numbers, depth): (Vec<u16>, Vec<u16>) = (0..3000).map(pixel).unzip();
        let dots = 200.0 / 1023.0 / INFRARED_TARGET;
        assert!((infrared_brightness(&numbers, &depth) - dots).abs() < 1e-9);
        assert!(infrared_brightness(&numbers, &[NO_DEPTH; 3000]) > 1.5, "where nothing has depth, all of it counts");
    }

    #[test]
    fn a_step_is_followed_in_the_time_constant() {
        let mut exposure = AutoExposure::colour();
        let before = exposure.exposure().time;
        for _ in 0..15 {
            exposure.follow(2.0 * exposure.exposure().time / before, 1.0 / 30.0);
        }
        let rest = (exposure.exposure().time / before).log2() + 1.0;
        assert!((rest - (-1.0_f64).exp()).abs() < 0.02, "{rest}");
    }
}
