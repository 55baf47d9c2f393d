//! Fast-Hessian detector (§3.2–3.4): box-filter determinants over scale space, their maxima, refined.

use super::integral::IntegralImage;
use nalgebra::{Matrix3, Vector3};
use pulp::{Arch, NullaryFnOnce};

/// A scale-space maximum of the determinant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum {
    /// Column, pixels.
    pub x: f32,
    /// Row, pixels.
    pub y: f32,
    /// Scale s, pixels.
    pub scale: f32,
    /// Determinant.
    pub response: f32,
    /// Sign of the trace.
    pub laplacian_positive: bool,
}

/// Filters in an octave (§3.3).
const INTERVALS: usize = 4;
/// The finest octave looks at every second pixel, each further one at half as many.
const FIRST_STEP: usize = 2;
/// w in det ≈ Dxx·Dyy − (w·Dxy)² (§3.2).
const DXY_WEIGHT: f32 = 0.9;

/// Responses of one filter on a grid of every `step`-th pixel.
#[derive(Clone, Debug, Default)]
struct Layer {
    /// Edge of the filter, pixels: 9, 15, 21, … (§3.3).
    filter: usize,
    step: usize,
    columns: usize,
    rows: usize,
    determinant: Vec<f32>,
    trace_positive: Vec<bool>,
}

/// The detector's working memory.
#[derive(Clone, Debug, Default)]
pub struct Detector {
    layers: Vec<Layer>,
    rows: FilterRows,
}

/// Edge of filter `interval` of octave `octave`: 9 15 21 27, 15 27 39 51, 27 51 75 99, … (§3.3).
fn filter_edge(octave: usize, interval: usize) -> usize {
    3 * ((2 << octave) * (interval + 1) + 1)
}

impl Detector {
    /// All maxima above `threshold`, in scan order.
    pub fn maxima(&mut self, integral: &IntegralImage, octaves: usize, threshold: f32) -> Vec<Maximum> {
        self.layers.resize_with(octaves * INTERVALS, Layer::default);
        let mut maxima = Vec::new();
        for octave in 0..octaves {
            let layers = &mut self.layers[octave * INTERVALS..(octave + 1) * INTERVALS];
            for (interval, layer) in layers.iter_mut().enumerate() {
                let (filter, step) = (filter_edge(octave, interval), FIRST_STEP << octave);
                Arch::new().dispatch(Filters { layer, integral, filter, step, rows: &mut self.rows });
            }
            for middle in 1..INTERVALS - 1 {
                find_maxima(&layers[middle - 1..=middle + 1], threshold, &mut maxima);
            }
        }
        maxima
    }
}

/// A layer to be computed. A type of its own: [`Arch::dispatch`] inlines no closure.
struct Filters<'a> {
    layer: &'a mut Layer,
    integral: &'a IntegralImage,
    filter: usize,
    step: usize,
    rows: &'a mut FilterRows,
}

impl NullaryFnOnce for Filters<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.layer.compute(self.integral, self.filter, self.step, self.rows);
    }
}

/// One row of the integral image, combined vertically for each of the three filters, so that along the row
/// every output needs only two to four reads; and what comes of them at every pixel.
#[derive(Clone, Debug, Default)]
struct FilterRows {
    xx: Vec<i32>,
    yy: Vec<i32>,
    xy: Vec<i32>,
    determinant: Vec<f32>,
    trace: Vec<f32>,
}

impl FilterRows {
    /// Combines the integral image's rows for outputs in pixel row `y`; the filter must fit.
    #[inline(always)]
    fn combine(&mut self, integral: &IntegralImage, y: usize, filter: usize) {
        let lobe = filter / 3;
        let (half, half_lobe) = (filter / 2, lobe / 2);
        let count = integral.width() + 1;
        let row = |y: usize| &integral.row(y)[..count];
        for out in [&mut self.xx, &mut self.yy, &mut self.xy] {
            out.resize(count, 0);
        }
        let (top, bottom) = (row(y + 1 - lobe), row(y + lobe));
        for (x, out) in self.xx[..count].iter_mut().enumerate() {
            *out = bottom[x].wrapping_sub(top[x]);
        }
        let (top, bottom) = (row(y - half), row(y + half + 1));
        let (inner_top, inner_bottom) = (row(y - half_lobe), row(y + half_lobe + 1));
        for (x, out) in self.yy[..count].iter_mut().enumerate() {
            let inner = inner_bottom[x].wrapping_sub(inner_top[x]);
            *out = bottom[x].wrapping_sub(top[x]).wrapping_sub(inner.wrapping_mul(3));
        }
        let (above_top, above_bottom) = (row(y - lobe), row(y));
        let (below_top, below_bottom) = (row(y + 1), row(y + lobe + 1));
        for (x, out) in self.xy[..count].iter_mut().enumerate() {
            let above = above_bottom[x].wrapping_sub(above_top[x]);
            *out = above.wrapping_sub(below_bottom[x].wrapping_sub(below_top[x]));
        }
    }

