//! The robot's wheels: how wide apart they seem when it turns.

use nalgebra::Isometry3;

use super::statistics::mean;
use super::{Effort, Finding, Findings};
use crate::physics::{Floor, STEP, Simulation, WorldError};
use crate::robot::{CameraMount, EncoderParams, RobotModel, VelocityCommand};
use crate::world::World;

/// Effective over geometric track of a P3-AT that spins at 1 rad/s, from truth and encoders.
///
/// # Errors
/// None: the world is empty.
pub fn track_ratio(floor: Floor, seed: u64) -> Result<f64, WorldError> {
    let robot = RobotModel::p3at(&CameraMount::default());
    let world = World { name: "plain".into(), ..World::default() };
    let mut simulation = Simulation::new(&world, &robot, floor.into(), &Isometry3::identity(), seed)?;
    let mut spin = |seconds: f64| {
        for _ in 0..(seconds / STEP).round() as usize {
            simulation.step(VelocityCommand { speed: 0.0, turn_rate: 1.0 });
        }
        let (left, right) = simulation.ticks();
        (simulation.world_from_robot().rotation.euler_angles().2, (right - left) as f64)
    };
    let ((start, start_ticks), (end, end_ticks)) = (spin(3.0), spin(2.0));
    let turned = (end - start).rem_euclid(std::f64::consts::TAU);
    let rolled = (end_ticks - start_ticks) / EncoderParams::default().ticks_per_turn * std::f64::consts::TAU;
    Ok(rolled * robot.wheel_radius() / turned / robot.track())
}

/// V16: ARIA's parameters of the P3-AT have 0.588 m for a track of 0.394 m; others found 1.37 to 1.56 on hard floors.
pub(super) fn track(effort: Effort) -> Findings {
    let seeds = if effort == Effort::Full { 8 } else { 4 };
    let ratio = |floor: Floor| -> Result<f64, WorldError> {
        Ok(mean(&(0..seeds).map(|seed| track_ratio(floor, seed)).collect::<Result<Vec<_>, _>>()?))
    };
    let (tile, concrete, carpet) = (ratio(Floor::TILE)?, ratio(Floor::CONCRETE)?, ratio(Floor::CARPET)?);
    let hard = |name: &str, ratio: f64| {
        Finding::new(format!("effective over geometric track, {name}"), 1.49, 1.35..=1.75, ratio)
    };
    Ok(vec![
        hard("tile", tile),
        hard("concrete", concrete),
        Finding::new("the same on carpet, over that on tile", 1.1, 1.0..=1.5, carpet / tile),
    ])
}
