//! Least squares that begins by forgiving much: what both motions from rays descend by.

use nalgebra::{Isometry3, Matrix6, Vector6};

use crate::geometry::exp_se3;

/// Scale of the Cauchy weight, in σ.
const CAUCHY: f64 = 1.5;
/// In the first rounds the weight is this much wider: the wheels may be off by a degree. Falls by half each round.
const FIRST_WIDTH: f64 = 16.0;
/// A step that moves less than this ends it, metres and radians.
const STEP_TOLERANCE: f64 = 1e-7;

/// Gauss-Newton from `start`, in so many rounds at most. `normal` gives Hessian and gradient of a left perturbation
/// (ρ, φ) for a motion and a scale of the Cauchy weight; `hold` puts right what a step may not change.
pub(super) fn annealed(
    start: &Isometry3<f64>,
    rounds: usize,
    normal: impl Fn(&Isometry3<f64>, f64) -> (Matrix6<f64>, Vector6<f64>),
    hold: impl Fn(&mut Isometry3<f64>),
) -> Isometry3<f64> {
    let mut motion = *start;
    let mut width = FIRST_WIDTH;
    for _ in 0..rounds {
        let (hessian, gradient) = normal(&motion, CAUCHY * width);
        let Some(cholesky) = hessian.cholesky() else { break };
        let step: Vector6<f64> = -cholesky.solve(&gradient);
        motion = exp_se3(&step) * motion;
        hold(&mut motion);
        if width == 1.0 && step.norm() < STEP_TOLERANCE {
            break;
        }
        width = (0.5 * width).max(1.0);
    }
    // Products of many unit quaternions are none.
    motion.rotation.renormalize();
    motion
}
