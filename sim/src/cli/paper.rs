//! `sunblind paper`: a paper's experiments, driven again.

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::{Failure, answer, run};
use crate::paper::{Experiment2, Outcome, OwnPose, goals, page, table_1};
use crate::runner::log::RunLog;
use crate::scenario::{AnyScenario, Fault, Override, Source};
use crate::validation::Effort;

const HELP: &str = "\
Examples:
  sunblind paper a --quick
      a quarter of the way at twice the pace, once, the start of experiment 2, and Table 1 of three units: some five minutes
  sunblind paper a --quick --seeds 10
      the same with ten seeds, their mean and spread
  sunblind paper a
      the whole way of 1250 s, three times, experiment 2, and a drive by the robot's own pose: more than an hour

To be called where the scenarios are: scenarios/paper/experiment_1.toml, experiment_1_quick.toml and
experiment_2.toml. Each run's report is
in the output folder, and paper_a.md, which sets the paper's tables beside ours. A goal that is missed is said so there; it
is no error.";

/// How much of experiment 2 is driven with `--quick`, seconds: some 23 m.
const QUICK_DURATION: f64 = 60.0;

/// Drive a paper's experiments, and set its tables beside ours.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Paper {
    /// a: multispectral visual odometry, fused with the wheels
    #[arg(value_name = "PAPER")]
    paper: Which,
    /// A quarter of the way at twice the pace, and one seed
    #[arg(long)]
    quick: bool,
    /// How many seeds [default: 3, with --quick 1]
    #[arg(long, value_name = "N")]
    seeds: Option<NonZero<u64>>,
    /// Where the runs and the page go
    #[arg(long, value_name = "DIR", default_value = "out/paper_a")]
    out: PathBuf,
}

#[derive(Clone, Copy, ValueEnum)]
enum Which {
    A,
}

impl Paper {
    pub fn run(&self) -> Result<(), Failure> {
        let Which::A = self.paper;
        let (file, form, usual) = match self.quick {
            true => ("experiment_1_quick.toml", "a quarter of the way at twice the pace", 1),
            false => ("experiment_1.toml", "in full", 3),
        };
        let mut outcomes = Vec::new();
        for seed in 1..=self.seeds.map_or(usual, NonZero::get) {
            let log = self.drive(file, &format!("experiment_1_seed_{seed}"), &[Override::seed(seed)])?;
            outcomes.extend(Outcome::of(&log));
        }
        let page_file = self.out.join("paper_a.md");
        let table_1 = table_1(if self.quick { Effort::Reduced } else { Effort::Full })?;
        let text = page(&outcomes, form, &table_1) + &self.other_drives()?;
        // Beside, then in its place: half a page would look like a whole one.
        let unfinished = self.out.join("paper_a.md.new");
        fs::create_dir_all(&self.out)
            .and_then(|()| fs::write(&unfinished, &text))
            .and_then(|()| fs::rename(&unfinished, &page_file))
            .map_err(|source| Failure::Unwritable { file: page_file.clone(), source })?;
        let goals: Vec<_> = table_1.goals.into_iter().chain(goals(&outcomes)).collect();
        let missed = goals.iter().filter(|goal| !goal.held()).count();
        answer(&format!("{text}\n{missed} of {} goals missed; page: {}", goals.len(), page_file.display()));
        Ok(())
    }

    /// Experiment 2 and the drive by the robot's own pose, once each.
    fn other_drives(&self) -> Result<String, Failure> {
        let start = [Override::set("duration_s", &QUICK_DURATION.to_string())];
        let (changes, form) = match self.quick {
            true => {
                (&start[..], "The start of its way, out of the office and into the yard (the rest without `--quick`)")
            }
            false => (&[][..], "From the office once round the yard and in again"),
        };
        let log = self.drive("experiment_2.toml", "experiment_2", changes)?;
        let second = Experiment2::of(&log).map_or_else(String::new, |second| second.section(form));
        if self.quick {
            return Ok(second + "\n## Driven by its own EKF\n\nNot driven with `--quick`.\n");
        }
        let by_ekf = [Override::set("estimator.drives", "ekf")];
        let log = self.drive("experiment_1_quick.toml", "experiment_1_by_ekf", &by_ekf)?;
        Ok(second + &OwnPose::of(&log).map_or_else(String::new, |own| own.section()))
    }

    /// Drives one of the paper's scenarios; its report goes to a folder of its own.
    fn drive(&self, file: &str, name: &str, changes: &[Override]) -> Result<RunLog, Failure> {
        let source = Source::read(&Path::new("scenarios/paper").join(file), changes)?;
        let no_robot = || source.blame(Fault::new("world.name", "the paper's experiments are a robot's"));
        let AnyScenario::Robot(scenario) = source.scenario()? else { return Err(no_robot().into()) };
        run::drive(name, &source, &scenario, &self.out.join(name))
    }
}
