//! A simulated robot that drives on its own estimate: what its sensors say goes to the localisers, what the first of
//! them says goes to the tracker, and the tracker's command to the motors.

use std::time::Duration;

use cpu_time::ThreadTime;
use sunblind_estimator::fusion::PlanarPose;
use sunblind_estimator::guidance::{Path, Tracker, TrackingParams};
use sunblind_estimator::mode::Energies;
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};
use thiserror::Error;

use super::driven::Driven;
use super::log::{RunFacts, RunLog, SimulationCost};
use super::session::Session;
use crate::evaluation::{evaluate, position_error};
use crate::record::writer::{RecordingWriter, WriteError};
use crate::render::RenderError;
use crate::robot::VelocityCommand;
use crate::scenario::expect::{Metrics, OF_THE_SENSOR, judge, metrics, of_corrections, of_the_modes};
use crate::scenario::{Fault, Scenario};
use crate::simulator::Simulator;
use crate::world::World;
use crate::world::plan::Plan;

/// Why a run ended early.
#[derive(Debug, Error)]
pub enum RunError {
    /// The path can't be driven.
    #[error("{}", .0.problem)]
    Scenario(Fault),
    /// The graphics adapter stopped working.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// What was measured can't be kept.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// A run in the making: the scenario, its robot, and what is done with what the sensors say.
pub struct Run<'a> {
    /// What it is called in the report.
    pub name: &'a str,
    /// The scenario.
    pub scenario: &'a Scenario,
    /// Its world, for the report.
    pub world: &'a World,
    /// Its robot, at the start.
    pub simulator: &'a mut Simulator,
    /// Whose estimates are wanted. The first one drives, unless the scenario has the truth do so.
    pub localizers: Vec<Driven>,
    /// Keeps what is measured and the truth.
    pub recording: Option<&'a RecordingWriter>,
    /// Called after each frame.
    pub on_frame: &'a (dyn Fn() + Sync),
}

impl Run<'_> {
    /// Drives the robot along its path until its end or until the time is up.
    ///
    /// # Errors
    /// See [`RunError`].
    pub fn drive(self) -> Result<RunLog, RunError> {
        let Self { name, scenario, world, simulator, localizers, recording, on_frame } = self;
        let path = scenario.path.shape().map_err(RunError::Scenario)?;
        let start = scenario.start().map_err(RunError::Scenario)?;
        let planned_path = path.points().iter().map(|point| point.position.into()).collect();
        let end = Timestamp::from_nanos((scenario.duration * 1e9) as i64);
        let rig = simulator.calibration().rig.clone();
        let mut session = Session::new(localizers, rig, expected_frames(scenario), on_frame);
        let mut driver = Driver::new(scenario, path, start);
        let mut command = VelocityCommand::default();
        let mut physics = Duration::ZERO;
        while simulator.now() < end && !driver.tracker.finished() {
            let before = ThreadTime::now();
            let arrived = simulator.step(command)?;
            physics += before.elapsed();
            if arrived.is_empty() {
                continue;
            }
            let (written, ()) = rayon::join(|| keep(&arrived, recording), || session.take(&arrived));
            written?;
            if let Some(streams) = session.wanted_streams() {
                simulator.want_infrared(streams.infrared && !streams.rgb);
            }
            if arrived.iter().any(|measurement| matches!(measurement.data, MeasurementData::WheelTicks { .. })) {
                command = driver.command(simulator, &session);
            }
        }
        if let Some(recording) = recording {
            simulator.truth().iter().try_for_each(|pose| recording.write_truth(pose))?;
        }
        let mut log = session.finish(name.to_owned(), Vec::new(), simulator.truth());
        log.information = simulator.information().to_vec();
        log.plan = Some(Plan::of(world));
        log.planned_path = planned_path;
        let facts = facts(&log, scenario, simulator, physics);
        log.expectations = judge(&scenario.expect, &metrics_of(&log, &facts));
        log.facts = Some(facts);
        Ok(log)
    }
}

