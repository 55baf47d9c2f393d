//! A scenario as hardware would be: takes velocity commands, delivers measurements in the order in which they arrive,
//! and keeps the truth for the judge. Knows no estimator.

mod eye;
mod video;

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use nalgebra::{Isometry3, Vector3};
use rand_chacha::rand_core::Rng;
use sunblind_estimator::fusion::{Drive, PlanarPose};
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};
use thiserror::Error;

use crate::evaluation::StampedPose;
use crate::kinect::{FRAME_INTERVAL, Kinect};
use crate::modes::StampedInformation;
use crate::physics::{STEP, Simulation, WorldError};
use crate::random::stream;
use crate::record::{Arrival, Body, Calibration, Latency, Sensor};
use crate::render::{Adapter, RenderError, Sweep};
use crate::robot::VelocityCommand;
use crate::scenario::light::lamp_groups;
use crate::scenario::{Covered, Fault, Light, Scenario, StreamMode};
use crate::truth;
use crate::world::World;
use eye::{Eye, Images};
use video::Video;

/// From one step of the physics to the next, nanoseconds.
const STEP_NANOS: i64 = (STEP * 1e9) as i64;
/// The P3-AT's microcontroller sends its encoders' counts ten times a second (ARIA's default), nanoseconds.
const WHEELS_EVERY: i64 = 100_000_000;
/// A gyro beside it is read by a computer of its own, nanoseconds; a common rate.
const INERTIAL_EVERY: i64 = 10_000_000;
/// The truth is kept so often, nanoseconds: a robot that brakes strays 0.05 mm from the straight line between.
const TRUTH_EVERY: i64 = 20_000_000;
/// From the exposure of an image until its estimate can steer, seconds: two of the Kinect's own frames until it is on
/// the host (measured by others as 2 to 3), and one for the estimator's work on it.
const IMAGES_TAKE: f64 = 0.1;
/// From the counting of the ticks until they are there, seconds: some 40 bytes over a serial line of 38,400 baud.
const WHEELS_TAKE: f64 = 0.01;

