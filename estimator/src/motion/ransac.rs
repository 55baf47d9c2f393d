//! The motion that most pairs agree with (Fischler & Bolles 1981).

use nalgebra::{Isometry3, Matrix3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::{MotionFailure, Pair, fit_rigid};

/// Parameters of the search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RansacParams {
    /// Samples tried, at most.
    pub max_iterations: usize,
    /// The search ends when a better sample has been missed with no more than this probability.
    pub miss_probability: f64,
    /// Largest Mahalanobis distance of an inlier, in σ; √χ²(3, 0.95) = 2.8.
    pub max_distance_sigma: f64,
    /// Fewest inliers of a motion that is believed.
    pub min_inliers: usize,
}

impl Default for RansacParams {
    fn default() -> Self {
        Self { max_iterations: 300, miss_probability: 1e-3, max_distance_sigma: 2.8, min_inliers: 12 }
    }
}

/// The sample motion `reference_from_camera` with the most inliers. Equal pairs give an equal answer: the samples
/// come from a generator that is seeded here.
///
/// # Errors
/// [`MotionFailure::TooFewMatches`] or [`MotionFailure::TooFewInliers`].
pub fn ransac(pairs: &[Pair], params: &RansacParams) -> Result<Isometry3<f64>, MotionFailure> {
    let needed = params.min_inliers.max(3);
    if pairs.len() < needed {
        return Err(MotionFailure::TooFewMatches { found: pairs.len(), needed });
    }
    // The rotation between the two frames turns one of the two covariances; for choosing among samples it can be
    // left out, and the weights can be made once.
    let information: Vec<Matrix3<f64>> = pairs
        .iter()
        .map(|pair| (pair.camera.covariance + pair.reference.covariance).try_inverse().unwrap_or_else(Matrix3::zeros))
        .collect();
    let limit = params.max_distance_sigma * params.max_distance_sigma;
    let agrees = |motion: &Isometry3<f64>, index: usize| {
        let pair = &pairs[index];
        let error = motion * pair.camera.position - pair.reference.position;
        error.dot(&(information[index] * error)) < limit
    };

    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut best: Option<(usize, Isometry3<f64>)> = None;
    let mut iterations = params.max_iterations;
    let mut iteration = 0;
    while iteration < iterations {
        iteration += 1;
        let sample = three_of(pairs.len(), &mut random);
        let chosen = sample.iter().map(|&index| (&pairs[index].camera.position, &pairs[index].reference.position));
        let Some(motion) = fit_rigid(chosen) else { continue };
        // A sample that its own motion does not explain is no sample of a rigid motion.
        if !sample.iter().all(|&index| agrees(&motion, index)) {
            continue;
        }
        let count = (0..pairs.len()).filter(|&index| agrees(&motion, index)).count();
        if best.is_none_or(|(most, _)| count > most) {
            best = Some((count, motion));
            let share = (count as f64 / pairs.len() as f64).powi(3);
            let enough = (params.miss_probability.ln() / (1.0 - share).max(1e-12).ln()).ceil();
            iterations = params.max_iterations.min(enough as usize);
        }
    }
    match best {
        Some((count, motion)) if count >= needed => Ok(motion),
        found => Err(MotionFailure::TooFewInliers { found: found.map_or(0, |(count, _)| count), needed }),
    }
}

/// Three different indices below `count`, `count` ≥ 3.
fn three_of(count: usize, random: &mut impl Rng) -> [usize; 3] {
    let mut draw = || random.random_range(0..count as u64) as usize;
    let first = draw();
    let second = loop {
        let index = draw();
        if index != first {
            break index;
        }
    };
    let third = loop {
        let index = draw();
        if index != first && index != second {
            break index;
        }
    };
    [first, second, third]
}
