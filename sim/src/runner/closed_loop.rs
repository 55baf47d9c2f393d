//! A simulated robot that drives on its own estimate: what its sensors say goes to the localisers, what the first of
//! them says goes to the tracker, and the tracker's command to the motors.

use sunblind_estimator::fusion::PlanarPose;
use sunblind_estimator::guidance::{Path, Tracker, TrackingParams};
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};
use thiserror::Error;

use super::driven::Driven;
use super::log::RunLog;
use super::session::Session;
use crate::record::writer::{RecordingWriter, WriteError};
use crate::render::RenderError;
use crate::robot::VelocityCommand;
use crate::scenario::{Fault, Scenario};
use crate::simulator::Simulator;

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

/// Drives the scenario's robot along its path until its end or until the time is up. What was measured goes to
/// `recording` as well, if there is one. The first localiser drives, unless the scenario has the truth do so.
///
/// # Errors
/// See [`RunError`].
pub fn run(
    name: String,
    scenario: &Scenario,
    simulator: &mut Simulator,
    localizers: Vec<Driven>,
    recording: Option<&RecordingWriter>,
    on_frame: &(dyn Fn() + Sync),
) -> Result<RunLog, RunError> {
    let path = scenario.path.shape().map_err(RunError::Scenario)?;
    let start = scenario.start().map_err(RunError::Scenario)?;
    let end = Timestamp::from_nanos((scenario.duration * 1e9) as i64);
    let rig = simulator.calibration().rig.clone();
    let mut session = Session::new(localizers, rig, expected_frames(scenario), on_frame);
    let mut driver = Driver::new(scenario, path, start);
    let mut command = VelocityCommand::default();
    while simulator.now() < end && !driver.tracker.finished() {
        let arrived = simulator.step(command)?;
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
    Ok(session.finish(name, Vec::new(), simulator.truth()))
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
