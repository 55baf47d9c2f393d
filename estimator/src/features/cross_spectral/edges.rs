//! Where an image has edges of which direction: what colour and infrared have in common.

use crate::image::GrayImage;

/// Directions of an edge's brighter side, in steps of 45° from +x towards +y.
const DIRECTIONS: usize = 8;
/// The same whichever side is the brighter.
pub const ORIENTATIONS: usize = DIRECTIONS / 2;
/// Pixels in a cell, both ways.
const CELL: usize = 2;
/// Binomial, σ = 1 px, against the pixels' noise; in sixteenths.
const FINE: [i32; 5] = [1, 4, 6, 4, 1];
/// Binomial, σ = √2 cells: half of what lies between two samples of a descriptor.
const COARSE: [f32; 9] = {
    let whole = 256.0;
    [
        1.0 / whole,
        8.0 / whole,
        28.0 / whole,
        56.0 / whole,
        70.0 / whole,
        56.0 / whole,
        28.0 / whole,
        8.0 / whole,
        1.0 / whole,
    ]
};

/// The edges about a place, by orientation: square roots, that one strong edge does not outshine the rest (Arandjelović &
/// Zisserman 2012, there for SIFT).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// How steep, whichever side is the brighter; √(grey levels a pixel, summed over a cell).
    pub unsigned: [f32; ORIENTATIONS],
    /// Negative where the darker side is the one that [`DIRECTIONS`] would call brighter.
    pub signed: [f32; ORIENTATIONS],
}

/// The edges about any place of an image.
#[derive(Clone, Debug, Default)]
pub struct Edges {
    columns: usize,
    rows: usize,
    cells: Vec<Seen>,
    /// Steepness by direction, grey levels a pixel, summed over a cell.
    steep: Vec<[f32; DIRECTIONS]>,
    blurred: Vec<[f32; DIRECTIONS]>,
}

impl Edges {
    /// Fills it from `image`, reusing the memory.
    pub fn compute(&mut self, image: &GrayImage) {
        let (width, height) = image.size();
        (self.columns, self.rows) = (width.div_ceil(CELL), height.div_ceil(CELL));
        let count = self.columns * self.rows;
        self.steep.clear();
        self.steep.resize(count, [0.0; DIRECTIONS]);
        self.blurred.clear();
        self.blurred.resize(count, [0.0; DIRECTIONS]);
        self.cells.clear();
        self.cells.resize(count, Seen::default());
        if count == 0 {
            return;
        }
        let mut smooth = [vec![0; width], vec![0; width], vec![0; width]];
        let mut column = vec![0; width + 4];
        for y in 0..height {
            // The rows above, here and below; at the border the border's.
            if y == 0 {
                smooth_row(image, 0, &mut column, &mut smooth[0]);
                smooth[1] = smooth[0].clone();
            } else {
                smooth.rotate_left(1);
            }
            smooth_row(image, (y + 1).min(height - 1), &mut column, &mut smooth[2]);
            let cells = &mut self.steep[y / CELL * self.columns..][..self.columns];
            for x in 0..width {
                let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
                let (dx, dy) = (smooth[1][right] - smooth[1][left], smooth[2][x] - smooth[0][x]);
                add(&mut cells[x / CELL], dx, dy);
            }
        }
        self.spread();
    }

    /// Blurs what is steep.
    fn spread(&mut self) {
        let (columns, rows) = (self.columns, self.rows);
        blur_rows(&self.steep, &mut self.blurred, columns);
        let mut sums = vec![[0.0; DIRECTIONS]; columns];
        for (y, out) in self.cells.chunks_exact_mut(columns).enumerate() {
            sums.fill([0.0; DIRECTIONS]);
            for (tap, weight) in COARSE.iter().enumerate() {
                let from = (y + tap).saturating_sub(COARSE.len() / 2).min(rows - 1);
                for (sum, cell) in sums.iter_mut().zip(&self.blurred[from * columns..]) {
                    accumulate(sum, cell, *weight);
                }
            }
            for (out, sum) in out.iter_mut().zip(&sums) {
                *out = seen(sum);
            }
        }
    }

    /// The edges about each place of columns `xs` and rows `ys`, pixels; outside the image those of its border. Of an image
    /// without pixels: none.
    pub fn at<const N: usize>(&self, xs: [f32; N], ys: [f32; N]) -> [[Seen; N]; N] {
        let mut found = [[Seen::default(); N]; N];
        if self.cells.is_empty() {
            return found;
        }
        let columns = xs.map(|x| place(x, self.columns));
        for (found, y) in found.iter_mut().zip(ys) {
            let (row, below, share) = place(y, self.rows);
            let row_at = |row: usize| &self.cells[row * self.columns..][..self.columns];
            let (row, below) = (row_at(row), row_at(below));
            for (found, (left, right, along)) in found.iter_mut().zip(columns) {
                let shares =
                    [(1.0 - along) * (1.0 - share), along * (1.0 - share), (1.0 - along) * share, along * share];
                let cells = [&row[left], &row[right], &below[left], &below[right]];
                for k in 0..ORIENTATIONS {
                    let sum = |of: fn(&Seen) -> &[f32; ORIENTATIONS]| {
                        (0..4).map(|corner| shares[corner] * of(cells[corner])[k]).sum()
                    };
                    (found.unsigned[k], found.signed[k]) = (sum(|seen| &seen.unsigned), sum(|seen| &seen.signed));
                }
            }
        }
        found
    }
}

