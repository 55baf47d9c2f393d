//! Images as JPEG: colour as it is, infrared in grey, depth in false colour, each on one scale for the whole run.

use std::io;

use base64::Engine;
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{FilterType, resize};
use image::{GrayImage, ImageEncoder, Luma, PixelWithColorType, Rgb, RgbImage};
use sunblind_estimator::image::{Image, InfraredImage};

use super::timing::quantile;
use crate::false_colour;
use crate::runner::log::{RunLog, Snapshot};

/// What a depth pixel without a value is drawn in: a grey, which the colours of depth never are.
pub(super) const NO_VALUE: [u8; 3] = [128, 132, 138];
/// Infrared values beyond those of this share are white, so that a sunlit window doesn't leave the rest in the dark.
const WHITE_SHARE: f64 = 0.95;
/// Infrared values are proportional to light, and a screen shows a value's power: about that of sRGB.
const GAMMA: f32 = 2.2;

/// What values mean in colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tones {
    /// Metres.
    pub nearest: f32,
    pub farthest: f32,
    /// The infrared value that is drawn white.
    white: f32,
}

impl Tones {
    /// Depths from the range that holds all but the outermost 2 % at either end.
    pub(super) fn of(log: &RunLog) -> Self {
        // As small as they are drawn: in infrared, the mean over dots and what is between them.
        let images: &[Snapshot] = if log.thumbnails.is_empty() { &log.snapshots } else { &log.thumbnails };
        let depths = images.iter().flat_map(|image| image.depth.pixels());
        let mut depths: Vec<f64> = depths.filter(|z| has_value(**z)).map(|&z| f64::from(z)).collect();
        depths.sort_by(f64::total_cmp);
        let (nearest, farthest) = if depths.is_empty() {
            (0.5, 5.0)
        } else {
            let (near, far) = (quantile(&depths, 0.02), quantile(&depths, 0.98));
            ((10.0 * near).floor() / 10.0, (10.0 * far).ceil() / 10.0)
        };
        let infrared = images.iter().filter_map(|image| image.infrared.as_ref());
        let mut values: Vec<f64> = infrared.flat_map(|image| image.pixels()).map(|&value| value.into()).collect();
        values.sort_by(f64::total_cmp);
        let white = if values.is_empty() { 0.0 } else { quantile(&values, WHITE_SHARE) };
        Self { nearest: nearest as f32, farthest: farthest.max(nearest + 0.1) as f32, white: white.max(1.0) as f32 }
    }

    /// By nearest neighbour: a mean over an edge or a hole would show a depth that nobody measured.
    pub(super) fn depth(&self, image: &Image<f32>, widest: u32) -> RgbImage {
        let (width, height) = (image.width() as u32, image.height() as u32);
        let small = small_size(width, height, widest);
        RgbImage::from_fn(small.0, small.1, |x, y| {
            let z = image.at((x * width / small.0) as usize, (y * height / small.1) as usize);
            let share = (z - self.nearest) / (self.farthest - self.nearest);
            Rgb(if has_value(z) { false_colour::of_depth(share) } else { NO_VALUE })
        })
    }

    pub(super) fn infrared(&self, image: &InfraredImage, widest: u32) -> GrayImage {
        // Light adds up, greys don't: first smaller, then grey.
        let size = (image.width() as u32, image.height() as u32);
        let light: image::ImageBuffer<Luma<u16>, _> = image::ImageBuffer::from_raw(size.0, size.1, image.pixels())
            .expect("an image has as many pixels as its size says");
        let (width, height) = small_size(size.0, size.1, widest);
        let grey = |Luma([value]): &Luma<u16>| {
            Luma([(255.0 * (f32::from(*value) / self.white).min(1.0).powf(1.0 / GAMMA)).round() as u8])
        };
        let light = resize(&light, width, height, FilterType::Triangle);
        GrayImage::from_fn(width, height, |x, y| grey(light.get_pixel(x, y)))
    }
}

fn has_value(z: f32) -> bool {
    z.is_finite() && z > 0.0
}

/// An image no wider than `widest`.
pub(super) fn colour(image: &sunblind_estimator::image::RgbImage, widest: u32) -> RgbImage {
    let (width, height) = (image.width() as u32, image.height() as u32);
    let full = RgbImage::from_raw(width, height, image.pixels().as_flattened().to_vec());
    let full = full.expect("an image has as many pixels as its size says");
    let small = small_size(width, height, widest);
    if small.0 == width { full } else { resize(&full, small.0, small.1, FilterType::Triangle) }
}

/// What is no wider than `widest` stays as it is, and so does an image without rows.
fn small_size(width: u32, height: u32, widest: u32) -> (u32, u32) {
    if width <= widest || height == 0 { (width, height) } else { (widest, (widest * height / width).max(1)) }
}

pub(super) fn css([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Base64; empty for an empty image.
pub(super) fn jpeg<P: PixelWithColorType<Subpixel = u8>>(
    image: &image::ImageBuffer<P, Vec<u8>>,
    quality: u8,
) -> io::Result<String> {
    if image.is_empty() {
        return Ok(String::new());
    }
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, quality)
        .write_image(image, image.width(), image.height(), P::COLOR_TYPE)
        .map_err(io::Error::other)?;
    Ok(base64::engine::general_purpose::STANDARD.encode(bytes))
}
