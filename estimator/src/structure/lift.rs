//! Features lifted to 3D points with covariance.

use nalgebra::{Isometry3, Matrix3, Point2, Point3, Vector3};
use serde::{Deserialize, Serialize};

use super::RegisteredDepth;
use crate::camera::CameraModel;
use crate::features::surf::Feature;

/// How uncertain a pixel and its depth are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DepthNoise {
    /// σ_z = this · z²: half the quantisation step of a Kinect v1 (Khoshelham & Elberink 2012), 1/m.
    #[serde(rename = "axial_per_m")]
    pub axial: f64,
    /// σ of a feature's position in the image at scale s = 1; grows with s. Pixels.
    #[serde(rename = "pixel_sigma_px")]
    pub pixel_sigma: f64,
    /// Depths beyond this are not used. Metres.
    #[serde(rename = "max_depth_m")]
    pub max_depth: f64,
    /// A feature about which depth scatters by more than this share of it has none: it lies on the edge of a surface,
    /// and nobody knows whether it belongs to that or to what is behind. 0–1.
    pub max_scatter: f64,
    /// Half the edge of the window that depth is gathered from, pixels; at most [`MAX_WINDOW`].
    #[serde(rename = "window_px")]
    pub window: usize,
}

impl Default for DepthNoise {
    fn default() -> Self {
        Self { axial: 1.425e-3, pixel_sigma: 0.75, max_depth: 8.0, max_scatter: 0.05, window: 3 }
    }
}

/// Largest half edge of the window that depth is gathered from, pixels.
pub const MAX_WINDOW: usize = 5;

/// A feature's place in space, in the colour camera's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landmark {
    /// Position, metres.
    pub position: Point3<f64>,
    /// Its covariance, m².
    pub covariance: Matrix3<f64>,
}

impl Landmark {
    /// The same point in another frame: `to_from_here` takes this frame's coordinates there.
    pub fn moved(&self, to_from_here: &Isometry3<f64>) -> Self {
        let rotation = to_from_here.rotation.to_rotation_matrix();
        Self {
            position: to_from_here * self.position,
            covariance: rotation.matrix() * self.covariance * rotation.matrix().transpose(),
        }
    }
}

/// The depth at a pixel and its standard deviation, metres; `None` where there is too little of it. Depth is the
/// median of a small window, at least half of which must hold values; what the window scatters is added to σ_z, so
/// that a point on a depth edge weighs little.
pub fn depth_at(x: f32, y: f32, depth: &RegisteredDepth, noise: &DepthNoise) -> Option<(f64, f64)> {
    let reach = noise.window;
    let (x, y) = (x.round() as usize, y.round() as usize);
    let rows = y.saturating_sub(reach)..=(y + reach).min(depth.height() - 1);
    let columns = x.saturating_sub(reach)..=(x + reach).min(depth.width() - 1);
    let mut around = [0.0_f32; (2 * MAX_WINDOW + 1).pow(2)];
    let mut count = 0;
    for row in rows {
        for &z in &depth.row(row)[columns.clone()] {
            around[count] = z;
            count += usize::from(z > 0.0);
        }
    }
    if 2 * count < (2 * reach + 1).pow(2) {
        return None;
    }
    let around = &mut around[..count];
    around.sort_unstable_by(f32::total_cmp);
    let z = f64::from(around[count / 2]);
    // Half the distance between the quartiles is 0.67 σ of a normal scatter.
    let scatter = f64::from(around[count * 3 / 4] - around[count / 4]) * (0.5 / 0.6745);
    (z <= noise.max_depth && scatter <= noise.max_scatter * z).then(|| (z, (noise.axial * z * z).hypot(scatter)))
}

/// The 3D point of one feature; `None` without trustworthy depth.
pub fn lift(feature: &Feature, depth: &RegisteredDepth, camera: &CameraModel, noise: &DepthNoise) -> Option<Landmark> {
    let (z, sigma_z) = depth_at(feature.x, feature.y, depth, noise)?;
    let ray = camera.ray(&Point2::new(f64::from(feature.x), f64::from(feature.y)));
    let sigma = noise.pixel_sigma * f64::from(feature.scale);
    let (sigma_x, sigma_y) = (sigma * z / camera.fx, sigma * z / camera.fy);
    let across = Matrix3::from_diagonal(&Vector3::new(sigma_x * sigma_x, sigma_y * sigma_y, 0.0));
    let along = ray * ray.transpose() * (sigma_z * sigma_z);
    Some(Landmark { position: Point3::from(ray * z), covariance: across + along })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Rig;

    fn feature(x: f32, y: f32) -> Feature {
        Feature { x, y, scale: 2.0, orientation: 0.0, response: 1.0, laplacian_positive: true, descriptor: [0.0; 64] }
    }

    fn lifted(depth: &RegisteredDepth, x: f32, y: f32) -> Option<Landmark> {
        lift(&feature(x, y), depth, &Rig::kinect_default().colour, &DepthNoise::default())
    }

    #[test]
    fn twice_as_far_is_four_times_as_uncertain() {
        let sigma = |z: f32| {
            let landmark = lifted(&RegisteredDepth::filled(640, 480, z), 319.5, 239.5).unwrap();
            assert!((landmark.position.z - f64::from(z)).abs() < 1e-6);
            landmark.covariance[(2, 2)].sqrt()
        };
        // Half of Kinect's step at 2 m: 5.7 mm (Khoshelham & Elberink 2012).
        assert!((sigma(2.0) - 0.0057).abs() < 1e-4);
        assert!((sigma(4.0) / sigma(2.0) - 4.0).abs() < 1e-6);
    }

    #[test]
    fn a_point_on_an_edge_has_none_and_one_on_a_slant_is_trusted_less() {
        let mut edge = RegisteredDepth::filled(640, 480, 3.0);
        let mut slant = edge.clone();
        for (edge, slant) in edge.pixels_mut().chunks_mut(640).zip(slant.pixels_mut().chunks_mut(640)) {
            edge[320..].fill(1.0);
            slant.iter_mut().enumerate().for_each(|(x, z)| *z += 0.02 * (x as f32 - 320.0));
        }
        let sigma = |depth, x: f32| lifted(depth, x, 240.0).map(|landmark| landmark.covariance[(2, 2)].sqrt());
        assert_eq!(sigma(&edge, 320.0), None);
        assert!(sigma(&edge, 340.0).unwrap() < 0.01);
        // Two centimetres a pixel, half of the window within two pixels of the middle.
        let slanted = sigma(&slant, 320.0).unwrap();
        assert!((0.03..0.09).contains(&slanted), "{slanted}");
    }

    #[test]
    fn no_depth_no_landmark() {
        let nothing = RegisteredDepth::filled(640, 480, 0.0);
        assert_eq!(lifted(&nothing, 320.0, 240.0), None);
        assert_eq!(lifted(&RegisteredDepth::filled(640, 480, 9.5), 320.0, 240.0), None);
        // In a corner there is only a quarter of the window.
        for (x, y) in [(-0.4, 0.0), (639.0, 479.4), (639.4, 0.0), (0.0, 479.0)] {
            assert_eq!(lifted(&RegisteredDepth::filled(640, 480, 2.0), x, y), None);
        }
    }
}
