//! A view for alignment by all pixels: shade and depth on a grid coarser than the image.

use std::sync::Arc;

use nalgebra::{Point2, Vector3};

use crate::camera::CameraModel;
use crate::image::Image;

/// Pixels of the sensor in one of the grid, both ways.
pub const PIXELS: usize = 4;
/// A block whose depths differ by more than this share lies on an edge.
const FLAT: f32 = 0.04;

/// Shade and depth of one instant on a grid coarser than the image.
#[derive(Clone, Debug)]
pub struct DenseView {
    /// The camera, in the grid's pixels.
    pub camera: CameraModel,
    /// Through each pixel, z = 1.
    pub rays: Arc<Vec<Vector3<f64>>>,
    /// Levels; 0 = unknown.
    pub shade: Image<f32>,
    /// σ of what shade changes by from pixel to pixel for no reason of the scene's, levels.
    pub shade_noise: f32,
    /// Z, metres; 0 = unknown, or an edge.
    pub depth: Image<f32>,
}

/// What of a view depends on the camera alone.
pub struct ViewMaker {
    camera: CameraModel,
    rays: Arc<Vec<Vector3<f64>>>,
    shade_noise: f32,
}

impl ViewMaker {
    /// For one camera; `shade_noise` as in [`DenseView`].
    pub fn new(camera: &CameraModel, shade_noise: f32) -> Self {
        let size = PIXELS as f64;
        // Pixel centres are at whole numbers in both.
        let centre = |c: f64| (c + 0.5) / size - 0.5;
        let coarse = CameraModel {
            width: camera.width / PIXELS,
            height: camera.height / PIXELS,
            fx: camera.fx / size,
            fy: camera.fy / size,
            cx: centre(camera.cx),
            cy: centre(camera.cy),
            distortion: camera.distortion,
        };
        let ray = |index| coarse.ray(&Point2::new((index % coarse.width) as f64, (index / coarse.width) as f64));
        let rays = Arc::new((0..coarse.width * coarse.height).map(ray).collect());
        Self { camera: coarse, rays, shade_noise }
    }

    /// The view of one image; `shade` in levels, `depth` in metres, 0 = unknown in both.
    pub fn view(&self, shade: &Image<f32>, depth: &Image<f32>) -> DenseView {
        DenseView {
            camera: self.camera,
            rays: Arc::clone(&self.rays),
            shade: shrunk(shade, f32::INFINITY),
            shade_noise: self.shade_noise,
            depth: shrunk(depth, FLAT),
        }
    }
}

/// Means of blocks of pixels, of those that are known; 0 where fewer than half are, or they differ by more than a
/// share of their mean.
fn shrunk(image: &Image<f32>, most: f32) -> Image<f32> {
    let edge = PIXELS;
    let (width, height) = (image.width() / edge, image.height() / edge);
    let mut small = Image::filled(width, height, 0.0);
    for y in 0..height {
        for x in 0..width {
            let (mut sum, mut count, mut least, mut largest) = (0.0, 0, f32::INFINITY, 0.0_f32);
            for row in y * edge..(y + 1) * edge {
                for &value in image.row(row)[x * edge..(x + 1) * edge].iter().filter(|value| **value > 0.0) {
                    (sum, count, least, largest) = (sum + value, count + 1, least.min(value), largest.max(value));
                }
            }
            if 2 * count >= edge * edge {
                let mean = sum / count as f32;
                small.pixels_mut()[y * width + x] = if largest - least <= most * mean { mean } else { 0.0 };
            }
        }
    }
    small
}

impl DenseView {
    /// Whether a place lies within the image, with pixels around it.
    pub fn shows(&self, x: f32, y: f32) -> bool {
        x >= 1.0 && y >= 1.0 && x < (self.camera.width - 2) as f32 && y < (self.camera.height - 2) as f32
    }

    /// The value between pixels and its slopes along x and y, a pixel of the grid each; `None` next to what is unknown.
    pub fn sample(&self, image: &Image<f32>, x: f32, y: f32) -> Option<[f32; 3]> {
        if !self.shows(x, y) {
            return None;
        }
        let width = image.width();
        let (column, row) = (x as usize, y as usize);
        let (across, down) = (x - column as f32, y - row as f32);
        let pixels = image.pixels();
        let at = |dx: usize, dy: usize| pixels[(row + dy - 1) * width + column + dx - 1];
        // Rows and columns −1 to 2 about the place, without the corners.
        let (a, b, c, d) = (at(1, 1), at(2, 1), at(1, 2), at(2, 2));
        let (left, right, left_down, right_down) = (at(0, 1), at(3, 1), at(0, 2), at(3, 2));
        let (above, above_right, below, below_right) = (at(1, 0), at(2, 0), at(1, 3), at(2, 3));
        let all = [a, b, c, d, left, right, left_down, right_down, above, above_right, below, below_right];
        if all.contains(&0.0) {
            return None;
        }
        let mix = |a: f32, b: f32, c: f32, d: f32| {
            let (top, bottom) = (a + across * (b - a), c + across * (d - c));
            top + down * (bottom - top)
        };
        // Central differences at the four pixels, between which they are mixed like the values.
        let slope_x = 0.5 * mix(b - left, right - a, d - left_down, right_down - c);
        let slope_y = 0.5 * mix(c - above, d - above_right, below - a, below_right - b);
        Some([mix(a, b, c, d), slope_x, slope_y])
    }

    /// How steep shade is at a pixel, levels a pixel of the grid; 0 next to what is unknown.
    pub fn steepness(&self, x: usize, y: usize) -> f32 {
        let at = |x: usize, y: usize| self.shade.at(x, y);
        let (left, right, above, below) = (at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1));
        if [left, right, above, below].contains(&0.0) { 0.0 } else { 0.5 * (right - left).hypot(below - above) }
    }
}
