//! What the visual odometry found in the images, over time.

use super::{Figure, Key, lost_spans, seconds, time_range, track_class};
use crate::report::chart::Chart;
use crate::report::judged::Judged;
use crate::runner::log::{FrameCounts, Track};

pub(in crate::report) fn figures(judged: &Judged) -> Vec<Figure> {
    let several = judged.log.tracks.len() > 1;
    let tracks = judged.log.tracks.iter().enumerate();
    let mut figures: Vec<_> = tracks.filter_map(|(index, track)| features(judged, index, track, several)).collect();
    figures.extend(depth(judged));
    figures
}

/// Features, matches and inliers of one track; `None` when it counts nothing.
fn features(judged: &Judged, index: usize, track: &Track, several: bool) -> Option<Figure> {
    let most = counted(judged, track).map(|(_, counts)| counts.features.max(counts.matches)).max()?;
    let series = |count: fn(&FrameCounts) -> usize| -> Vec<(f64, f64)> {
        counted(judged, track).map(|(time, counts)| (time, count(counts) as f64)).collect()
    };
    let keyframes: Vec<f64> =
        counted(judged, track).filter(|(_, counts)| counts.keyframe).map(|(time, _)| time).collect();
    let lost = lost_spans(judged, track);
    let class = track_class(index);

    let mut chart = Chart::new(time_range(judged), 0.0..1.08 * most.max(1) as f64);
    chart.spans("lost", &lost);
    chart.line("quiet", &series(|counts| counts.features));
    chart.line(&format!("{class} thin"), &series(|counts| counts.matches));
    chart.band(&class, &series(|counts| counts.inliers));
    chart.line(&class, &series(|counts| counts.inliers));
    chart.marks("keyframe", &keyframes);

    let mut legend = vec![
        Key::new("line quiet", "features"),
        Key::new(format!("line thin {class}"), "matches"),
        Key::new(format!("line {class}"), "inliers"),
    ];
    if !keyframes.is_empty() {
        legend.push(Key::new("mark keyframe", format!("keyframe ({})", keyframes.len())));
    }
    if !lost.is_empty() {
        legend.push(Key::new("span lost", "lost"));
    }
    let title = if several { format!("Features: {}", track.label) } else { "Features".into() };
    let svg = chart.into_svg("time, s", "count", "Features, matches and inliers over time");
    Some(Figure { title, legend, svg, note: String::new() })
}

/// How much of the depth image holds a value: the sensor's doing, and so one figure for all tracks.
fn depth(judged: &Judged) -> Option<Figure> {
    let track = judged.log.tracks.iter().find(|track| counted(judged, track).next().is_some())?;
    let shares: Vec<_> =
        counted(judged, track).map(|(time, counts)| (time, 100.0 * counts.depth_valid_share)).collect();
    let mut chart = Chart::new(time_range(judged), 0.0..100.0);
    chart.band("depth", &shares);
    chart.line("depth", &shares);
    Some(Figure {
        title: "Depth".into(),
        legend: vec![Key::new("line depth", "pixels with a value")],
        svg: chart.into_svg("time, s", "%", "Share of depth pixels with a value over time"),
        note: String::new(),
    })
}

/// (seconds, counts) of the frames that have counts.
fn counted<'a>(judged: &Judged, track: &'a Track) -> impl Iterator<Item = (f64, &'a FrameCounts)> {
    track.frames.iter().filter_map(|frame| Some((seconds(judged, frame.time), frame.counts.as_ref()?)))
}
