//! Drives localisers through what was measured: the only caller of the estimator.
//!
//! [`replay`] is the way in for a recording, a [`Run`] for a scenario; a [`Session`] takes measurements as they come, from
//! anywhere. A localiser of your own is scored in a few lines:
//!
//! ```no_run
//! use sunblind_sim::evaluation::evaluate;
//! use sunblind_sim::record::Recording;
//! use sunblind_sim::runner::{Driven, ReplayOptions, replay};
//! # use sunblind_estimator::Localizer;
//! # fn score(my_localizer: Box<dyn Localizer + Send>) -> Result<(), Box<dyn std::error::Error>> {
//! let recording = Recording::open("path/to/recording".as_ref(), None)?;
//! let log = replay(&recording, vec![Driven::own("mine", "my localiser", my_localizer)], &ReplayOptions::default())?;
//! let score = evaluate(&log.tracks[0].frames, &log.truth);
//! # Ok(())
//! # }
//! ```

mod closed_loop;
mod digest;
mod driven;
mod energies;
mod follower;
mod gallery;
pub mod log;
mod pairing;
mod replay;
mod session;
mod stage_clock;
mod without_gyro;

pub use closed_loop::{Run, RunError, expected_frames};
pub use driven::Driven;
pub use replay::{ReplayError, ReplayOptions, replay};
pub use session::Session;
