//! Moves the robot through the world: rigid bodies, driven wheels that slip on the ground, walls to bump into.
//! The only room that names the physics engine.
//!
//! A skid-steer robot turns by dragging its tyres sideways. The engine's friction acts along K⁻¹·slip (K: how a
//! contact's slip answers an impulse), so that the robot turns as if its wheels stood further apart,
//!
//! effective track / track = 1 + (wheelbase / track)² / (1 + α),
//!
//! whatever the friction coefficient; α is a property of the ground ([`Grip`]).

mod convert;
mod floor;
mod ground;
mod simulation;
mod slip;
mod unevenness;
mod vehicle;

pub use floor::{Floor, FloorArea, FloorPlan, Grip, GripVariation};
pub use ground::WorldError;
pub use simulation::{Bump, STEP, Simulation, Twist};
