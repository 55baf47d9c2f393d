//! `sunblind record`: a scenario's sensor streams and truth as a recording.

use std::path::PathBuf;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::scenario_args::ScenarioArgs;
use super::{Failure, answer};
use crate::scenario::{AnyScenario, Fault};
use crate::textured_room;

const HELP: &str = "\
Example:
  sunblind record scenarios/textured_room.toml --out out/textured_room
      then: sunblind replay out/textured_room

The folder holds a recording in the TUM RGB-D layout: rgb/, depth/ (16-bit PNG, 5000 a metre), rgb.txt, depth.txt,
groundtruth.txt (seconds, metres, unit quaternion) and calibration.toml; times are exact to the nanosecond. It appears
whole at the end or not at all; an earlier recording there is replaced.";

/// Record what a simulated Kinect sees in a scenario, with the truth.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Record {
    /// The scenario's file
    scenario: PathBuf,
    /// Where the recording goes
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    changes: ScenarioArgs,
}

impl Record {
    pub fn run(&self) -> Result<(), Failure> {
        let (source, scenario) = self.changes.load(&self.scenario)?;
        let AnyScenario::TexturedRoom(scenario) = scenario else {
            let problem = "only the textured room can be recorded so far; write name = \"textured_room\"";
            return Err(source.blame(Fault::new("world.name", problem)).into());
        };
        let style = ProgressStyle::with_template("recording {wide_bar} {pos}/{len} frames, {eta} left");
        let bar = ProgressBar::new(scenario.frames() as u64).with_style(style.expect("the template is well formed"));
        textured_room::record(&scenario, &self.out, |done, _| bar.set_position(done as u64))?;
        bar.finish_and_clear();
        answer(&format!("{}: {} frames with their truth", self.out.display(), scenario.frames()));
        Ok(())
    }
}
