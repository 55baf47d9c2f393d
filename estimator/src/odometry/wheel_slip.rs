//! How far a robot goes for each metre that its wheels roll, learnt from the ground that passes below. One look is off by as
//! much as the ground is bumpy; but grounds are of two kinds, on one of which tyres hardly slip.

use crate::motion::Scale;

/// Metres gone for each metre rolled on a hard floor, and its σ: users report distances wrong by 1–2 %, tyres' radius in it.
const HARD: Scale = Scale { value: 1.0, sigma: 0.01 };
/// On grass and gravel, where wheels over-spin: by 3–5 %.
const SOFT: Scale = Scale { value: 0.96, sigma: 0.03 };
/// Probability of soft ground before anything was seen. A guess.
const SOFT_AT_FIRST: f64 = 0.2;
/// How often one ground ends and the other begins, 1/m: every ten metres. A guess.
const CHANGES: f64 = 0.1;
/// How fast soft ground changes from place to place: σ after a metre. A guess: half of what it is, within five metres.
const WALK: f64 = 0.012;
/// Of how many looks the misfit is a mean.
const LOOKS: f64 = 6.0;
/// By how much the variance of a look is larger than its scatter about the mean says: the bumps of a lawn are longer than
/// the way from one look to the next. A guess.
const CORRELATED: f64 = 2.0;
/// The least misfit: looks that agree by chance are not as good as that. A guess.
const LEAST_MISFIT: f64 = 0.2;
/// One look counts for no more than so many σ in the misfit.
const LARGEST_OFF: f64 = 3.0;
/// A look may be wrong altogether: what is added to how likely it is on either ground.
const WRONG: f64 = 1e-3;
/// σ of the camera's height, which all looks share, as a share of it: half a centimetre of suspension and tyres. A guess.
const HEIGHT: f64 = 0.01;

/// Metres gone for each metre rolled, and how sure that is. Two models of the ground side by side, of which the looks say
/// which is the likelier (Magill 1965, with changes from one to the other as in Blom & Bar-Shalom 1988).
#[derive(Clone, Copy, Debug)]
pub struct WheelSlip {
    /// Probability that the ground is soft.
    soft: f64,
    /// What it then is like.
    share: f64,
    variance: f64,
    /// How many times as large the variance of a look is as it says, by how far looks were off.
    misfit: f64,
}

impl Default for WheelSlip {
    fn default() -> Self {
        Self { soft: SOFT_AT_FIRST, share: SOFT.value, variance: SOFT.sigma * SOFT.sigma, misfit: 1.0 }
    }
}

impl WheelSlip {
    /// After a way of so many metres of which nothing was seen.
    pub fn unseen(&self, way: f64) -> Self {
        let changed = 1.0 - (-CHANGES * way).exp();
        let soft = self.soft * (1.0 - changed) + (1.0 - self.soft) * changed;
        // Of a soft ground that has just begun nothing is known.
        let new = (1.0 - self.soft) * changed / soft;
        let share = self.share * (1.0 - new) + SOFT.value * new;
        let variance = (self.variance + WALK * WALK * way) * (1.0 - new) + SOFT.sigma * SOFT.sigma * new;
        Self { soft, share, variance, ..*self }
    }

    /// What is known of the share once a way of so many metres was seen to be longer than rolled by `look`. `skid`: σ of what
    /// else the wheels err by on it, metres, as in a turn.
    pub fn seen(&self, look: &Scale, way: f64, skid: f64) -> Self {
        let before = self.unseen(way);
        let expected = before.scale();
        let (of_look, of_skid) = (look.sigma * look.sigma, (skid / way).powi(2));
        let unexpected = (look.value - expected.value).powi(2) - expected.sigma * expected.sigma - of_skid;
        let squared = (unexpected.max(0.0) / of_look).min(LARGEST_OFF * LARGEST_OFF);
        let misfit = self.misfit + (squared - self.misfit) / LOOKS;
        let noise = of_look * misfit.max(LEAST_MISFIT) * CORRELATED + of_skid + HEIGHT * HEIGHT;
        let likelihood = |share: f64, variance: f64| {
            let total = variance + noise;
            (-0.5 * (look.value - share).powi(2) / total).exp() / total.sqrt() + WRONG
        };
        let soft = before.soft * likelihood(before.share, before.variance);
        let hard = (1.0 - before.soft) * likelihood(HARD.value, HARD.sigma * HARD.sigma);
        let gain = before.variance / (before.variance + noise);
        Self {
            soft: soft / (soft + hard),
            share: before.share + gain * (look.value - before.share),
            variance: (1.0 - gain) * before.variance,
            misfit,
        }
    }

    /// The share.
    pub fn scale(&self) -> Scale {
        let hard = 1.0 - self.soft;
        let value = self.soft * self.share + hard * HARD.value;
        let of_soft = self.variance + HEIGHT * HEIGHT + (self.share - value).powi(2);
        let of_hard = HARD.sigma * HARD.sigma + (HARD.value - value).powi(2);
        Scale { value, sigma: (self.soft * of_soft + hard * of_hard).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// After so many looks of 0.3 m each, about a share with a σ, which they all claim is `claimed`.
    fn after(looks: u32, share: f64, sigma: f64, claimed: f64) -> Scale {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut slip = WheelSlip::default();
        for _ in 0..looks {
            let noise: f64 = StandardNormal.sample(&mut random);
            slip = slip.seen(&Scale { value: share + sigma * noise, sigma: claimed }, 0.3, 0.0);
        }
        slip.scale()
    }

    #[test]
    fn many_doubtful_looks_make_a_sure_share() {
        // Each claims to be sure.
        let Scale { value, sigma } = after(60, 0.94, 0.05, 0.02);
        assert!((value - 0.94).abs() < 0.03 && (0.01..0.04).contains(&sigma), "{value} {sigma}");
    }

    #[test]
    fn on_even_ground_few_looks_count() {
        let Scale { value, .. } = after(4, 0.955, 0.01, 0.015);
        assert!((value - 0.955).abs() < 0.015, "{value}");
    }

    #[test]
    fn a_hard_floor_is_not_taken_for_a_soft_one() {
        for seen in [0.985, 0.99, 1.0, 1.01, 1.02] {
            let Scale { value, sigma } = after(40, seen, 0.03, 0.03);
            assert!((value - 1.0).abs() < 0.015 && sigma < 0.025, "{seen}: {value} {sigma}");
        }
    }

    #[test]
    fn from_asphalt_to_gravel_within_two_metres() {
        let mut slip = WheelSlip::default();
        let looks = |slip: WheelSlip, value: f64, count: u32| {
            (0..count).fold(slip, |slip, _| slip.seen(&Scale { value, sigma: 0.025 }, 0.4, 0.0))
        };
        slip = looks(slip, 0.995, 20);
        assert!((slip.scale().value - 0.995).abs() < 0.01, "{slip:?}");
        slip = looks(slip, 0.95, 5);
        assert!((slip.scale().value - 0.95).abs() < 0.015, "{slip:?}");
        slip = looks(slip, 0.995, 5);
        assert!((slip.scale().value - 0.995).abs() < 0.015, "{slip:?}");
    }

    #[test]
    fn what_skids_in_a_turn_teaches_little() {
        let skidding = WheelSlip::default().seen(&Scale { value: 0.8, sigma: 0.015 }, 0.1, 0.02);
        let before = WheelSlip::default().scale().value;
        assert!((skidding.scale().value - before).abs() < 0.02, "{skidding:?}");
    }
}
