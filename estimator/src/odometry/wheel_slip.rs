//! How far a robot goes for each metre that its wheels roll, learnt from the ground that passes below: one look is off by
//! as much as the ground is bumpy, many are not.

use crate::motion::Scale;

/// σ of the share before anything was seen. Tyres on grass slip by 3–5 % (an estimate).
const UNKNOWN: f64 = 0.05;
/// How fast it changes from place to place: σ after a metre. A guess: half of what it is, within ten metres.
const WALK: f64 = 0.008;
/// Of how many looks the scatter is a mean.
const LOOKS: f64 = 6.0;
/// By how much the variance of a look is larger than its scatter about the mean says: the bumps of a lawn are longer than
/// the way from one look to the next. A guess.
const CORRELATED: f64 = 2.0;

/// Metres gone for each metre rolled, and how sure that is.
#[derive(Clone, Copy, Debug)]
pub struct WheelSlip {
    share: f64,
    variance: f64,
    /// Variance of a look, by how far looks were off.
    scatter: f64,
}

impl Default for WheelSlip {
    fn default() -> Self {
        Self { share: 1.0, variance: UNKNOWN * UNKNOWN, scatter: 0.0 }
    }
}

impl WheelSlip {
    /// What is known of the share once a way of so many metres was seen to be longer than rolled by `look`. `skid`: σ of what
    /// else the wheels err by on it, metres, as in a turn.
    pub fn seen(&self, look: &Scale, way: f64, skid: f64) -> Self {
        let variance = self.variance + WALK * WALK * way;
        let off = look.value - self.share;
        let by_scatter = (off * off - variance).max(0.0);
        let scatter = self.scatter + (by_scatter - self.scatter) / LOOKS;
        let noise = (look.sigma * look.sigma).max(scatter) * CORRELATED + (skid / way).powi(2);
        let gain = variance / (variance + noise);
        Self { share: self.share + gain * off, variance: (1.0 - gain) * variance, scatter }
    }

    /// The share.
    pub fn scale(&self) -> Scale {
        Scale { value: self.share, sigma: self.variance.sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    #[test]
    fn many_doubtful_looks_make_a_sure_share() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut slip = WheelSlip::default();
        for _ in 0..60 {
            let noise: f64 = StandardNormal.sample(&mut random);
            // Each claims to be sure.
            slip = slip.seen(&Scale { value: 0.94 + 0.1 * noise, sigma: 0.02 }, 0.3, 0.0);
        }
        let Scale { value, sigma } = slip.scale();
        assert!((value - 0.94).abs() < 0.03 && (0.01..0.04).contains(&sigma), "{slip:?}");
    }

    #[test]
    fn on_even_ground_the_first_look_counts() {
        let slip = WheelSlip::default().seen(&Scale { value: 0.96, sigma: 0.015 }, 0.3, 0.0);
        assert!((slip.scale().value - 0.96).abs() < 0.01, "{slip:?}");
    }

    #[test]
    fn what_skids_in_a_turn_teaches_little() {
        let turning = WheelSlip::default().seen(&Scale { value: 0.8, sigma: 0.015 }, 0.1, 0.02);
        assert!((turning.scale().value - 1.0).abs() < 0.02, "{turning:?}");
    }
}
