//! The truth at instants between those it was recorded at.

use nalgebra::Isometry3;
use sunblind_estimator::Timestamp;

use crate::evaluation::StampedPose;

/// The longest hole in the truth, in seconds, that is interpolated across. A body that accelerates with 1 m/s² strays
/// up to a T²/8 = 8 mm from the straight line in it; beyond that the truth would be less true than what it judges.
const LONGEST_GAP: f64 = 0.25;

/// The pose at `time`: the position interpolated linearly, the rotation along the sphere. `None` outside the recorded
/// truth and in its holes. `recorded` is in time order.
pub fn at(recorded: &[StampedPose], time: Timestamp) -> Option<StampedPose> {
    let after = recorded.partition_point(|pose| pose.time < time);
    let next = recorded.get(after)?;
    if next.time == time {
        return Some(*next);
    }
    let previous = recorded.get(after.checked_sub(1)?)?;
    let gap = next.time.since(previous.time);
    if gap > LONGEST_GAP {
        return None;
    }
    let share = time.since(previous.time) / gap;
    let (start, end) = (&previous.world_from_body, &next.world_from_body);
    let translation = start.translation.vector.lerp(&end.translation.vector, share);
    // As a power, because nalgebra's slerp gives up between rotations that are all but equal: a robot at rest.
    let rotation = start.rotation.rotation_to(&end.rotation).powf(share) * start.rotation;
    Some(StampedPose { time, world_from_body: Isometry3::from_parts(translation.into(), rotation) })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn pose(ms: i64, x: f64, yaw: f64) -> StampedPose {
        let world_from_body = Isometry3::new(Vector3::new(x, 0.0, 0.0), Vector3::new(0.0, 0.0, yaw));
        StampedPose { time: Timestamp::from_nanos(ms * 1_000_000), world_from_body }
    }

    fn at_ms(recorded: &[StampedPose], ms: i64) -> Option<StampedPose> {
        at(recorded, Timestamp::from_nanos(ms * 1_000_000))
    }

    #[test]
    fn between_two_poses_lies_their_mean() {
        let between = at_ms(&[pose(0, 1.0, 0.2), pose(100, 2.0, 0.6)], 25).unwrap();
        let distance = between.world_from_body.inverse() * pose(25, 1.25, 0.3).world_from_body;
        assert!(distance.translation.vector.norm() + distance.rotation.angle() < 1e-12);
    }

    #[test]
    fn a_quaternion_and_its_negative_are_one_rotation() {
        let (first, mut second) = (pose(0, 0.0, 0.2), pose(100, 0.0, 0.4));
        let negative = nalgebra::Unit::new_unchecked(-second.world_from_body.rotation.into_inner());
        second.world_from_body = Isometry3::from_parts(second.world_from_body.translation, negative);
        let between = at_ms(&[first, second], 50).unwrap();
        assert!((between.world_from_body.rotation.angle() - 0.3).abs() < 1e-9);
    }

    #[test]
    fn a_body_at_rest_is_interpolated_too() {
        for turned in [0.0, 1e-12, 1e-8] {
            let between = at_ms(&[pose(0, 0.0, 0.0), pose(100, 0.0, turned)], 50).unwrap();
            assert!((between.world_from_body.rotation.angle() - turned / 2.0).abs() < 1e-12, "{turned}");
        }
    }

    #[test]
    fn nothing_is_made_up_outside_or_in_a_hole() {
        let recorded = [pose(0, 0.0, 0.0), pose(100, 1.0, 0.0), pose(900, 2.0, 0.0)];
        assert_eq!(at_ms(&recorded, 100), Some(recorded[1]));
        assert_eq!(at_ms(&recorded, 900), Some(recorded[2]));
        for ms in [-1, 500, 901] {
            assert_eq!(at_ms(&recorded, ms), None, "{ms} ms");
        }
        assert_eq!(at_ms(&[], 0), None);
    }
}
