//! The options that every command with a scenario has.

use std::path::Path;

use clap::Args;

use crate::scenario::{AnyScenario, Override, ScenarioError, Source};

#[derive(Args)]
pub(super) struct ScenarioArgs {
    /// Change a value of the scenario, by its dotted key; may be repeated, the last one counts
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
    /// Another seed than the scenario's
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// The scenario's short form
    #[arg(long)]
    short: bool,
}

impl ScenarioArgs {
    /// The scenario with its changes, and where its keys stand.
    pub fn load(&self, file: &Path) -> Result<(Source, AnyScenario), ScenarioError> {
        let overrides: Vec<_> = self.overrides.iter().cloned().chain(self.seed.map(Override::seed)).collect();
        let source = Source::read(file, &overrides)?;
        let scenario = source.scenario()?;
        Ok((source, if self.short { scenario.shortened() } else { scenario }))
    }
}
