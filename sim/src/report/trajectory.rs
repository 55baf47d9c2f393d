//! Trajectories in the TUM format, for `evo` and its kin.

use std::fmt::Write;

use nalgebra::Isometry3;
use sunblind_estimator::Timestamp;

/// Lines of `timestamp tx ty tz qx qy qz qw`: seconds, metres.
pub(super) fn to_tum(poses: impl Iterator<Item = (Timestamp, Isometry3<f64>)>) -> String {
    let mut text = String::new();
    for (time, pose) in poses {
        let (t, q) = (pose.translation, pose.rotation.coords);
        let time = decimal_seconds(time);
        writeln!(text, "{time} {:.9} {:.9} {:.9} {:.9} {:.9} {:.9} {:.9}", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
            .expect("a string takes all that is written to it");
    }
    text
}

/// Seconds with all nine decimals: through a float an epoch time would lose its last digits.
pub(super) fn decimal_seconds(time: Timestamp) -> String {
    let nanos = i128::from(time.as_nanos());
    let sign = if nanos < 0 { "-" } else { "" };
    format!("{sign}{}.{:09}", nanos.abs() / 1_000_000_000, nanos.abs() % 1_000_000_000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_nanosecond_is_kept() {
        for (nanos, text) in [
            (1_305_031_102_175_304_001, "1305031102.175304001"),
            (0, "0.000000000"),
            (-1, "-0.000000001"),
            (i64::MIN, "-9223372036.854775808"),
        ] {
            assert_eq!(decimal_seconds(Timestamp::from_nanos(nanos)), text);
        }
    }
}
