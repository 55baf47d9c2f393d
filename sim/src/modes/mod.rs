//! Which mode would have been best, in truth, and how well the estimator's switch did. Nothing of it reaches the
//! estimator.
//!
//! An instant's best mode follows from what its images hold, by a definition that the switch knows nothing of:
//!
//! - **Colour** and **infrared** carry information when enough of the image is unsaturated and has a contrast, free of
//!   noise, above 3 σ of the chip's noise at that brightness. In infrared the projector's dots are contrast like any
//!   other: night mode divides them out.
//! - **Depth** carries information when at least 30 % of its pixels lie within 3 σ of the true depth, σ being 1.425 mm at
//!   1 m and growing with z² (Khoshelham & Elberink 2012).
//! - The paper's [`RULES`](sunblind_estimator::mode::RULES), with Low for nothing and High for something, give the mode.
//!
//! While the exposures lag behind a door all images may be dark or white: then wheels alone are the best there is.

mod information;
mod score;

pub use information::{DEPTH_STEP, Information, Seen};
pub use score::{Score, score, switches};

use sunblind_estimator::Timestamp;
use sunblind_estimator::mode::ModeReport;

/// What the switch said at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampedReport {
    /// When the images were captured that it had seen last.
    pub time: Timestamp,
    /// The mode, and how it came about.
    pub report: ModeReport,
}

/// What the images of an instant held in truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampedInformation {
    /// When they were captured.
    pub time: Timestamp,
    /// How much there was in them.
    pub information: Information,
}
