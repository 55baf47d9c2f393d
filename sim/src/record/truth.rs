//! `groundtruth.txt`: where the body really was, `timestamp tx ty tz qx qy qz qw` a line.

use std::path::Path;

use nalgebra::{Isometry3, Quaternion, Translation3};

use super::error::RecordError;
use super::list::{self, Entry, Order};
use super::rotation::rotation;
use crate::evaluation::StampedPose;

const POSE: &str = "`timestamp tx ty tz qx qy qz qw`: seconds, metres and a unit quaternion";
/// How far a quaternion's norm may be from 1: TUM files have four decimals, some tools three.
const NORM_TOLERANCE: f64 = 0.01;

/// The poses in `file`, in time order (a time may repeat); none when there is no such file.
pub(super) fn read(file: &Path) -> Result<Vec<StampedPose>, RecordError> {
    if !file.exists() {
        return Ok(Vec::new());
    }
    let text = list::read(file, POSE)?;
    // Motion capture at 300 Hz repeats time stamps once they are rounded to 0.1 ms, as TUM's are.
    list::entries(file, &text, POSE, Order::NotFalling)?.iter().map(pose).collect()
}

fn pose(entry: &Entry) -> Result<StampedPose, RecordError> {
    let [tx, ty, tz, qx, qy, qz, qw] = entry.numbers(POSE)?;
    let quaternion = Quaternion::new(qw, qx, qy, qz);
    let rotation = rotation(quaternion, NORM_TOLERANCE).ok_or_else(|| RecordError::Values {
        place: entry.place_of(entry.rest),
        problem: format!("the quaternion's length is {:.4}, not 1", quaternion.norm()),
        wanted: POSE,
    })?;
    Ok(StampedPose {
        time: entry.time,
        world_from_body: Isometry3::from_parts(Translation3::new(tx, ty, tz), rotation),
    })
}