fn facts(log: &RunLog, scenario: &Scenario, simulator: &Simulator, physics: Duration) -> RunFacts {
    let visual = log.tracks.iter().max_by_key(|track| track.frames.len());
    let frames = visual.map_or(0, |track| track.frames.len()).max(1) as f64;
    let per_frame = |seconds: f64| 1e3 * seconds / frames;
    let estimator_ms: f64 = log.tracks.iter().flat_map(|track| &track.frames).flat_map(|frame| frame.stage_ms).sum();
    let (depth, physics) = (simulator.depth_cost().as_secs_f64(), physics.as_secs_f64());
    let way = simulator.truth().windows(2);
    RunFacts {
        seed: scenario.seed,
        quality: scenario.kinect.quality,
        duration: simulator.now().as_secs(),
        path: way.map(|pair| position_error(&pair[0].world_from_body, &pair[1].world_from_body)).sum(),
        adapter: Some(simulator.adapter().name.clone()),
        driver: Some(simulator.adapter().driver.clone()),
        cpu_ms_per_frame: SimulationCost {
            // A software adapter works on threads of its own: it is charged with all that nobody else did.
            render: (per_frame(log.cpu - depth - physics) - estimator_ms / frames).max(0.0),
            depth: per_frame(depth),
            physics: per_frame(physics),
        },
    }
}

/// What a scenario's expectations are held against.
fn metrics_of(log: &RunLog, facts: &RunFacts) -> Metrics {
    let evaluated: Vec<_> = log
        .tracks
        .iter()
        .filter_map(|track| Some((track.name.as_str(), evaluate(&track.frames, &log.truth)?)))
        .collect();
    let mut metrics = metrics(evaluated.iter().map(|(name, evaluation)| (*name, evaluation)));
    let frames = log.tracks.iter().map(|track| track.frames.len()).max().unwrap_or(0);
    metrics.insert("path_m".into(), facts.path);
    metrics.insert("duration_s".into(), facts.duration);
    metrics.insert("frames".into(), frames as f64);
    let Energies { rgb, infrared, depth } = log.energies;
    let of_the_sensor = [log.depth_valid_share(), rgb, infrared, depth];
    let measured = OF_THE_SENSOR.into_iter().zip(of_the_sensor);
    metrics.extend(measured.filter_map(|(key, value)| Some((key.to_owned(), value?))));
    metrics.extend(of_corrections(log.corrections()));
    metrics.extend(log.mode_score().iter().flat_map(of_the_modes));
    metrics
}

/// At least so many frames there will be, if the robot gets through.
pub fn expected_frames(scenario: &Scenario) -> usize {
    let path_takes = scenario.path.shape().map_or(0.0, |path| path.length() / scenario.path.speed);
    (scenario.duration.min(path_takes) * scenario.kinect.rate) as usize
}

fn keep(measurements: &[Measurement], recording: Option<&RecordingWriter>) -> Result<(), WriteError> {
    recording.map_or(Ok(()), |recording| measurements.iter().try_for_each(|measurement| recording.write(measurement)))
}

/// Whoever steers.
struct Driver {
    tracker: Tracker,
    /// Where the robot was told it stands.
    world_from_odom: PlanarPose,
    by_truth: bool,
    last: Timestamp,
}

impl Driver {
    fn new(scenario: &Scenario, path: Path, start: PlanarPose) -> Self {
        let params = TrackingParams { speed: scenario.path.speed, ..TrackingParams::default() };
        Self {
            tracker: Tracker::new(path, params),
            world_from_odom: start,
            by_truth: scenario.estimator.drives.pose_source().is_none(),
            last: Timestamp::from_nanos(0),
        }
    }

    fn command(&mut self, simulator: &Simulator, session: &Session) -> VelocityCommand {
        let elapsed = simulator.now().since(self.last);
        self.last = simulator.now();
        let world_from_robot = if self.by_truth {
            simulator.world_from_robot()
        } else {
            let Some(estimate) = session.estimate() else { return VelocityCommand::default() };
            self.world_from_odom.to_isometry() * estimate.odom_from_robot
        };
        let command = self.tracker.command(&PlanarPose::from_isometry(&world_from_robot), elapsed);
        VelocityCommand { speed: command.linear, turn_rate: command.angular }
    }
}
