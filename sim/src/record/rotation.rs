//! Quaternions as they stand in files.

use nalgebra::{Quaternion, UnitQuaternion};

/// A quaternion this near to length 1 is as near as 64-bit numbers can say.
const ROUNDING: f64 = 1e-15;

/// The rotation of a quaternion whose length is 1 within `tolerance`; `None` otherwise. What is of length 1 already is
/// taken bit for bit, so that a rotation survives being written and read.
pub(super) fn rotation(quaternion: Quaternion<f64>, tolerance: f64) -> Option<UnitQuaternion<f64>> {
    match (quaternion.norm() - 1.0).abs() {
        off if off <= ROUNDING => Some(UnitQuaternion::new_unchecked(quaternion)),
        off if off <= tolerance => Some(UnitQuaternion::from_quaternion(quaternion)),
        _ => None,
    }
}
