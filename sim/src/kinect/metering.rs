//! What the colour camera's automatic control makes of an image: how bright it is, and whether white is white.

/// Mean of the colour image's linear light that is aimed at, of full scale: a grey card.
const TARGET: f64 = 0.18;
/// Every how many pixels the image is looked at.
pub(super) const STRIDE: usize = 7;
/// Seconds in which a change of the light's colour is made up for but for 1/e. A guess: slower than exposure, so that
/// the two do not chase one another.
const TIME_CONSTANT: f64 = 1.0;
/// Largest ratio of two channels' gains. A guess: from daylight to incandescent light takes about so much.
const LARGEST_RATIO: f64 = 2.5;

/// A colour image as it is metered: means of linear light, of full scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Metered {
    /// Luminance.
    luminance: f64,
    /// R, G, B of the pixels without a channel at full scale, as those have lost their colour.
    balance: [f64; 3],
}

impl Metered {
    pub fn of(pixels: &[[u8; 3]]) -> Self {
        let linear: [f64; 256] = std::array::from_fn(|encoded| (encoded as f64 / 255.0).powf(2.2));
        let (mut luminance, mut balance, mut unsaturated) = (0.0, [0.0; 3], 0.0);
        for pixel in pixels.iter().step_by(STRIDE) {
            let light = pixel.map(|encoded| linear[usize::from(encoded)]);
            luminance += 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
            if !pixel.contains(&u8::MAX) {
                balance.iter_mut().zip(light).for_each(|(sum, light)| *sum += light);
                unsaturated += 1.0;
            }
        }
        luminance /= pixels.len().div_ceil(STRIDE) as f64;
        Self { luminance, balance: balance.map(|sum| sum / f64::max(unsaturated, 1.0)) }
    }

    /// Mean light relative to the target.
    pub fn brightness(&self) -> f64 {
        self.luminance / TARGET
    }
}

/// Automatic white balance: the mean of what is seen is taken for grey ("grey world"), as far as that makes the light one
/// that there is: a lawn is not lit by green lamps.
#[derive(Clone, Copy, Debug)]
pub(super) struct WhiteBalance {
    /// Of R, G, B; the least of them is 1, so that what saturates the chip stays white.
    pub gains: [f64; 3],
}

impl WhiteBalance {
    /// As for light of the screen's own white.
    pub fn neutral() -> Self {
        Self { gains: [1.0; 3] }
    }

    /// Follows an image that was taken with these gains, the next one comes `elapsed` seconds later; infinitely long:
    /// at once.
    pub fn follow(&mut self, metered: &Metered, elapsed: f64) {
        let share = 1.0 - (-elapsed / TIME_CONSTANT).exp();
        // Where it is black nothing is known.
        if metered.balance.contains(&0.0) {
            return;
        }
        let asked: [f64; 3] = std::array::from_fn(|channel| self.gains[channel] / metered.balance[channel]);
        let asked = near_locus(asked);
        let least = asked.into_iter().fold(f64::INFINITY, f64::min);
        let asked = asked.map(|gain| (gain / least).min(LARGEST_RATIO));
        self.gains = std::array::from_fn(|channel| {
            let gain = self.gains[channel];
            gain * (asked[channel] / gain).powf(share)
        });
        let least = self.gains.into_iter().fold(f64::INFINITY, f64::min);
        self.gains = self.gains.map(|gain| gain / least);
    }

    /// The largest factor by which a gain differs.
    pub fn change_from(&self, before: &Self) -> f64 {
        let factors = self.gains.iter().zip(before.gains).map(|(&now, before)| (now / before).max(before / now));
        factors.fold(1.0, f64::max)
    }
}

/// Light from a glowing body or the sky has ln(G/√(RB)) = 0.115 · ln(R/B) in linear sRGB, from 2856 K (0.23, 2.07) through
/// D50 (0.058, 0.49) to 10,000 K: from the CIE's tables, to 0.02.
const LOCUS_SLOPE: f64 = 0.115;
/// How far off that line a balance still goes. Fluorescent tubes and LEDs are that green or pink; a guess.
const OFF_LOCUS: f64 = 0.08;

/// Gains for the light nearest to that which `gains` would make white, with as much green as such light has.
fn near_locus([red, green, blue]: [f64; 3]) -> [f64; 3] {
    // Light is one over its gains.
    let warmth = (blue / red).ln();
    let greenness = ((red * blue).sqrt() / green).ln();
    let line = LOCUS_SLOPE * warmth;
    let held = greenness.clamp(line - OFF_LOCUS, line + OFF_LOCUS);
    [red, green * (greenness - held).exp(), blue]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image of a grey card in light of a colour, taken with gains.
    fn card(light: [f64; 3], gains: [f64; 3]) -> Metered {
        let level = |channel: usize| ((0.1 * light[channel] * gains[channel]).powf(1.0 / 2.2) * 255.0).round() as u8;
        Metered::of(&[[level(0), level(1), level(2)]; 100])
    }

    #[test]
    fn a_grey_card_becomes_grey_in_lamplight_and_takes_its_time() {
        let lamplight = [1.3, 1.0, 0.62];
        let mut balance = WhiteBalance::neutral();
        balance.follow(&card(lamplight, balance.gains), 0.1);
        assert!(balance.gains[2] / balance.gains[0] < 1.1, "{:?}", balance.gains);
        for _ in 0..50 {
            balance.follow(&card(lamplight, balance.gains), 0.1);
        }
        let seen: [f64; 3] = std::array::from_fn(|channel| lamplight[channel] * balance.gains[channel]);
        assert!(seen.iter().all(|light| (light / seen[1] - 1.0).abs() < 0.05), "{seen:?}");
        assert_eq!(balance.gains.into_iter().fold(f64::INFINITY, f64::min), 1.0);
    }

    #[test]
    fn a_lawn_stays_green_and_what_is_grey_beside_it_grey() {
        // By day a lawn of albedo 0.063, 0.11, 0.041 fills the image; a grey kerb must not turn pink.
        let mut balance = WhiteBalance::neutral();
        balance.follow(&card([0.63, 1.1, 0.41], balance.gains), f64::INFINITY);
        let [red, green, blue] = balance.gains;
        assert!(green / (red * blue).sqrt() > 0.85, "{:?}", balance.gains);
        assert!(0.63 * red < 1.1 * green && 0.41 * blue < 1.1 * green);
    }

    #[test]
    fn candlelight_stays_warm_and_darkness_changes_nothing() {
        let mut balance = WhiteBalance::neutral();
        for _ in 0..10 {
            balance.follow(&card([5.0, 1.0, 0.3], balance.gains), f64::INFINITY);
        }
        assert!(balance.gains[2] <= LARGEST_RATIO + 1e-9 && balance.gains[0] == 1.0, "{:?}", balance.gains);
        let before = balance.gains;
        balance.follow(&Metered::of(&[[0, 0, 0]; 100]), f64::INFINITY);
        assert_eq!(balance.gains, before);
    }

    #[test]
    fn white_that_saturates_has_no_colour_to_go_by() {
        let mut pixels = vec![[255, 255, 120]; 70];
        pixels.extend([[90, 90, 90]; 70]);
        let mut balance = WhiteBalance::neutral();
        balance.follow(&Metered::of(&pixels), f64::INFINITY);
        assert!(balance.gains.iter().all(|gain| (gain - 1.0).abs() < 1e-9), "{:?}", balance.gains);
    }
}
