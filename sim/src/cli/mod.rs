//! The command line.

pub mod record;
