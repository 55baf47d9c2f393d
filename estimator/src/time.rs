//! Instants and durations: integer nanoseconds, so that equal inputs stay equal after any arithmetic.

use serde::{Deserialize, Serialize};

/// An instant on the recording's or the robot's own clock, in nanoseconds from an epoch that only its source knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Timestamp(i64);

impl Timestamp {
    /// From whole nanoseconds.
    pub const fn from_nanos(nanos: i64) -> Self {
        Self(nanos)
    }

    /// From seconds, rounded to the nearest nanosecond; `None` when not finite or out of range (292 years).
    pub fn from_secs(secs: f64) -> Option<Self> {
        let nanos = (secs * 1e9).round();
        // The bound is exact in f64; i64::MAX itself is not.
        (nanos.abs() < 9.223_372_036_854_775e18).then_some(Self(nanos as i64))
    }

    /// Whole nanoseconds since the epoch.
    pub const fn as_nanos(self) -> i64 {
        self.0
    }

    /// Seconds since the epoch.
    pub fn as_secs(self) -> f64 {
        self.0 as f64 * 1e-9
    }

    /// Seconds from `earlier` to `self`; negative when `self` comes first.
    pub fn since(self, earlier: Self) -> f64 {
        // i128 because two instants at opposite ends of the range are further apart than an i64 can say.
        (i128::from(self.0) - i128::from(earlier.0)) as f64 * 1e-9
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_survive_a_round_trip() {
        for secs in [0.0, 0.033_333, 1_305_031_102.175_304] {
            let there = Timestamp::from_secs(secs).unwrap();
            assert!((there.as_secs() - secs).abs() < 1e-6);
        }
    }

    #[test]
    fn what_no_clock_can_show_is_refused() {
        for secs in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
            assert_eq!(Timestamp::from_secs(secs), None);
        }
    }

    #[test]
    fn the_ends_of_time_do_not_overflow() {
        let end = Timestamp::from_nanos(i64::MAX);
        let start = Timestamp::from_nanos(i64::MIN);
        assert!(end.since(start) > 1.8e10);
    }
}
