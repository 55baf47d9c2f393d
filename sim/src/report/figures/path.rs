//! The path seen along two axes; from above on the floor plan, where there is one.

use std::ops::Range;

use nalgebra::Isometry3;

use super::{Figure, Key, track_class};
use crate::report::chart::Chart;
use crate::report::judged::Judged;

/// Least extent of a map, metres: of a path that hardly leaves its start one wants to see that.
const LEAST_EXTENT: f64 = 0.05;
/// How far beyond the paths a floor plan is shown, metres.
const AROUND: f64 = 4.0;

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

    let all = || tracks.iter().flatten().chain(&truth).copied();
    let (mut chart, mut legend) =
        if view.up == 1 { floor(judged, all()) } else { (Chart::with_equal_axes(extents(all())), Vec::new()) };
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

/// A map that shows `points`, with the floor plan and the planned path.
pub(in crate::report) fn floor(judged: &Judged, points: impl Iterator<Item = (f64, f64)> + Clone) -> (Chart, Vec<Key>) {
    let planned: Vec<_> = judged.log.planned_path.iter().map(|&[x, y]| (x, y)).collect();
    let mut ranges = extents(points.chain(planned.iter().copied()));
    if let Some(plan) = &judged.log.plan {
        let corners = plan.walls.iter().flatten().chain(plan.furniture.iter().flatten());
        let [x, y] = extents(corners.map(|&[x, y]| (x, y)));
        ranges = [around(&ranges[0], &x), around(&ranges[1], &y)];
    }
    let mut chart = Chart::with_equal_axes(ranges);
    let mut legend = Vec::new();
    if let Some(plan) = &judged.log.plan {
        chart.plan(plan);
    }
    if !planned.is_empty() {
        chart.line("planned", &planned);
        legend.push(Key::new("line planned", "planned"));
    }
    (chart, legend)
}

/// The range of what is shown, and as much of the plan as is near.
fn around(shown: &Range<f64>, plan: &Range<f64>) -> Range<f64> {
    let near = shown.start - AROUND..shown.end + AROUND;
    shown.start.min(plan.start.clamp(near.start, near.end))..shown.end.max(plan.end.clamp(near.start, near.end))
}

fn extents(points: impl Iterator<Item = (f64, f64)> + Clone) -> [Range<f64>; 2] {
    [extent(points.clone().map(|point| point.0)), extent(points.map(|point| point.1))]
}

/// From the least to the greatest finite value, with some air.
fn extent(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let (low, high) = if low > high { (0.0, 0.0) } else { (low, high) };
    let missing = 0.5 * (LEAST_EXTENT - (high - low)).max(0.0);
    let air = missing + 0.06 * (high - low);
    low - air..high + air
}
