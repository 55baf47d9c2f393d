//! `sunblind difficulty`: how hard recordings are for visual odometry.

use std::path::PathBuf;

use clap::Args;
use comfy_table::{CellAlignment, Table, presets};
use sunblind_estimator::params::Variant;
use sunblind_estimator::{EstimatorParams, Timestamp};

use super::{Failure, answer, overrides, replay::progress_bar};
use crate::evaluation::{Step, frame_steps};
use crate::record::{FrameFiles, Recording};
use crate::runner::log::{FrameCounts, RunLog};
use crate::runner::{Driven, ReplayOptions, replay};
use crate::scenario::Override;

const HELP: &str = "\
Examples:
  sunblind difficulty recordings/kitchen
  sunblind difficulty recordings/kitchen out/lab_loop --max-rate-hz 15 --set paper.max_depth_m=8
      how a simulated recording compares with a real one of twice its frame rate, all of a Kinect's range counted

Each frame is held against the one before it (variant = \"paper\"), with the estimator that `sunblind replay` runs. Recordings
of different frame rates are compared with --max-rate-hz: from frame to frame, half as many a second differ twice as
much. Keypoints count only where there is depth up to paper.max_depth_m, 2.4 m unless it is set. The table shows medians over the frames: the motion from frame to frame and what it is estimated wrong by, both by the truth (which
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
    /// Leave frames out, so that no more than these are left of a second
    #[arg(long, value_name = "HZ", value_parser = rate, allow_negative_numbers = true)]
    max_rate_hz: Option<f64>,
    /// Change a parameter of the estimator; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
}

impl Difficulty {
    pub fn run(&self) -> Result<(), Failure> {
        let params = EstimatorParams { variant: Variant::Paper, ..overrides::params(&self.overrides)? };
        let mut measured = Vec::new();
        for folder in &self.recordings {
            let mut recording = Recording::open(folder, None)?;
            if let Some(rate) = self.max_rate_hz {
                recording.frames = no_faster_than(rate, recording.frames);
            }
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

fn rate(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|rate: &f64| rate.is_finite() && *rate > 0.0);
    value.ok_or_else(|| "write a number of frames a second, more than 0".to_owned())
}

/// Every frame that comes no sooner after the last one taken than `rate` (Hz) allows, within a tenth.
fn no_faster_than(rate: f64, frames: Vec<FrameFiles>) -> Vec<FrameFiles> {
    let mut last: Option<Timestamp> = None;
    let mut taken = |frame: &FrameFiles| {
        let due = last.is_none_or(|last| frame.rgb.time.since(last) * rate > 0.9);
        if due {
            last = Some(frame.rgb.time);
        }
        due
    };
    frames.into_iter().filter(|frame| taken(frame)).collect()
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
    use crate::record::ImageFile;

    #[test]
    fn the_median_leaves_outliers_out() {
        assert_eq!(median(vec![3.0, 900.0, 1.0, 2.0, 4.0]), 3.0);
        assert!(median(vec![]).is_nan() && root_mean_square(&[]).is_nan());
        assert_eq!(root_mean_square(&[3.0, 4.0, 0.0, 0.0]), 2.5);
    }

    #[test]
    fn half_of_thirty_frames_a_second_are_fifteen() {
        let image = |ns| ImageFile { time: Timestamp::from_nanos(ns), path: "image.png".into() };
        let at_30_hz = |index: i64| {
            let ns = 33_333_333 * index;
            FrameFiles { rgb: image(ns), depth: image(ns) }
        };
        let frames: Vec<FrameFiles> = (0..30).map(at_30_hz).collect();
        let left = |rate| no_faster_than(rate, frames.clone());
        assert!(left(15.0) == frames.iter().step_by(2).cloned().collect::<Vec<_>>());
        assert!(left(30.0) == frames && left(1000.0) == frames);
        assert_eq!(left(20.0).len(), 15, "every frame is too soon, every other one is not");
        assert!(rate("0").is_err() && rate("-15").is_err() && rate("fast").is_err() && rate("15") == Ok(15.0));
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
