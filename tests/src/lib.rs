//! Tests that cross crates live in `tests/`; this library holds what they share.

pub mod oracle;
pub mod pgm;
pub mod recorded;
pub mod repeatability;
