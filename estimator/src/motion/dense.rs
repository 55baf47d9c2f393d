//! Motion between two views by all of their pixels: shade against shade, and depth against depth as far as the geometry
//! says where the camera is (after Kerl, Sturm & Cremers 2013). For images whose texture is too faint for features.

use nalgebra::{Isometry3, Matrix6, Point3, SMatrix, SVector, Vector3, Vector6};

use super::MotionFailure;
use crate::geometry::exp_se3;
use crate::structure::{DenseView, PIXELS};

/// A motion by all pixels.
#[derive(Clone, Debug)]
pub struct DenseMotion {
    /// The reference camera's frame → the camera's.
    pub camera_from_reference: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ), in the camera's frame; m², m·rad, rad².
    pub covariance: Matrix6<f64>,
    /// How far the pixels moved, root of the mean square; pixels of the sensor.
    pub flow: f64,
    /// Share of the reference's pixels that are seen again, 0–1.
    pub overlap: f64,
}

/// Rounds, at most.
const ITERATIONS: usize = 12;
/// A step that moves less than this ends them, metres and radians.
const STEP_TOLERANCE: f64 = 2e-5;
/// Shade that changes by less than so many σ of its noise a pixel of the grid may be nothing else, and where it is fixed to
/// the sensor it says that nothing moved.
const STEEP: f32 = 3.0;
/// σ of depth against depth: this · z², metres. Half a step of a Kinect on both sides.
const AXIAL: f64 = 2.0e-3;
/// σ of the place that a depth is of, pixels of the grid: a Kinect's matcher takes it from a window as large as two.
const PLACE: f64 = 0.3;
/// Surfaces farther from each other than this share of their depth are different ones.
const SAME_SURFACE: f64 = 0.04;
/// σ of the slope of depth, an AXIAL's σ of depth a pixel of the grid: the mean of a block is half as noisy, and a slope is
/// half the difference of two.
const SLOPE: f64 = 0.1;
/// A flat wall's noise looks like slopes that say where along it the camera is. So many times of what noise makes of
/// a flat wall is nothing.
const NOTHING: f64 = 3.0;
/// Depth that changes by more than this share from one pixel of the grid to the next is no surface but an edge.
const EDGE: f64 = 0.08;
/// Scale of the Cauchy weight, in σ (see [`RefineParams`](super::RefineParams)).
const CAUCHY: f64 = 2.0;
/// Neighbours share the noise of the filters before them: so many pixels of the grid are worth one.
const CORRELATED: f64 = 6.0;
/// Least share of the reference that must be seen again.
const LEAST_OVERLAP: f64 = 0.25;
/// σ of shade where two motions are compared, levels.
const MISFIT_SIGMA: f64 = 6.0;
/// What a pixel costs in whose place another surface is seen, or none. A guess.
const UNSEEN: f64 = 4.0;
/// Least σ of shade, levels: what the projector's speckle leaves.
const LEAST_SHADE_SIGMA: f64 = 1.5;

type Matrix7 = SMatrix<f64, 7, 7>;
type Vector7 = SVector<f64, 7>;

/// Aligns `camera` to `reference` from `start`, the reference camera's frame → the camera's.
///
/// # Errors
/// [`MotionFailure::TooFewInliers`] or [`MotionFailure::DegenerateGeometry`].
pub fn align(
    reference: &DenseView,
    camera: &DenseView,
    start: &Isometry3<f64>,
    max_weakest_sigma: f64,
) -> Result<DenseMotion, MotionFailure> {
    let mut motion = *start;
    let mut last = None;
    // Shade is relative to each image's median: the difference is found along with the motion.
    let mut offset = 0.0;
    let mut sigma = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let system = System::at(&motion, offset, sigma, reference, camera, 1);
        sigma = system.shade_sigma;
        let (hessian, gradient) = system.normal();
        last = Some(system);
        let Some(cholesky) = hessian.cholesky() else { break };
        let step: Vector7 = -cholesky.solve(&gradient);
        motion = exp_se3(&step.fixed_rows::<6>(0).into_owned()) * motion;
        offset += step[6];
        if step.fixed_rows::<6>(0).norm() < STEP_TOLERANCE {
            break;
        }
    }
    // Products of many unit quaternions are none, and what starts from this one would make it worse.
    motion.rotation.renormalize();
    let Some(system) = last else { return Err(MotionFailure::NotSought) };
    let needed = (LEAST_OVERLAP * system.possible as f64) as usize;
    if system.seen < needed.max(1) {
        return Err(MotionFailure::TooFewInliers { found: system.seen, needed });
    }
    let degenerate = MotionFailure::DegenerateGeometry { sigma: f64::INFINITY };
    let inverse = system.normal().0.cholesky().ok_or(degenerate)?.inverse();
    let covariance: Matrix6<f64> = inverse.fixed_view::<6, 6>(0, 0) * CORRELATED;
    let sigma = weakest_sigma(&covariance, system.depth);
    if sigma.is_nan() || sigma > max_weakest_sigma {
        return Err(MotionFailure::DegenerateGeometry { sigma });
    }
    Ok(DenseMotion {
        camera_from_reference: motion,
        covariance,
        flow: system.flow,
        overlap: system.seen as f64 / system.possible.max(1) as f64,
    })
}

