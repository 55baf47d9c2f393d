//! Runs, records, replays and judges localisation. `record` reads and writes recordings, `runner` drives the
//! estimator (the only room that does), `evaluation` holds it against the truth, `report` shows the result,
//! `new_folder` puts it in its place whole or not at all, `cli` is the command line.
//!
//! What is simulated: `scenario` says what, `simulator` is that as hardware would be. In it `world` is the place, `robot`
//! the device, `physics` moves the one through the other (the only room that names the physics engine), `render` makes
//! images (the only one that names wgpu), `kinect` makes of them what the device gives out; `random` gives every effect
//! its own stream. `validation` holds the device against published figures, `paper` the estimator against a paper's.
//! `textured_room` makes a small recording with known truth without any of them.

pub mod cli;
pub mod evaluation;
mod false_colour;
pub mod kinect;
pub mod light;
pub mod modes;
pub mod new_folder;
mod paper;
pub mod physics;
pub mod random;
pub mod record;
pub mod render;
pub mod report;
pub mod robot;
pub mod runner;
pub mod scenario;
pub mod simulator;
pub mod textured_room;
mod truth;
pub mod validation;
pub mod world;
