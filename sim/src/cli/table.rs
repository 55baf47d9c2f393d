//! A run as a table on the terminal, one row a track.

use comfy_table::{CellAlignment, Table, presets};
use sunblind_estimator::Health;

use crate::evaluation::evaluate;
use crate::runner::log::{RunLog, Track};
use crate::scenario::expect::Judged;

const HEADER: [&str; 8] = ["track", "ATE m", "RPE m", "RPE °", "drift %", "frames", "lost", "ms/frame"];

/// The table; what could not be measured is a dash.
pub(super) fn of(log: &RunLog) -> String {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(HEADER);
    for track in &log.tracks {
        table.add_row(row(track, log));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

/// What had to hold and did or did not.
pub(super) fn of_expectations(expectations: &[Judged]) -> String {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(["expected", "value", "bound", ""]);
    for Judged { name, value, bound, held } in expectations {
        let value = if value.is_finite() { format!("{value:.4}") } else { "–".to_owned() };
        table.add_row([name.clone(), value, bound.to_string(), if *held { "held" } else { "missed" }.to_owned()]);
    }
    if let Some(column) = table.column_mut(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

fn row(track: &Track, log: &RunLog) -> [String; HEADER.len()] {
    let score = evaluate(&track.frames, &log.truth);
    // A metric that the recording is too short for is NaN.
    let metric = |value: Option<f64>, digits: usize| match value.filter(|value| value.is_finite()) {
        Some(value) => format!("{value:.digits$}"),
        None => "–".to_owned(),
    };
    let lost = track.frames.iter().filter(|frame| matches!(frame.health, Health::Lost(_))).count();
    let spent_ms: f64 = track.frames.iter().flat_map(|frame| frame.stage_ms).sum();
    let timed = spent_ms > 0.0;
    [
        track.name.clone(),
        metric(score.as_ref().map(|score| score.ate_m), 4),
        metric(score.as_ref().map(|score| score.rpe_m), 4),
        metric(score.as_ref().map(|score| score.rpe_deg), 3),
        metric(score.as_ref().map(|score| score.drift_percent), 2),
        track.frames.len().to_string(),
        lost.to_string(),
        metric(timed.then(|| spent_ms / track.frames.len() as f64), 1),
    ]
}
