//! The report's figures: what there are no data for is left out.

mod counts;
mod errors;
mod modes;
mod path;

use serde::Serialize;
use sunblind_estimator::Timestamp;

pub(super) use self::counts::figures as counts;
pub(super) use self::errors::figures as errors;
pub(super) use self::modes::figures as modes;
pub(super) use self::path::{figures as path, floor};
use super::judged::{Judged, is_lost};
use crate::runner::log::Track;

/// A chart with what one must know to read it.
#[derive(Serialize)]
pub(super) struct Figure {
    pub title: String,
    pub legend: Vec<Key>,
    /// Holds nothing from outside, and goes into the page as it is.
    pub svg: String,
    /// A sentence below; may be empty.
    pub note: String,
}

/// An entry of a legend.
#[derive(Serialize)]
pub(super) struct Key {
    /// Its sample's classes in the style sheet.
    pub class: String,
    pub label: String,
}

impl Key {
    pub(super) fn new(class: impl Into<String>, label: impl Into<String>) -> Self {
        Self { class: class.into(), label: label.into() }
    }
}

/// The class that colours the track of this index.
pub(super) fn track_class(index: usize) -> String {
    format!("t{}", index % 6)
}

/// The recorded time from the first frame to the last, for the x axis: seconds, never of no length.
fn time_range(judged: &Judged) -> std::ops::Range<f64> {
    0.0..judged.duration().max(1e-3)
}

/// Seconds from the first frame.
pub(super) fn seconds(judged: &Judged, time: Timestamp) -> f64 {
    judged.start().map_or(0.0, |start| time.since(start))
}

/// The stretches in which a track was lost, half a frame to each side of the frames; seconds.
fn lost_spans(judged: &Judged, track: &Track) -> Vec<(f64, f64)> {
    let half = 0.5 * judged.frame_interval().unwrap_or(0.0);
    track
        .frames
        .chunk_by(|a, b| is_lost(a) == is_lost(b))
        .filter(|run| is_lost(&run[0]))
        .map(|run| (seconds(judged, run[0].time) - half, seconds(judged, run[run.len() - 1].time) + half))
        .collect()
}
