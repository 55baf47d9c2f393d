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
    /// `fast`: images of 320 × 240, for smoke tests; in the scenario, kinect.quality
    #[arg(long, value_name = "HOW", value_parser = ["fast", "full"])]
    quality: Option<String>,
    /// The scenario's short form
    #[arg(long)]
    short: bool,
}

impl ScenarioArgs {
    /// The scenario with its changes, and where its keys stand.
    pub fn load(&self, file: &Path) -> Result<(Source, AnyScenario), ScenarioError> {
        let mut overrides = self.overrides.clone();
        overrides.extend(self.seed.map(Override::seed));
        overrides.extend(self.quality.as_deref().map(Override::quality));
        let source = Source::read(file, &overrides)?;
        let scenario = source.scenario()?;
        Ok((source, if self.short { scenario.shortened() } else { scenario }))
    }
}
