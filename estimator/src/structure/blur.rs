//! Box filters, repeated until they are near a Gaussian.

use crate::image::Image;

/// `passes` box filters of `2·reach + 1` pixels in both directions; σ² = passes · reach · (reach + 1) / 3. Beyond its rim
/// the image is zero.
pub(super) fn blur(image: &Image<f32>, reach: usize, passes: usize) -> Image<f32> {
    let (width, height) = image.size();
    let mut current = image.clone();
    let mut next = Image::filled(width, height, 0.0);
    let weight = 1.0 / (2 * reach + 1) as f32;
    for _ in 0..passes {
        for y in 0..height {
            let row = current.row(y);
            let out = &mut next.pixels_mut()[y * width..(y + 1) * width];
            let mut sum: f32 = row[..reach.min(width)].iter().sum();
            for x in 0..width {
                sum += row.get(x + reach).copied().unwrap_or(0.0);
                out[x] = sum * weight;
                sum -= if x >= reach { row[x - reach] } else { 0.0 };
            }
        }
        // Down the columns, all of them at once.
        let mut sums = vec![0.0_f32; width];
        let add = |sums: &mut [f32], row: &[f32], sign: f32| {
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += sign * value);
        };
        for y in 0..reach.min(height) {
            add(&mut sums, next.row(y), 1.0);
        }
        for y in 0..height {
            if y + reach < height {
                add(&mut sums, next.row(y + reach), 1.0);
            }
            let out = &mut current.pixels_mut()[y * width..(y + 1) * width];
            out.iter_mut().zip(&sums).for_each(|(out, sum)| *out = sum * weight);
            if y >= reach {
                add(&mut sums, next.row(y - reach), -1.0);
            }
        }
    }
    current
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
