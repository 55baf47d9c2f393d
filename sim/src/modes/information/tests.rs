//! Images of which it is known how much there is in them.

use nalgebra::Isometry3;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::kinect::calibration::Calibration;
use crate::kinect::sensors::{Exposure, colour, infrared};
use crate::random::stream;

const EXPOSURE: Exposure = Exposure { time: 0.01, gain: 2.0 };

/// An infrared image of 64 × 64 pixels: a mean, upon it a chequered pattern and the chip's noise, both in its σ.
fn infrared_image(mean: f64, pattern: f64, noise: f64) -> (InfraredImage, InfraredSensor) {
    let chip = infrared::sensor(EXPOSURE, true, 0, 0);
    let per_electron = f64::from(chip.numbers_per_electron);
    let sigma = (mean / per_electron + f64::from(chip.read_variance)).sqrt() * per_electron;
    let mut random = stream(1, "noise of a test", 0);
    let pixel = |index: usize| {
        let sign = if (index % 64 + index / 64).is_multiple_of(2) { 1.0 } else { -1.0 };
        let draw: f64 = StandardNormal.sample(&mut random);
        (mean + sigma * (pattern * sign + noise * draw)).round().clamp(0.0, 1023.0) as u16
    };
    (InfraredImage::from_pixels(64, 64, (0..64 * 64).map(pixel).collect()).unwrap(), chip)
}

fn share(mean: f64, pattern: f64, noise: f64) -> f64 {
    let (image, chip) = infrared_image(mean, pattern, noise);
    of_infrared(&image, &chip)
}

#[test]
fn contrast_counts_from_three_sigma_on_at_any_brightness_with_noise_or_without() {
    for mean in [150.0, 300.0, 600.0] {
        for noise in [0.0, 1.0] {
            assert_eq!(share(mean, 0.0, noise), 0.0, "noise is no contrast: {mean}");
            assert_eq!(share(mean, 2.0, noise), 0.0, "{mean}");
            assert_eq!(share(mean, 4.0, noise), 1.0, "{mean}");
        }
    }
    let at_the_limit = share(300.0, 3.0, 1.0);
    assert!((0.2..0.8).contains(&at_the_limit), "{at_the_limit}");
}

#[test]
fn what_is_saturated_or_black_says_nothing() {
    assert_eq!(share(2000.0, 9.0, 1.0), 0.0, "all is white");
    assert_eq!(share(0.0, 0.0, 1.0), 0.0, "all is black, but for noise");
    let (mut image, chip) = infrared_image(300.0, 6.0, 1.0);
    image.pixels_mut()[..64 * 32].fill(1023);
    assert_eq!(of_infrared(&image, &chip), 0.5, "the lower half is left");
    // A window frame: what is left of a block beside it counts if it is half of the block.
    let (mut image, chip) = infrared_image(300.0, 6.0, 1.0);
    for (index, pixel) in image.pixels_mut().iter_mut().enumerate() {
        if index % 64 < 13 {
            *pixel = 1023;
        }
    }
    assert_eq!(of_infrared(&image, &chip), 6.0 / 8.0);
}

#[test]
fn colour_is_judged_by_its_light_and_not_by_its_code() {
    let chip = colour::sensor(EXPOSURE, [1.0; 3], true, 0);
    let per_electron = f64::from(chip.level_per_electron.y);
    let striped = |level: f64, sigmas: f64| {
        let sigma = (level / per_electron + f64::from(chip.read_variance)).sqrt() * per_electron;
        let code = |level: f64| {
            (1..=255_u8).min_by(|&a, &b| {
                let off = |code: u8| (f64::from(linear(f32::from(code) / 255.0)) - level).abs();
                off(a).total_cmp(&off(b))
            })
        };
        let codes = [-1.0, 1.0].map(|sign| code(level + sign * sigmas * sigma).unwrap());
        let pixels = (0..64 * 64).map(|index| [200, codes[index % 2], 7]).collect();
        of_colour(&RgbImage::from_pixels(64, 64, pixels).unwrap(), &chip)
    };
    for level in [0.02, 0.2, 0.7] {
        assert_eq!([striped(level, 2.0), striped(level, 5.0)], [0.0, 1.0], "{level}");
    }
    assert_eq!(of_colour(&RgbImage::filled(64, 64, [0, 255, 0]), &chip), 0.0);
}

#[test]
fn depth_is_right_within_three_of_the_published_sigma() {
    let unit = Calibration::nominal();
    let camera = unit.rig(Isometry3::identity()).depth;
    let of_wall = |z: f64, error: f64| {
        let image = DepthImage::filled(64, 64, unit.raw_of(z + error));
        of_depth(&image, &camera, &Image::filled(8, 8, z as f32))
    };
    for z in [1.0, 2.0, 4.0] {
        let sigma = 1.425e-3 * z * z;
        // A value is rounded to half a step, which is one sigma.
        assert_eq!([of_wall(z, 1.5 * sigma), of_wall(z, -4.5 * sigma)], [1.0, 0.0], "{z} m");
    }
    let nothing = DepthImage::filled(64, 64, unit.raw_of(0.0));
    assert_eq!(of_depth(&nothing, &camera, &Image::filled(8, 8, 2.0)), 0.0);
    let something = DepthImage::filled(64, 64, unit.raw_of(8.0));
    assert_eq!(of_depth(&something, &camera, &Image::filled(8, 8, f32::INFINITY)), 0.0, "the sky has none");
    let mut half = DepthImage::filled(64, 64, unit.raw_of(2.0));
    half.pixels_mut()[..64 * 32].fill(unit.raw_of(2.5));
    assert_eq!(of_depth(&half, &camera, &Image::filled(8, 8, 2.0)), 0.5);
}

#[test]
fn the_best_mode_is_that_of_the_papers_table() {
    let best = |rgb, infrared, depth| Information { rgb, infrared, depth }.best_mode();
    assert_eq!(best(0.5, 0.5, 0.5), Mode::Indoor);
    assert_eq!(best(0.5, 0.0, 0.5), Mode::Indoor);
    assert_eq!(best(0.5, 0.5, 0.29), Mode::Outdoor);
    assert_eq!(best(0.0, 0.5, 0.3), Mode::Night);
    for (rgb, infrared, depth) in [(0.5, 0.0, 0.0), (0.0, 0.5, 0.0), (0.0, 0.0, 0.5), (0.0, 0.0, 0.0)] {
        assert_eq!(best(rgb, infrared, depth), Mode::Odometer);
    }
}
