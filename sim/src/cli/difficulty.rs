//! `sunblind difficulty`: how hard recordings are for visual odometry.

use std::path::PathBuf;

use clap::Args;
use comfy_table::{CellAlignment, Table, presets};
use sunblind_estimator::EstimatorParams;
use sunblind_estimator::params::Variant;

use super::{Failure, answer, overrides, replay::progress_bar};
use crate::evaluation::{Step, frame_steps};
use crate::record::Recording;
use crate::runner::log::{FrameCounts, RunLog};
use crate::runner::{Driven, ReplayOptions, replay};
use crate::scenario::Override;

const HELP: &str = "\
Examples:
  sunblind difficulty recordings/kitchen
  sunblind difficulty recordings/kitchen out/lab_loop
      how a simulated recording compares with a real one

Each frame is held against the one before it (variant = \"paper\"), with the estimator that `sunblind replay` runs. The table
shows medians over the frames: the motion from frame to frame and what it is estimated wrong by, both by the truth (which
the estimator never sees) and a dash without it; SURF keypoints, matches, matches that agree on one motion (inliers); and
the depth pixels without a value. RMSE is over all frames: what the median leaves out. From the second recording on there
is a column with its ratio to the first.";

/// Compare how hard recordings are: keypoints, matches, missing depth, errors from frame to frame.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Difficulty {
    /// The recordings' folders (TUM RGB-D layout)
    #[arg(required = true, value_name = "RECORDING")]
    recordings: Vec<PathBuf>,
    /// Change a parameter of the estimator; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
}

impl Difficulty {
    pub fn run(&self) -> Result<(), Failure> {
        let params = EstimatorParams { variant: Variant::Paper, ..overrides::params(&self.overrides)? };
        let mut measured = Vec::new();
        for folder in &self.recordings {
            let recording = Recording::open(folder, None)?;
            // Wheels have no part in it.
            let rig = sunblind_estimator::Rig { drive: None, ..recording.rig.clone() };
            let driven = Driven::product("mvo", "frame to frame", params.clone(), rig)?;
            let progress = progress_bar(recording.frames.len());
            let options = ReplayOptions { on_frame: &|| progress.inc(1), ..ReplayOptions::default() };
            let log = replay(&recording, vec![driven], &options);
            progress.finish_and_clear();
            measured.push((recording.name, values(&log?)));
        }
        answer(&table(&measured));
        Ok(())
    }
}

/// What is measured, and the digits after the point that it is shown with.
const MEASURES: [(&str, usize); 11] = [
    ("frames", 0),
    ("motion, mm", 1),
    ("motion, °", 2),
    ("keypoints", 0),
    ("matches", 0),
    ("inliers", 0),
    ("depth pixels without value, %", 1),
    ("motion error, mm", 2),
    ("motion error, °", 3),
    ("RMSE of motion, mm", 2),
    ("RMSE of motion, °", 3),
];

/// In the order of [`MEASURES`]; NaN for what could not be measured.
type Values = [f64; MEASURES.len()];

fn values(log: &RunLog) -> Values {
    let frames = &log.tracks[0].frames;
    // The first frame has none before it.
    let counts: Vec<FrameCounts> = frames.iter().skip(1).filter_map(|frame| frame.counts).collect();
    let count = |value: &dyn Fn(&FrameCounts) -> f64| median(counts.iter().map(value).collect());
    let steps = frame_steps(frames, &log.truth);
    let of = |value: &dyn Fn(&(Step, Step)) -> f64| steps.iter().map(value).collect::<Vec<f64>>();
    let wrong_by_mm = of(&|(_, error)| 1000.0 * error.translation);
    let wrong_by_deg = of(&|(_, error)| error.rotation.to_degrees());
    [
        frames.len() as f64,
        median(of(&|(motion, _)| 1000.0 * motion.translation)),
        median(of(&|(motion, _)| motion.rotation.to_degrees())),
        count(&|counts| counts.features as f64),
        count(&|counts| counts.matches as f64),
        count(&|counts| counts.inliers as f64),
        count(&|counts| 100.0 * (1.0 - counts.depth_valid_share)),
        median(wrong_by_mm.clone()),
        median(wrong_by_deg.clone()),
        root_mean_square(&wrong_by_mm),
        root_mean_square(&wrong_by_deg),
    ]
}

/// The lower of the two in the middle where there are two; NaN of nothing.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(f64::NAN)
}

/// NaN of nothing.
fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// A column a recording, then one for each ratio to the first.
fn table(measured: &[(String, Values)]) -> String {
    let Some(((first_name, first), others)) = measured.split_first() else { return String::new() };
    let mut table = Table::new();
    let names = measured.iter().map(|(name, _)| name.clone());
    let ratios = others.iter().map(|(name, _)| format!("{name} / {first_name}"));
    let header = std::iter::once("median of the frames".to_owned()).chain(names).chain(ratios);
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(header);
    for (index, (label, digits)) in MEASURES.into_iter().enumerate() {
        let values = measured.iter().map(|(_, values)| number(values[index], digits));
        let ratios = others.iter().map(|(_, values)| number(values[index] / first[index], 2));
        table.add_row(std::iter::once(label.to_owned()).chain(values).chain(ratios));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

/// A dash for what could not be measured.
fn number(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { "–".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_leaves_outliers_out() {
        assert_eq!(median(vec![3.0, 900.0, 1.0, 2.0, 4.0]), 3.0);
        assert!(median(vec![]).is_nan() && root_mean_square(&[]).is_nan());
        assert_eq!(root_mean_square(&[3.0, 4.0, 0.0, 0.0]), 2.5);
    }

    #[test]
    fn ratios_are_to_the_first_recording() {
        let mut real = [100.0; MEASURES.len()];
        real[7] = f64::NAN;
        let table = table(&[("real".into(), real), ("lab".into(), [50.0; MEASURES.len()])]);
        let line = |label: &str| table.lines().find(|line| line.contains(label)).unwrap().to_owned();
        assert!(line("keypoints").contains("0.50") && line("median of").contains("lab / real"));
        assert!(line("motion error, mm").contains('–') && !line("motion error, mm").contains("NaN"));
    }
}
