//! Trajectories held against the truth, with the definitions of `evo`.

mod alignment;
mod consistency;
mod corrections;
mod drift;
#[cfg(test)]
mod tests;
mod tracking;

use nalgebra::{Isometry3, Matrix6};
use serde::Serialize;
use sunblind_estimator::{Mode, Timestamp};

use crate::runner::log::FrameLog;

pub use corrections::{Corrections, corrections};
pub use tracking::Tracking;

/// Shortest stretch in one mode that says how it drifts, metres.
const SHORTEST_STRETCH: f64 = 1.0;

/// A pose at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampedPose {
    /// When.
    pub time: Timestamp,
    /// The body's pose in the world.
    pub world_from_body: Isometry3<f64>,
}

/// How far a trajectory lies from the truth. What can't be had (a second's drift of half a second's recording,
/// a percentage of a path of no length) is NaN, so that no bound on it holds, and `null` in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Evaluation {
    /// RMSE along the world's x, from the common start pose, without alignment.
    pub rmse_x_m: f64,
    /// RMSE along the world's y, likewise.
    pub rmse_y_m: f64,
    /// RMSE of the angle of the whole rotation error, likewise. For a robot on a plane that is the heading error.
    pub rmse_theta_deg: f64,
    /// Absolute trajectory error: RMSE of the position after the best rigid alignment, without scale
    /// (`evo_ape tum truth.tum estimate.tum -a`).
    pub ate_m: f64,
    /// Frames in 1 s, by the median time between two of them: what the relative pose error is taken over.
    pub rpe_delta_frames: usize,
    /// Relative pose error over 1 s: RMSE of the translation over all pairs of frames that far apart
    /// (at 30 Hz `evo_rpe tum truth.tum estimate.tum --delta 30 --delta_unit f --all_pairs`).
    pub rpe_m: f64,
    /// The same of the rotation angle (`… -r angle_deg`).
    pub rpe_deg: f64,
    /// Relative pose error from one frame to the next, translation.
    pub rpe_frame_m: f64,
    /// Relative pose error from one frame to the next, rotation angle.
    pub rpe_frame_deg: f64,
    /// Mean of translation error / length over all sub-paths of 5, 10, 20, 50 and 100 m (KITTI's measure at a
    /// robot's lengths); over the whole path where it is shorter than 5 m.
    pub drift_percent: f64,
    /// Distance from the truth at the last frame, without alignment.
    pub end_error_m: f64,
    /// Average normalised estimation error squared of x, y and heading, not divided by their number: 3 for a covariance
    /// that is right, more for one that is too small. `null` for a localiser that gives none.
    pub anees: f64,
    /// Length of the true path.
    pub path_m: f64,
}

/// A frame's pose beside the true one, both `world_from_body`.
#[derive(Clone, Copy)]
struct PosePair {
    time: Timestamp,
    estimate: Isometry3<f64>,
    truth: Isometry3<f64>,
    /// Of a left perturbation of the estimate.
    covariance: Matrix6<f64>,
}

/// Holds `frames` against the poses of `truth` (in time order) at exactly the same instants; both in one world, from
/// one start pose. `None` when fewer than 3 frames have truth.
pub fn evaluate(frames: &[FrameLog], truth: &[StampedPose]) -> Option<Evaluation> {
    let pairs = pair_by_time(frames, truth);
    if pairs.len() < 3 {
        return None;
    }
    let last = pairs.last()?;
    let position_errors = || pairs.iter().map(|pair| pair.estimate.translation.vector - pair.truth.translation.vector);
    let lengths = drift::path_lengths(&pairs);
    let times: Vec<Timestamp> = pairs.iter().map(|pair| pair.time).collect();
    let rpe_delta_frames = ((1.0 / median_interval(&times)?).round() as usize).max(1);
    let second = relative_errors(&pairs, rpe_delta_frames);
    let frame = relative_errors(&pairs, 1);
    Some(Evaluation {
        rmse_x_m: root_mean_square(position_errors().map(|error| error.x)),
        rmse_y_m: root_mean_square(position_errors().map(|error| error.y)),
        rmse_theta_deg: root_mean_square(pairs.iter().map(|pair| rotation_error(&pair.estimate, &pair.truth)))
            .to_degrees(),
        ate_m: alignment::aligned_rmse(&pairs),
        rpe_delta_frames,
        rpe_m: root_mean_square(second.iter().map(translation)),
        rpe_deg: root_mean_square(second.iter().map(rotation)).to_degrees(),
        rpe_frame_m: root_mean_square(frame.iter().map(translation)),
        rpe_frame_deg: root_mean_square(frame.iter().map(rotation)).to_degrees(),
        drift_percent: 100.0 * drift::mean_drift(&pairs, &lengths),
        end_error_m: position_error(&last.estimate, &last.truth),
        anees: consistency::average_nees(&pairs),
        path_m: *lengths.last()?,
    })
}

