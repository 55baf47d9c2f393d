//! The robot as bodies and joints of the engine.

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use rapier3d::prelude::*;

use super::convert;
use super::ground::groups;
use super::slip::GroundContact;
use crate::robot::{Geometry, Inertial, RobotModel, Shape, Side, WheelSpeeds};

/// How hard a motor holds its speed, N·m·s/rad. At 20 a spin of 60 °/s reached only 54.7; measured.
const MOTOR_STIFFNESS: f64 = 1000.0;
/// The rounding of a wheel's edge where it meets obstacles, as a share of its width or radius; a guess.
const TYRE_ROUNDING: f64 = 0.1;
/// Tyres and body against obstacles: the obstacle's own friction counts alone.
const UNIT_FRICTION: f64 = 1.0;

pub(super) struct Vehicle {
    pub(super) chassis: RigidBodyHandle,
    pub(super) wheels: Vec<MountedWheel>,
    /// What bumps into things.
    pub(super) bumpers: Vec<ColliderHandle>,
}

pub(super) struct MountedWheel {
    pub(super) side: Side,
    pub(super) body: RigidBodyHandle,
    axle: ImpulseJointHandle,
    tyre: ColliderHandle,
    radius: f64,
    /// How far it has turned since the reset, rad; positive rolls forward.
    pub(super) angle: f64,
    /// The engine's own angle when `angle` was last updated, rad, known up to whole turns.
    angle_in_turn: f64,
}

impl Vehicle {
    /// Puts the robot into the world, at rest.
    pub(super) fn build(robot: &RobotModel, world_from_robot: &Isometry3<f64>, physics: &mut PhysicsWorld) -> Self {
        let chassis = physics.insert_body(body(&robot.chassis.inertial, world_from_robot));
        let mut bumpers: Vec<_> = robot
            .chassis
            .shapes
            .iter()
            .map(|shape| physics.insert_collider(bumper(collider(shape), groups::CHASSIS_TOUCHES), Some(chassis)))
            .collect();
        let mut wheels = Vec::new();
        for wheel in &robot.wheels {
            let hub = Translation3::from(wheel.hub.coords);
            let handle = physics.insert_body(body(&wheel.inertial, &(world_from_robot * hub)));
            let tyre = ColliderBuilder::ball(wheel.radius)
                .density(0.0)
                .collision_groups(groups::TYRE_TOUCHES)
                .active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS);
            let rounding = TYRE_ROUNDING * wheel.width.min(wheel.radius);
            let flank =
                ColliderBuilder::round_cylinder(wheel.width / 2.0 - rounding, wheel.radius - rounding, rounding);
            let axle = RevoluteJointBuilder::new(Vector::Y)
                .local_anchor1(convert::point(&wheel.hub))
                .local_anchor2(Vector::ZERO)
                .contacts_enabled(false)
                .motor_model(MotorModel::ForceBased)
                .motor_velocity(0.0, MOTOR_STIFFNESS)
                .motor_max_force(wheel.max_torque);
            let tyre = physics.insert_collider(tyre, Some(handle));
            bumpers.push(physics.insert_collider(bumper(flank, groups::WHEEL_TOUCHES), Some(handle)));
            wheels.push(MountedWheel {
                side: wheel.side,
                body: handle,
                axle: physics.insert_impulse_joint(chassis, handle, axle),
                tyre,
                radius: wheel.radius,
                angle: 0.0,
                angle_in_turn: 0.0,
            });
        }
        Self { chassis, wheels, bumpers }
    }

    /// Tells the motors what to hold.
    pub(super) fn set_wheel_speeds(&self, speeds: WheelSpeeds, physics: &mut PhysicsWorld) {
        for wheel in &self.wheels {
            let speed = match wheel.side {
                Side::Left => speeds.left,
                Side::Right => speeds.right,
            };
            let joint = physics.impulse_joints.get_mut(wheel.axle, false).expect("the axle is never removed");
            // The engine's revolute joints turn about their own x, whichever axis of the bodies that is.
            joint.data.set_motor_velocity(JointAxis::AngX, speed, MOTOR_STIFFNESS);
        }
    }

    /// The tyres on a ground that holds each as `grip_at` its (x, y) says.
    pub(super) fn ground_contacts(
        &self,
        physics: &PhysicsWorld,
        grip_at: impl Fn(f64, f64) -> super::floor::Grip,
    ) -> Vec<GroundContact> {
        let contact = |wheel: &MountedWheel| {
            let hub = physics.bodies[wheel.body].translation();
            GroundContact { tyre: wheel.tyre, wheel: wheel.body, radius: wheel.radius, grip: grip_at(hub.x, hub.y) }
        };
        self.wheels.iter().map(contact).collect()
    }

    /// Follows the wheels' turning; to be called each step, for half a turn may be missed otherwise.
    pub(super) fn follow_wheels(&mut self, physics: &PhysicsWorld) {
        let chassis = physics.bodies[self.chassis].rotation();
        for wheel in &mut self.wheels {
            let chassis_from_wheel = chassis.inverse() * *physics.bodies[wheel.body].rotation();
            // Not the joint's own angle: it is an arcsine, which is worthless near half a turn.
            let angle = 2.0 * chassis_from_wheel.y.atan2(chassis_from_wheel.w);
            let turned = (angle - wheel.angle_in_turn + PI).rem_euclid(TAU) - PI;
            wheel.angle += turned;
            wheel.angle_in_turn = angle;
        }
    }

    /// Mean over the wheels of one side of what `of` says of each.
    pub(super) fn side_mean(&self, side: Side, of: impl Fn(&MountedWheel) -> f64) -> f64 {
        let (sum, count) = self
            .wheels
            .iter()
            .filter(|wheel| wheel.side == side)
            .fold((0.0, 0.0), |(sum, count), wheel| (sum + of(wheel), count + 1.0));
        sum / count
    }
}

fn body(inertial: &Inertial, world_from_body: &Isometry3<f64>) -> RigidBodyBuilder {
    let Inertial { mass, centre, inertia } = inertial;
    RigidBodyBuilder::dynamic()
        .pose(convert::pose(world_from_body))
        .additional_mass_properties(MassProperties::with_inertia_matrix(
            convert::point(centre),
            *mass,
            convert::matrix(inertia),
        ))
        .can_sleep(false)
}

fn bumper(shape: ColliderBuilder, touches: InteractionGroups) -> ColliderBuilder {
    shape
        .density(0.0)
        .collision_groups(touches)
        .friction(UNIT_FRICTION)
        .friction_combine_rule(CoefficientCombineRule::Multiply)
}

fn collider(shape: &Shape) -> ColliderBuilder {
    // URDF's cylinders lie along z, the engine's along y.
    let along_z = UnitQuaternion::from_axis_angle(&nalgebra::Vector3::x_axis(), PI / 2.0);
    let (collider, frame) = match shape.geometry {
        Geometry::Box { size: [x, y, z] } => {
            (ColliderBuilder::cuboid(x / 2.0, y / 2.0, z / 2.0), shape.robot_from_shape)
        }
        Geometry::Cylinder { radius, length } => {
            (ColliderBuilder::cylinder(length / 2.0, radius), shape.robot_from_shape * along_z)
        }
        Geometry::Sphere { radius } => (ColliderBuilder::ball(radius), shape.robot_from_shape),
    };
    collider.position(convert::pose(&frame))
}
