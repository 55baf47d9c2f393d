//! `sunblind check`: whether scenarios can be run.

use std::path::PathBuf;

use clap::Args;

use super::scenario_args::ScenarioArgs;
use super::{Failure, answer};
use crate::scenario::AnyScenario;

const HELP: &str = "\
Examples:
  sunblind check scenarios/*.toml
  sunblind check scenarios/lab_loop.toml --set path.speed_m_per_s=0.6
      would the scenario still be valid?

Prints a line for each scenario: what it is, or the first thing wrong with it, as file:line:column, and what to write
instead. Nothing is simulated. Exit code 2 when a scenario can't be run.";

/// Check scenarios without running them.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Check {
    /// The scenarios' files
    #[arg(required = true, value_name = "SCENARIO")]
    scenarios: Vec<PathBuf>,
    #[command(flatten)]
    changes: ScenarioArgs,
}

impl Check {
    pub fn run(&self) -> Result<(), Failure> {
        let mut invalid = 0;
        for file in &self.scenarios {
            match self.changes.load(file) {
                Ok((_, scenario)) => answer(&format!("{}: ok, {}", file.display(), in_words(&scenario))),
                Err(error) => {
                    invalid += 1;
                    answer(&error.to_string());
                }
            }
        }
        if invalid == 0 { Ok(()) } else { Err(Failure::Invalid { invalid, all: self.scenarios.len() }) }
    }
}

fn in_words(scenario: &AnyScenario) -> String {
    match scenario {
        AnyScenario::Robot(scenario) => {
            let path = scenario.path.shape().expect("a checked scenario has a path");
            let (metres, seconds, expectations) = (path.length(), scenario.duration, scenario.expect.len());
            let plural = if expectations == 1 { "" } else { "s" };
            format!("{metres:.1} m in at most {seconds} s, {expectations} expectation{plural}")
        }
        AnyScenario::TexturedRoom(scenario) => format!("{} frames of the textured room", scenario.frames()),
    }
}
