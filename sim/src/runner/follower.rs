//! Follows one localiser through a stream of measurements and writes down what it says.

use nalgebra::Isometry3;
use sha2::{Digest, Sha256};
use sunblind_estimator::geometry::adjoint;
use sunblind_estimator::odometry::FeatureTrack;
use sunblind_estimator::{
    Disposition, Estimate, Health, Localizer, Measurement, MeasurementData, Mode, Rejection, Streams, Timestamp,
};

use super::driven::Driven;
use super::log::{FrameCounts, FrameLog, Track};
use crate::evaluation::{StampedPose, true_pose_at};
use crate::modes::StampedReport;

/// A localiser and its logs so far, each in its own odom frame.
pub(super) struct Follower {
    driven: Driven,
    /// One a track.
    logs: Vec<Vec<FrameLog>>,
    modes: Vec<StampedReport>,
    estimates: Sha256,
    newest_report: Option<Timestamp>,
    /// Whether its newest report is of the frame that was logged last.
    reported: bool,
    refused: usize,
    first_refusal: Option<Rejection>,
}

impl Follower {
    pub fn new(driven: Driven) -> Self {
        let logs = driven.tracks.iter().map(|_| Vec::new()).collect();
        Self {
            driven,
            logs,
            modes: Vec::new(),
            estimates: Sha256::new(),
            newest_report: None,
            reported: false,
            refused: 0,
            first_refusal: None,
        }
    }

    /// The localiser itself.
    pub fn localizer(&self) -> &dyn Localizer {
        self.driven.localizer()
    }

    /// Hands one measurement over, unless it is an image that isn't wanted.
    pub fn take(&mut self, measurement: &Measurement) {
        if !is_wanted(&measurement.data, self.driven.localizer().wanted_streams()) {
            return;
        }
        match self.driven.localizer_mut().handle(measurement.clone()) {
            // That no motion was found is part of the estimate's health, and nobody needs every sensor.
            Disposition::Used | Disposition::Rejected(Rejection::NoMotion(_) | Rejection::Unsupported) => {}
            Disposition::Rejected(reason) => {
                self.refused += 1;
                self.first_refusal.get_or_insert(reason);
            }
        }
    }

    /// Writes down what it says once it has the frame of `time`.
    pub fn log(&mut self, time: Timestamp) {
        self.modes.extend(self.driven.mode_report().map(|report| StampedReport { time, report }));
        let estimates = self.driven.estimates();
        let counts = self.counts();
        self.reported = counts.is_some();
        let stage_ms = self.driven.take_stage_ms();
        for ((estimate, track), log) in estimates.into_iter().zip(&self.driven.tracks).zip(&mut self.logs) {
            digest(&mut self.estimates, &estimate);
            let Some(time) = instant(&estimate, time, log.last()) else { continue };
            log.push(FrameLog {
                time,
                world_from_body: estimate.odom_from_robot,
                covariance: estimate.covariance,
                mode: estimate.mode,
                health: estimate.health,
                counts: counts.filter(|_| track.is_visual),
                stage_ms: if track.is_visual { stage_ms } else { [0.0; 4] },
            });
        }
    }

    /// The feature tracks of the frame that was logged last, and its mode; none and wheels when it gave no report.
    pub fn feature_tracks(&self) -> (Vec<FeatureTrack>, Mode) {
        let report = self.driven.last_frame().filter(|_| self.reported);
        report.map_or((Vec::new(), Mode::Odometer), |report| (report.tracks.clone(), report.mode))
    }

    /// What the localiser counted in the newest frame; `None` when its newest report is of an older one.
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

    /// What its mode switch has said, once a frame.
    pub fn take_modes(&mut self) -> Vec<StampedReport> {
        std::mem::take(&mut self.modes)
    }

    /// The instants that it has spoken of, track by track.
    pub fn times(&self) -> impl Iterator<Item = impl Iterator<Item = Timestamp>> {
        self.logs.iter().map(|log| log.iter().map(|entry| entry.time))
    }

    /// SHA-256 over every estimate so far.
    pub fn digest(&self) -> impl AsRef<[u8]> {
        self.estimates.clone().finalize()
    }

    /// One sentence when measurements were refused.
    pub fn warning(&self) -> Option<String> {
        let first = self.first_refusal.as_ref()?;
        Some(format!("{}: {} measurements were refused, the first as {first:?}", self.driven.name(), self.refused))
    }

    /// The finished logs, each placed in the world of `truth` by the first instant that the truth covers.
    pub fn finish(self, truth: &[StampedPose]) -> Vec<Track> {
        let parameters = self.driven.parameters;
        let finished = self.driven.tracks.into_iter().zip(self.logs).map(|(track, mut frames)| {
            let placed = frames
                .iter()
                .find_map(|frame| Some(true_pose_at(truth, frame.time)? * frame.world_from_body.inverse()));
            if let Some(world_from_odom) = placed {
                place(&mut frames, &world_from_odom);
            }
            Track { name: track.name, label: track.label, parameters: parameters.clone(), frames }
        });
        finished.collect()
    }
}

fn is_wanted(data: &MeasurementData, wanted: Streams) -> bool {
    match data {
        MeasurementData::Rgb(_) => wanted.rgb,
        MeasurementData::Infrared(_) => wanted.infrared,
        MeasurementData::Depth(_) => wanted.depth,
        _ => true,
    }
}

/// When an estimate is of: it is held against the truth of that instant, not of the frame's, since wheels may have
/// carried it on, or not caught up with the frame yet. A pose that was logged before is not logged again unless it is
/// lost; then it stands for the frame.
fn instant(estimate: &Estimate, frame: Timestamp, last: Option<&FrameLog>) -> Option<Timestamp> {
    let is_new = |time: &Timestamp| last.is_none_or(|last| *time > last.time);
    let known = estimate.time.filter(is_new);
    let stands_for_the_frame = estimate.time.is_none() || estimate.health != Health::Good;
    known.or(Some(frame).filter(|_| stands_for_the_frame).filter(is_new))
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
