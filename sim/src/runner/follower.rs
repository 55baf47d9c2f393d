//! Follows one localiser through a recording and writes down what it says.

use nalgebra::Isometry3;
use sha2::{Digest, Sha256};
use sunblind_estimator::geometry::adjoint;
use sunblind_estimator::odometry::FeatureTrack;
use sunblind_estimator::{Disposition, Estimate, Measurement, MeasurementData, Rejection, Timestamp};

use super::driven::Driven;
use super::log::{FrameCounts, FrameLog, Track};
use crate::evaluation::StampedPose;
use crate::record::Frame;

/// A localiser and its log so far, in the localiser's own odom frame.
pub(super) struct Follower {
    driven: Driven,
    frames: Vec<FrameLog>,
    estimates: Sha256,
    newest_report: Option<Timestamp>,
    refusals: Vec<Rejection>,
}

impl Follower {
    pub fn new(driven: Driven) -> Self {
        Self { driven, frames: Vec::new(), estimates: Sha256::new(), newest_report: None, refusals: Vec::new() }
    }

    /// Hands one frame over and writes down the answer.
    pub fn take(&mut self, frame: &Frame) {
        let wanted = self.driven.localizer().wanted_streams();
        let rgb = wanted.rgb.then(|| (frame.rgb_time, MeasurementData::Rgb(frame.rgb.clone())));
        let depth = wanted.depth.then(|| (frame.depth_time, MeasurementData::Depth(frame.depth.clone())));
        let mut images: Vec<_> = [rgb, depth].into_iter().flatten().collect();
        images.sort_by_key(|(time, _)| *time);
        for (time, data) in images {
            let measurement = Measurement { captured_at: time, available_at: time, data };
            match self.driven.localizer_mut().handle(measurement) {
                // That no motion was found is part of the estimate's health.
                Disposition::Used | Disposition::Rejected(Rejection::NoMotion(_)) => {}
                Disposition::Rejected(reason) => self.refusals.push(reason),
            }
        }
        let estimate = self.driven.localizer().estimate();
        digest(&mut self.estimates, &estimate);
        let counts = self.counts();
        self.frames.push(FrameLog {
            time: frame.rgb_time,
            world_from_body: estimate.odom_from_robot,
            covariance: estimate.covariance,
            mode: estimate.mode,
            health: estimate.health,
            counts,
            stage_ms: self.driven.take_stage_ms(),
        });
    }

    /// The feature tracks of the frame that was taken last; none when it gave no report.
    pub fn feature_tracks(&self) -> Vec<FeatureTrack> {
        let reported = self.frames.last().is_some_and(|frame| frame.counts.is_some());
        self.driven.last_frame().filter(|_| reported).map(|report| report.tracks.clone()).unwrap_or_default()
    }

    /// What the localiser counted in the frame that it was just given; `None` when its newest report is an older one.
    fn counts(&mut self) -> Option<FrameCounts> {
        let report = self.driven.last_frame()?;
        if self.newest_report.replace(report.time) == Some(report.time) {
            return None;
        }
        Some(FrameCounts {
            features: report.features,
            matches: report.matches,
            inliers: report.inliers,
            keyframe: report.keyframe,
            depth_valid_share: report.depth_valid_share,
        })
    }

    /// How many frames it was given.
    pub fn frames_taken(&self) -> usize {
        self.frames.len()
    }

    /// SHA-256 over every estimate so far.
    pub fn digest(&self) -> impl AsRef<[u8]> {
        self.estimates.clone().finalize()
    }

    /// One sentence when images were refused.
    pub fn warning(&self) -> Option<String> {
        let first = self.refusals.first()?;
        Some(format!("{}: {} images were refused, the first as {first:?}", self.driven.name, self.refusals.len()))
    }

    /// The finished log, placed in the world of `truth` by the first frame that the truth covers.
    pub fn finish(mut self, truth: &[StampedPose]) -> Track {
        let placed = truth.first().and_then(|truth| {
            let estimate = self.frames.iter().find(|frame| frame.time == truth.time)?;
            Some(truth.world_from_body * estimate.world_from_body.inverse())
        });
        if let Some(world_from_odom) = placed {
            place(&mut self.frames, &world_from_odom);
        }
        let Driven { name, label, parameters, .. } = self.driven;
        Track { name, label, parameters, frames: self.frames }
    }
}

fn place(frames: &mut [FrameLog], world_from_odom: &Isometry3<f64>) {
    let adjoint = adjoint(world_from_odom);
    for frame in frames {
        frame.world_from_body = world_from_odom * frame.world_from_body;
        frame.covariance = adjoint * frame.covariance * adjoint.transpose();
    }
}

/// Adds the bits of every number of an estimate.
fn digest(hash: &mut Sha256, estimate: &Estimate) {
    let Estimate { time, odom_from_robot, covariance, mode, health } = estimate;
    let numbers = odom_from_robot
        .translation
        .vector
        .iter()
        .chain(odom_from_robot.rotation.coords.iter())
        .chain(covariance.iter());
    for number in numbers {
        hash.update(number.to_bits().to_le_bytes());
    }
    // Debug writes a float with as many digits as bring its bits back.
    hash.update(format!("{time:?} {mode:?} {health:?}"));
}
