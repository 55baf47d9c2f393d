//! `summary.json`: the run in numbers, for programs.

use std::collections::BTreeMap;
use std::io;

use serde::Serialize;

use super::judged::{Judged, lost_frames, tracked_frames};
use super::timing::{STAGES, StageTime, Timing};
use crate::evaluation::Evaluation;
use crate::runner::log::Track;

/// The layout's version, raised when a field changes its meaning or goes.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
struct Summary<'a> {
    schema: u32,
    /// The recording's name.
    scenario: &'a str,
    digest: &'a str,
    duration_s: f64,
    /// Of the true path; of the judged estimator's own where there is no truth.
    path_m: f64,
    frames: usize,
    /// Of the judged estimator.
    lost_frames: usize,
    wall_s: f64,
    cpu_s: f64,
    /// Recorded time / wall time: above 1 is faster than it happened.
    real_time_factor: f64,
    cpu_ms_per_frame: CpuPerFrame,
    /// The one that is judged.
    judged: &'a str,
    estimators: BTreeMap<&'a str, EstimatorSummary>,
    warnings: &'a [String],
    expectations: [(); 0],
}

#[derive(Serialize)]
struct CpuPerFrame {
    /// Mean over the frames of the stages' sum, of the estimator that made the judged track; `null` when nobody held a clock to it.
    estimator: Option<f64>,
}

#[derive(Serialize)]
struct EstimatorSummary {
    frames: usize,
    tracked_frames: usize,
    lost_frames: usize,
    /// Its fields stand beside these; none without truth.
    #[serde(flatten)]
    evaluation: Option<Evaluation>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stages: Option<BTreeMap<&'static str, StageTime>>,
}

/// Indented, with a line feed at the end.
pub(super) fn to_json(judged: &Judged) -> io::Result<String> {
    let log = judged.log;
    let estimators = log.tracks.iter().zip(&judged.evaluations);
    let summary = Summary {
        schema: SCHEMA,
        scenario: &log.recording,
        digest: &log.digest,
        duration_s: judged.duration(),
        path_m: judged.path(),
        frames: judged.track.frames.len(),
        lost_frames: lost_frames(judged.track),
        wall_s: log.wall,
        cpu_s: log.cpu,
        real_time_factor: judged.duration() / log.wall,
        cpu_ms_per_frame: CpuPerFrame { estimator: judged.timing().map(|timing| timing.mean_ms) },
        judged: &judged.track.name,
        estimators: estimators
            .map(|(track, evaluation)| (track.name.as_str(), estimator(track, *evaluation)))
            .collect(),
        warnings: &log.warnings,
        expectations: [],
    };
    Ok(serde_json::to_string_pretty(&summary)? + "\n")
}

fn estimator(track: &Track, evaluation: Option<Evaluation>) -> EstimatorSummary {
    EstimatorSummary {
        frames: track.frames.len(),
        tracked_frames: tracked_frames(track),
        lost_frames: lost_frames(track),
        evaluation,
        stages: Timing::of(track).map(|timing| STAGES.into_iter().zip(timing.stages).collect()),
    }
}
