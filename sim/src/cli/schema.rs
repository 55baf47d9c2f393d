//! `sunblind schema`: what a scenario file may hold, for editors.

use clap::Args;

use super::{Failure, answer};
use crate::scenario::schema::schema;

const HELP: &str = "\
Example:
  sunblind schema > scenario.schema.json
      then, as the first line of a scenario: #:schema ./scenario.schema.json";

/// Print the JSON Schema of scenario files.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Schema {}

impl Schema {
    pub fn run(&self) -> Result<(), Failure> {
        answer(&serde_json::to_string_pretty(&schema()).expect("a schema is plain JSON"));
        Ok(())
    }
}
