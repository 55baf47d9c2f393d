//! `sunblind record SCENARIO --out DIR`.

use std::path::PathBuf;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use thiserror::Error;

use crate::record::writer::WriteError;
use crate::scenario::{Scenario, ScenarioError, World};
use crate::textured_room;

/// Records what a simulated Kinect sees in a scenario, with the truth: TUM RGB-D layout.
#[derive(Args, Debug)]
pub struct RecordArgs {
    /// The scenario file, such as scenarios/textured_room.toml.
    scenario: PathBuf,
    /// The folder to write; a recording that is already there is replaced.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// An invalid scenario, or a folder that can't be written.
pub fn run(args: &RecordArgs) -> Result<(), RecordCommandError> {
    let scenario = Scenario::load(&args.scenario)?;
    let bar = ProgressBar::new(scenario.frames() as u64).with_style(
        ProgressStyle::with_template("recording {wide_bar} {pos}/{len} frames, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    let progress = |done: usize, _| bar.set_position(done as u64);
    match scenario.world {
        World::TexturedRoom => textured_room::record(&scenario, &args.out, progress)?,
    }
    bar.finish_and_clear();
    println!("{} frames in {}", scenario.frames(), args.out.display());
    Ok(())
}

/// Why nothing was recorded.
#[derive(Debug, Error)]
pub enum RecordCommandError {
    /// The scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The recording can't be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