/// An edge and the one with its contrast reversed, taken together.
fn seen(steep: &[f32; DIRECTIONS]) -> Seen {
    let root = |value: f32| value.abs().sqrt().copysign(value);
    Seen {
        unsigned: std::array::from_fn(|k| root(steep[k] + steep[k + ORIENTATIONS])),
        signed: std::array::from_fn(|k| root(steep[k] - steep[k + ORIENTATIONS])),
    }
}

/// A pixel coordinate as a cell, the next one, and the share of that.
fn place(coordinate: f32, cells: usize) -> (usize, usize, f32) {
    let middle = (CELL - 1) as f32 / 2.0;
    let in_cells = ((coordinate - middle) * (1.0 / CELL as f32)).clamp(0.0, (cells - 1) as f32);
    let whole = in_cells as usize;
    (whole, (whole + 1).min(cells - 1), in_cells - whole as f32)
}

fn accumulate(sum: &mut [f32; DIRECTIONS], cell: &[f32; DIRECTIONS], weight: f32) {
    for (sum, value) in sum.iter_mut().zip(cell) {
        *sum += weight * value;
    }
}

fn blur_rows(from: &[[f32; DIRECTIONS]], to: &mut [[f32; DIRECTIONS]], columns: usize) {
    let reach = COARSE.len() / 2;
    let mut padded = vec![[0.0; DIRECTIONS]; columns + 2 * reach];
    for (from, to) in from.chunks_exact(columns).zip(to.chunks_exact_mut(columns)) {
        padded[..reach].fill(from[0]);
        padded[reach..columns + reach].copy_from_slice(from);
        padded[columns + reach..].fill(from[columns - 1]);
        for (out, taps) in to.iter_mut().zip(padded.windows(COARSE.len())) {
            for (cell, weight) in taps.iter().zip(&COARSE) {
                accumulate(out, cell, *weight);
            }
        }
    }
}

/// Row `y` smoothed both ways, in 256ths of a grey level.
fn smooth_row(image: &GrayImage, y: usize, column: &mut [i32], out: &mut [i32]) {
    let (width, height) = image.size();
    let inner = &mut column[2..width + 2];
    inner.fill(0);
    for (tap, weight) in FINE.iter().enumerate() {
        let row = image.row((y + tap).saturating_sub(2).min(height - 1));
        for (sum, &pixel) in inner.iter_mut().zip(row) {
            *sum += weight * i32::from(pixel);
        }
    }
    let (first, last) = (column[2], column[width + 1]);
    column[..2].fill(first);
    column[width + 2..].fill(last);
    for (out, taps) in out.iter_mut().zip(column.windows(FINE.len())) {
        *out = taps.iter().zip(&FINE).map(|(value, weight)| value * weight).sum();
    }
}

/// Adds a gradient: split into the two directions beside it, as a vector is.
fn add(cell: &mut [f32; DIRECTIONS], dx: i32, dy: i32) {
    // 256ths, over two pixels.
    const UNIT: f32 = 1.0 / 512.0;
    let (along_x, along_y) = (dx.abs(), dy.abs());
    // Looked up: which way an edge points, no processor can guess.
    let index = usize::from(along_x < along_y) + 2 * usize::from(dx < 0) + 4 * usize::from(dy < 0);
    let axis = [0, 2, 4, 2, 0, 6, 4, 6][index];
    let diagonal = [1, 1, 3, 3, 7, 7, 5, 5][index];
    cell[axis] += (along_x - along_y).abs() as f32 * UNIT;
    cell[diagonal] += along_x.min(along_y) as f32 * (UNIT * std::f32::consts::SQRT_2);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope of two grey levels a pixel towards `angle`.
    fn slope(angle: f32) -> GrayImage {
        let mut image = GrayImage::filled(48, 48, 0);
        for (index, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let (x, y) = ((index % 48) as f32 - 24.0, (index / 48) as f32 - 24.0);
            *pixel = (128.0 + 2.0 * (x * angle.cos() + y * angle.sin())).round() as u8;
        }
        image
    }

    #[test]
    fn a_slope_has_its_direction() {
        let mut edges = Edges::default();
        for direction in 0..DIRECTIONS {
            edges.compute(&slope(direction as f32 * std::f32::consts::FRAC_PI_4));
            let [[Seen { unsigned, signed }]] = edges.at([24.0], [24.0]);
            let orientation = direction % ORIENTATIONS;
            // Two levels a pixel, four pixels a cell.
            assert!((unsigned[orientation].powi(2) - 8.0).abs() < 0.4, "{direction}: {unsigned:?}");
            let sign = if direction < ORIENTATIONS { 1.0 } else { -1.0 };
            assert!((sign * signed[orientation] - unsigned[orientation]).abs() < 0.01, "{direction}: {signed:?}");
            let others = (0..ORIENTATIONS).filter(|&other| other != orientation).map(|other| unsigned[other].powi(2));
            assert!(others.sum::<f32>() < 0.8, "{direction}: {unsigned:?}");
        }
    }

    #[test]
    fn a_flat_image_has_none_and_a_tiny_one_is_no_trouble() {
        let mut edges = Edges::default();
        for (width, height) in [(0, 0), (1, 1), (2, 1), (3, 40)] {
            edges.compute(&GrayImage::filled(width, height, 77));
            assert_eq!(edges.at([0.4], [30.0]), [[Seen::default()]]);
        }
    }
}
