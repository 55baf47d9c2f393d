//! Tests that cross crates live in `tests/`; this library holds what they share.

pub mod command;
pub mod fake_localizer;
pub mod mrclam;
pub mod oracle;
pub mod pgm;
pub mod recorded;
pub mod repeatability;
pub mod tiny_drive;
pub mod tiny_recording;
