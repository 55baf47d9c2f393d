//! Image energy: E = mean of I², I being a pixel's value as a share of full scale, 0 to 1 (paper A, equation 20; what is
//! printed there, ΣI²/(255·N·M), would reach 255).
//!
//! Of depth a pixel is worth 1 that has a value, however far away it is, and 0 one that has none. By distance, as the paper's
//! images have it, a wall 0.4 m ahead would be a hundredth of one at 4 m, and one sparse far corner as much as a near
//! wall.

use serde::Serialize;

use crate::camera::DepthCamera;
use crate::image::{DepthImage, InfraredImage, RgbImage};

/// Largest infrared value: 10 bits.
const INFRARED_FULL_SCALE: f64 = 1023.0;

/// Energies of the images of one instant, or their means over many; `None` where there was no such image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Energies {
    /// Of colour.
    pub rgb: Option<f64>,
    /// Of infrared.
    pub infrared: Option<f64>,
    /// Of depth.
    pub depth: Option<f64>,
}

/// Of a colour image: luma.
pub fn of_colour(image: &RgbImage) -> f64 {
    mean_square(image.to_luma().pixels(), |luma| f64::from(luma) / 255.0)
}

/// Of an infrared image.
pub fn of_infrared(image: &InfraredImage) -> f64 {
    mean_square(image.pixels(), |number| f64::from(number) / INFRARED_FULL_SCALE)
}

/// Of a depth image: the share of its pixels with a value.
pub fn of_depth(image: &DepthImage, camera: &DepthCamera) -> f64 {
    mean_square(image.pixels(), |value| f64::from(u8::from(camera.depth_of(value).is_some())))
}

/// 0 of nothing.
fn mean_square<P: Copy>(pixels: &[P], share: impl Fn(P) -> f64) -> f64 {
    pixels.iter().map(|&pixel| share(pixel).powi(2)).sum::<f64>() / pixels.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Rig;

    #[test]
    fn full_scale_is_one_and_nothing_is_none() {
        assert_eq!(of_colour(&RgbImage::filled(4, 3, [255; 3])), 1.0);
        assert_eq!(of_infrared(&InfraredImage::filled(4, 3, 1023)), 1.0);
        assert_eq!(of_colour(&RgbImage::filled(4, 3, [0; 3])), 0.0);
        // A grey of half the scale has a quarter of the energy.
        assert!((of_infrared(&InfraredImage::filled(4, 3, 512)) - 0.25).abs() < 1e-3);
    }

    #[test]
    fn depth_counts_wherever_it_is() {
        // 5000 units a metre, 0 = no value.
        let camera = Rig::kinect_default().depth;
        assert_eq!(of_depth(&DepthImage::filled(4, 3, 0), &camera), 0.0);
        for near_or_far in [2_000, 10_000, 50_000] {
            assert_eq!(of_depth(&DepthImage::filled(4, 3, near_or_far), &camera), 1.0);
        }
        let mut half = DepthImage::filled(4, 3, 20_000);
        half.pixels_mut()[..6].fill(0);
        assert_eq!(of_depth(&half, &camera), 0.5);
    }
}
