//! The paper's fuzzy controller (paper A, §6.2, Table 3): from what the images hold to how much speaks for each mode.

use serde::{Deserialize, Serialize};

use crate::measurement::Mode;

/// Where an energy stops being Low and where it is fully High; between the two it is both, in shares that change evenly.
/// The paper shows its own in a figure only, and of a light sensor's numbers they would say little for another's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Breakpoints {
    /// Up to here it is Low only. Energy, 0–1.
    pub low: f64,
    /// From here on it is High only. Energy, 0–1.
    pub high: f64,
}

impl Breakpoints {
    /// The memberships of an energy.
    pub fn membership(&self, energy: f64) -> Membership {
        Membership::of_high(((energy - self.low) / (self.high - self.low)).clamp(0.0, 1.0))
    }
}

/// How far an energy is Low and High, 0–1 each; the two add up to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Membership {
    /// In Low.
    pub low: f64,
    /// In High.
    pub high: f64,
}

impl Membership {
    /// By the share in High.
    pub fn of_high(high: f64) -> Self {
        Self { low: 1.0 - high, high }
    }

    fn in_class(&self, class: Class) -> f64 {
        match class {
            Class::Low => self.low,
            Class::High => self.high,
        }
    }
}

/// Memberships of the three energies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Memberships {
    /// Of colour's.
    pub rgb: Membership,
    /// Of infrared's.
    pub infrared: Membership,
    /// Of depth's.
    pub depth: Membership,
}

/// A fuzzy set of energies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// The image holds too little to be used.
    Low,
    /// It holds enough.
    High,
}

/// If the energies of colour, infrared and depth are of these classes, then this mode.
pub type Rule = ([Class; 3], Mode);

/// Table 3, row by row. (Table 2 numbers the modes otherwise; it is this one that rules.)
pub const RULES: [Rule; 8] = {
    use Class::{High, Low};
    [
        ([Low, Low, Low], Mode::Odometer),
        ([Low, Low, High], Mode::Odometer),
        ([Low, High, Low], Mode::Odometer),
        ([Low, High, High], Mode::Night),
        ([High, Low, Low], Mode::Odometer),
        ([High, Low, High], Mode::Indoor),
        ([High, High, Low], Mode::Outdoor),
        ([High, High, High], Mode::Indoor),
    ]
};

/// The modes in the order of Table 3's numbers, which also decides between equal degrees.
const BY_NUMBER: [Mode; 4] = [Mode::Indoor, Mode::Outdoor, Mode::Night, Mode::Odometer];

/// How much speaks for each mode, 0–1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Degrees {
    /// For colour + depth.
    pub indoor: f64,
    /// For colour + infrared.
    pub outdoor: f64,
    /// For infrared + depth.
    pub night: f64,
    /// For the wheels alone.
    pub odometer: f64,
}

impl Degrees {
    /// For a mode.
    pub fn of(&self, mode: Mode) -> f64 {
        match mode {
            Mode::Indoor => self.indoor,
            Mode::Outdoor => self.outdoor,
            Mode::Night => self.night,
            Mode::Odometer => self.odometer,
        }
    }

    fn of_mut(&mut self, mode: Mode) -> &mut f64 {
        match mode {
            Mode::Indoor => &mut self.indoor,
            Mode::Outdoor => &mut self.outdoor,
            Mode::Night => &mut self.night,
            Mode::Odometer => &mut self.odometer,
        }
    }

    /// The mode that most speaks for.
    pub fn strongest(&self) -> Mode {
        let first = BY_NUMBER[0];
        BY_NUMBER.into_iter().fold(first, |best, mode| if self.of(mode) > self.of(best) { mode } else { best })
    }

