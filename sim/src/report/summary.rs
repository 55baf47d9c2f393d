//! `summary.json`: the run in numbers, for programs.

use std::collections::BTreeMap;
use std::io;

use serde::Serialize;
use sunblind_estimator::mode::Energies;

use super::judged::{Judged, lost_frames, tracked_frames};
use super::timing::{STAGES, StageTime, Timing};
use crate::evaluation::{Corrections, Evaluation};
use crate::modes::Score;
use crate::runner::log::Track;
use crate::scenario::Quality;
use crate::scenario::expect::Judged as Expected;

/// The layout's version, raised when a field changes its meaning or goes.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
struct Summary<'a> {
    schema: u32,
    /// The scenario's or the recording's name.
    scenario: &'a str,
    /// `null` for a recording, as is all that only a simulation has.
    seed: Option<u64>,
    /// `fast` or `full`.
    quality: Option<Quality>,
    digest: &'a str,
    adapter: Option<&'a str>,
    driver: Option<&'a str>,
    duration_s: f64,
    /// Of the true path; of the judged estimator's own where there is no truth.
    path_m: f64,
    /// That the camera took: a track that rests on wheels has fewer instants.
    frames: usize,
    /// Of the judged estimator.
    lost_frames: usize,
    wall_s: f64,
    cpu_s: f64,
    /// Recorded or simulated time / wall time: above 1 is faster than it happened.
    real_time_factor: f64,
    cpu_ms_per_frame: CpuPerFrame,
    /// The one that is judged.
    judged: &'a str,
    estimators: BTreeMap<&'a str, EstimatorSummary>,
    sensor: SensorSummary,
    /// `null` without a mode switch, and of a recording, which does not say what would have been best.
    modes: Option<Score>,
    warnings: &'a [String],
    expectations: &'a [Expected],
}

/// Means over the frames, milliseconds; `null` where nobody held a clock to it.
#[derive(Serialize)]
struct CpuPerFrame {
    render: Option<f64>,
    depth: Option<f64>,
    physics: Option<f64>,
    /// All stages of the estimator that made the judged track.
    estimator: Option<f64>,
}

#[derive(Serialize)]
struct SensorSummary {
    /// Mean share of the depth images' pixels that have a value; `null` when nobody counted.
    depth_valid_share: Option<f64>,
    /// Mean energies of the images, 0 to 1; `null` where there were none.
    energies: Energies,
}

#[derive(Serialize)]
struct EstimatorSummary {
    frames: usize,
    tracked_frames: usize,
    lost_frames: usize,
    /// Its fields stand beside these; none without truth.
    #[serde(flatten)]
    evaluation: Option<Evaluation>,
    /// Of what is fused with wheels, likewise.
    #[serde(flatten)]
    corrections: Option<Corrections>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stages: Option<BTreeMap<&'static str, StageTime>>,
}

/// Indented, with a line feed at the end.
pub(super) fn to_json(judged: &Judged) -> io::Result<String> {
    let log = judged.log;
    let facts = log.facts.as_ref();
    let cost = facts.map(|facts| facts.cpu_ms_per_frame);
    let estimators = log.tracks.iter().zip(&judged.evaluations);
    let corrections: BTreeMap<_, _> = log.corrections().into_iter().collect();
    let corrections = |track: &Track| corrections.get(track.name.as_str()).copied();
    let summary = Summary {
        schema: SCHEMA,
        scenario: &log.recording,
        seed: facts.map(|facts| facts.seed),
        quality: facts.map(|facts| facts.quality),
        digest: &log.digest,
        adapter: facts.and_then(|facts| facts.adapter.as_deref()),
        driver: facts.and_then(|facts| facts.driver.as_deref()),
        duration_s: judged.duration_of_run(),
        path_m: judged.path(),
        frames: judged.camera_frames(),
        lost_frames: lost_frames(judged.track),
        wall_s: log.wall,
        cpu_s: log.cpu,
        real_time_factor: judged.real_time_factor(),
        cpu_ms_per_frame: CpuPerFrame {
            render: cost.map(|cost| cost.render),
            depth: cost.map(|cost| cost.depth),
            physics: cost.map(|cost| cost.physics),
            estimator: judged.timing().map(|timing| timing.mean_ms),
        },
        judged: &judged.track.name,
        estimators: estimators
            .map(|(track, evaluation)| (track.name.as_str(), estimator(track, *evaluation, corrections(track))))
            .collect(),
        sensor: SensorSummary { depth_valid_share: log.depth_valid_share(), energies: log.energies },
        modes: log.mode_score(),
        warnings: &log.warnings,
        expectations: &log.expectations,
    };
    Ok(serde_json::to_string_pretty(&summary)? + "\n")
}

fn estimator(track: &Track, evaluation: Option<Evaluation>, corrections: Option<Corrections>) -> EstimatorSummary {
    EstimatorSummary {
        frames: track.frames.len(),
        tracked_frames: tracked_frames(track),
        lost_frames: lost_frames(track),
        evaluation,
        corrections,
        stages: Timing::of(track).map(|timing| STAGES.into_iter().zip(timing.stages).collect()),
    }
}
