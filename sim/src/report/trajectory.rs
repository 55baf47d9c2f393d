//! Trajectories in the TUM format, for `evo` and its kin.

use std::fmt::Write;

use nalgebra::Isometry3;
use sunblind_estimator::Timestamp;

use crate::record::stamp::decimal_seconds;

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
