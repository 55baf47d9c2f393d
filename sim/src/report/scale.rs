//! From data to the page: linear scales and the round numbers on them.

/// Maps the data from `from` to `to` onto a length from `start` to `end`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    pub from: f64,
    pub to: f64,
    pub start: f64,
    pub end: f64,
}

impl Scale {
    /// Where on the page a value lies.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.start + (value - self.from) / (self.to - self.from) * (self.end - self.start)
    }

    /// Round values about `wanted` in number, each with its label.
    pub(super) fn ticks(&self, wanted: f64) -> Vec<(f64, String)> {
        let step = round_step((self.to - self.from) / wanted);
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        // A hair of tolerance, so that an end that is itself a round number gets its tick.
        let first = (self.from / step - 1e-9).ceil() as i64;
        let last = (self.to / step + 1e-9).floor() as i64;
        (first..=last).map(|index| index as f64 * step).map(|value| (value, label(value, decimals))).collect()
    }
}

/// With a true minus sign.
fn label(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}").replace('-', "−")
}

/// The least of 1, 2, 5 × 10ⁿ that is no less than `step`.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    // The tolerance keeps 0.2, computed as 0.20000000000000001, from becoming 0.5.
    let mantissa = [1.0, 2.0, 5.0].into_iter().find(|mantissa| mantissa * power >= step * (1.0 - 1e-9));
    mantissa.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(from: f64, to: f64, wanted: f64) -> Vec<String> {
        let ticks = Scale { from, to, start: 0.0, end: 1.0 }.ticks(wanted);
        ticks.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(labels(0.0, 10.0, 5.0), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(-0.13, 0.21, 4.0), ["−0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(labels(0.0, 0.031, 4.0), ["0.00", "0.01", "0.02", "0.03"]);
        assert_eq!(labels(0.0, 1234.0, 4.0), ["0", "500", "1000"]);
    }

    #[test]
    fn steps_are_one_two_or_five() {
        for (step, round) in [(0.2, 0.2), (0.21, 0.5), (3.0, 5.0), (6.0, 10.0), (1.0, 1.0)] {
            assert!((round_step(step) / round - 1.0).abs() < 1e-12, "{step}");
        }
    }
}
