//! A run and what it was worth: what every part of the report reads.

use std::io::{self, ErrorKind};

use sunblind_estimator::{Health, Timestamp};

use super::timing::Timing;
use crate::evaluation::{Evaluation, evaluate, median_interval};
use crate::runner::log::{FrameLog, RunLog, Track};

/// A log with its evaluations.
pub(super) struct Judged<'a> {
    pub log: &'a RunLog,
    /// The track that is judged: the first.
    pub track: &'a Track,
    /// One a track, in their order; `None` without truth.
    pub evaluations: Vec<Option<Evaluation>>,
}

impl<'a> Judged<'a> {
    /// # Errors
    /// `InvalidInput` without tracks, or with a track name that can't name a file.
    pub(super) fn new(log: &'a RunLog) -> io::Result<Self> {
        let refuse = |message: String| Err(io::Error::new(ErrorKind::InvalidInput, message));
        let Some(track) = log.tracks.first() else { return refuse("a run without tracks".into()) };
        let mut taken = vec!["truth"];
        for Track { name, .. } in &log.tracks {
            // The name becomes a file's: it must stay inside the folder and meet no other.
            let plain = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
            if !plain || taken.contains(&name.as_str()) {
                return refuse(format!("no name for a track: {name:?} (letters, digits, - and _, each name once)"));
            }
            taken.push(name);
        }
        let evaluations = log.tracks.iter().map(|track| evaluate(&track.frames, &log.truth)).collect();
        Ok(Self { log, track, evaluations })
    }

    /// The judged track's evaluation.
    pub(super) fn evaluation(&self) -> Option<&Evaluation> {
        self.evaluations.first()?.as_ref()
    }

    /// Where the time of the judged track's estimator went: kept with the track of its visual odometry, if that is
    /// another one. `None` when nobody held a clock to it.
    pub(super) fn timing(&self) -> Option<Timing> {
        self.log.tracks.iter().find_map(Timing::of)
    }

    /// How many frames the camera took: one for each instant of the visual odometry, where there is one.
    pub(super) fn camera_frames(&self) -> usize {
        self.log.tracks.iter().map(|track| track.frames.len()).max().unwrap_or(0)
    }

    /// When the first frame was taken.
    pub(super) fn start(&self) -> Option<Timestamp> {
        Some(self.track.frames.first()?.time)
    }

    /// From the first frame to the last, seconds.
    pub(super) fn duration(&self) -> f64 {
        match self.track.frames.as_slice() {
            [first, .., last] => last.time.since(first.time),
            _ => 0.0,
        }
    }

    /// Simulated time, or recorded time from the first frame to the last; seconds.
    pub(super) fn duration_of_run(&self) -> f64 {
        self.log.facts.as_ref().map_or_else(|| self.duration(), |facts| facts.duration)
    }

    /// How much faster than it happened the run was.
    pub(super) fn real_time_factor(&self) -> f64 {
        self.duration_of_run() / self.log.wall
    }

    /// Length of the true path, metres; of the judged track's own path where there is no truth.
    pub(super) fn path(&self) -> f64 {
        if let Some(facts) = &self.log.facts {
            return facts.path;
        }
        self.evaluation().map_or_else(|| own_path(&self.track.frames), |evaluation| evaluation.path_m)
    }

    /// The median time between two frames, seconds; `None` of fewer than two.
    pub(super) fn frame_interval(&self) -> Option<f64> {
        let times: Vec<Timestamp> = self.track.frames.iter().map(|frame| frame.time).collect();
        median_interval(&times)
    }
}

fn own_path(frames: &[FrameLog]) -> f64 {
    let position = |frame: &FrameLog| frame.world_from_body.translation.vector;
    frames.windows(2).map(|pair| (position(&pair[1]) - position(&pair[0])).norm()).sum()
}

/// Whether the frame gave no motion.
pub(super) fn is_lost(frame: &FrameLog) -> bool {
    matches!(frame.health, Health::Lost(_))
}

/// Frames that were tracked.
pub(super) fn tracked_frames(track: &Track) -> usize {
    track.frames.iter().filter(|frame| frame.health == Health::Good).count()
}

/// Frames that gave no motion.
pub(super) fn lost_frames(track: &Track) -> usize {
    track.frames.iter().filter(|frame| is_lost(frame)).count()
}
