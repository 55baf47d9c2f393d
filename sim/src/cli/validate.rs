//! `sunblind validate`: the simulated Kinect against published figures.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use comfy_table::{CellAlignment, Table, presets};
use indicatif::{ProgressBar, ProgressStyle};

use super::{Failure, answer};
use crate::validation::{EXPERIMENTS, Effort, Experiment, Finding, ValidationError, table};

const HELP: &str = "\
Examples:
  sunblind validate
      some two minutes; ends with a table of every target
  sunblind validate --target V2 --target V11
      these alone
  sunblind validate --markdown VALIDATION.md
      the table as a page

Everything is measured through the device's own images, of small worlds under known light. A target is \"published\"
where it was measured on real devices or follows from their published build, \"model\" where it comes from photon counts,
as nobody has published how much depth a Kinect v1 has by illuminance. Exit code 1 when something is not held.";

/// Measure the simulated Kinect against what is published of the real one.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Validate {
    /// Only this target; may be repeated
    #[arg(long = "target", value_name = "V1…V17", value_parser = target)]
    targets: Vec<String>,
    /// Look at less: enough to see what broke
    #[arg(long)]
    quick: bool,
    /// Write the table to a file, as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

fn target(name: &str) -> Result<String, String> {
    let known = EXPERIMENTS.iter().find(|experiment| experiment.target.eq_ignore_ascii_case(name));
    known.map(|experiment| experiment.target.to_owned()).ok_or_else(|| "write V1 to V17".to_owned())
}

impl Validate {
    pub fn run(&self) -> Result<(), Failure> {
        let is_wanted = |experiment: &&Experiment| {
            self.targets.is_empty() || self.targets.iter().any(|target| target == experiment.target)
        };
        let wanted: Vec<_> = EXPERIMENTS.iter().filter(is_wanted).collect();
        let effort = if self.quick { Effort::Reduced } else { Effort::Full };
        let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg}").expect("the template is well formed");
        let progress = ProgressBar::new(wanted.len() as u64).with_style(style);
        let mut measured = Vec::new();
        for experiment in wanted {
            progress.set_message(format!("{}, {}", experiment.target, experiment.about));
            measured.push((experiment, experiment.run(effort)?));
            progress.inc(1);
        }
        progress.finish_and_clear();
        answer(&terminal_table(&measured));
        if let Some(file) = &self.markdown {
            fs::write(file, table::markdown(&measured))
                .map_err(|source| Failure::Unwritable { file: file.clone(), source })?;
            answer(&format!("written: {}", file.display()));
        }
        let missed = measured.iter().flat_map(|(_, findings)| findings).filter(|finding| !finding.held()).count();
        if missed == 0 { Ok(()) } else { Err(Failure::Missed { missed }) }
    }
}

fn terminal_table(measured: &[(&Experiment, Vec<Finding>)]) -> String {
    let mut terminal = Table::new();
    terminal.load_style(presets::UTF8_FULL_CONDENSED).set_header(table::HEADER);
    for (experiment, findings) in measured {
        findings.iter().for_each(|finding| {
            terminal.add_row(table::row(experiment, finding));
        });
    }
    for column in [2, 4] {
        if let Some(column) = terminal.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    terminal.to_string()
}

impl From<ValidationError> for Failure {
    fn from(error: ValidationError) -> Self {
        match error {
            ValidationError::Render(error) => Self::Render(error),
            ValidationError::World(error) => Self::World(error),
        }
    }
}
