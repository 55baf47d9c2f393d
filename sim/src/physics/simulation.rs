//! The robot in the world, step by step.

use nalgebra::{Isometry3, Vector3};
use rapier3d::prelude::*;

use super::convert;
use super::floor::FloorPlan;
use super::ground::{self, WorldError};
use super::slip::Slip;
use super::vehicle::Vehicle;
use crate::random::stream;
use crate::robot::{Drive, EncoderParams, InertialSensor, RobotModel, Side, VelocityCommand};
use crate::world::World;

/// One step, seconds. Wheels and contacts stay calm at it; longer ones were not measured.
pub const STEP: f64 = 1.0 / 200.0;

/// m/s².
const GRAVITY: f64 = 9.81;
/// Less than this is no bump, N; a guess at what closes a bumper's switch.
const BUMP_FORCE: f64 = 5.0;
/// How long the robot stands before its run begins, steps: its weight settles into the contacts.
const SETTLING: usize = 100;

/// Velocity of the robot frame's origin, in the robot frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// m/s.
    pub linear: Vector3<f64>,
    /// rad/s.
    pub angular: Vector3<f64>,
}

/// The robot pressing against something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// Index into [`World::objects`]; `None` for the ground (or a thing's top) under the body.
    pub object: Option<usize>,
    /// N.
    pub force: f64,
}

/// One robot in one world. Equal arguments and equal commands give equal runs, bit for bit.
///
/// Pose and velocity are the truth: no localiser may see them.
pub struct Simulation {
    physics: PhysicsWorld,
    vehicle: Vehicle,
    drive: Drive,
    encoder: EncoderParams,
    floors: FloorPlan,
    seed: u64,
    steps: u64,
    gyro: Option<InertialSensor>,
    accelerometer: Option<InertialSensor>,
    readings: Readings,
    bumps: Vec<Bump>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Readings {
    gyro: Option<Vector3<f64>>,
    accelerometer: Option<Vector3<f64>>,
}

impl Simulation {
    /// The robot at rest at `world_from_robot`, wheels on the ground. The seed draws the floors' variation and the
    /// sensors' noise.
    ///
    /// # Errors
    /// A mesh that nothing can bump into.
    pub fn new(
        world: &World,
        robot: &RobotModel,
        floors: FloorPlan,
        world_from_robot: &Isometry3<f64>,
        seed: u64,
    ) -> Result<Self, WorldError> {
        let mut physics = engine();
        ground::build(world, &mut physics)?;
        let vehicle = Vehicle::build(robot, world_from_robot, &mut physics);
        let max_wheel_speed = robot.wheels.iter().map(|wheel| wheel.max_speed).fold(f64::INFINITY, f64::min);
        let sensor = |name, noise: Option<_>| noise.map(|noise| InertialSensor::new(noise, stream(seed, name, 0)));
        let mut simulation = Self {
            drive: Drive::new(robot.drive, robot.wheel_radius(), max_wheel_speed),
            encoder: robot.encoder,
            gyro: sensor("gyro", robot.gyro),
            accelerometer: sensor("accelerometer", robot.accelerometer),
            physics,
            vehicle,
            floors,
            seed,
            steps: 0,
            readings: Readings::default(),
            bumps: Vec::new(),
        };
        for _ in 0..SETTLING {
            simulation.step(VelocityCommand::default());
        }
        simulation.steps = 0;
        for wheel in &mut simulation.vehicle.wheels {
            wheel.angle = 0.0;
        }
        Ok(simulation)
    }

    /// [`STEP`] seconds on, the motors following `command`.
    pub fn step(&mut self, command: VelocityCommand) {
        let speeds = self.drive.follow(command, STEP);
        self.vehicle.set_wheel_speeds(speeds, &mut self.physics);
        let slip =
            Slip { contacts: self.vehicle.ground_contacts(&self.physics, |x, y| self.floors.grip_at(self.seed, x, y)) };
        let velocity_before = self.velocity_in_world();
        self.physics.step_with_events(&slip, &());
        self.vehicle.follow_wheels(&self.physics);
        self.read_inertial_sensors((self.velocity_in_world() - velocity_before) / STEP);
        self.bumps = self.find_bumps();
        self.steps += 1;
    }

