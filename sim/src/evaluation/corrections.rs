//! How far an estimate leaps: what it moves by, from one frame to the next, that the wheels did not tell.

use serde::Serialize;
use sunblind_estimator::Timestamp;

use super::{PosePair, StampedPose, Step, pair_by_time, relative_error};
use crate::runner::log::FrameLog;

/// A correction belongs to a change of the mode that is no further off, seconds.
const ABOUT_A_SWITCH: f64 = 1.0;

/// The largest corrections of a fused estimate in one step. Whoever steers by it sees the robot leap that far.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Corrections {
    /// The largest shift beyond the wheels' motion.
    pub max_correction_m: f64,
    /// The largest turn beyond the wheels' motion.
    pub max_correction_deg: f64,
    /// The largest shift within a second of a change of the mode; NaN without one.
    pub switch_correction_m: f64,
    /// The largest turn within a second of a change of the mode; NaN without one.
    pub switch_correction_deg: f64,
}

/// What `frames` moved by beyond the wheels' own track, from each instant that both speak of to the next: at the later one.
pub fn corrections(frames: &[FrameLog], wheels: &[FrameLog]) -> Vec<(Timestamp, Step)> {
    let pose = |frame: &FrameLog| StampedPose { time: frame.time, world_from_body: frame.world_from_body };
    let wheels: Vec<_> = wheels.iter().map(pose).collect();
    let correction = |pair: &[PosePair]| (pair[1].time, Step::of(&relative_error(&pair[0], &pair[1])));
    pair_by_time(frames, &wheels).windows(2).map(correction).collect()
}

impl Corrections {
    /// Of a fused track beside the wheels'. `switches`: when the mode changed. `None` when the two share fewer than two
    /// instants.
    pub fn of(frames: &[FrameLog], wheels: &[FrameLog], switches: &[Timestamp]) -> Option<Self> {
        let all = corrections(frames, wheels);
        let is_near = |time: Timestamp| switches.iter().any(|&switch| time.since(switch).abs() <= ABOUT_A_SWITCH);
        let largest = |of: fn(&Step) -> f64, counts: &dyn Fn(Timestamp) -> bool| {
            all.iter().filter(|(time, _)| counts(*time)).map(|(_, step)| of(step)).fold(f64::NAN, f64::max)
        };
        let shift = |step: &Step| step.translation;
        let turn = |step: &Step| step.rotation.to_degrees();
        (!all.is_empty()).then(|| Self {
            max_correction_m: largest(shift, &|_| true),
            max_correction_deg: largest(turn, &|_| true),
            switch_correction_m: largest(shift, &is_near),
            switch_correction_deg: largest(turn, &is_near),
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Matrix6, Vector3};
    use sunblind_estimator::{Health, Mode};

    use super::*;

    /// Ten frames a second.
    fn track(pose: impl Fn(u32) -> Isometry3<f64>) -> Vec<FrameLog> {
        let frame = |index: u32| FrameLog {
            time: Timestamp::from_nanos(100_000_000 * i64::from(index)),
            world_from_body: pose(index),
            covariance: Matrix6::zeros(),
            mode: Mode::Indoor,
            health: Health::Good,
            counts: None,
            stage_ms: [0.0; 4],
        };
        (0..60).map(frame).collect()
    }

    /// Along a bend.
    fn driven(index: u32) -> Isometry3<f64> {
        let step = Isometry3::new(Vector3::x() * 0.03, Vector3::z() * 0.02);
        (0..index).fold(Isometry3::identity(), |pose, _| pose * step)
    }

    #[test]
    fn what_wheels_told_is_no_correction() {
        // Two leaps: 2 cm to the side after 2 s, half a degree after 4.
        let turn = Isometry3::rotation(Vector3::z() * 0.5_f64.to_radians());
        let fused = |index: u32| {
            let start = Isometry3::new(Vector3::new(3.0, 1.0, 0.0), Vector3::z());
            let shift = if index < 20 { Isometry3::identity() } else { Isometry3::translation(0.0, 0.02, 0.0) };
            let so_far = start * driven(index.min(39)) * shift;
            if index < 40 { so_far } else { so_far * turn * driven(39).inverse() * driven(index) }
        };
        let (fused, wheels) = (track(fused), track(driven));
        let at = |seconds| Timestamp::from_secs(seconds).unwrap();
        let found = Corrections::of(&fused, &wheels, &[at(3.5), at(0.2)]).unwrap();
        // A shift is seen by the turn of the step that follows it.
        assert!((found.max_correction_m - 0.02).abs() < 1e-9, "{found:?}");
        assert!((found.max_correction_deg - 0.5).abs() < 1e-9, "{found:?}");
        assert!((found.switch_correction_deg - 0.5).abs() < 1e-9 && found.switch_correction_m < 0.001, "{found:?}");
        let undisturbed = Corrections::of(&fused, &wheels, &[at(0.2)]).unwrap();
        assert!(undisturbed.switch_correction_m < 1e-9 && undisturbed.switch_correction_deg < 1e-6, "{undisturbed:?}");
        let steady = Corrections::of(&fused, &wheels, &[]).unwrap();
        assert!(steady.switch_correction_m.is_nan() && steady.switch_correction_deg.is_nan());
        assert_eq!(Corrections::of(&fused, &wheels[..1], &[]), None);
    }
}
