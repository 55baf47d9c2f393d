//! `sunblind record`: a scenario's sensor streams and truth as a recording.

use std::path::PathBuf;

use clap::Args;

use super::scenario_args::ScenarioArgs;
use super::{Failure, answer, stage};
use crate::record::writer::RecordingWriter;
use crate::runner::{Run, expected_frames};
use crate::scenario::{AnyScenario, Scenario, Source};
use crate::textured_room;

const HELP: &str = "\
Example:
  sunblind record scenarios/lab_loop.toml --short --out out/lab
      then: sunblind replay out/lab

The folder holds a recording in the TUM RGB-D layout: rgb/, ir/ and depth/ with their lists (rgb.txt, ...), odometry.txt,
groundtruth.txt (seconds, metres, unit quaternion) and calibration.toml, which says what a value of depth means. Times are
exact to the nanosecond. It appears whole at the end or not at all; an earlier recording there is replaced.

The robot drives as in `sunblind run`, on its own estimate: a replay with the same parameters says the same, to the bit.";

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
        let frames = match scenario {
            AnyScenario::Robot(scenario) => self.drive(&source, &scenario)?,
            AnyScenario::TexturedRoom(scenario) => self.carry(&scenario)?,
        };
        answer(&format!("{}: {frames} frames with their truth", self.out.display()));
        Ok(())
    }

    /// A robot drives as in `sunblind run`.
    fn drive(&self, source: &Source, scenario: &Scenario) -> Result<usize, Failure> {
        let world = stage::world(source, scenario)?;
        let mut simulator = stage::simulator(source, scenario, &world)?;
        let calibration = simulator.calibration().clone();
        let writer = RecordingWriter::create(&self.out, &calibration)?;
        let localizers = stage::localizers(scenario, calibration.rig)?;
        let progress = stage::progress_bar("recording", expected_frames(scenario));
        let run = Run {
            name: "",
            scenario,
            world: &world,
            simulator: &mut simulator,
            localizers,
            recording: Some(&writer),
            on_frame: &|| progress.inc(1),
        };
        let outcome = run.drive();
        progress.finish_and_clear();
        outcome.map_err(|error| stage::blame(source, error))?;
        writer.finish()?;
        Ok(progress.position() as usize)
    }

    /// The textured room's camera is carried through it.
    fn carry(&self, scenario: &textured_room::Scenario) -> Result<usize, Failure> {
        let progress = stage::progress_bar("recording", scenario.frames());
        textured_room::record(scenario, &self.out, |done, _| progress.set_position(done as u64))?;
        progress.finish_and_clear();
        Ok(scenario.frames())
    }
}