    /// Seconds since the start.
    pub fn elapsed(&self) -> f64 {
        self.steps as f64 * STEP
    }

    /// The true pose.
    pub fn world_from_robot(&self) -> Isometry3<f64> {
        convert::isometry(self.chassis().position())
    }

    /// The true velocity.
    pub fn twist(&self) -> Twist {
        let robot_from_world = self.world_from_robot().rotation.inverse();
        Twist {
            linear: robot_from_world * self.velocity_in_world(),
            angular: robot_from_world * convert::vector3(self.chassis().angvel()),
        }
    }

    /// Encoder counts since the start, left and right: the mean of a side's wheels, which a belt couples.
    pub fn ticks(&self) -> (i64, i64) {
        let ticks = |side| self.encoder.ticks(self.vehicle.side_mean(side, |wheel| wheel.angle));
        (ticks(Side::Left), ticks(Side::Right))
    }

    /// The gyro's reading over the last step, rad/s in the robot frame; `None` without a gyro.
    pub fn gyro(&self) -> Option<Vector3<f64>> {
        self.readings.gyro
    }

    /// The accelerometer's reading over the last step at the robot frame's origin: specific force, m/s² in the robot
    /// frame (at rest +9.81 along z); `None` without an accelerometer.
    pub fn accelerometer(&self) -> Option<Vector3<f64>> {
        self.readings.accelerometer
    }

    /// What the robot pressed against in the last step, by object.
    pub fn bumps(&self) -> &[Bump] {
        &self.bumps
    }

    fn chassis(&self) -> &RigidBody {
        &self.physics.bodies[self.vehicle.chassis]
    }

    /// Of the robot frame's origin.
    fn velocity_in_world(&self) -> Vector3<f64> {
        let chassis = self.chassis();
        convert::vector3(chassis.velocity_at_point(chassis.translation()))
    }

    fn read_inertial_sensors(&mut self, acceleration: Vector3<f64>) {
        let robot_from_world = self.world_from_robot().rotation.inverse();
        let specific_force = robot_from_world * (acceleration + Vector3::z() * GRAVITY);
        let angular = self.twist().angular;
        self.readings = Readings {
            gyro: self.gyro.as_mut().map(|sensor| sensor.read(&angular, STEP)),
            accelerometer: self.accelerometer.as_mut().map(|sensor| sensor.read(&specific_force, STEP)),
        };
    }

    fn find_bumps(&self) -> Vec<Bump> {
        let mut forces: Vec<Bump> = Vec::new();
        for &bumper in &self.vehicle.bumpers {
            for pair in self.physics.narrow_phase.contact_pairs_with(bumper) {
                let other = if pair.collider1 == bumper { pair.collider2 } else { pair.collider1 };
                let object = (self.physics.colliders[other].user_data as usize).checked_sub(1);
                let force = pair.total_impulse_magnitude() / STEP;
                match forces.iter_mut().find(|bump| bump.object == object) {
                    Some(bump) => bump.force += force,
                    None => forces.push(Bump { object, force }),
                }
            }
        }
        forces.retain(|bump| bump.force >= BUMP_FORCE);
        forces.sort_by_key(|bump| bump.object);
        forces
    }
}

/// Settings under which a skid-steer robot drives calmly and turns about the track of the closed form; measured.
fn engine() -> PhysicsWorld {
    let mut physics = PhysicsWorld { gravity: Vector::new(0.0, 0.0, -GRAVITY), ..PhysicsWorld::default() };
    let parameters = &mut physics.integration_parameters;
    parameters.dt = STEP;
    parameters.num_solver_iterations = 4;
    // With a single one the axles' joints are left with an error whose correction turns the wheels: 3 mm/s of counts
    // on a robot that stands.
    parameters.num_internal_pgs_iterations = 4;
    // The default lumps the contacts of a pair together, and friction with them.
    parameters.friction_model = FrictionModel::Coulomb;
    // Contacts that are kept from an earlier step would hide that a wheel has rolled on.
    parameters.contact_recycling = false;
    parameters.friction_in_bias_pass = false;
    physics
}

#[cfg(test)]
mod tests;
