//! Wheel encoders.

/// What an encoder resolves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderParams {
    /// Counts in one turn of the wheel.
    pub ticks_per_turn: f64,
}

impl Default for EncoderParams {
    /// A Pioneer P3-AT: 138 ticks a millimetre of its wheel of 0.111 m (the manual's default, from memory; low
    /// confidence. Users set 128, too).
    fn default() -> Self {
        Self { ticks_per_turn: 138e3 * std::f64::consts::TAU * 0.111 }
    }
}

impl EncoderParams {
    /// The count once the wheel has turned by `angle` (rad) since the reset: whole ticks, the last one only when it
    /// is complete.
    pub fn ticks(&self, angle: f64) -> i64 {
        (angle / std::f64::consts::TAU * self.ticks_per_turn).floor() as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_tick_counts_when_it_is_complete() {
        let encoder = EncoderParams { ticks_per_turn: 100.0 };
        assert_eq!(encoder.ticks(0.0), 0);
        assert_eq!(encoder.ticks(0.999 * TAU / 100.0), 0);
        assert_eq!(encoder.ticks(1.001 * TAU / 100.0), 1);
        assert_eq!(encoder.ticks(-0.001 * TAU / 100.0), -1);
        assert_eq!(encoder.ticks(-TAU * 3.0 - 0.001), -301);
    }

    #[test]
    fn the_p3at_counts_138_a_millimetre() {
        let ticks = EncoderParams::default().ticks(1.0 / 0.111);
        assert!((ticks - 138_000).abs() <= 1, "{ticks} in a metre");
    }

    proptest! {
        #[test]
        fn the_count_is_never_more_than_a_tick_behind(angle in -1e4..1e4_f64) {
            let encoder = EncoderParams::default();
            let exact = angle / TAU * encoder.ticks_per_turn;
            let behind = exact - encoder.ticks(angle) as f64;
            prop_assert!((0.0..=1.0).contains(&behind), "{behind}");
        }
    }
}
