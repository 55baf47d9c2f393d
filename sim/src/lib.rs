//! Runs, records, replays and judges localisation. `record` reads and writes recordings, `runner` drives the
//! estimator (the only room that does), `evaluation` holds it against the truth, `report` shows the result,
//! `new_folder` puts it in its place whole or not at all, `cli` is the command line; `textured_room` makes a small
//! recording with known truth on the CPU.

pub mod cli;
pub mod evaluation;
pub mod new_folder;
pub mod random;
pub mod record;
pub mod report;
pub mod runner;
pub mod scenario;
pub mod textured_room;
pub mod world;
