//! Rigid motion from matched 3D points.

use thiserror::Error;

/// Why two frames gave no motion.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum MotionFailure {
    /// Too little texture, or too little depth on it.
    #[error("too few features: {found} with depth, {needed} needed")]
    TooFewFeatures {
        /// Features with depth.
        found: usize,
        /// The least that is accepted.
        needed: usize,
    },
    /// The two frames have too little in common.
    #[error("too few matches: {found}, {needed} needed")]
    TooFewMatches {
        /// Matches.
        found: usize,
        /// The least that is accepted.
        needed: usize,
    },
    /// No rigid motion explains enough of the matches.
    #[error("too few inliers: {found}, {needed} needed")]
    TooFewInliers {
        /// Inliers of the best motion.
        found: usize,
        /// The least that is accepted.
        needed: usize,
    },
    /// The inliers leave a direction open (all on a line, or in one spot).
    #[error("degenerate geometry: the weakest direction is uncertain by {sigma:.3} m")]
    DegenerateGeometry {
        /// Standard deviation along the weakest direction at the points' distance, metres.
        sigma: f64,
    },
}