/// How badly a motion explains the views: the mean robust cost a pixel, looked at in every third of them both ways.
pub fn misfit(reference: &DenseView, camera: &DenseView, motion: &Isometry3<f64>) -> f64 {
    let system = System::at(motion, 0.0, MISFIT_SIGMA, reference, camera, 3);
    let is_out_of_sight = (system.in_view as f64) < LEAST_OVERLAP * system.possible as f64;
    if is_out_of_sight { f64::INFINITY } else { system.cost }
}

/// Normal equations at one motion.
struct System {
    shade: (Matrix7, Vector7),
    geometry: (Matrix6<f64>, Vector6<f64>),
    /// What noise alone makes of the geometry along a direction that it does not constrain.
    noise: f64,
    shade_sigma: f64,
    /// Pixels of the reference with depth, those in view, and those seen again.
    possible: usize,
    in_view: usize,
    seen: usize,
    /// Their mean depth, metres.
    depth: f64,
    flow: f64,
    cost: f64,
}

impl System {
    fn at(
        motion: &Isometry3<f64>,
        offset: f64,
        sigma: f64,
        reference: &DenseView,
        camera: &DenseView,
        every: usize,
    ) -> Self {
        let mut system = Self {
            shade: (Matrix7::zeros(), Vector7::zeros()),
            geometry: (Matrix6::zeros(), Vector6::zeros()),
            noise: 0.0,
            shade_sigma: sigma,
            possible: 0,
            in_view: 0,
            seen: 0,
            depth: 0.0,
            flow: 0.0,
            cost: 0.0,
        };
        let mut residuals: Vec<f32> = Vec::new();
        let mut rows = Vec::new();
        let (width, height) = reference.depth.size();
        let (fx, fy) = (camera.camera.fx, camera.camera.fy);
        for y in (1..height - 1).step_by(every) {
            for x in (1..width - 1).step_by(every) {
                let z = reference.depth.at(x, y);
                if z == 0.0 {
                    continue;
                }
                system.possible += 1;
                let point = motion * Point3::from(reference.rays[y * width + x] * f64::from(z));
                let Some(pixel) = camera.camera.project(&point) else { continue };
                let (u, v) = (pixel.x as f32, pixel.y as f32);
                if !camera.shows(u, v) {
                    continue;
                }
                system.in_view += 1;
                let Some([found, slope_x, slope_y]) = camera.sample(&camera.depth, u, v) else { continue };
                if f64::from(slope_x.hypot(slope_y)) > EDGE * point.z {
                    continue;
                }
                let apart = found - point.z as f32;
                // d(value at the pixel)/d(point), by the chain of projection and gradient.
                let across = |gradient: [f32; 2]| {
                    let (a, b) = (f64::from(gradient[0]) * fx / point.z, f64::from(gradient[1]) * fy / point.z);
                    Vector3::new(a, b, -(a * point.x + b * point.y) / point.z)
                };
                // Along the surface's normal, which this row points along, the distance is smaller by its length.
                let row = across([slope_x, slope_y]) - Vector3::z();
                if f64::from(apart.abs()) > SAME_SURFACE * point.z * row.norm() {
                    continue;
                }
                system.seen += 1;
                system.depth += point.z;
                system.flow += (pixel.x - x as f64).powi(2) + (pixel.y - y as f64).powi(2);
                // A slanted surface's depth is as uncertain as the place that it is read at.
                let slant = PLACE * f64::from(slope_x.hypot(slope_y));
                let variance = (AXIAL * point.z * point.z).powi(2) + slant * slant;
                let squared = f64::from(apart).powi(2) / variance;
                let weight = 1.0 / (1.0 + squared / (CAUCHY * CAUCHY)) / variance;
                system.cost += (1.0 + squared / (CAUCHY * CAUCHY)).ln();
                system.noise += weight * (SLOPE * AXIAL * point.z * fx).powi(2);
                add(&mut system.geometry, &full(&point, &row), f64::from(apart), weight);
                let Some([shade, gradient_x, gradient_y]) = camera.sample(&camera.shade, u, v) else { continue };
                let before = reference.shade.at(x, y);
                if reference.steepness(x, y) < STEEP * reference.shade_noise || shade == 0.0 || before == 0.0 {
                    continue;
                }
                let residual = shade - before - offset as f32;
                residuals.push(residual.abs());
                rows.push((full(&point, &across([gradient_x, gradient_y])), residual));
            }
        }
        let middle = residuals.len() / 2;
        if !residuals.is_empty() {
            let median = *residuals.select_nth_unstable_by(middle, f32::total_cmp).1;
            system.shade_sigma = (1.4826 * f64::from(median)).max(LEAST_SHADE_SIGMA);
        }
        let sigma = if sigma.is_finite() { sigma } else { system.shade_sigma };
        for (row, residual) in rows {
            let residual = f64::from(residual);
            let squared = (residual / sigma).powi(2);
            let weight = 1.0 / (1.0 + squared / (CAUCHY * CAUCHY)) / (sigma * sigma);
            system.cost += (1.0 + squared / (CAUCHY * CAUCHY)).ln();
            let row = Vector7::from_fn(|i, _| if i < 6 { row[i] } else { -1.0 });
            add(&mut system.shade, &row, residual, weight);
        }
        let seen = system.seen.max(1) as f64;
        system.depth /= seen;
        system.flow = PIXELS as f64 * (system.flow / seen).sqrt();
        // What is in view and not seen counts as badly explained.
        system.cost = (system.cost + UNSEEN * (system.in_view - system.seen) as f64) / system.in_view.max(1) as f64;
        system
    }

