//! What an image has beyond its local mean: the dots, without the light they lie in.

/// A row-major image of differences from the local mean.
#[derive(Clone, Debug)]
pub(super) struct Residual {
    pub width: usize,
    pub height: usize,
    /// All of the same known length, so that a window's rows are found without arithmetic; zeros after the image's own.
    rows: Vec<[i16; STRIDE]>,
}

/// Room for the widest image, the reference, and for whole vectors to be read from its last pixels.
pub(super) const STRIDE: usize = 816;
/// Half the window of the local mean, pixels. Small, so that edges of shade spoil little; 5×5 positions of the pattern
/// always hold a dot. Measured in an office's views: with 9×9 pixels two to three times as many matches are wrong.
const RADIUS: usize = 2;
const WINDOW: usize = 2 * RADIUS + 1;
const AREA: u32 = (WINDOW * WINDOW) as u32;

impl Residual {
    /// Each pixel of a 10-bit image less the mean of the window around it. Nearer to the border than the window
    /// reaches, 0.
    ///
    /// # Panics
    /// When rows are longer than [`STRIDE`].
    #[inline(always)]
    pub fn of(pixels: &[u16], width: usize, height: usize) -> Self {
        let mut rows = vec![[0; STRIDE]; height];
        let mut column_sums = vec![0_u16; width];
        for row in pixels.chunks_exact(width).take(WINDOW - 1) {
            for (sum, &pixel) in column_sums.iter_mut().zip(row) {
                *sum += pixel;
            }
        }
        for middle in RADIUS..height - RADIUS {
            let entering = &pixels[(middle + RADIUS) * width..][..width];
            for (sum, &pixel) in column_sums.iter_mut().zip(entering) {
                *sum += pixel;
            }
            let inner = width - 2 * RADIUS;
            let out = &mut rows[middle][RADIUS..][..inner];
            let row = &pixels[middle * width + RADIUS..][..inner];
            for (x, (value, &pixel)) in out.iter_mut().zip(row).enumerate() {
                let sum: u32 = column_sums[x..x + WINDOW].iter().map(|&sum| u32::from(sum)).sum();
                *value = pixel as i16 - (sum / AREA) as i16;
            }
            let leaving = &pixels[(middle - RADIUS) * width..][..width];
            for (sum, &pixel) in column_sums.iter_mut().zip(leaving) {
                *sum -= pixel;
            }
        }
        Self { width, height, rows }
    }

    /// Row `y`, and zeros after it.
    #[inline(always)]
    pub fn row_and_room(&self, y: usize) -> &[i16; STRIDE] {
        &self.rows[y]
    }

    #[inline(always)]
    pub fn row(&self, y: usize) -> &[i16] {
        &self.rows[y][..self.width]
    }
}

/// An image's rows in pairs, pixel by pixel: (x, y), (x, y + 1), (x + 1, y), … What processors multiply and add in one
/// instruction. The last row's partner is zero.
pub(super) struct RowPairs(Vec<[i16; 2 * STRIDE]>);

impl RowPairs {
    /// Each row with the next.
    #[inline(always)]
    pub fn of(image: &Residual) -> Self {
        let mut pairs = vec![[0; 2 * STRIDE]; image.height];
        let below = image.rows[1..].iter().chain([&[0; STRIDE]]);
        for ((pair, row), below) in pairs.iter_mut().zip(&image.rows).zip(below) {
            for (x, pixels) in pair.as_chunks_mut().0.iter_mut().enumerate() {
                *pixels = [row[x], below[x]];
            }
        }
        Self(pairs)
    }

    /// Some pairs, those of rows `y` and `y + 1`, `y + 1` and `y + 2`, ….
    #[inline(always)]
    pub fn rows<const COUNT: usize>(&self, y: usize) -> &[[i16; 2 * STRIDE]; COUNT] {
        self.0[y..].first_chunk().expect("rows that lie in the image")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_light_leaves_nothing_and_a_dot_stands_out() {
        let mut pixels = vec![500_u16; 30 * 20];
        assert!(Residual::of(&pixels, 30, 20).rows.as_flattened().iter().all(|&value| value == 0));
        pixels[10 * 30 + 15] += 25;
        let residual = Residual::of(&pixels, 30, 20);
        assert_eq!(residual.row(10)[15], 24);
        assert_eq!(residual.row(8)[13], -1);
        assert_eq!(residual.row(7)[15], 0);
    }
}
