//! SURF: Bay, Ess, Tuytelaars, Van Gool, *Speeded-Up Robust Features*, CVIU 110 (2008) 346–359.
//! Section numbers below are that paper's.
//!
//! `integral` (§3.1) → `hessian` (§3.2–3.4: responses, scale-space maxima) → `spread` (which of them to keep)
//! → `descriptor` (§4: orientation and the 64 numbers).

mod descriptor;
mod hessian;
mod integral;
mod spread;

use serde::{Deserialize, Serialize};

use crate::image::GrayImage;
use descriptor::describe;
use hessian::Detector;
pub use hessian::Maximum;
use integral::IntegralImage;

/// A point of interest and its descriptor.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Column, pixels.
    pub x: f32,
    /// Row, pixels.
    pub y: f32,
    /// Scale s of §3.3: the σ of the Gaussian that the box filter stands for, pixels (9×9 filter: 1.2).
    pub scale: f32,
    /// Direction of the strongest gradient, radians from +x towards +y.
    pub orientation: f32,
    /// Determinant of the approximated Hessian, for luma in 0–255 and filters normalised by their area.
    pub response: f32,
    /// Sign of the trace: dark blob on light (true) or light on dark (§4.3).
    pub laplacian_positive: bool,
    /// 4×4 regions × (Σdx, Σdy, Σ|dx|, Σ|dy|), unit length.
    pub descriptor: [f32; 64],
}

/// Parameters of the detector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SurfParams {
    /// Features kept a frame, at most.
    pub max_features: usize,
    /// Least response (see [`Feature::response`]). A guess that keeps noise of a few grey levels out;
    /// dlib's detector uses 30 on the same scale.
    pub min_response: f32,
    /// Octaves of scale space, 1–4 (§3.3). Three reach s = 10 px.
    pub octaves: usize,
    /// The image is cut into cells of this edge; each may hold about its fair share of the budget, so that one
    /// poster does not win. Pixels.
    #[serde(rename = "cell_px")]
    pub cell: usize,
}

impl Default for SurfParams {
    fn default() -> Self {
        Self { max_features: 700, min_response: 8.0, octaves: 3, cell: 80 }
    }
}

/// The detector with its working memory, reused from frame to frame.
pub struct Surf {
    params: SurfParams,
    integral: IntegralImage,
    detector: Detector,
}

impl Surf {
    /// A detector; it allocates on first use.
    pub fn new(params: SurfParams) -> Self {
        Self { params, integral: IntegralImage::default(), detector: Detector::default() }
    }

    /// Features of `image`, strongest first, at most `max_features`, spread over the image.
    pub fn detect(&mut self, image: &GrayImage) -> Vec<Feature> {
        self.detect_where(image, |_, _, _| true)
    }

    /// Features of `image` at places (x, y) and scales, all in pixels, that are `wanted`: others cost no budget.
    pub fn detect_where(&mut self, image: &GrayImage, wanted: impl Fn(f32, f32, f32) -> bool) -> Vec<Feature> {
        let kept = self.points(image, wanted);
        describe(&self.integral, &kept)
    }

    /// The same places, not described.
    pub fn points(&mut self, image: &GrayImage, wanted: impl Fn(f32, f32, f32) -> bool) -> Vec<Maximum> {
        self.integral.compute(image);
        let mut maxima = self.detector.maxima(&self.integral, self.params.octaves, self.params.min_response);
        maxima.retain(|maximum| wanted(maximum.x, maximum.y, maximum.scale));
        spread::spread(maxima, image.size(), self.params.cell, self.params.max_features)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    /// A soft blob of the given σ, dark (negative) or light, on grey.
    fn blob(centre: (f32, f32), sigma: f32, amplitude: f32) -> GrayImage {
        let mut image = GrayImage::filled(160, 120, 128);
        for (index, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let (dx, dy) = ((index % 160) as f32 - centre.0, (index / 160) as f32 - centre.1);
            *pixel = (128.0 + amplitude * (-(dx * dx + dy * dy) / (2.0 * sigma * sigma)).exp()).round() as u8;
        }
        image
    }

    fn strongest(image: &GrayImage) -> Feature {
        Surf::new(SurfParams::default()).detect(image).remove(0)
    }

    #[test]
    fn a_blob_is_found_where_it_is_with_its_size() {
        for sigma in [3.0_f32, 4.5, 6.0] {
            let feature = strongest(&blob((80.3, 60.6), sigma, 90.0));
            assert!((feature.x - 80.3).abs() < 0.25 && (feature.y - 60.6).abs() < 0.25, "{sigma}: {feature:?}");
            // Box filters answer best to a blob √2 wider than the Gaussian that they are named after.
            let expected = sigma / 2.0_f32.sqrt();
            assert!((feature.scale / expected - 1.0).abs() < 0.05, "σ {sigma} came out as {}", feature.scale);
        }
    }

    #[test]
    fn the_laplacian_tells_dark_from_light() {
        assert!(strongest(&blob((80.0, 60.0), 3.0, -90.0)).laplacian_positive);
        assert!(!strongest(&blob((80.0, 60.0), 3.0, 90.0)).laplacian_positive);
    }

    #[test]
    fn a_bare_wall_has_no_features() {
        assert!(Surf::new(SurfParams::default()).detect(&GrayImage::filled(640, 480, 90)).is_empty());
        assert!(Surf::new(SurfParams::default()).detect(&GrayImage::filled(8, 8, 90)).is_empty());
    }

    /// A blob with a brighter side, so that its orientation is defined.
    fn leaning(angle: f32) -> GrayImage {
        let mut image = blob((80.0, 60.0), 4.0, 40.0);
        for (index, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let (dx, dy) = ((index % 160) as f32 - 80.0, (index / 160) as f32 - 60.0);
            let along = dx * angle.cos() + dy * angle.sin();
            *pixel = (f32::from(*pixel) + along * 2.0).clamp(0.0, 255.0).round() as u8;
        }
        image
    }

    #[test]
    fn orientation_turns_with_the_image() {
        for step in 0..12 {
            let angle = step as f32 * PI / 6.0;
            let found = Surf::new(SurfParams::default())
                .detect(&leaning(angle))
                .into_iter()
                .min_by(|a, b| (a.x - 80.0).hypot(a.y - 60.0).total_cmp(&(b.x - 80.0).hypot(b.y - 60.0)))
                .unwrap();
            let error = (found.orientation - angle).rem_euclid(2.0 * PI);
            let error = error.min(2.0 * PI - error);
            assert!(error < 0.2, "{angle}: {}", found.orientation);
        }
    }

    #[test]
    fn descriptors_have_unit_length() {
        for feature in Surf::new(SurfParams::default()).detect(&leaning(0.7)) {
            let norm: f32 = feature.descriptor.iter().map(|value| value * value).sum();
            assert!((norm - 1.0).abs() < 1e-4);
        }
    }
}
