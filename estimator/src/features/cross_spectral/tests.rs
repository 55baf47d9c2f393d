//! Scenes that are functions of the plane, so that every place in both images is known exactly.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;

/// Discs that hide one another (the "dead leaves" of Lee, Mumford & Huang 2001).
struct Leaves(Vec<Leaf>);

struct Leaf {
    x: f32,
    y: f32,
    radius: f32,
    colour: f32,
    /// A brightness that says nothing of that in colour.
    other: f32,
}

const WIDTH: usize = 320;
const HEIGHT: usize = 240;

impl Leaves {
    fn new(seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let leaf = |_| Leaf {
            x: random.random_range(-20.0..340.0),
            y: random.random_range(-20.0..260.0),
            radius: random.random_range(5.0..22.0),
            colour: random.random_range(20.0..220.0),
            other: random.random_range(20.0..220.0),
        };
        // The first lie on top.
        Self((0..600).map(leaf).collect())
    }

    /// The image whose pixel (x, y) shows the place `scene(x, y)`, each pixel the mean of sixteen samples.
    fn seen(&self, brightness: impl Fn(&Leaf) -> f32, scene: impl Fn(f32, f32) -> (f32, f32)) -> GrayImage {
        let mut image = GrayImage::filled(WIDTH, HEIGHT, 0);
        for (index, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let (x, y) = ((index % WIDTH) as f32, (index / WIDTH) as f32);
            let sample = |k: usize| {
                let (x, y) = scene(x - 0.375 + 0.25 * (k % 4) as f32, y - 0.375 + 0.25 * (k / 4) as f32);
                let top = self.0.iter().find(|leaf| (leaf.x - x).powi(2) + (leaf.y - y).powi(2) < leaf.radius.powi(2));
                top.map_or(128.0, &brightness)
            };
            *pixel = ((0..16).map(sample).sum::<f32>() / 16.0).round() as u8;
        }
        image
    }
}

/// Shares of the matches that are right to 0.25 px, to one pixel, and within two σ.
fn shares(matches: &[CrossMatch], truth: impl Fn(f32, f32) -> (f32, f32)) -> (f32, f32, f32) {
    let share = |holds: &dyn Fn(&CrossMatch, f32, f32) -> bool| {
        let held = matches.iter().filter(|found| {
            let (x, y) = truth(found.colour.0, found.colour.1);
            holds(found, found.infrared.0 - x, found.infrared.1 - y)
        });
        held.count() as f32 / matches.len() as f32
    };
    (
        share(&|_, dx, _| dx.abs() < 0.25),
        share(&|_, dx, dy| dx.hypot(dy) < 1.0),
        share(&|found, dx, _| dx.abs() < 2.0 * found.sigma),
    )
}

/// The matches of a plane whose disparity grows from 4 to 12 px across the image, as 25 mm of baseline and f = 525 px see
/// it from 3.3 to 1.1 m; the infrared image is the `brightness` of the leaves. Also their shares.
fn of_a_slanted_plane(seed: u64, brightness: impl Fn(&Leaf) -> f32) -> (usize, (f32, f32, f32)) {
    let leaves = Leaves::new(seed);
    let colour = leaves.seen(|leaf| leaf.colour, |x, y| (x, y));
    let slope = 8.0 / WIDTH as f32;
    // What colour has at x, infrared has at x + 4 + slope·x.
    let infrared = leaves.seen(brightness, |x, y| ((x - 4.0) / (1.0 + slope), y));
    let band = Band { rows: 2.0, columns: (0.0, 20.0) };
    let found = CrossSpectral::new(CrossSpectralParams::default()).match_images(&colour, &infrared, Some(&band));
    let shares = shares(&found, |x, y| (x + 4.0 + slope * x, y));
    (found.len(), shares)
}

#[test]
fn disparities_are_found_to_a_quarter_of_a_pixel_where_contrast_is_reversed_in_parts() {
    // The left half; about its border signs are mixed.
    let reversed = |leaf: &Leaf| leaf.x < 160.0;
    let brightness = |leaf: &Leaf| if reversed(leaf) { 200.0 - 0.7 * leaf.colour } else { 30.0 + 0.7 * leaf.colour };
    let (count, (fine, near, within)) = of_a_slanted_plane(1, brightness);
    assert!(count > 250, "{count}");
    assert!(fine > 0.8 && near > 0.95 && within > 0.88, "{fine} {near} {within}");
}

#[test]
fn where_colour_says_nothing_of_infrared_matches_are_fewer_and_their_sigma_says_so() {
    let (count, (_, near, within)) = of_a_slanted_plane(1, |leaf| leaf.other);
    assert!(count < 250 && near < 0.9, "{count} {near}");
    assert!(within > 0.9, "{within}");
}

#[test]
fn an_image_and_its_negative_match_anywhere() {
    let leaves = Leaves::new(2);
    // Turned by two degrees, larger by 4 %, and moved.
    let (sin, cos) = (0.035_f32.sin() * 1.04, 0.035_f32.cos() * 1.04);
    let warped = |x: f32, y: f32| (cos * x - sin * y + 5.3, sin * x + cos * y - 7.7);
    let square = cos * cos + sin * sin;
    let back = |x: f32, y: f32| {
        let (x, y) = (x - 5.3, y + 7.7);
        ((cos * x + sin * y) / square, (cos * y - sin * x) / square)
    };
    let colour = leaves.seen(|leaf| leaf.colour, |x, y| (x, y));
    let infrared = leaves.seen(|leaf| 255.0 - 0.5 * leaf.colour, back);
    let found = CrossSpectral::new(CrossSpectralParams::default()).match_images(&colour, &infrared, None);
    let (_, near, _) = shares(&found, warped);
    assert!(found.len() > 150 && near > 0.9, "{} {near}", found.len());
}

#[test]
fn bare_and_tiny_images_have_no_matches() {
    let band = Band { rows: 2.0, columns: (0.0, 20.0) };
    let mut matcher = CrossSpectral::new(CrossSpectralParams::default());
    for (width, height) in [(0, 0), (1, 1), (64, 48)] {
        let image = GrayImage::filled(width, height, 99);
        assert!(matcher.match_images(&image, &image, Some(&band)).is_empty());
        assert!(matcher.match_images(&image, &image, None).is_empty());
        assert!(matcher.match_points(&[(3.0, 3.0)], &image, &image, &band)[0].is_none());
    }
}

#[test]
fn what_lies_outside_the_band_is_not_found() {
    let leaves = Leaves::new(3);
    let colour = leaves.seen(|leaf| leaf.colour, |x, y| (x, y));
    let infrared = leaves.seen(|leaf| leaf.colour, |x, y| (x - 30.0, y));
    let mut matcher = CrossSpectral::new(CrossSpectralParams::default());
    let inside = Band { rows: 2.0, columns: (20.0, 40.0) };
    let outside = Band { rows: 2.0, columns: (0.0, 20.0) };
    let all = matcher.match_images(&colour, &infrared, Some(&inside)).len();
    let wrong = matcher.match_images(&colour, &infrared, Some(&outside)).len();
    assert!(all > 100 && wrong * 20 < all, "{wrong} of {all}");
}
