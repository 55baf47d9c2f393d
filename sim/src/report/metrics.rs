//! The table of tracks: what each was worth.

use serde::Serialize;

use super::format::{angle, length, milliseconds, percent, plain_number};
use super::judged::{Judged, tracked_frames};
use super::timing::Timing;
use crate::evaluation::Evaluation;
use crate::runner::log::Track;

/// A row of the table of tracks.
#[derive(Serialize)]
pub(super) struct Metric {
    pub name: &'static str,
    pub meaning: &'static str,
    /// One a track.
    pub values: Vec<Value>,
}

#[derive(Serialize)]
pub(super) struct Value {
    pub text: String,
    pub best: bool,
}

/// The table's rows: (name, meaning, value, how to write it).
type Row = (&'static str, &'static str, fn(&Evaluation) -> f64, fn(f64) -> String);

const ROWS: [Row; 10] = [
    (
        "Path error (ATE)",
        "RMSE of the position once the whole path is laid on the true one as well as a rigid motion can.",
        |e| e.ate_m,
        length,
    ),
    (
        "Drift in a second (RPE)",
        "RMSE of the motion's translation error, over all pairs of frames 1 s apart.",
        |e| e.rpe_m,
        length,
    ),
    ("Turn drift in a second", "The same of the rotation angle.", |e| e.rpe_deg, angle),
    (
        "Drift from frame to frame",
        "RMSE of the translation error between neighbouring frames.",
        |e| e.rpe_frame_m,
        length,
    ),
    ("Turn drift from frame to frame", "The same of the rotation angle.", |e| e.rpe_frame_deg, angle),
    (
        "Drift over the way",
        "Mean translation error / length over sub-paths of 5 to 100 m, or over a shorter path as a whole.",
        |e| e.drift_percent,
        percent,
    ),
    ("Off at the end", "Distance from the truth at the last frame, from a common start.", |e| e.end_error_m, length),
    ("RMSE x", "Along the world's x, from a common start, not aligned.", |e| e.rmse_x_m, length),
    ("RMSE y", "Along the world's y, likewise.", |e| e.rmse_y_m, length),
    ("RMSE θ", "Angle of the whole rotation error, likewise.", |e| e.rmse_theta_deg, angle),
];

pub(super) fn metrics(judged: &Judged) -> Vec<Metric> {
    let tracks = || judged.log.tracks.iter();
    let plain = |name, meaning, texts: Vec<String>| Metric {
        name,
        meaning,
        values: texts.into_iter().map(|text| Value { text, best: false }).collect(),
    };
    let mut metrics = vec![plain(
        "Frames tracked",
        "A lost frame keeps the last good pose and counts like the others.",
        tracks().map(|track| format!("{} / {}", tracked_frames(track), track.frames.len())).collect(),
    )];
    if judged.evaluations.iter().any(Option::is_some) {
        metrics.extend(ROWS.iter().map(|row| evaluated(&judged.evaluations, row)));
    }
    // Neither of these is best where it is least.
    if judged.evaluations.iter().flatten().any(|evaluation| evaluation.anees.is_finite()) {
        let anees = |evaluation: &Option<Evaluation>| plain_number(evaluation.map_or(f64::NAN, |e| e.anees));
        metrics.push(plain(
            "Consistency (ANEES)",
            "Mean of the error squared by its covariance, in x, y and heading: 3 where the covariance is right, more where \
             it is too small.",
            judged.evaluations.iter().map(anees).collect(),
        ));
    }
    let corrections = judged.log.corrections();
    if !corrections.is_empty() {
        let leap = |track: &Track| {
            let of = corrections.iter().find(|(name, _)| *name == track.name);
            of.map_or("–".into(), |(_, c)| format!("{}, {}", length(c.max_correction_m), angle(c.max_correction_deg)))
        };
        metrics.push(plain(
            "Largest correction",
            "What the estimate moved by from one frame to the next that the wheels had not told.",
            tracks().map(leap).collect(),
        ));
    }
    if judged.log.tracks.iter().any(|track| Timing::of(track).is_some()) {
        let total = |track| Timing::of(track).map_or("–".into(), |timing| milliseconds(timing.total.median_ms));
        metrics.push(plain("Time a frame", "CPU, median over the frames, all stages.", tracks().map(total).collect()));
    }
    metrics
}

fn evaluated(evaluations: &[Option<Evaluation>], &(name, meaning, value, write): &Row) -> Metric {
    let values: Vec<f64> = evaluations.iter().map(|e| e.as_ref().map_or(f64::NAN, value)).collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let several = values.len() > 1;
    let values = values.iter().map(|&value| Value { text: write(value), best: several && value == least }).collect();
    Metric { name, meaning, values }
}
