//! `sunblind check`: whether scenarios can be run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;

use super::scenario_args::ScenarioArgs;
use super::{Failure, answer};
use crate::scenario::light::lamp_groups;
use crate::scenario::meaning::Obstacles;
use crate::scenario::{AnyScenario, ScenarioError, World};

const HELP: &str = "\
Examples:
  sunblind check scenarios/*.toml
  sunblind check scenarios/lab_loop.toml --set path.speed_m_per_s=0.6
      would the scenario still be valid?

Prints a line for each scenario: what it is, or the first thing wrong with it, as file:line:column, and what to write
instead: also where the path leads into something. Nothing is simulated. Exit code 2 when a scenario can't be run.";

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
        let mut worlds = BTreeMap::new();
        let mut invalid = 0;
        for file in &self.scenarios {
            match self.check(file, &mut worlds) {
                Ok(scenario) => answer(&format!("{}: ok, {}", file.display(), in_words(&scenario))),
                Err(error) => {
                    invalid += 1;
                    answer(&error.to_string());
                }
            }
        }
        if invalid == 0 { Ok(()) } else { Err(Failure::Invalid { invalid, all: self.scenarios.len() }) }
    }

    /// `worlds`: those that are built already.
    fn check(
        &self,
        file: &Path,
        worlds: &mut BTreeMap<World, (Obstacles, Vec<String>)>,
    ) -> Result<AnyScenario, ScenarioError> {
        let (source, scenario) = self.changes.load(file)?;
        if let AnyScenario::Robot(scenario) = &scenario {
            let world = &scenario.world;
            if !worlds.contains_key(world) {
                let built = world.build().map_err(|fault| source.blame(fault))?;
                worlds.insert(world.clone(), (Obstacles::of(&built), lamp_groups(&built)));
            }
            let (obstacles, groups) = &worlds[world];
            scenario.light.check_groups(groups).map_err(|fault| source.blame(fault))?;
            scenario.check_way(|from, to| obstacles.leave_free(from, to)).map_err(|fault| source.blame(fault))?;
        }
        Ok(scenario)
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
