//! `sunblind run`: a scenario is driven, estimated and judged.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;

use super::scenario_args::ScenarioArgs;
use super::{Failure, answer, output, stage, table, tell};
use crate::report;
use crate::runner::{self, log::RunLog};
use crate::scenario::{AnyScenario, Fault, Scenario, Source};

const HELP: &str = "\
Examples:
  sunblind run scenarios/lab_loop.toml
      drives it and writes out/lab_loop
  sunblind run scenarios/*.toml --short
      a few seconds of each, judged by their own short expectations
  sunblind run scenarios/lab_loop.toml --short --quality fast
      in a third of the time, with a Kinect of 320 × 240 pixels: shows that all works, not how well
  sunblind run scenarios/lab_loop.toml --seed 7 --set estimator.drives=\"odometry\"
      other noise and slip, and a robot that goes by its wheels alone

The robot drives its path on its own estimate, seen through a simulated Kinect. The output folder holds report.html (for
reading, one file), summary.json (for machines), truth.tum and one <track>.tum for each estimate (for evo),
timeline.csv, and modes.csv. It appears whole at the end or not at all; an earlier run's is replaced.

Below the table stands what the scenario expects; exit code 1 when something of it was missed. Equal scenarios give equal
digests, on one graphics driver, whatever the number of threads; images' sizes are part of them, so the quality is, too.";

/// Drive scenarios, estimate, and judge.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Run {
    /// The scenarios' files
    #[arg(required = true, value_name = "SCENARIO")]
    scenarios: Vec<PathBuf>,
    /// Where the results go; with several scenarios, a folder of its own in there for each [default: out/<name>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    changes: ScenarioArgs,
}

impl Run {
    pub fn run(&self) -> Result<(), Failure> {
        // All are read before the first is driven: a slip of the pen should not cost an hour.
        let loaded: Vec<_> = self.scenarios.iter().map(|file| self.load(file)).collect::<Result<_, _>>()?;
        let names: Vec<_> = self.scenarios.iter().map(|file| name_of(file)).collect();
        let mut seen = BTreeSet::new();
        if let Some(name) = names.iter().find(|name| !seen.insert(*name)) {
            return Err(Failure::SameName { name: name.clone() });
        }
        let mut missed = 0;
        let mut missed_by = Vec::new();
        for (name, (source, scenario)) in names.iter().zip(&loaded) {
            let here = run(name, source, scenario, &self.out_of(name))?;
            missed += here;
            missed_by.extend((here > 0).then_some(name.as_str()));
        }
        if missed == 0 {
            return Ok(());
        }
        if names.len() > 1 {
            answer(&format!("\nmissed: {}", missed_by.join(", ")));
        }
        Err(Failure::Missed { missed })
    }

    fn load(&self, file: &Path) -> Result<(Source, Scenario), Failure> {
        let (source, scenario) = self.changes.load(file)?;
        match scenario {
            AnyScenario::Robot(scenario) => Ok((source, *scenario)),
            AnyScenario::TexturedRoom(_) => {
                let problem =
                    "nobody drives through the textured room: `sunblind record` it, then `sunblind replay` that";
                Err(source.blame(Fault::new("world.name", problem)).into())
            }
        }
    }

    fn out_of(&self, name: &str) -> PathBuf {
        match &self.out {
            None => Path::new("out").join(name),
            Some(out) if self.scenarios.len() == 1 => out.clone(),
            Some(out) => out.join(name),
        }
    }
}

fn name_of(file: &Path) -> String {
    file.file_stem().map_or_else(|| "run".into(), |stem| stem.to_string_lossy().into_owned())
}

/// Drives one; how many of its expectations were missed.
fn run(name: &str, source: &Source, scenario: &Scenario, out: &Path) -> Result<usize, Failure> {
    let log = drive(name, source, scenario, out)?;
    for warning in &log.warnings {
        tell(&format!("warning: {warning}"));
    }
    answer(&format!("{}\n{}", headline(name, &log), table::of(&log)));
    if !log.expectations.is_empty() {
        answer(&table::of_expectations(&log.expectations));
    }
    answer(&format!("report: {}", out.join("report.html").display()));
    Ok(log.expectations.iter().filter(|expectation| !expectation.held).count())
}

/// Drives one, and keeps its results in `out`.
pub(super) fn drive(name: &str, source: &Source, scenario: &Scenario, out: &Path) -> Result<RunLog, Failure> {
    output::check(out)?;
    let world = stage::world(source, scenario)?;
    let mut simulator = stage::simulator(source, scenario, &world)?;
    let localizers = stage::localizers(scenario, simulator.calibration().rig.clone())?;
    let progress = stage::progress_bar(name, runner::expected_frames(scenario));
    let run = runner::Run {
        name,
        scenario,
        world: &world,
        simulator: &mut simulator,
        localizers,
        recording: None,
        on_frame: &|| progress.inc(1),
    };
    let outcome = run.drive();
    progress.finish_and_clear();
    let log = outcome.map_err(|error| stage::blame(source, error))?;
    output::publish(out, |folder| report::write(&log, folder).map(drop))?;
    Ok(log)
}

/// What was driven, and how quickly it was computed.
fn headline(name: &str, log: &RunLog) -> String {
    let Some(facts) = &log.facts else { return name.to_owned() };
    let factor = facts.duration / log.wall;
    format!("{name}: {:.1} m in {:.1} s, simulated at {factor:.2} times real time", facts.path, facts.duration)
}