/// Why a scenario can't be simulated.
#[derive(Debug, Error)]
pub enum SimulatorError {
    /// The scenario does not make sense after all.
    #[error("{}", .0.problem)]
    Scenario(Fault),
    /// The world is none that a robot can drive in.
    #[error(transparent)]
    World(#[from] WorldError),
    /// No graphics adapter, or one that stopped working.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// A robot in a world, and its sensors.
pub struct Simulator {
    physics: Simulation,
    eye: Eye,
    steps: i64,
    rate: f64,
    frames: i64,
    video: Video,
    calibration: Calibration,
    robot_from_infrared: Isometry3<f64>,
    light: Light,
    lamp_groups: Vec<String>,
    covered: Vec<Covered>,
    /// Of the readings since the last one that was sent: sum and count.
    gyro: (Vector3<f64>, f64),
    under_way: BTreeMap<Arrival, Measurement>,
    depth_cost: Duration,
    /// Every step's pose, as far back as an exposure may lie.
    recent: VecDeque<StampedPose>,
    truth: Vec<StampedPose>,
    information: Vec<StampedInformation>,
}

impl Simulator {
    /// The robot at its start. `world` is the scenario's, with its light.
    ///
    /// # Errors
    /// See [`SimulatorError`].
    pub fn new(scenario: &Scenario, world: &World) -> Result<Self, SimulatorError> {
        let robot = scenario.robot_model().map_err(SimulatorError::Scenario)?;
        let PlanarPose { x, y, heading } = scenario.start().map_err(SimulatorError::Scenario)?;
        let start = world.ground.standing(x, y, heading, robot.wheelbase() / 2.0);
        let floors = scenario.robot.floor_plan(&world.ground);
        let physics = Simulation::new(world, &robot, floors, &start, scenario.seed)?;
        let unit = scenario.kinect.unit();
        let robot_from_infrared = robot.robot_from_camera * unit.colour_from_infrared;
        let mut rig = scenario.kinect.residual().of(unit.rig(robot.robot_from_camera), scenario.seed);
        rig.drive = Some(Drive::default());
        let latency = [Sensor::Colour, Sensor::Infrared, Sensor::Depth]
            .into_iter()
            .fold(Latency::default(), |latency, sensor| latency.with(sensor, IMAGES_TAKE))
            .with(Sensor::Wheels, WHEELS_TAKE);
        let kinect =
            Kinect::new(world, unit, (&scenario.kinect).into(), stream(scenario.seed, "kinect", 0).next_u64())?;
        let mut simulator = Self {
            physics,
            eye: Eye::open(kinect, scenario.kinect.truth_depth),
            steps: 0,
            rate: scenario.kinect.rate,
            frames: 0,
            video: match scenario.kinect.streams {
                StreamMode::Simultaneous => Video::Both,
                StreamMode::Exclusive => Video::exclusive(scenario.kinect.stream_switch),
            },
            calibration: Calibration { rig, body: Body::Robot, latency },
            robot_from_infrared,
            light: scenario.light.clone(),
            lamp_groups: lamp_groups(world),
            covered: scenario.kinect.covered.clone(),
            gyro: (Vector3::zeros(), 0.0),
            under_way: BTreeMap::new(),
            depth_cost: Duration::ZERO,
            recent: VecDeque::new(),
            truth: Vec::new(),
            information: Vec::new(),
        };
        simulator.look_around();
        Ok(simulator)
    }

    /// What the sensors are believed to be, and when their readings arrive.
    pub fn calibration(&self) -> &Calibration {
        &self.calibration
    }

    /// What renders.
    pub fn adapter(&self) -> &Adapter {
        self.eye.adapter()
    }

    /// Now.
    pub fn now(&self) -> Timestamp {
        Timestamp::from_nanos(self.steps * STEP_NANOS)
    }

    /// Where the robot truly is.
    pub fn world_from_robot(&self) -> Isometry3<f64> {
        self.physics.world_from_robot()
    }

    /// Where it truly was so far.
    pub fn truth(&self) -> &[StampedPose] {
        &self.truth
    }

    /// What the images held in truth that have arrived so far.
    pub fn information(&self) -> &[StampedInformation] {
        &self.information
    }

    /// CPU time that finding depth in the infrared images has taken.
    pub fn depth_cost(&self) -> Duration {
        self.depth_cost
    }

    /// Of a device that gives colour or infrared, never both, infrared is wanted from now on. It takes the device a while
    /// to switch, in which it gives neither; what it has captured before still arrives.
    pub fn want_infrared(&mut self, wanted: bool) {
        self.video.want_infrared(wanted, self.now());
    }

    /// One step of the physics on, the motors following `command`: what has arrived by then, in order.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn step(&mut self, command: VelocityCommand) -> Result<Vec<Measurement>, RenderError> {
        self.physics.step(command);
        self.steps += 1;
        self.look_around();
        self.receive_images()?;
        let now = self.now();
        let arrived = self.under_way.extract_if(.., |_, measurement| measurement.available_at <= now);
        Ok(arrived.map(|(_, measurement)| measurement).collect())
    }

    /// Every sensor whose time has come takes its reading.
    fn look_around(&mut self) {
        let now = self.now();
        let pose = StampedPose { time: now, world_from_body: self.physics.world_from_robot() };
        let is_due = |every: i64| now.as_nanos() % every == 0;
        if is_due(TRUTH_EVERY) {
            self.truth.push(pose);
        }
        self.recent.push_back(pose);
        if self.recent.len() > 2 + (2.0 * FRAME_INTERVAL / STEP) as usize {
            self.recent.pop_front();
        }
        if let Some(rate) = self.physics.gyro() {
            self.gyro = (self.gyro.0 + rate, self.gyro.1 + 1.0);
            if is_due(INERTIAL_EVERY) {
                self.measure(now, MeasurementData::Gyro(self.gyro.0 / self.gyro.1));
                self.gyro = (Vector3::zeros(), 0.0);
            }
        }
        if is_due(WHEELS_EVERY) {
            let (left, right) = self.physics.ticks();
            self.measure(now, MeasurementData::WheelTicks { left, right });
        }
        self.expose(now);
    }

    /// Has a frame taken whose whole interval lies in the past.
    fn expose(&mut self, now: Timestamp) {
        let half = (FRAME_INTERVAL / 2.0 * 1e9) as i64;
        let captured_at = ((self.frames + 1) as f64 / self.rate * 1e9).round() as i64;
        if now.as_nanos() < captured_at + half {
            return;
        }
        self.frames += 1;
        let recent = self.recent.make_contiguous();
        let world_from_infrared = |at: i64| {
            let pose = truth::at(recent, Timestamp::from_nanos(at)).or(recent.first().copied());
            pose.expect("the robot was somewhere").world_from_body * self.robot_from_infrared
        };
        let sweep = Sweep::between(&world_from_infrared(captured_at - half), &world_from_infrared(captured_at + half));
        let carried = self.video.carries(Timestamp::from_nanos(captured_at - half));
        let light = self.light.at(captured_at as f64 * 1e-9, &self.lamp_groups);
        let covered = self.covered.iter().any(|covered| covered.contains(captured_at as f64 * 1e-9));
        self.eye.capture(Timestamp::from_nanos(captured_at), sweep, light, carried, covered);
    }

    /// Waits for the frames that must have arrived by now.
    fn receive_images(&mut self) -> Result<(), RenderError> {
        let now = self.now();
        let latency = self.calibration.latency.clone();
        let has_arrived = |captured_at| latency.available_at(Sensor::Depth, captured_at) <= now;
        while self.eye.oldest().is_some_and(has_arrived) {
            let Images { captured_at, data, information, depth_cost } = self.eye.wait()?;
            self.depth_cost += depth_cost;
            self.information.push(StampedInformation { time: captured_at, information });
            data.into_iter().for_each(|data| self.measure(captured_at, data));
        }
        Ok(())
    }

    fn measure(&mut self, captured_at: Timestamp, data: MeasurementData) {
        let available_at = self.calibration.latency.available_at(Sensor::of(&data), captured_at);
        let measurement = Measurement { captured_at, available_at, data };
        self.under_way.insert(Arrival::of(&measurement), measurement);
    }
}
