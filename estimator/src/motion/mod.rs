//! Rigid motion from matched 3D points: `rigid` (closed form, paper A Eq. 4) inside `ransac`, then either the
//! paper's reject-and-refit (`paper`) or least squares weighted by the points' uncertainty (`refine`); or from all pixels
//! of two views (`dense`); or, without depth, from rays alone (`epipolar`), its length by the ground below (`ground`) or
//! the inverse depths of a short baseline (`inverse_depth`).

mod annealed;
mod dense;
mod epipolar;
mod ground;
mod inverse_depth;
mod paper;
mod ransac;
mod refine;
mod rigid;

use nalgebra::{Isometry3, Matrix6};
use thiserror::Error;

use crate::structure::Landmark;

pub use dense::{DenseMotion, align, misfit};
pub use epipolar::{EpipolarMotion, RayPair, Rolled, epipolar_motion};
pub use ground::{GroundPlane, Scale, scale_over_ground};
pub use inverse_depth::{DepthPair, Expected, inverse_depth_motion};
pub use paper::{PaperMotionParams, icp_surf};
pub use ransac::{RansacParams, ransac};
pub use refine::{RefineParams, refine};
pub use rigid::fit_rigid;

/// The same thing seen twice: in the camera's frame now, and in the frame of reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// In the camera's frame.
    pub camera: Landmark,
    /// In the reference frame.
    pub reference: Landmark,
}

/// A motion and how sure it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Camera frame → reference frame.
    pub reference_from_camera: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ), in the reference frame; m², m·rad, rad².
    pub covariance: Matrix6<f64>,
    /// For each pair, whether it agrees.
    pub inliers: Vec<bool>,
}

impl Motion {
    /// How many pairs agree.
    pub fn inlier_count(&self) -> usize {
        self.inliers.iter().filter(|&&inlier| inlier).count()
    }
}

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
    /// The motion that explains the matches is far from the wheels', and explains them badly.
    #[error("a motion {sigmas:.1} σ from the wheels', of matches that hardly agree")]
    AgainstTheWheels {
        /// How far it is from where the wheels say, in the σ of what robots skid by.
        sigmas: f64,
    },
    /// The first frame of its kind after a change of mode.
    #[error("no earlier frame of the mode's images")]
    NoReference,
    /// The mode goes by the wheels: no image can be trusted.
    #[error("no image that the mode trusts")]
    NotSought,
}
