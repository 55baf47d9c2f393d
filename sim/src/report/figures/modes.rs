//! How the mode was chosen over time, and which would have been the best.

use std::ops::Range;

use sunblind_estimator::Mode;
use sunblind_estimator::mode::ModeReport;

use super::{Figure, Key, seconds, time_range};
use crate::modes::{Score, StampedReport};
use crate::report::chart::Chart;
use crate::report::format::{duration, percent};
use crate::report::judged::Judged;

/// The modes, with their classes in the style sheet and what they are called.
const MODES: [(Mode, &str, &str); 4] = [
    (Mode::Indoor, "indoor", "indoor: colour + depth"),
    (Mode::Outdoor, "outdoor", "outdoor: colour + infrared"),
    (Mode::Night, "night", "night: infrared + depth"),
    (Mode::Odometer, "wheels", "wheels alone"),
];

/// A y axis on which lines at 0 and at 1 are seen whole.
const AROUND_A_SHARE: Range<f64> = -0.04..1.04;

/// The inputs likewise, each with how High it is.
type Input = (&'static str, &'static str, fn(&ModeReport) -> f64);
const INPUTS: [Input; 3] = [
    ("rgb", "colour", |report| report.memberships.rgb.high),
    ("ir", "infrared", |report| report.memberships.infrared.high),
    ("depth", "depth", |report| report.memberships.depth.high),
];

pub(in crate::report) fn figures(judged: &Judged) -> Vec<Figure> {
    if judged.log.modes.is_empty() {
        return Vec::new();
    }
    vec![ribbons(judged), memberships(judged), degrees(judged)]
}

/// The mode chosen, and the best one where that is known.
fn ribbons(judged: &Judged) -> Figure {
    let log = judged.log;
    let chosen: Vec<_> = log.modes.iter().map(|said| (seconds(judged, said.time), said.report.mode)).collect();
    let best: Vec<_> =
        log.information.iter().map(|known| (seconds(judged, known.time), known.information.best_mode())).collect();
    let rows: &[&str] = if best.is_empty() { &["mode"] } else { &["mode", "best"] };
    let mut chart = Chart::with_rows(time_range(judged), rows);
    for (row, modes) in [chosen, best].iter().enumerate() {
        let mut since = None;
        for (index, &(time, mode)) in modes.iter().enumerate() {
            let next = modes.get(index + 1);
            let start = *since.get_or_insert(time);
            if next.is_none_or(|(_, next)| *next != mode) {
                chart.stretch(class_of(mode), row, [start, next.map_or(time, |(next, _)| *next)]);
                since = None;
            }
        }
    }
    let legend = MODES.map(|(_, class, label)| Key::new(format!("swatch {class}"), label)).into();
    let svg = chart.into_svg("time, s", "", "The mode over time, and the best one");
    Figure { title: "Mode".into(), legend, svg, note: log.mode_score().map_or_else(String::new, in_words) }
}

fn memberships(judged: &Judged) -> Figure {
    let mut chart = Chart::new(time_range(judged), AROUND_A_SHARE);
    for (class, _, high) in INPUTS {
        chart.line(class, &over_time(judged, |said| high(&said.report)));
    }
    let legend = INPUTS.map(|(class, label, _)| Key::new(format!("line {class}"), label)).into();
    let svg = chart.into_svg("time, s", "share in High", "Memberships of the energies in High over time");
    let note = "How far the energy of each image counts as High; the rest is Low.".into();
    Figure { title: "Energies".into(), legend, svg, note }
}

fn degrees(judged: &Judged) -> Figure {
    let mut chart = Chart::new(time_range(judged), AROUND_A_SHARE);
    for (mode, class, _) in MODES {
        chart.line(class, &over_time(judged, |said| said.report.inference.degrees.of(mode)));
    }
    let legend = MODES.map(|(_, class, label)| Key::new(format!("line {class}"), label)).into();
    let svg = chart.into_svg("time, s", "degree", "How much speaks for each mode over time");
    let note = "The strongest of the rules that lead to the mode; each of the eight rules is in modes.csv.".into();
    Figure { title: "What speaks for each mode".into(), legend, svg, note }
}

fn over_time(judged: &Judged, value: impl Fn(&StampedReport) -> f64) -> Vec<(f64, f64)> {
    judged.log.modes.iter().map(|said| (seconds(judged, said.time), value(said))).collect()
}

fn class_of(mode: Mode) -> &'static str {
    let [.., (_, wheels, _)] = MODES;
    MODES.into_iter().find(|(known, ..)| *known == mode).map_or(wheels, |(_, class, _)| class)
}

fn in_words(score: Score) -> String {
    let Score { accuracy_percent, latency_s, switches, true_changes, useless_s, .. } = score;
    let mut words = format!("{switches} switches for {true_changes} changes of the best mode");
    if latency_s.is_finite() {
        words += &format!(", the slowest {} late", duration(latency_s));
    }
    if accuracy_percent.is_finite() {
        words += &format!(
            "; {} of the time in the best mode, but for a second to each side of its changes",
            percent(accuracy_percent)
        );
    }
    words + &format!("; at most {} in a mode without one of its images.", duration(useless_s))
}