    /// The mode whose number in Table 3 is nearest to the degrees' centroid. Modes are names, not numbers on a scale: half
    /// indoor and half night is "outdoor" here. For comparison.
    pub fn centroid(&self) -> Mode {
        let (mut moment, mut sum) = (0.0, 0.0);
        for (index, mode) in BY_NUMBER.into_iter().enumerate() {
            moment += index as f64 * self.of(mode);
            sum += self.of(mode);
        }
        // Of three memberships that each add up to 1, some rule fires with at least a half: the sum is never zero.
        BY_NUMBER[((moment / sum).round() as usize).min(BY_NUMBER.len() - 1)]
    }
}

/// What the rules say.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Inference {
    /// How strongly each of [`RULES`] fires, 0–1.
    pub strengths: [f64; 8],
    /// What that adds up to.
    pub degrees: Degrees,
}

impl Inference {
    /// Mamdani's: a rule is as strong as its weakest condition, a mode as its strongest rule.
    pub fn of(memberships: &Memberships) -> Self {
        let inputs = [memberships.rgb, memberships.infrared, memberships.depth];
        let mut degrees = Degrees::default();
        let strengths = RULES.map(|(classes, mode)| {
            let strength = inputs.iter().zip(classes).map(|(input, class)| input.in_class(class)).fold(1.0, f64::min);
            let degree = degrees.of_mut(mode);
            *degree = degree.max(strength);
            strength
        });
        Self { strengths, degrees }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn degrees(rgb: f64, infrared: f64, depth: f64) -> Degrees {
        let [rgb, infrared, depth] = [rgb, infrared, depth].map(Membership::of_high);
        Inference::of(&Memberships { rgb, infrared, depth }).degrees
    }

    #[test]
    fn the_corners_are_table_3() {
        let mode = |rgb, infrared, depth| {
            let degrees = degrees(rgb, infrared, depth);
            assert_eq!(degrees.of(degrees.strongest()), 1.0);
            assert_eq!(degrees.strongest(), degrees.centroid());
            degrees.strongest()
        };
        for (rgb, infrared) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)] {
            assert_eq!(mode(rgb, infrared, 0.0), Mode::Odometer);
        }
        assert_eq!(mode(0.0, 0.0, 1.0), Mode::Odometer);
        assert_eq!(mode(0.0, 1.0, 1.0), Mode::Night);
        assert_eq!(mode(1.0, 0.0, 1.0), Mode::Indoor);
        assert_eq!(mode(1.0, 1.0, 0.0), Mode::Outdoor);
        assert_eq!(mode(1.0, 1.0, 1.0), Mode::Indoor);
    }

    #[test]
    fn memberships_follow_the_breakpoints() {
        let breakpoints = Breakpoints { low: 0.01, high: 0.03 };
        for (energy, high) in [(0.0, 0.0), (0.01, 0.0), (0.015, 0.25), (0.02, 0.5), (0.03, 1.0), (1.0, 1.0)] {
            let membership = breakpoints.membership(energy);
            assert!((membership.high - high).abs() < 1e-12 && (membership.low + high - 1.0).abs() < 1e-12);
        }
    }

    /// A lamp that fades, above an infrared image and depth that stay or waver: the answer goes from indoor to night,
    /// through wheels at most.
    #[test]
    fn dusk_is_never_outdoors() {
        let steps = || (0..=100).map(|step| f64::from(step) / 100.0);
        let mut centroid_says_outdoor = false;
        for rgb in steps() {
            for infrared in steps() {
                for depth in steps().filter(|depth| *depth >= 0.5) {
                    let degrees = degrees(rgb, infrared, depth);
                    assert_ne!(degrees.strongest(), Mode::Outdoor, "{rgb} {infrared} {depth}");
                    centroid_says_outdoor |= depth == 1.0 && degrees.centroid() == Mode::Outdoor;
                }
            }
        }
        assert!(centroid_says_outdoor, "which is why it is not the default");
    }

    proptest! {
        #[test]
        fn something_always_speaks_for_some_mode(rgb in 0.0..1.0_f64, infrared in 0.0..1.0_f64, depth in 0.0..1.0_f64) {
            let degrees = degrees(rgb, infrared, depth);
            prop_assert!(degrees.of(degrees.strongest()) >= 0.5);
        }
    }
}
