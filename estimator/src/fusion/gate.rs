//! Whether a measurement is believable to a filter, and what if none is any more.

use serde::{Deserialize, Serialize};

/// Parameters of the gate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GateParams {
    /// Whether there is one.
    pub enabled: bool,
    /// Largest squared Mahalanobis distance of an innovation; χ² of 99 % is 11.34 for a pose, 9.21 for range and
    /// bearing. Twice as much where covariances are half of what they should be.
    pub limit: f64,
    /// After so many refusals in a row that agree with each other one of the two is wrong, and nothing says which: until one
    /// passes or disagrees, what is measured is let in, and both covariances are raised until it fits. Without this a gate
    /// locks a lost filter out for good; a filter that alone were doubted would leap to whatever is wrong for long. What is
    /// wrong in another way each time says nothing against the filter.
    pub max_refusals: usize,
}

impl Default for GateParams {
    /// The limit is for poses, of which visual odometry's covariances may be half of what they should be: one of 11.34 keeps
    /// out what is a little off until it is off by centimetres, and then lets it in at once. On the P3-AT it is the wheels
    /// that slip: a gate without a way back would keep out what notices it.
    fn default() -> Self {
        Self { enabled: true, limit: 25.0, max_refusals: 5 }
    }
}

impl GateParams {
    /// None: all is believed.
    pub fn open() -> Self {
        Self { enabled: false, ..Self::default() }
    }
}

/// What becomes of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    Admit,
    Refuse,
    /// Admit, the filter's covariance and the measurement's times this, above 1.
    AdmitDoubting(f64),
}

/// A gate with a way back.
#[derive(Clone, Debug)]
pub(super) struct Gate {
    params: GateParams,
    refusals: usize,
}

impl Gate {
    pub fn new(params: GateParams) -> Self {
        Self { params, refusals: 0 }
    }

    /// Whether the last measurement was within the gate.
    pub fn is_calm(&self) -> bool {
        self.refusals == 0
    }

    /// Judges an innovation by its squared Mahalanobis distance; `repeats`: whether it says what the last one that was
    /// refused said, `None` where the two can't be compared.
    pub fn judge(&mut self, squared: f64, repeats: Option<bool>) -> Verdict {
        if !self.params.enabled || squared <= self.params.limit {
            self.refusals = 0;
            return Verdict::Admit;
        }
        if repeats == Some(false) {
            self.refusals = 0;
        }
        if self.refusals < self.params.max_refusals {
            self.refusals += 1;
            return Verdict::Refuse;
        }
        if repeats.is_none() {
            self.refusals = 0;
        }
        // By this the two covariances, and so the innovation's, are as large as just to fit.
        Verdict::AdmitDoubting(squared / self.params.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gate_keeps_out_and_lets_back_in() {
        let mut gate = Gate::new(GateParams { enabled: true, limit: 9.0, max_refusals: 2 });
        let verdicts = [4.0, 20.0, 5.0, 20.0, 30.0, 18.0, 20.0].map(|squared| gate.judge(squared, Some(true)));
        use Verdict::{Admit, AdmitDoubting, Refuse};
        assert_eq!(verdicts, [Admit, Refuse, Admit, Refuse, Refuse, AdmitDoubting(2.0), AdmitDoubting(20.0 / 9.0)]);
        let mut open = Gate::new(GateParams::open());
        assert_eq!(open.judge(1e9, None), Admit);
        // Wrong in another way each time, for ever.
        assert!((0..9).all(|_| gate.judge(20.0, Some(false)) == Refuse));
    }
}