    /// Both together: of the geometry only what it constrains.
    fn normal(&self) -> (Matrix7, Vector7) {
        let (mut hessian, mut gradient) = self.shade;
        // Along a direction that nothing constrains the offset still needs a pivot.
        hessian[(6, 6)] += 1e-9;
        // Turns count as the way that they move what is seen.
        let turn = 1.0 / self.depth.max(0.1);
        let scale = Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, turn, turn, turn));
        let unscale = Matrix6::from_diagonal(&Vector6::new(1.0, 1.0, 1.0, 1.0 / turn, 1.0 / turn, 1.0 / turn));
        let eigen = (scale * self.geometry.0 * scale).symmetric_eigen();
        // As much of each direction as is more than noise.
        let mut kept = Matrix6::zeros();
        let mut constrained = Matrix6::zeros();
        for (&value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            let share = (1.0 - NOTHING * self.noise / value.max(f64::MIN_POSITIVE)).max(0.0);
            kept += vector * vector.transpose() * share;
            constrained += vector * vector.transpose() * (share * value);
        }
        let constrained = unscale * constrained * unscale;
        let pull = unscale * kept * scale * self.geometry.1;
        let mut corner = hessian.fixed_view_mut::<6, 6>(0, 0);
        corner += constrained;
        let mut top = gradient.fixed_rows_mut::<6>(0);
        top += pull;
        (hessian, gradient)
    }
}

/// From d/d(point) to d/d(ρ, φ): the point moves by ρ + φ × point.
fn full(point: &Point3<f64>, row: &Vector3<f64>) -> Vector6<f64> {
    let turn = point.coords.cross(row);
    Vector6::new(row.x, row.y, row.z, turn.x, turn.y, turn.z)
}

fn add<const N: usize>(
    system: &mut (SMatrix<f64, N, N>, SVector<f64, N>),
    row: &SVector<f64, N>,
    residual: f64,
    weight: f64,
) {
    system.0.ger(weight, row, row, 1.0);
    system.1.axpy(weight * residual, row, 1.0);
}

/// σ of the weakest direction in which what is seen may move; metres.
fn weakest_sigma(covariance: &Matrix6<f64>, depth: f64) -> f64 {
    let mut jacobian = SMatrix::<f64, 3, 6>::identity();
    jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-crate::geometry::skew(&(Vector3::z() * depth)));
    (jacobian * covariance * jacobian.transpose()).symmetric_eigenvalues().max().max(0.0).sqrt()
}

#[cfg(test)]
mod tests;
