//! Images as plain row-major arrays. The first pixel's centre is (0, 0); x grows right, y grows down.

/// A row-major image of `width × height` pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image<P> {
    width: usize,
    height: usize,
    pixels: Vec<P>,
}

/// Colour, 8 bits a channel, in the order red, green, blue.
pub type RgbImage = Image<[u8; 3]>;
/// Luma, 8 bits.
pub type GrayImage = Image<u8>;
/// Infrared, 10 bits in the low end of a `u16`.
pub type InfraredImage = Image<u16>;
/// Depth as the sensor gives it; the rig's [`DepthEncoding`](crate::camera::DepthEncoding) says what a value means.
pub type DepthImage = Image<u16>;

impl<P> Image<P> {
    /// Takes `width · height` pixels in row-major order; `None` when their number is another.
    pub fn from_pixels(width: usize, height: usize, pixels: Vec<P>) -> Option<Self> {
        (width.checked_mul(height)? == pixels.len()).then_some(Self { width, height, pixels })
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// (width, height) in pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// All pixels, row after row.
    pub fn pixels(&self) -> &[P] {
        &self.pixels
    }

    /// All pixels, row after row, to write to.
    pub fn pixels_mut(&mut self) -> &mut [P] {
        &mut self.pixels
    }

    /// Row `y`.
    pub fn row(&self, y: usize) -> &[P] {
        &self.pixels[y * self.width..(y + 1) * self.width]
    }
}

impl<P: Copy> Image<P> {
    /// An image with every pixel `value`.
    pub fn filled(width: usize, height: usize, value: P) -> Self {
        Self { width, height, pixels: vec![value; width * height] }
    }

    /// The pixel in column `x`, row `y`. Panics outside the image.
    pub fn at(&self, x: usize, y: usize) -> P {
        self.row(y)[x]
    }
}

impl<P: Copy + Into<f32>> Image<P> {
    /// The value at a place between four pixels, bilinear; beyond the last column and row as there. Panics where `x` or `y`
    /// lies outside the image.
    pub fn between(&self, x: f32, y: f32) -> f32 {
        let (column, row) = (x as usize, y as usize);
        let (right, below) = ((column + 1).min(self.width - 1), (row + 1).min(self.height - 1));
        let (x, y) = (x - column as f32, y - row as f32);
        let along = |row: &[P]| row[column].into() * (1.0 - x) + row[right].into() * x;
        along(self.row(row)) * (1.0 - y) + along(self.row(below)) * y
    }
}

impl RgbImage {
    /// Luma by ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B, in 16-bit fixed point.
    pub fn to_luma(&self) -> GrayImage {
        let pixels = self
            .pixels
            .iter()
            .map(|&[r, g, b]| {
                ((19595 * u32::from(r) + 38470 * u32::from(g) + 7471 * u32::from(b) + 0x8000) >> 16) as u8
            })
            .collect();
        GrayImage { width: self.width, height: self.height, pixels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn luma_keeps_black_white_and_grey() {
        for value in [0, 1, 127, 255] {
            assert_eq!(RgbImage::filled(2, 2, [value; 3]).to_luma().at(1, 1), value);
        }
    }

    #[test]
    fn between_four_pixels_lies_their_plane_and_beyond_the_last_ones_nothing_new() {
        let image = Image::from_pixels(2, 2, vec![10_u16, 20, 30, 40]).unwrap();
        for (x, y) in [(0.0, 0.0), (0.25, 0.5), (0.75, 0.125)] {
            assert_eq!(image.between(x, y), 10.0 + 10.0 * x + 20.0 * y);
        }
        assert_eq!((image.between(1.5, 0.0), image.between(1.5, 1.5)), (20.0, 40.0));
    }

    #[test]
    fn a_wrong_pixel_count_is_refused() {
        assert!(Image::from_pixels(3, 2, vec![0_u8; 5]).is_none());
        assert!(Image::from_pixels(usize::MAX, 2, vec![0_u8; 5]).is_none());
    }
}
