//! Points that can be found again: SURF and the matching of its descriptors; the same across colour and infrared.

pub mod cross_spectral;
pub mod matching;
pub mod surf;
