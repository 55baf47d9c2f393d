//! `sunblind replay`: the estimator on a recording.

use std::fmt::Write;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use clap::Args;
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use sunblind_estimator::params::Variant;
use sunblind_estimator::{EstimatorParams, ParamError, Rig};

use super::overrides;
use super::{Failure, answer, output, table, tell};
use crate::record::Recording;
use crate::report;
use crate::runner::{Driven, ReplayOptions, replay};
use crate::scenario::Override;

const HELP: &str = "\
Examples:
  sunblind replay recordings/kitchen
      replays it and writes out/kitchen
  sunblind replay recordings/kitchen --out /tmp/trial --set variant=paper
      the odometry as in the paper, into another folder
  sunblind replay recordings/kitchen --calibration kinect2.toml
      with another calibration than the recording's own

DATASET is a folder in the TUM RGB-D layout:
  rgb.txt, depth.txt    `timestamp filename` a line; seconds; 8-bit colour, 16-bit grey depth, PNG or JPEG
  groundtruth.txt       optional; `timestamp tx ty tz qx qy qz qw` a line; seconds, metres, unit quaternion
  calibration.toml      optional; lengths in px and m; without it a Kinect's defaults are assumed, 2 px out of line; the
                        better yours is (`alignment_sigma_px`), the more the filters rely on what is seen
  odometry.txt          optional, with [drive] in calibration.toml; `timestamp left_ticks right_ticks` a line
  gyro.txt              optional; `timestamp wx wy wz` a line; rad/s in the robot's frame
  ir.txt                optional; `timestamp filename` a line; 16-bit grey with 10-bit values

The output folder holds report.html (for reading, one file), summary.json (for machines), truth.tum and one <track>.tum
for each estimate (for evo), timeline.csv, and modes.csv. It appears whole at the end or not at all; an earlier run's is
replaced.

The table shows, per track: ATE, the RMSE of the position after rigid alignment (m); RPE, the RMSE of the motion over
1 s (m and °); drift, translation error over length travelled (%); frames; lost, the frames that gave no motion; and the
estimator's time per frame (ms), without decoding the images.";

/// Run the estimator on a recording and hold it against the truth.
///
/// Two tracks are estimated: `mvo`, the product's visual odometry, and `mvo_paper`, the same as in the paper, to
/// compare with. Where the recording has wheels there are three more: `odometry`, the wheels alone, and `ekf` and
/// `svsf`, both together; the first one shown is the one that the robot would go by. Equal inputs give equal results, for
/// any number of threads.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Replay {
    /// The recording's folder (TUM RGB-D layout)
    dataset: PathBuf,
    /// Calibration to use instead of the recording's calibration.toml
    #[arg(long, value_name = "FILE")]
    calibration: Option<PathBuf>,
    /// Where the results go [default: out/<name of the recording>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads that work at a time [default: the number of cores]
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
    /// Change a parameter of the estimator; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
}

impl Replay {
    pub fn run(self) -> Result<(), Failure> {
        let params = overrides::params(&self.overrides)?;
        let recording = Recording::open(&self.dataset, self.calibration.as_deref())?;
        let localizers = localizers(params, &recording.rig)?;
        let out = self.out.unwrap_or_else(|| Path::new("out").join(&recording.name));
        output::check(&out)?;

        let progress = progress_bar(recording.frames.len());
        let mut options = ReplayOptions { on_frame: &|| progress.inc(1), ..ReplayOptions::default() };
        options.threads = self.threads.unwrap_or(options.threads);
        let outcome = replay(&recording, localizers, &options);
        progress.finish_and_clear();
        let log = outcome?;

        for warning in &log.warnings {
            tell(&format!("warning: {warning}"));
        }
        output::publish(&out, |folder| report::write(&log, folder).map(drop))?;
        answer(&format!(
            "{}: {} frames, poses of {}\n{}\nreport: {}",
            recording.name,
            recording.frames.len(),
            recording.body.in_words(),
            table::of(&log),
            out.join("report.html").display()
        ));
        Ok(())
    }
}

/// The product's estimator and, unless it is asked for anyway, the paper's visual odometry to compare with.
fn localizers(params: EstimatorParams, rig: &Rig) -> Result<Vec<Driven>, ParamError> {
    let mut paper = params.clone();
    paper.variant = Variant::Paper;
    let label = match params.variant {
        Variant::Keyframes => "visual odometry, keyframes",
        Variant::Paper => PAPER_LABEL,
    };
    // Only its visual odometry is of interest.
    let without_wheels = Rig { drive: None, ..rig.clone() };
    let compared = (paper != params).then(|| Driven::product("mvo_paper", PAPER_LABEL, paper, without_wheels));
    let mut localizers = vec![Driven::product("mvo", label, params, rig.clone())?];
    localizers.extend(compared.transpose()?);
    Ok(localizers)
}

const PAPER_LABEL: &str = "visual odometry, as in the paper";

/// Frames, frames a second and time left, on standard error; nothing where that is no terminal.
pub(super) fn progress_bar(frames: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} frames  {per_second}/s  {eta} left")
        .expect("the template is well formed")
        .with_key("per_second", |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.1}", state.per_sec());
        });
    ProgressBar::new(frames as u64).with_style(style)
}
