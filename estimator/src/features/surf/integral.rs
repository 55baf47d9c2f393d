//! Integral image (§3.1): the sum over any upright rectangle from four reads.

use crate::image::GrayImage;

/// Sums of all pixels above and left of each pixel corner: (width + 1) × (height + 1), row-major.
/// Arithmetic on it wraps, which leaves every rectangle's sum exact.
#[derive(Clone, Debug, Default)]
pub struct IntegralImage {
    width: usize,
    height: usize,
    sums: Vec<i32>,
}

impl IntegralImage {
    /// Fills it from `image`, reusing the memory.
    pub fn compute(&mut self, image: &GrayImage) {
        (self.width, self.height) = image.size();
        let stride = self.width + 1;
        self.sums.clear();
        self.sums.resize(stride * (self.height + 1), 0);
        for y in 0..self.height {
            let (above, below) = self.sums.split_at_mut((y + 1) * stride);
            let above = &above[y * stride + 1..];
            let mut row_sum = 0_i32;
            for ((sum, &up), &pixel) in below[1..stride].iter_mut().zip(above).zip(image.row(y)) {
                row_sum = row_sum.wrapping_add(i32::from(pixel));
                *sum = up.wrapping_add(row_sum);
            }
        }
    }

    /// Image columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Image rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The sums along the upper edge of pixel row `y`, `y` in 0..=height: width + 1 values.
    pub fn row(&self, y: usize) -> &[i32] {
        let stride = self.width + 1;
        &self.sums[y * stride..(y + 1) * stride]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_rectangle_sums_its_pixels(pixels in prop::collection::vec(any::<u8>(), 7 * 5), x0 in 0..7_usize, w in 0..7_usize, y0 in 0..5_usize, h in 0..5_usize) {
            let image = GrayImage::from_pixels(7, 5, pixels).unwrap();
            let mut integral = IntegralImage::default();
            integral.compute(&image);
            let (x1, y1) = ((x0 + w).min(7), (y0 + h).min(5));
            let plain: i32 = (y0..y1).flat_map(|y| image.row(y)[x0..x1].iter()).map(|&p| i32::from(p)).sum();
            let quick = integral.row(y1)[x1] - integral.row(y1)[x0] - integral.row(y0)[x1] + integral.row(y0)[x0];
            prop_assert_eq!(plain, quick);
        }
    }
}