    /// Determinant and trace at `count` pixels from column `first` on, from the combined rows. At every one, though only
    /// every `step`-th is wanted: many beside each other take less than a few far apart.
    #[inline(always)]
    fn respond(&mut self, first: usize, count: usize, filter: usize) {
        let left = first - filter / 2;
        let inputs = [&self.xx, &self.yy, &self.xy].map(|row| &row[left..]);
        self.determinant.resize(count, 0.0);
        self.trace.resize(count, 0.0);
        respond(inputs, filter, &mut self.determinant, &mut self.trace);
    }
}

/// Determinants and traces from combined rows that begin at the first filter's left edge. A function of its own: of its
/// arguments the compiler knows that none overlaps another, and computes many at once.
#[inline(always)]
fn respond([xx, yy, xy]: [&[i32]; 3], filter: usize, determinants: &mut [f32], traces: &mut [f32]) {
    let (half, lobe) = (filter / 2, filter / 3);
    let half_lobe = lobe / 2;
    let per_area = 1.0 / (filter * filter) as f32;
    let count = determinants.len();
    let traces = &mut traces[..count];
    let [outer_left, inner_left, inner_right, outer_right] =
        [0, half - half_lobe, half + half_lobe + 1, filter].map(|x| &xx[x..][..count]);
    let [left, right] = [half + 1 - lobe, half + lobe].map(|x| &yy[x..][..count]);
    let [far_left, near_left, near_right, far_right] =
        [half - lobe, half, half + 1, half + lobe + 1].map(|x| &xy[x..][..count]);
    for k in 0..count {
        let centre = inner_right[k].wrapping_sub(inner_left[k]);
        let dxx = outer_right[k].wrapping_sub(outer_left[k]).wrapping_sub(centre.wrapping_mul(3));
        let dyy = right[k].wrapping_sub(left[k]);
        let dxy = near_left[k].wrapping_sub(far_left[k]).wrapping_sub(far_right[k].wrapping_sub(near_right[k]));
        let (dxx, dyy) = (dxx as f32 * per_area, dyy as f32 * per_area);
        let dxy = dxy as f32 * (per_area * DXY_WEIGHT);
        determinants[k] = dxx * dyy - dxy * dxy;
        traces[k] = dxx + dyy;
    }
}

impl Layer {
    /// Responses of the `filter` wide filters at every `step`-th pixel; zero where they do not fit.
    #[inline(always)]
    fn compute(&mut self, integral: &IntegralImage, filter: usize, step: usize, rows: &mut FilterRows) {
        (self.filter, self.step) = (filter, step);
        (self.columns, self.rows) = (integral.width().div_ceil(step), integral.height().div_ceil(step));
        let count = self.columns * self.rows;
        self.determinant.clear();
        self.determinant.resize(count, 0.0);
        self.trace_positive.clear();
        self.trace_positive.resize(count, false);

        let half = filter / 2;
        // Grid positions whose filter lies inside the image: half ≤ position, position + half < size.
        let first = half.div_ceil(step);
        let inside = |size: usize| first..(size.saturating_sub(half)).div_ceil(step).max(first);
        let columns = inside(integral.width());
        if columns.is_empty() {
            return;
        }
        for row in inside(integral.height()) {
            rows.combine(integral, row * step, filter);
            rows.respond(first * step, (columns.len() - 1) * step + 1, filter);
            let start = row * self.columns;
            let determinants = &mut self.determinant[start + columns.start..start + columns.end];
            let traces = &mut self.trace_positive[start + columns.start..start + columns.end];
            for (k, (determinant, trace_positive)) in determinants.iter_mut().zip(traces).enumerate() {
                (*determinant, *trace_positive) = (rows.determinant[k * step], rows.trace[k * step] > 0.0);
            }
        }
    }

    fn row(&self, y: usize) -> &[f32] {
        &self.determinant[y * self.columns..(y + 1) * self.columns]
    }
}

