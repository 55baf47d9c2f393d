//! Where four squares of a chequered board meet, to a fraction of a pixel.

use nalgebra::{Complex, Point2, Vector2};
use sunblind_estimator::image::Image;

/// The search's first and last step, pixels.
const STEPS: [f64; 2] = [1.0, 1.0 / 256.0];
/// Least share of a window's variance that is a corner's: of a sharp one it is 0.6, of a blurred one up to 0.85, of noise
/// less than 0.1 unless the noise has spots as large as the window. A guess.
const LEAST: f64 = 0.5;

/// The corner near a pixel, in a window of `reach` pixels to all sides that holds no other one. What is not a number is
/// unknown. `None` where there is none, or something unknown in the window.
///
/// Once about a corner it is dark, bright, dark and bright: it has the largest second circular harmonic anywhere near,
/// however the board lies, and by symmetry noise alone can move it.
pub fn corner(image: &Image<f32>, near: Point2<f64>, reach: f64) -> Option<Point2<f64>> {
    let (mut at, mut step) = (near, STEPS[0]);
    let mut best = saddle(image, at, reach)?;
    while step >= STEPS[1] {
        let around = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)];
        let mut moved = None;
        for (x, y) in around {
            let there = at + Vector2::new(x, y);
            let found = saddle(image, there, reach)?;
            if found > best {
                (best, moved) = (found, Some(there));
            }
        }
        match moved {
            Some(there) if (there - near).norm() <= reach => at = there,
            Some(_) => return None,
            None => step /= 2.0,
        }
    }
    (best >= LEAST).then_some(at)
}

/// One of a window, and what it counts.
struct Pixel {
    value: f64,
    weight: f64,
    /// Its place from the window's middle as a complex number, squared; 1 at the window's rim.
    square: Complex<f64>,
}

/// Share of a window's variance that its second circular harmonic is; `None` where the window leaves the image.
fn saddle(image: &Image<f32>, at: Point2<f64>, reach: f64) -> Option<f64> {
    let (width, height) = image.size();
    let range = |middle: f64, size: usize| {
        let (first, last) = ((middle - reach).ceil(), (middle + reach).floor());
        (first >= 0.0 && last < size as f64).then_some(first as usize..=last as usize)
    };
    let (columns, rows) = (range(at.x, width)?, range(at.y, height)?);
    let pixels = rows.flat_map(|y| columns.clone().map(move |x| (x, y))).map(|(x, y)| {
        let from_here = Complex::new(x as f64 - at.x, y as f64 - at.y) / reach;
        // No pixel comes in or goes out with a jump.
        let weight = (1.0 - from_here.norm_sqr()).max(0.0).powi(2);
        Pixel { value: f64::from(image.at(x, y)), weight, square: from_here * from_here }
    });
    let pixels: Vec<_> = pixels.filter(|pixel| pixel.weight > 0.0).collect();
    let sum = |of: fn(&Pixel) -> f64| pixels.iter().map(of).sum::<f64>();
    let mean = sum(|pixel| pixel.weight * pixel.value) / sum(|pixel| pixel.weight);
    let variance = pixels.iter().map(|pixel| pixel.weight * (pixel.value - mean).powi(2)).sum::<f64>();
    let harmonic = pixels.iter().map(|pixel| pixel.square * (pixel.weight * (pixel.value - mean)));
    // Half of the harmonic's norm is its real part's, half its imaginary part's.
    let norm = 0.5 * sum(|pixel| pixel.weight * pixel.square.norm_sqr());
    let share = harmonic.sum::<Complex<f64>>().norm_sqr() / (norm * variance);
    share.is_finite().then_some(share)
}

#[cfg(test)]
mod tests {
    use rand::RngExt;

    use super::*;
    use crate::random::stream;

    /// Squares of `edge` pixels turned by an angle, with a corner at a place; each pixel is the mean over its area.
    fn squares(at: Point2<f64>, angle: f64, edge: f64, noise: f64) -> Image<f32> {
        let mut random = stream(1, "corner", 0);
        let (sin, cos) = angle.sin_cos();
        let pixels = (0..60 * 60).map(|index| {
            let bright = (0..64).filter(|sample| {
                let part = |k: usize| (k as f64 + 0.5) / 8.0 - 0.5;
                let x = (index % 60) as f64 + part(sample % 8) - at.x;
                let y = (index / 60) as f64 + part(sample / 8) - at.y;
                let (across, down) = ((cos * x + sin * y) / edge, (cos * y - sin * x) / edge);
                (across.floor() + down.floor()) % 2.0 == 0.0
            });
            (20.0 + 180.0 * bright.count() as f64 / 64.0 + noise * random.random_range(-1.0..1.0)) as f32
        });
        Image::from_pixels(60, 60, pixels.collect()).expect("as many pixels")
    }

    #[test]
    fn a_corner_is_found_to_less_than_a_tenth_of_a_pixel_however_the_board_lies() {
        for (shift, degrees) in [(0.0, 3.0), (0.13, 12.0), (0.38, 45.0), (0.5, -27.0), (0.71, 80.0)] {
            let truth = Point2::new(30.0 + shift, 29.0 - 0.7 * shift);
            let image = squares(truth, f64::to_radians(degrees), 15.0, 0.0);
            let found = corner(&image, truth + Vector2::new(1.9, -1.4), 6.5).expect("a corner");
            assert!((found - truth).norm() < 0.08, "{found} for {truth} at {degrees}°");
            let noisy = squares(truth, f64::to_radians(degrees), 15.0, 40.0);
            let found = corner(&noisy, truth + Vector2::new(1.9, -1.4), 6.5).expect("a corner");
            assert!((found - truth).norm() < 0.4, "{found} for {truth} at {degrees}° in noise");
        }
    }

    #[test]
    fn what_is_no_corner_is_none() {
        let middle = Point2::new(30.0, 30.0);
        let even = squares(Point2::new(-500.0, -500.0), 0.0, 1e6, 60.0);
        assert_eq!(corner(&even, middle, 6.5), None, "noise");
        let edge = squares(Point2::new(30.3, -500.0), 0.1, 1e6, 0.0);
        assert_eq!(corner(&edge, middle, 6.5), None, "an edge");
        let mut unknown = squares(middle, 0.1, 15.0, 0.0);
        assert!(corner(&unknown, middle, 6.5).is_some());
        unknown.pixels_mut()[31 * 60 + 32] = f32::NAN;
        assert_eq!(corner(&unknown, middle, 6.5), None, "a hole");
        assert_eq!(corner(&unknown, Point2::new(3.0, 30.0), 6.5), None, "beyond the rim");
    }
}
