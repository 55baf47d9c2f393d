//! `report.html`: everything made ready for the template, which only arranges it.

use std::io;

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{Environment, UndefinedBehavior};
use serde::Serialize;

use super::figures::{self, Figure, track_class};
use super::format::{angle, duration, length, milliseconds, percent};
use super::headline::headline;
use super::judged::{Judged, tracked_frames};
use super::pictures::{Pictures, pictures};
use super::timing::{STAGES, StageTime, Timing};
use crate::evaluation::Evaluation;

#[derive(Serialize)]
struct Page<'a> {
    style: &'static str,
    recording: &'a str,
    headline: String,
    warnings: &'a [String],
    facts: Vec<Fact>,
    tracks: Vec<TrackName<'a>>,
    path: Vec<Figure>,
    metrics: Vec<Metric>,
    error: Vec<Figure>,
    seen: Vec<Figure>,
    pictures: Option<Pictures>,
    timings: Vec<TrackTiming<'a>>,
    frame_budget: Option<String>,
    parameters: Vec<(Vec<&'a str>, &'a str)>,
    provenance: Vec<(&'static str, String)>,
    files: Vec<String>,
}

/// A column of the table of tracks.
#[derive(Serialize)]
struct TrackName<'a> {
    class: String,
    name: &'a str,
    label: &'a str,
}

/// A number in large type.
#[derive(Serialize)]
struct Fact {
    value: String,
    name: &'static str,
}

/// A row of the table of tracks.
#[derive(Serialize)]
struct Metric {
    name: &'static str,
    meaning: &'static str,
    /// One a track.
    values: Vec<Value>,
}

#[derive(Serialize)]
struct Value {
    text: String,
    best: bool,
}

/// Where a track's time went.
#[derive(Serialize)]
struct TrackTiming<'a> {
    label: &'a str,
    stages: Vec<Stage>,
    total: Stage,
}

#[derive(Serialize)]
struct Stage {
    name: &'static str,
    class: String,
    median: String,
    p95: String,
    /// Width of its bar: its median as a share of the slowest track's, percent.
    width: String,
}

/// The page as UTF-8 text; every word that comes from outside is escaped by the template engine.
pub(super) fn to_html(judged: &Judged) -> io::Result<String> {
    let mut templates = Environment::new();
    let syntax = SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build().map_err(io::Error::other)?;
    templates.set_syntax(syntax);
    templates.set_undefined_behavior(UndefinedBehavior::Strict);
    // The name's ending is what turns escaping on.
    templates.add_template("page.html", include_str!("page.html")).map_err(io::Error::other)?;
    let log = judged.log;
    let page = Page {
        style: include_str!("page.css"),
        recording: &log.recording,
        headline: headline(judged),
        warnings: &log.warnings,
        facts: facts(judged),
        tracks: (log.tracks.iter().enumerate())
            .map(|(index, track)| TrackName { class: track_class(index), name: &track.name, label: &track.label })
            .collect(),
        path: figures::path(judged),
        metrics: metrics(judged),
        error: figures::errors(judged),
        seen: figures::counts(judged),
        pictures: pictures(judged)?,
        timings: timings(judged),
        frame_budget: judged.frame_interval().map(|interval| milliseconds(1e3 * interval)),
        parameters: parameters(judged),
        provenance: provenance(judged),
        files: files(judged),
    };
    templates.get_template("page.html").and_then(|template| template.render(Serde(page))).map_err(io::Error::other)
}

fn facts(judged: &Judged) -> Vec<Fact> {
    let mut facts = vec![Fact {
        value: format!("{} / {}", tracked_frames(judged.track), judged.track.frames.len()),
        name: "frames tracked",
    }];
    if let Some(evaluation) = judged.evaluation() {
        facts.push(Fact { value: length(evaluation.ate_m), name: "from the true path (ATE)" });
        facts.push(Fact { value: length(evaluation.rpe_m), name: "drift in a second (RPE)" });
        facts.push(Fact { value: angle(evaluation.rpe_deg), name: "turn drift in a second" });
        facts.push(Fact { value: percent(evaluation.drift_percent), name: "drift over the way" });
    }
    if let Some(timing) = judged.timing() {
        facts.push(Fact { value: milliseconds(timing.total.median_ms), name: "a frame (median)" });
    }
    facts
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

fn metrics(judged: &Judged) -> Vec<Metric> {
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
    if judged.log.tracks.iter().any(|track| Timing::of(track).is_some()) {
        let total = |track| Timing::of(track).map_or("–".into(), |timing| milliseconds(timing.total.median_ms));
        metrics.push(plain("Time a frame", "Median over the frames, all stages.", tracks().map(total).collect()));
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

fn timings<'a>(judged: &Judged<'a>) -> Vec<TrackTiming<'a>> {
    let timed: Vec<_> =
        judged.log.tracks.iter().filter_map(|track| Some((track.label.as_str(), Timing::of(track)?))).collect();
    let sum = |timing: &Timing| timing.stages.iter().map(|stage| stage.median_ms).sum::<f64>();
    let slowest = timed.iter().map(|(_, timing)| sum(timing)).fold(1e-9, f64::max);
    let stage = |name, class: String, time: StageTime| Stage {
        name,
        class,
        median: milliseconds(time.median_ms),
        p95: milliseconds(time.p95_ms),
        width: format!("{:.1}", 100.0 * time.median_ms / slowest),
    };
    timed
        .into_iter()
        .map(|(label, timing)| TrackTiming {
            label,
            stages: (0..STAGES.len())
                .map(|index| stage(STAGES[index], format!("stage{index}"), timing.stages[index]))
                .collect(),
            total: stage("all", String::new(), timing.total),
        })
        .collect()
}

/// Each set of parameters with the names of the tracks that one estimator made with it.
fn parameters<'a>(judged: &Judged<'a>) -> Vec<(Vec<&'a str>, &'a str)> {
    let groups = judged.log.tracks.chunk_by(|a, b| a.parameters == b.parameters);
    groups
        .map(|tracks| (tracks.iter().map(|track| track.name.as_str()).collect(), tracks[0].parameters.trim()))
        .collect()
}

fn provenance(judged: &Judged) -> Vec<(&'static str, String)> {
    let log = judged.log;
    let mut rows = vec![
        ("Recorded time", duration(judged.duration())),
        ("Wall time", duration(log.wall)),
        ("CPU time", duration(log.cpu)),
    ];
    let factor = judged.duration() / log.wall;
    if factor.is_finite() {
        rows.push(("Real-time factor", format!("{factor:.2} × (above 1: faster than it happened)")));
    }
    rows.push(("Sunblind", env!("CARGO_PKG_VERSION").into()));
    rows.push(("Digest", log.digest.clone()));
    rows
}

fn files(judged: &Judged) -> Vec<String> {
    let truth = (!judged.log.truth.is_empty()).then(|| "truth.tum".into());
    let tracks = judged.log.tracks.iter().map(|track| format!("{}.tum", track.name));
    ["summary.json".into(), "timeline.csv".into()].into_iter().chain(truth).chain(tracks).collect()
}