/// Appends the maxima of the middle of three neighbouring layers over 3×3×3 (§3.4), refined by a quadric
/// (Brown & Lowe 2002).
fn find_maxima(layers: &[Layer], threshold: f32, maxima: &mut Vec<Maximum>) {
    let [below, middle, above] = layers else { return };
    for y in 1..middle.rows.saturating_sub(1) {
        let rows: [[&[f32]; 3]; 3] =
            [below, middle, above].map(|layer| [layer.row(y - 1), layer.row(y), layer.row(y + 1)]);
        for x in 1..middle.columns.saturating_sub(1) {
            let value = rows[1][1][x];
            if value <= threshold || value <= rows[1][1][x - 1] || value <= rows[1][1][x + 1] {
                continue;
            }
            let beaten = |row: &[f32]| value > row[x - 1] && value > row[x] && value > row[x + 1];
            if !(beaten(rows[1][0]) && beaten(rows[1][2]) && rows[0].iter().chain(&rows[2]).all(|row| beaten(row))) {
                continue;
            }
            if let Some(offset) = refine(&rows, x) {
                let step = middle.step as f32;
                let filter = middle.filter as f32 + offset.z * (above.filter - middle.filter) as f32;
                maxima.push(Maximum {
                    x: (x as f32 + offset.x) * step,
                    y: (y as f32 + offset.y) * step,
                    // The 9×9 filter stands for σ = 1.2 (§3.2).
                    scale: filter * (1.2 / 9.0),
                    response: value,
                    laplacian_positive: middle.trace_positive[y * middle.columns + x],
                });
            }
        }
    }
}

/// Offset of the quadric's peak from the middle sample, in samples (column, row, layer); `None` when it lies
/// nearer to another sample, where the fit can't be trusted.
fn refine(rows: &[[&[f32]; 3]; 3], x: usize) -> Option<Vector3<f32>> {
    let at = |layer: usize, row: usize, dx: isize| rows[layer][row][x.wrapping_add_signed(dx)];
    let centre = at(1, 1, 0);
    let gradient = 0.5 * Vector3::new(at(1, 1, 1) - at(1, 1, -1), at(1, 2, 0) - at(1, 0, 0), at(2, 1, 0) - at(0, 1, 0));
    let xx = at(1, 1, 1) + at(1, 1, -1) - 2.0 * centre;
    let yy = at(1, 2, 0) + at(1, 0, 0) - 2.0 * centre;
    let ss = at(2, 1, 0) + at(0, 1, 0) - 2.0 * centre;
    let xy = 0.25 * (at(1, 2, 1) - at(1, 2, -1) - at(1, 0, 1) + at(1, 0, -1));
    let xs = 0.25 * (at(2, 1, 1) - at(2, 1, -1) - at(0, 1, 1) + at(0, 1, -1));
    let ys = 0.25 * (at(2, 2, 0) - at(2, 0, 0) - at(0, 2, 0) + at(0, 0, 0));
    let hessian = Matrix3::new(xx, xy, xs, xy, yy, ys, xs, ys, ss);
    let offset = -(hessian.try_inverse()? * gradient);
    (offset.amax() < FURTHEST_PEAK).then_some(offset)
}

/// How far, in samples, the refined peak may lie from the sample that won.
const FURTHEST_PEAK: f32 = 0.6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_have_the_papers_edges() {
        let edges = |octave| (0..INTERVALS).map(|interval| filter_edge(octave, interval)).collect::<Vec<_>>();
        assert_eq!(edges(0), [9, 15, 21, 27]);
        assert_eq!(edges(1), [15, 27, 39, 51]);
        assert_eq!(edges(2), [27, 51, 75, 99]);
    }

    #[test]
    fn responses_equal_the_plain_box_filters() {
        // The three filters of Fig. 1 written out pixel by pixel.
        let pixels = (0..64 * 48).map(|i: usize| (i.wrapping_mul(2_654_435_761) >> 7) as u8).collect();
        let image = crate::image::GrayImage::from_pixels(64, 48, pixels).unwrap();
        let mut integral = IntegralImage::default();
        integral.compute(&image);
        let mut layer = Layer::default();
        for filter in [9_usize, 15, 21] {
            layer.compute(&integral, filter, 2, &mut FilterRows::default());
            let (x, y) = (32_isize, 24_isize);
            let lobe = filter as isize / 3;
            let (mut dxx, mut dyy, mut dxy) = (0.0, 0.0, 0.0);
            for v in -(filter as isize / 2)..=filter as isize / 2 {
                for u in -(filter as isize / 2)..=filter as isize / 2 {
                    let pixel = f32::from(image.at((x + u) as usize, (y + v) as usize));
                    let lobe_weight = |along: isize| if along.abs() <= lobe / 2 { -2.0 } else { 1.0 };
                    dxx += if v.abs() < lobe { pixel * lobe_weight(u) } else { 0.0 };
                    dyy += if u.abs() < lobe { pixel * lobe_weight(v) } else { 0.0 };
                    let corner = u != 0 && v != 0 && u.abs() <= lobe && v.abs() <= lobe;
                    dxy += if corner { pixel * -((u * v).signum() as f32) } else { 0.0 };
                }
            }
            let area = (filter * filter) as f32;
            let expected = (dxx * dyy - (0.9 * dxy) * (0.9 * dxy)) / (area * area);
            let found = layer.row(12)[16];
            assert!((found - expected).abs() < 1e-3 * expected.abs().max(1.0), "{filter}: {found}, {expected}");
        }
    }
}
