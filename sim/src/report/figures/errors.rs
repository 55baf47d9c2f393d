//! Errors against the truth over time, beside what the estimator believes of them.

use nalgebra::{Isometry3, Matrix3};

use super::{Figure, Key, lost_spans, seconds, time_range, track_class};
use crate::evaluation::{position_error, rotation_error, true_pose_at};
use crate::report::chart::Chart;
use crate::report::format::percent;
use crate::report::judged::Judged;
use crate::report::uncertainty::{bound_95, position_covariance, rotation_covariance};
use crate::runner::log::FrameLog;

/// One kind of error.
struct Kind {
    title: &'static str,
    error: fn(&Isometry3<f64>, &Isometry3<f64>) -> f64,
    covariance: fn(&FrameLog) -> Matrix3<f64>,
    /// From the greatest error to the axis's unit and how many of them make a metre or a radian.
    unit: fn(f64) -> (&'static str, f64),
}

const KINDS: [Kind; 2] = [
    Kind {
        title: "Position",
        error: position_error,
        covariance: position_covariance,
        unit: |greatest| match greatest {
            greatest if greatest < 0.01 => ("mm", 1e3),
            greatest if greatest < 1.0 => ("cm", 1e2),
            _ => ("m", 1.0),
        },
    },
    Kind {
        title: "Rotation",
        error: rotation_error,
        covariance: rotation_covariance,
        unit: |_| ("degrees", 180.0 / std::f64::consts::PI),
    },
];

pub(in crate::report) fn figures(judged: &Judged) -> Vec<Figure> {
    KINDS.iter().filter_map(|kind| figure(judged, kind)).collect()
}

/// `None` when no frame has truth.
fn figure(judged: &Judged, kind: &Kind) -> Option<Figure> {
    let tracks: Vec<Vec<(f64, f64)>> =
        judged.log.tracks.iter().map(|track| errors(judged, kind, &track.frames)).collect();
    let bounds: Vec<(f64, f64)> = judged
        .track
        .frames
        .iter()
        .map(|frame| (seconds(judged, frame.time), bound_95(&(kind.covariance)(frame))))
        .collect();
    let greatest_error = greatest(tracks.iter().flatten())?;
    let greatest_bound = greatest(&bounds).unwrap_or(0.0);
    let known_bounds = greatest_bound > 0.0;
    // A band far above all errors would press them flat.
    let top = greatest_error.max(greatest_bound.min(2.5 * greatest_error)).max(1e-9);
    let (unit, factor) = (kind.unit)(top);
    let in_unit = |points: &[(f64, f64)]| points.iter().map(|&(t, value)| (t, factor * value)).collect::<Vec<_>>();

    let mut chart = Chart::new(time_range(judged), 0.0..1.08 * factor * top);
    let mut legend = Vec::new();
    let lost = lost_spans(judged, judged.track);
    chart.spans("lost", &lost);
    if known_bounds {
        chart.band("t0", &in_unit(&bounds));
    }
    for (index, points) in tracks.iter().enumerate().rev() {
        chart.line(&track_class(index), &in_unit(points));
    }
    for (index, track) in judged.log.tracks.iter().enumerate() {
        legend.push(Key::new(format!("line {}", track_class(index)), track.label.as_str()));
    }
    if known_bounds {
        legend.push(Key::new("band t0", "95 % by its own covariance"));
    }
    if !lost.is_empty() {
        legend.push(Key::new("span lost", "lost"));
    }
    let note = if known_bounds { honesty(&tracks[0], &bounds) } else { "The estimator gave no covariance.".into() };
    let description = format!("{} error over time", kind.title);
    Some(Figure { title: kind.title.into(), legend, svg: chart.into_svg("time, s", unit, &description), note })
}

/// (seconds, error) of each frame; NaN where there is no truth.
fn errors(judged: &Judged, kind: &Kind, frames: &[FrameLog]) -> Vec<(f64, f64)> {
    let error = |frame: &FrameLog| {
        let truth = true_pose_at(&judged.log.truth, frame.time);
        truth.map_or(f64::NAN, |truth| (kind.error)(&frame.world_from_body, &truth))
    };
    frames.iter().map(|frame| (seconds(judged, frame.time), error(frame))).collect()
}

/// Of the finite values.
fn greatest<'a>(points: impl IntoIterator<Item = &'a (f64, f64)>) -> Option<f64> {
    points.into_iter().map(|point| point.1).filter(|value| value.is_finite()).max_by(f64::total_cmp)
}

/// How often the errors kept within their bounds, in words; frames without a bound (the first) don't count.
fn honesty(errors: &[(f64, f64)], bounds: &[(f64, f64)]) -> String {
    let judged: Vec<bool> = errors
        .iter()
        .zip(bounds)
        .filter(|(error, bound)| error.1.is_finite() && bound.1 > 0.0)
        .map(|(error, bound)| error.1 <= bound.1)
        .collect();
    if judged.is_empty() {
        return String::new();
    }
    let within = judged.iter().filter(|&&within| within).count();
    let share = 100.0 * within as f64 / judged.len() as f64;
    format!("Within the shaded bound in {} of the frames; an honest covariance has it at about 95 %.", percent(share))
}
