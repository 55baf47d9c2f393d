//! Automatic exposure: from the images to the next ones' exposure time and gain. It lags, and acts late.

use std::collections::VecDeque;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::matcher::NO_DEPTH;
use super::metering::STRIDE;
use super::sensors::{Exposure, colour, infrared};

/// Seconds in which a step in brightness is made up for but for 1/e. Estimate, 0.2 to 1.5 are plausible.
const TIME_CONSTANT: f64 = 0.5;
/// From an image to the first that heeds it, seconds: three frames of 30 Hz. Estimate, two to five are plausible.
const DEAD_TIME: f64 = 0.1;
/// Share of an infrared image's pixels with depth that may exceed the target below; some 2 % are dots' peaks.
const ABOVE_WITH_DEPTH: f64 = 0.02;
/// Brightness aimed at for the brightest of the rest, of full scale. A guess, well below saturation.
const TARGET_WITH_DEPTH: f64 = 0.6;
/// Share of pixels with depth from which on only they are metered. A guess.
const LEAST_WITH_DEPTH: f64 = 0.05;
/// Share of all pixels that may exceed the target below, where too few have depth: a sky or a window, four times as
/// bright as what one drives on, fills a fifth of the view, and nothing is to be seen there. A guess.
const ABOVE_WITHOUT_DEPTH: f64 = 0.25;
/// Brightness aimed at for the brightest of the rest, of full scale. A guess: what is twice as bright still fits, as
/// concrete in the sun beside asphalt.
const TARGET_WITHOUT_DEPTH: f64 = 0.4;
/// Most that one frame's metering is believed, in either direction: saturation hides how much too bright it was.
const LARGEST_CORRECTION: f64 = 8.0;

/// What may be changed in the dark and in the sun. Which of them the device does is not known: users report that it is
/// "useless above some 10 klx", and its driver's settings name a gain, but no exposure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InfraredExposure {
    /// Exposure time down to one row, then gain: the image stays usable in full sun.
    #[default]
    Free,
    /// The same, but no shorter than 2 ms: concrete in full sun still fits, white paint does not.
    LimitedExposure,
    /// Gain alone, at the longest exposure: the image saturates beyond some 10 klx of sun.
    GainOnly,
}

impl InfraredExposure {
    /// Shortest exposure, seconds.
    fn shortest(self) -> f64 {
        match self {
            Self::Free => infrared::SHORTEST,
            // A guess: what it is for is said above.
            Self::LimitedExposure => 0.002,
            Self::GainOnly => infrared::LONGEST,
        }
    }
}

/// An exposure that follows the light.
#[derive(Clone, Debug)]
pub(super) struct AutoExposure {
    shortest: f64,
    longest: f64,
    highest_gain: f64,
    /// Exposure time × gain, seconds.
    product: f64,
    /// What the last images ask for, and how long ago they were taken, seconds; the oldest first.
    asked: VecDeque<(f64, f64)>,
}

impl AutoExposure {
    pub fn colour() -> Self {
        Self::within(colour::SHORTEST, colour::LONGEST, colour::HIGHEST_GAIN)
    }

    pub fn infrared(policy: InfraredExposure) -> Self {
        Self::within(policy.shortest(), infrared::LONGEST, infrared::HIGHEST_GAIN)
    }

    fn within(shortest: f64, longest: f64, highest_gain: f64) -> Self {
        Self { shortest, longest, highest_gain, product: longest, asked: VecDeque::new() }
    }

    /// As long an exposure as there may be, then gain: least noise.
    pub fn exposure(&self) -> Exposure {
        let time = self.product.clamp(self.shortest, self.longest);
        Exposure { time, gain: (self.product / time).clamp(1.0, self.highest_gain) }
    }

    /// Follows the metering of an image that was taken with the exposure as it is; the next one comes `elapsed` seconds
    /// later. `brightness` is what was seen, relative to what was aimed at.
    pub fn follow(&mut self, brightness: f64, elapsed: f64) {
        self.asked.push_back((self.asked_by(brightness), 0.0));
        self.asked.iter_mut().for_each(|(_, age)| *age += elapsed);
        // Half a millisecond: sums of intervals are not exact.
        let is_heeded = |asked: Option<&(f64, f64)>| asked.is_some_and(|(_, age)| *age > DEAD_TIME - 5e-4);
        while is_heeded(self.asked.get(1)) {
            self.asked.pop_front();
        }
        if let Some((asked, _)) = self.asked.front().filter(|asked| is_heeded(Some(asked))) {
            let share = 1.0 - (-elapsed / TIME_CONSTANT).exp();
            self.set(self.product * (asked / self.product).powf(share));
        }
    }

    /// Goes to what an image asks for at once, as if much time had passed. By what factor that was off.
    pub fn settle(&mut self, brightness: f64) -> f64 {
        let before = self.product;
        self.asked.clear();
        self.set(self.asked_by(brightness));
        (self.product / before).max(before / self.product)
    }

    fn asked_by(&self, brightness: f64) -> f64 {
        self.product * brightness.recip().clamp(LARGEST_CORRECTION.recip(), LARGEST_CORRECTION)
    }

    fn set(&mut self, product: f64) {
        self.product = product.clamp(self.shortest, self.longest * self.highest_gain);
    }
}

