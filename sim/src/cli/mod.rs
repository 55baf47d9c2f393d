//! The command line: reads arguments, runs a command, and turns what came of it into an exit code.

pub mod bug;
mod check;
mod contact_sheet;
mod difficulty;
mod doctor;
mod output;
mod overrides;
mod paper;
mod record;
mod render;
mod replay;
mod run;
mod scenario_args;
mod schema;
mod stage;
mod table;
mod validate;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use sunblind_estimator::ParamError;
use thiserror::Error;

use crate::new_folder::FolderError;
use crate::physics::WorldError;
use crate::record::RecordError;
use crate::record::writer::WriteError;
use crate::render::RenderError;
use crate::runner::ReplayError;
use crate::scenario::ScenarioError;

/// An expectation does not hold.
const MISSED: u8 = 1;
/// What the user gave can't be worked with.
const BAD_INPUT: u8 = 2;
/// No graphics adapter, or one that stopped working.
const NO_ADAPTER: u8 = 3;

const ABOUT: &str = "\
A testbed for ground-robot localisation with a Kinect: makes recordings, replays them through the estimator that runs on \
the robot, and shows how far from the truth it is.

Exit codes:
  0   done, and every expectation held
  1   an expectation was missed
  2   bad usage, or a scenario or recording that can't be used; the message says where and what to do
  3   no graphics adapter that works; `sunblind doctor` says what to install
  70  a bug in sunblind; please report it";

#[derive(Parser)]
#[command(name = "sunblind", version, about = "A testbed for ground-robot localisation", long_about = ABOUT)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Check(check::Check),
    Difficulty(difficulty::Difficulty),
    Doctor(doctor::Doctor),
    Paper(paper::Paper),
    Record(record::Record),
    Render(render::Render),
    Replay(replay::Replay),
    Run(run::Run),
    Schema(schema::Schema),
    Validate(validate::Validate),
}

/// Why a command failed: something about what it was given, or nothing to render with.
#[derive(Debug, Error)]
enum Failure {
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    #[error("{invalid} of {all} scenarios can't be run")]
    Invalid { invalid: usize, all: usize },
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error(transparent)]
    Replay(#[from] ReplayError),
    #[error("two scenarios are called {name}, and their results would go to one folder; run them one by one")]
    SameName { name: String },
    #[error("{missed} expectation{} missed", if *missed == 1 { " was" } else { "s were" })]
    Missed { missed: usize },
    #[error(transparent)]
    World(#[from] WorldError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error("{0}; change it with --set or in the calibration")]
    Params(#[from] ParamError),
    #[error(transparent)]
    Override(#[from] overrides::OverrideError),
    #[error(transparent)]
    Output(#[from] FolderError),
    #[error("{}: can't be written: {source}", file.display())]
    Unwritable { file: std::path::PathBuf, source: io::Error },
    #[error("--at {at}: the path ends after {end:.2} s; give a smaller number of seconds")]
    BeyondPath { at: f64, end: f64 },
}

impl Failure {
    fn exit_code(&self) -> u8 {
        match self {
            Self::Missed { .. } => MISSED,
            Self::Render(_) => NO_ADAPTER,
            _ => BAD_INPUT,
        }
    }
}

/// Runs the command that the process was started with.
pub fn run() -> ExitCode {
    bug::exit_on_panic();
    let outcome = match Cli::parse().command {
        Command::Check(check) => check.run(),
        Command::Difficulty(difficulty) => difficulty.run(),
        Command::Doctor(doctor) => doctor.run(),
        Command::Paper(paper) => paper.run(),
        Command::Record(record) => record.run(),
        Command::Render(render) => render.run(),
        Command::Replay(replay) => replay.run(),
        Command::Run(run) => run.run(),
        Command::Schema(schema) => schema.run(),
        Command::Validate(validate) => validate.run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            tell(&format!("error: {failure}"));
            ExitCode::from(failure.exit_code())
        }
    }
}

/// A line for the user on standard error. A closed one is not worth failing for.
fn tell(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// A result on standard output, which may be closed early (`sunblind … | head`).
fn answer(text: &str) {
    let _ = writeln!(io::stdout(), "{text}");
}
