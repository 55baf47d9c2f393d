//! `report.html`: everything made ready for the template, which only arranges it.

use std::io;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{Environment, UndefinedBehavior};
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::animation::{Animation, animation};
use super::expectations::{Expectations, expectations};
use super::figures::{self, Figure, track_class};
use super::format::{angle, duration, length, milliseconds, percent};
use super::headline::headline;
use super::imagery::Tones;
use super::judged::{Judged, tracked_frames};
use super::metrics::{Metric, metrics};
use super::pictures::{Pictures, pictures};
use super::timing::{STAGES, StageTime, Timing};
use crate::runner::log::SimulationCost;

/// The only code that the page may run.
const SCRIPT: &str = include_str!("page.js");

#[derive(Serialize)]
struct Page<'a> {
    style: &'static str,
    script: &'static str,
    script_hash: String,
    recording: &'a str,
    headline: String,
    warnings: &'a [String],
    expectations: Option<Expectations<'a>>,
    facts: Vec<Fact>,
    animation: Option<Animation>,
    tracks: Vec<TrackName<'a>>,
    path: Vec<Figure>,
    metrics: Vec<Metric>,
    error: Vec<Figure>,
    modes: Vec<Figure>,
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
    let tones = Tones::of(log);
    let page = Page {
        style: include_str!("page.css"),
        script: SCRIPT,
        script_hash: STANDARD.encode(Sha256::digest(SCRIPT)),
        recording: &log.recording,
        headline: headline(judged),
        warnings: &log.warnings,
        expectations: expectations(&log.expectations),
        facts: facts(judged),
        animation: animation(judged, &tones)?,
        tracks: (log.tracks.iter().enumerate())
            .map(|(index, track)| TrackName { class: track_class(index), name: &track.name, label: &track.label })
            .collect(),
        path: figures::path(judged),
        metrics: metrics(judged),
        error: figures::errors(judged),
        modes: figures::modes(judged),
        seen: figures::counts(judged),
        pictures: pictures(judged, &tones)?,
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
    let time = if log.facts.is_some() { "Simulated time" } else { "Recorded time" };
    let mut rows = vec![(time, duration(judged.duration_of_run()))];
    if let Some(facts) = &log.facts {
        rows.push(("Way driven", length(facts.path)));
        rows.push(("Seed", facts.seed.to_string()));
        rows.push(("Quality", facts.quality.name().into()));
    }
    rows.extend([("Wall time", duration(log.wall)), ("CPU time", duration(log.cpu))]);
    let factor = judged.real_time_factor();
    if factor.is_finite() {
        rows.push(("Real-time factor", format!("{factor:.2} × (above 1: faster than it happened)")));
    }
    if let Some(facts) = &log.facts {
        let SimulationCost { render, depth, physics } = facts.cpu_ms_per_frame;
        let [render, depth, physics] = [render, depth, physics].map(milliseconds);
        rows.push(("CPU a frame", format!("images {render}, depth {depth}, physics {physics}")));
        rows.extend(facts.adapter.clone().map(|adapter| ("Graphics adapter", adapter)));
        rows.extend(facts.driver.clone().map(|driver| ("Driver", driver)));
    }
    rows.push(("Sunblind", env!("CARGO_PKG_VERSION").into()));
    rows.push(("Digest", log.digest.clone()));
    rows
}

fn files(judged: &Judged) -> Vec<String> {
    let truth = (!judged.log.truth.is_empty()).then(|| "truth.tum".into());
    let tracks = judged.log.tracks.iter().map(|track| format!("{}.tum", track.name));
    let modes = (!judged.log.modes.is_empty()).then(|| "modes.csv".into());
    ["summary.json".into(), "timeline.csv".into()].into_iter().chain(modes).chain(truth).chain(tracks).collect()
}
