//! Box filters, repeated until they are near a Gaussian.

use crate::image::Image;

/// Rows summed side by side: each sum waits for itself only, so several cost little more than one.
const ABREAST: usize = 8;

/// `passes` box filters of `2·reach + 1` pixels in both directions; σ² = passes · reach · (reach + 1) / 3. Beyond its rim
/// the image is zero.
pub(super) fn blur(image: &Image<f32>, reach: usize, passes: usize) -> Image<f32> {
    let (width, height) = image.size();
    let mut current = image.clone();
    let mut next = Image::filled(width, height, 0.0);
    for _ in 0..passes {
        let (from, to) = (current.pixels().chunks(ABREAST * width), next.pixels_mut().chunks_mut(ABREAST * width));
        from.zip(to).for_each(|(from, to)| along_rows(from, to, width, reach));
        down_columns(next.pixels(), current.pixels_mut(), width, reach);
    }
    current
}

/// One box filter along each of up to [`ABREAST`] rows.
fn along_rows(from: &[f32], to: &mut [f32], width: usize, reach: usize) {
    let weight = 1.0 / (2 * reach + 1) as f32;
    // Pixels of one column next to each other, with nothing on either side.
    let mut columns = vec![[0.0_f32; ABREAST]; width + 2 * reach];
    for (row, from) in from.chunks_exact(width).enumerate() {
        columns[reach..].iter_mut().zip(from).for_each(|(column, &value)| column[row] = value);
    }
    let mut sums = [0.0_f32; ABREAST];
    columns[..2 * reach].iter().for_each(|column| add(&mut sums, column));
    for x in 0..width {
        add(&mut sums, &columns[x + 2 * reach]);
        let leaves = columns[x];
        columns[x] = sums.map(|sum| sum * weight);
        sums.iter_mut().zip(leaves).for_each(|(sum, value)| *sum -= value);
    }
    for (row, to) in to.chunks_exact_mut(width).enumerate() {
        to.iter_mut().zip(&columns).for_each(|(to, column)| *to = column[row]);
    }
}

fn add(sums: &mut [f32], values: &[f32]) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
}

/// One box filter down the columns, all of them at once.
fn down_columns(from: &[f32], to: &mut [f32], width: usize, reach: usize) {
    let weight = 1.0 / (2 * reach + 1) as f32;
    let mut sums = vec![0.0_f32; width];
    let nothing = vec![0.0_f32; width];
    from.chunks_exact(width).take(reach).for_each(|row| add(&mut sums, row));
    for (y, out) in to.chunks_exact_mut(width).enumerate() {
        let row = |at: Option<usize>| at.and_then(|y| from.get(y * width..(y + 1) * width)).unwrap_or(&nothing);
        let (enters, leaves) = (row(Some(y + reach)), row(y.checked_sub(reach)));
        for (((out, sum), enters), leaves) in out.iter_mut().zip(&mut sums).zip(enters).zip(leaves) {
            *sum += enters;
            *out = *sum * weight;
            *sum -= leaves;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_becomes_a_bell_of_the_stated_width() {
        for (reach, passes) in [(2, 2), (5, 2), (1, 3)] {
            let mut image = Image::filled(61, 51, 0.0);
            image.pixels_mut()[25 * 61 + 30] = 1.0;
            let bell = blur(&image, reach, passes);
            let moment = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
                let pixels = bell.pixels().iter().enumerate();
                pixels.map(|(i, value)| f64::from(*value) * of((i % 61) as f64 - 30.0, (i / 61) as f64 - 25.0)).sum()
            };
            let expected = (passes * reach * (reach + 1)) as f64 / 3.0;
            assert!((moment(&|_, _| 1.0) - 1.0).abs() < 1e-5);
            for square in [moment(&|x, _| x * x), moment(&|_, y| y * y)] {
                assert!((square - expected).abs() < 1e-3, "{square} instead of {expected}");
            }
            assert!(bell.pixels().iter().all(|value| *value > -1e-6));
        }
    }
}
