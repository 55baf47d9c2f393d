//! A scenario made ready to be driven: a world with light in it, a free way, a robot with its sensors, localisers.

use indicatif::{ProgressBar, ProgressStyle};
use sunblind_estimator::{EstimatorParams, ParamError, Rig};

use super::Failure;
use crate::render::Adapter;
use crate::runner::{Driven, RunError};
use crate::scenario::meaning::Obstacles;
use crate::scenario::{Scenario, Source};
use crate::simulator::{Simulator, SimulatorError};
use crate::world::World;

/// The scenario's world under its light.
///
/// # Errors
/// When something stands in the path's way, or nothing here can render.
pub(super) fn world(source: &Source, scenario: &Scenario) -> Result<World, Failure> {
    // Before the light, which may take a while.
    let obstacles = Obstacles::of(&scenario.world.build().map_err(|fault| source.blame(fault))?);
    scenario.check_way(|from, to| obstacles.leave_free(from, to)).map_err(|fault| source.blame(fault))?;
    Adapter::find()?;
    lit_world(source, scenario)
}

/// The scenario's world under its light, with a bar for as long as that takes.
///
/// # Errors
/// There is no such world, or it has no such lamps.
pub(super) fn lit_world(source: &Source, scenario: &Scenario) -> Result<World, Failure> {
    let style = ProgressStyle::with_template("light, once for a world {wide_bar} {percent} %");
    let bar = ProgressBar::new(100).with_style(style.expect("the template is well formed"));
    let world = scenario.lit_world(&|share| bar.set_position((100.0 * share) as u64));
    bar.finish_and_clear();
    Ok(world.map_err(|fault| source.blame(fault))?)
}

/// The robot at its start.
///
/// # Errors
/// No graphics adapter, or a description that is none of a robot.
pub(super) fn simulator(source: &Source, scenario: &Scenario, world: &World) -> Result<Simulator, Failure> {
    Simulator::new(scenario, world).map_err(|error| match error {
        SimulatorError::Scenario(fault) => source.blame(fault).into(),
        SimulatorError::World(error) => Failure::World(error),
        SimulatorError::Render(error) => Failure::Render(error),
    })
}

/// The product's estimator, as the scenario has it.
///
/// # Errors
/// Parameters that it can't run with.
pub(super) fn localizers(scenario: &Scenario, rig: Rig) -> Result<Vec<Driven>, ParamError> {
    let written = &scenario.estimator.params;
    let pose_from = scenario.estimator.drives.pose_source().unwrap_or(written.pose_from);
    let params = EstimatorParams { pose_from, ..written.clone() };
    let compared = scenario.estimator.odometry_without_gyro;
    let compared = compared.then(|| Driven::odometry_without_gyro(params.clone(), rig.clone())).transpose()?;
    let mut localizers = vec![Driven::product("mvo", "visual odometry", params, rig)?];
    localizers.extend(compared);
    Ok(localizers)
}

/// Frames, and how long it still takes, on standard error; nothing where that is no terminal. `frames` is a guess: a
/// robot may be early or late.
pub(super) fn progress_bar(doing: &str, frames: usize) -> ProgressBar {
    let template = format!("{doing} {{wide_bar}} {{pos}}/{{len}} frames, {{eta}} left");
    let style = ProgressStyle::with_template(&template).expect("the template is well formed");
    ProgressBar::new(frames as u64).with_style(style)
}

/// A run's error in words that name the file.
pub(super) fn blame(source: &Source, error: RunError) -> Failure {
    match error {
        RunError::Scenario(fault) => source.blame(fault).into(),
        RunError::Render(error) => Failure::Render(error),
        RunError::Write(error) => Failure::Write(error),
    }
}
