//! `groundtruth.txt`: where the body really was, `timestamp tx ty tz qx qy qz qw` a line.

use std::path::Path;

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::error::RecordError;
use super::list::{self, Entry, Order};
use crate::evaluation::StampedPose;

const POSE: &str = "`timestamp tx ty tz qx qy qz qw`";
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
    let fault = |part: &str, problem: String| RecordError::Pose { place: entry.place_of(part), problem };
    let mut values = [0.0; 7];
    let mut fields = entry.rest.split_whitespace();
    for (index, value) in values.iter_mut().enumerate() {
        let field = fields.next().ok_or_else(|| {
            fault(&entry.rest[entry.rest.len()..], format!("{index} of 7 numbers after the time stamp"))
        })?;
        *value = field
            .parse::<f64>()
            .ok()
            .filter(|value| value.is_finite())
            .ok_or_else(|| fault(field, format!("`{field}` is no finite number")))?;
    }
    if let Some(extra) = fields.next() {
        return Err(fault(extra, format!("`{extra}` is one field too many")));
    }
    let [tx, ty, tz, qx, qy, qz, qw] = values;
    let rotation = Quaternion::new(qw, qx, qy, qz);
    if (rotation.norm() - 1.0).abs() > NORM_TOLERANCE {
        return Err(fault(entry.rest, format!("the quaternion's length is {:.4}, not 1", rotation.norm())));
    }
    let world_from_body =
        Isometry3::from_parts(Translation3::new(tx, ty, tz), UnitQuaternion::from_quaternion(rotation));
    Ok(StampedPose { time: entry.time, world_from_body })
}