/// A motion, or what one is wrong by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Metres.
    pub translation: f64,
    /// Radians.
    pub rotation: f64,
}

impl Step {
    fn of(motion: &Isometry3<f64>) -> Self {
        Self { translation: translation(motion), rotation: rotation(motion) }
    }
}

/// The true motion from each of `frames` to the next, and what the estimated one is wrong by (the relative pose error
/// over one frame). Of frames that have truth.
pub fn frame_steps(frames: &[FrameLog], truth: &[StampedPose]) -> Vec<(Step, Step)> {
    let step = |pair: &[PosePair]| {
        let motion = pair[0].truth.inv_mul(&pair[1].truth);
        (Step::of(&motion), Step::of(&relative_error(&pair[0], &pair[1])))
    };
    pair_by_time(frames, truth).windows(2).map(step).collect()
}

/// Errors at the ends of all stretches that were driven in one mode, as a share of their lengths, percent. Each stretch is
/// held against the truth from its own start; those that are shorter than a metre don't count. NaN when there are none.
pub fn drift_in_mode(frames: &[FrameLog], truth: &[StampedPose], mode: Mode) -> f64 {
    let (mut error, mut length) = (0.0, 0.0);
    for stretch in frames.chunk_by(|frame, next| frame.mode == next.mode) {
        if stretch[0].mode != mode {
            continue;
        }
        let pairs = pair_by_time(stretch, truth);
        let gone = drift::path_lengths(&pairs).last().copied().unwrap_or(0.0);
        if gone >= SHORTEST_STRETCH {
            error += translation(&relative_error(&pairs[0], &pairs[pairs.len() - 1]));
            length += gone;
        }
    }
    100.0 * error / length
}

/// The pose of `truth` (in time order) at exactly `time`.
pub fn true_pose_at(truth: &[StampedPose], time: Timestamp) -> Option<Isometry3<f64>> {
    let index = truth.binary_search_by_key(&time, |pose| pose.time).ok()?;
    Some(truth[index].world_from_body)
}

/// Distance of a pose from the true one, metres.
pub fn position_error(world_from_body: &Isometry3<f64>, truth: &Isometry3<f64>) -> f64 {
    (world_from_body.translation.vector - truth.translation.vector).norm()
}

/// Angle of the rotation between a pose and the true one, radians.
pub fn rotation_error(world_from_body: &Isometry3<f64>, truth: &Isometry3<f64>) -> f64 {
    truth.rotation.angle_to(&world_from_body.rotation)
}

fn pair_by_time(frames: &[FrameLog], truth: &[StampedPose]) -> Vec<PosePair> {
    frames
        .iter()
        .filter_map(|frame| {
            let truth = true_pose_at(truth, frame.time)?;
            let FrameLog { time, world_from_body, covariance, .. } = *frame;
            Some(PosePair { time, estimate: world_from_body, truth, covariance })
        })
        .collect()
}

/// The median time from one instant to the next, seconds; `None` of fewer than two.
pub(crate) fn median_interval(times: &[Timestamp]) -> Option<f64> {
    let mut intervals: Vec<f64> = times.windows(2).map(|pair| pair[1].since(pair[0])).collect();
    intervals.sort_by(f64::total_cmp);
    intervals.get(intervals.len() / 2).copied()
}

/// The relative pose errors E of Sturm et al. (IROS 2012), eq. 1, over all pairs `delta` frames apart.
fn relative_errors(pairs: &[PosePair], delta: usize) -> Vec<Isometry3<f64>> {
    pairs.iter().zip(pairs.iter().skip(delta)).map(|(from, to)| relative_error(from, to)).collect()
}

fn relative_error(from: &PosePair, to: &PosePair) -> Isometry3<f64> {
    from.truth.inv_mul(&to.truth).inv_mul(&from.estimate.inv_mul(&to.estimate))
}

fn translation(error: &Isometry3<f64>) -> f64 {
    error.translation.vector.norm()
}

fn rotation(error: &Isometry3<f64>) -> f64 {
    error.rotation.angle()
}

/// NaN of nothing.
fn root_mean_square(errors: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = errors.fold((0.0, 0), |(sum, count), error| (sum + error * error, count + 1));
    (sum / f64::from(count)).sqrt()
}
