//! A match to a fraction of a pixel.

use nalgebra::{Matrix2, Vector2};

use super::CrossMatch;
use super::descriptor::Descriptor;
use super::edges::Edges;

/// Between the nine places that are compared, pixels.
const SPACING: f32 = 1.0;
/// Rounds, at most.
const ROUNDS: usize = 4;
/// A step shorter than this ends it, pixels.
const ENOUGH: f32 = 0.02;
/// Further from where it began the peak is another one, pixels.
const FURTHEST: f32 = 4.0;
/// σ of a place found in the image itself with its contrast reversed, pixels.
const LEAST_SIGMA: f32 = 0.06;
/// σ, in what the peak is wide where it has fallen by as much as the two differ. From half of the recorded pairs, warped
/// onto each other: 0.2–0.3 over a tenfold range of widths.
const SIGMA_OF_WIDTH: f32 = 0.25;

/// Where the edges are most like a descriptor.
#[derive(Clone, Copy, Debug)]
pub struct Peak {
    pub x: f32,
    pub y: f32,
    pub similarity: f32,
    /// σ of `x`, pixels.
    pub sigma: f32,
}

impl Peak {
    /// The match of a place in the colour image with this one in the infrared image.
    pub fn matched_with(&self, colour: (f32, f32)) -> CrossMatch {
        CrossMatch { colour, infrared: (self.x, self.y), similarity: self.similarity, sigma: self.sigma }
    }
}

/// Where near `start` the edges are most like `wanted`: the peak of a quadric through nine places, again and again. `None`
/// where there is no such peak.
pub fn peak_near(wanted: &Descriptor, edges: &Edges, start: (f32, f32)) -> Option<Peak> {
    let start = Vector2::new(start.0, start.1);
    let similarity = |at: Vector2<f32>| wanted.similarity(&Descriptor::at(edges, at.x, at.y));
    let (mut at, mut curvature) = (start, 0.0);
    for _ in 0..ROUNDS {
        let quadric = Quadric::through(|dx, dy| similarity(at + SPACING * Vector2::new(dx, dy)))?;
        at += SPACING * quadric.step;
        curvature = quadric.curvature / (SPACING * SPACING);
        if (at - start).norm() > FURTHEST {
            return None;
        }
        if quadric.step.norm() < ENOUGH {
            break;
        }
    }
    let similarity = similarity(at);
    let width = ((1.0 - similarity).max(0.0) / curvature).sqrt();
    Some(Peak { x: at.x, y: at.y, similarity, sigma: LEAST_SIGMA.hypot(SIGMA_OF_WIDTH * width) })
}

/// What fits the values on a 3×3 grid best.
struct Quadric {
    /// From the middle to the peak, in grid steps, at most one either way.
    step: Vector2<f32>,
    /// How steeply it falls along the columns, the best row being chosen for each; per grid step squared.
    curvature: f32,
}

impl Quadric {
    /// `None` where there is no peak.
    fn through(value: impl Fn(f32, f32) -> f32) -> Option<Self> {
        let v: [[f32; 3]; 3] =
            std::array::from_fn(|row| std::array::from_fn(|column| value(column as f32 - 1.0, row as f32 - 1.0)));
        let row = |k: usize| v[k].iter().sum::<f32>();
        let column = |k: usize| v[0][k] + v[1][k] + v[2][k];
        // Least squares on the grid.
        let gradient = Vector2::new(column(2) - column(0), row(2) - row(0)) / 6.0;
        let xx = (column(0) + column(2) - 2.0 * column(1)) / 3.0;
        let yy = (row(0) + row(2) - 2.0 * row(1)) / 3.0;
        let xy = (v[0][0] + v[2][2] - v[0][2] - v[2][0]) / 4.0;
        let hessian = Matrix2::new(xx, xy, xy, yy);
        if xx >= 0.0 || hessian.determinant() <= 0.0 {
            return None;
        }
        let step = -(hessian.try_inverse()? * gradient);
        Some(Self { step: step.map(|offset| offset.clamp(-1.0, 1.0)), curvature: -hessian.determinant() / yy })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadrics_peak_is_found_exactly_and_a_ridge_has_none() {
        let bowl =
            |x: f32, y: f32| 0.9 - 0.02 * (x - 0.3).powi(2) - 0.03 * (y + 0.4).powi(2) + 0.01 * (x - 0.3) * (y + 0.4);
        let found = Quadric::through(bowl).unwrap();
        assert!((found.step - Vector2::new(0.3, -0.4)).norm() < 1e-4, "{}", found.step);
        // The Schur complement: 0.04 − 0.01²/0.06.
        assert!((found.curvature - (0.04 - 1e-4 / 0.06)).abs() < 1e-5, "{}", found.curvature);
        assert!(Quadric::through(|x, y| 0.9 - 0.02 * (x - y).powi(2) + 0.001 * (x + y).powi(2)).is_none());
        assert!(Quadric::through(|_, _| 0.5).is_none());
    }
}
