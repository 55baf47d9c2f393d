//! The path seen along two axes.

use nalgebra::Isometry3;

use super::{Figure, Key, track_class};
use crate::report::chart::Chart;
use crate::report::judged::Judged;

/// Least extent of a map, metres: of a path that hardly leaves its start one wants to see that.
const LEAST_EXTENT: f64 = 0.05;

/// A plane of the world, by the indices of its axes.
struct View {
    /// What it shows where z is up.
    title: &'static str,
    across: usize,
    up: usize,
}

const VIEWS: [View; 2] =
    [View { title: "From above", across: 0, up: 1 }, View { title: "From the side", across: 0, up: 2 }];
const AXES: [&str; 3] = ["x", "y", "z"];

pub(in crate::report) fn figures(judged: &Judged) -> Vec<Figure> {
    if judged.track.frames.is_empty() {
        return Vec::new();
    }
    VIEWS.iter().map(|view| figure(judged, view)).collect()
}

fn figure(judged: &Judged, view: &View) -> Figure {
    let log = judged.log;
    let seen = |pose: &Isometry3<f64>| (pose.translation.vector[view.across], pose.translation.vector[view.up]);
    let truth: Vec<_> = log.truth.iter().map(|pose| seen(&pose.world_from_body)).collect();
    let tracks: Vec<Vec<_>> = log
        .tracks
        .iter()
        .map(|track| track.frames.iter().map(|frame| seen(&frame.world_from_body)).collect())
        .collect();

    let all = || tracks.iter().flatten().chain(&truth);
    let mut chart = Chart::with_equal_axes(extent(all().map(|point| point.0)), extent(all().map(|point| point.1)));
    let mut legend = Vec::new();
    if !truth.is_empty() {
        chart.line("truth", &truth);
        legend.push(Key::new("line truth", "truth"));
    }
    // The judged track comes last, to lie on top.
    for (index, points) in tracks.iter().enumerate().rev() {
        chart.line(&track_class(index), points);
        if let Some(&end) = points.last() {
            chart.dot(&track_class(index), end, "");
        }
    }
    if let Some(&start) = tracks[0].first() {
        chart.dot("start", start, "start");
    }
    legend.extend(
        log.tracks
            .iter()
            .enumerate()
            .map(|(index, track)| Key::new(format!("line {}", track_class(index)), track.label.as_str())),
    );
    let (across, up) = (AXES[view.across], AXES[view.up]);
    // Without truth the axes are those of whatever body the poses are of: for a camera, z is forward.
    let title = if truth.is_empty() { format!("{up} over {across}") } else { view.title.into() };
    let note = match (truth.is_empty(), view.up) {
        (false, 1) => "The dot is the end. The world's axes are the truth's; z is taken for up.",
        (true, 1) => "The dot is the end. Without truth the axes are those of the start pose.",
        _ => "",
    };
    let svg = chart.into_svg(&format!("{across}, m"), &format!("{up}, m"), &format!("Path, {up} over {across}"));
    Figure { title, legend, svg, note: note.into() }
}

/// From the least to the greatest finite value, with some air.
fn extent(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let (low, high) = if low > high { (0.0, 0.0) } else { (low, high) };
    let missing = 0.5 * (LEAST_EXTENT - (high - low)).max(0.0);
    let air = missing + 0.06 * (high - low);
    low - air..high + air
}