/// Brightness of an infrared image but for its brightest pixels, relative to the target. Of the pixels that have depth,
/// as the device's control looks at some ranges of depth (its driver's settings name them): a window in the view must not
/// darken the dots. Of all pixels where too few have any.
pub(super) fn infrared_brightness(pixels: &[u16], depth: &[u16]) -> f64 {
    let sampled = || pixels.iter().zip(depth).step_by(STRIDE);
    let with_depth: Vec<u16> = sampled().filter(|(_, depth)| **depth != NO_DEPTH).map(|(number, _)| *number).collect();
    let (mut numbers, above, target) = if with_depth.len() as f64 >= LEAST_WITH_DEPTH * sampled().len() as f64 {
        (with_depth, ABOVE_WITH_DEPTH, TARGET_WITH_DEPTH)
    } else {
        (sampled().map(|(number, _)| *number).collect(), ABOVE_WITHOUT_DEPTH, TARGET_WITHOUT_DEPTH)
    };
    let rank = ((1.0 - above) * (numbers.len() - 1) as f64) as usize;
    let (_, number, _) = numbers.select_nth_unstable(rank);
    f64::from(*number) / 1023.0 / target
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_is_used_up_before_gain_and_both_have_ends() {
        let mut exposure = AutoExposure::infrared(InfraredExposure::Free);
        for _ in 0..20 {
            exposure.settle(0.0);
        }
        assert_eq!(exposure.exposure().time, infrared::LONGEST);
        assert!((exposure.exposure().gain - infrared::HIGHEST_GAIN).abs() < 1e-9);
        exposure.settle(4.0);
        assert_eq!(exposure.exposure().time, infrared::LONGEST);
        assert!((exposure.exposure().gain - infrared::HIGHEST_GAIN / 4.0).abs() < 1e-9);
        for _ in 0..20 {
            exposure.settle(100.0);
        }
        assert_eq!(exposure.exposure(), Exposure { time: infrared::SHORTEST, gain: 1.0 });
    }

    #[test]
    fn policies_differ_in_how_short_an_exposure_may_be() {
        let shortest = |policy| {
            let mut exposure = AutoExposure::infrared(policy);
            for _ in 0..20 {
                exposure.settle(100.0);
            }
            exposure.exposure().time
        };
        assert_eq!(shortest(InfraredExposure::GainOnly), infrared::LONGEST);
        assert_eq!(shortest(InfraredExposure::LimitedExposure), 0.002);
        assert_eq!(shortest(InfraredExposure::Free), infrared::SHORTEST);
    }

    #[test]
    fn a_window_does_not_darken_the_dots() {
        // A third of the view is a window without depth.
        let pixel = |index: usize| if index.is_multiple_of(3) { (1000, NO_DEPTH) } else { (200, 800) };
        let (numbers, depth): (Vec<u16>, Vec<u16>) = (0..3000).map(pixel).unzip();
        let dots = 200.0 / 1023.0 / TARGET_WITH_DEPTH;
        assert!((infrared_brightness(&numbers, &depth) - dots).abs() < 1e-9);
        assert!(infrared_brightness(&numbers, &[NO_DEPTH; 3000]) > 1.5, "where nothing has depth, all of it counts");
    }

    #[test]
    fn a_bright_sky_does_not_darken_the_ground_and_a_facade_twice_as_bright_fits() {
        let numbers: Vec<u16> = (0..3000).map(|index| if index < 600 { 1023 } else { 150 }).collect();
        let ground = 150.0 / 1023.0 / TARGET_WITHOUT_DEPTH;
        assert!((infrared_brightness(&numbers, &[NO_DEPTH; 3000]) - ground).abs() < 1e-9);
        // Half of the view is sunlit, twice as bright as the rest.
        let numbers: Vec<u16> = (0..3000).map(|index| if index < 1500 { 600 } else { 300 }).collect();
        assert!(600.0 / infrared_brightness(&numbers, &[NO_DEPTH; 3000]) < 0.5 * 1023.0);
    }

    /// Exposure products, relative to the first, of the images after the light has doubled.
    fn after_doubling(interval: f64, images: usize) -> Vec<f64> {
        let mut exposure = AutoExposure::colour();
        let before = exposure.exposure().time;
        let image = |_| {
            let product = exposure.exposure().time / before;
            exposure.follow(2.0 * product, interval);
            product
        };
        (0..images).map(image).collect()
    }

    #[test]
    fn a_step_is_heeded_late_and_followed_in_the_time_constant() {
        let products = after_doubling(1.0 / 30.0, 200);
        assert_eq!(products[..3], [1.0; 3], "two to five frames pass before anything happens");
        assert!(products[3] < 1.0);
        // What is left of the step, in logarithms of light, when the time constant is over.
        let rest = products[2 + 15].log2() + 1.0;
        assert!((rest - (-1.0_f64).exp()).abs() < 0.02, "{rest}");
        assert!((products[199] - 0.5).abs() < 1e-3, "{}", products[199]);
        assert!(products.windows(2).all(|pair| pair[1] <= pair[0]), "it does not swing");
    }

    #[test]
    fn fewer_images_a_second_are_followed_as_quickly() {
        let (fast, slow) = (after_doubling(1.0 / 30.0, 61), after_doubling(0.1, 21));
        assert!((fast[60] - slow[20]).abs() < 0.01, "after two seconds: {} and {}", fast[60], slow[20]);
    }
}
