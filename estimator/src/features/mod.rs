//! Points that can be found again: SURF and the matching of its descriptors.

pub mod matching;
pub mod surf;
