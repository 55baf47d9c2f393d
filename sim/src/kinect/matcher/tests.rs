//! The matcher on infrared images made on the CPU: a scene of depths, dots, even ambient light, Gaussian noise.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use super::*;

/// The nominal unit's matcher and a way to show it scenes.
struct Bench {
    calibration: Calibration,
    projector: Projector,
    matcher: Matcher,
}

impl Bench {
    fn new() -> Self {
        Self::of(Calibration::nominal())
    }

    fn of(calibration: Calibration) -> Self {
        let projector = Projector::of(&calibration);
        let matcher = Matcher::new(&calibration, &projector);
        Self { calibration, projector, matcher }
    }

    /// `dot`: digital numbers of a dot's peak, the same at all distances; `noise`: their standard deviation.
    fn infrared(&self, depth: impl Fn(f64, f64) -> f64, dot: f64, ambient: f64, noise: f64) -> InfraredImage {
        let camera = self.calibration.infrared;
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let noise = Normal::new(0.0, noise).unwrap();
        let pixels = (0..camera.width * camera.height).map(|index| {
            let (column, row) = ((index % camera.width) as f64, (index / camera.width) as f64);
            let (x, y) = ((column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy);
            let light = f64::from(self.projector.light_seen_at(x, y, depth(column, row)));
            (light * dot + ambient + noise.sample(&mut random)).round().clamp(0.0, 1023.0) as u16
        });
        InfraredImage::from_pixels(camera.width, camera.height, pixels.collect()).unwrap()
    }

    /// Raw disparity, unrounded, of a depth.
    fn raw(&self, z: f64) -> f64 {
        REFERENCE_RAW - STEPS_PER_PIXEL * 0.075 * self.calibration.infrared.fx * (1.0 / z - 1.0 / 1.2)
    }
}

/// What the matcher makes of a wall, judged against where it is.
struct Found {
    /// Share of pixels with depth.
    valid: f64,
    /// Share of those that are wrong by more than a pixel.
    wrong: f64,
    /// Mean and standard deviation of the others' error, raw steps.
    bias: f64,
    spread: f64,
}

/// Digital numbers of a dot's peak in these tests.
const DOT: f64 = 400.0;
const AMBIENT: f64 = 300.0;

impl Bench {
    fn find_wall(&self, z: f64, noise: f64) -> Found {
        let depth = self.matcher.depth(&self.infrared(|_, _| z, DOT, AMBIENT, noise));
        // Inside the dead margins, and where the pattern reaches at any distance.
        let raw: Vec<u16> =
            (8..depth.height() - 8).flat_map(|y| depth.row(y)[24..depth.width() - 24].to_vec()).collect();
        let errors = raw.iter().filter(|&&raw| raw != NO_DEPTH).map(|&raw| f64::from(raw) - self.raw(z));
        let (right, wrong): (Vec<f64>, Vec<f64>) = errors.partition(|error| error.abs() < STEPS_PER_PIXEL);
        let bias = right.iter().sum::<f64>() / right.len() as f64;
        let variance = right.iter().map(|error| (error - bias).powi(2)).sum::<f64>() / right.len() as f64;
        let valid = right.len() + wrong.len();
        Found {
            valid: valid as f64 / raw.len() as f64,
            wrong: wrong.len() as f64 / valid.max(1) as f64,
            bias,
            spread: variance.sqrt(),
        }
    }
}

#[test]
fn without_noise_depth_is_complete_and_right_to_the_step() {
    let bench = Bench::new();
    for z in [0.6, 0.8, 1.2, 1.25, 2.0, 2.1, 4.0, 9.0] {
        let found = bench.find_wall(z, 0.0);
        assert!(found.valid > 0.995 && found.wrong < 1e-4, "{z} m: {} valid, {} wrong", found.valid, found.wrong);
        // Rounding may shift all by half a step.
        assert!(found.bias.abs() < 0.55 && found.spread < 0.6, "{z} m: {} ± {} steps", found.bias, found.spread);
    }
}

#[test]
fn a_halved_unit_finds_depth_as_the_full_one_does() {
    let (full, halved) = (Bench::new(), Bench::of(Calibration::nominal().halved()));
    for (z, noise) in [(0.6, 0.0), (1.2, 0.0), (4.0, 0.0), (9.0, 0.0), (1.2, 80.0), (4.0, 80.0)] {
        let [full, found] = [&full, &halved].map(|bench| bench.find_wall(z, noise));
        // The view's middle tile, the brightest, is larger, and there are fewer candidates to be mistaken for.
        assert!(found.valid > full.valid - 0.01, "{z} m: {} valid, {}", full.valid, found.valid);
        assert!(found.wrong < 0.01 && found.bias.abs() < 0.55, "{z} m: {} wrong, {} steps", found.wrong, found.bias);
        // Without noise it is rounding alone, of whatever fraction the distance happens to have.
        assert!(found.spread < 1.2 * full.spread.max(0.5), "{z} m: ± {} steps, {}", full.spread, found.spread);
    }
}

#[test]
fn sub_pixel_shifts_are_not_drawn_to_whole_pixels() {
    let bench = Bench::new();
    for eighths in 0..=8 {
        let shift = 5.0 + f64::from(eighths) / 8.0;
        let z = 1.0 / (1.0 / bench.calibration.reference_distance + shift / 43.5);
        let infrared = bench.infrared(|_, _| z, DOT, AMBIENT, 0.0);
        let live = Live::of(&Residual::of(infrared.pixels(), 640, 480));
        let (mut sum, mut count) = (0.0, 0.0);
        let candidate = (5 + i16::from(eighths > 4) - SHIFTS.start as i16) as u8;
        let mut candidates = [NO_MATCH; 640];
        candidates[RADIUS..632].fill(candidate);
        let (mut row, mut shifts) = (Row::new(640), [NO_SHIFT; 640]);
        for y in 100..140 {
            bench.matcher.reference.refine_row(&live, y, &candidates, &mut row, &mut shifts);
            for found in shifts.iter().filter(|&&found| found != NO_SHIFT) {
                sum += STEPS_PER_PIXEL * (f64::from(*found) - shift);
                count += 1.0;
            }
        }
        assert!((sum / count).abs() < 0.05, "{shift} px: {} steps", sum / count);
    }
}

#[test]
fn matches_are_lost_in_noise_rather_than_wrong() {
    // The published share of correct matches of an ideal correlation is 1.00 at 5, 0.99 at 3, 0.79 at 2 and 0.36 at 1.
    let bench = Bench::new();
    let mut last = 1.0;
    for (signal_to_noise, least, most) in [(5.0, 0.9, 1.0), (3.0, 0.5, 0.99), (2.0, 0.1, 0.79), (1.0, 0.0, 0.05)] {
        let found = bench.find_wall(1.2, DOT / signal_to_noise);
        let valid = found.valid;
        assert!((least..=most).contains(&valid) && valid <= last, "{valid} valid at {signal_to_noise}");
        assert!(found.wrong * valid < 1e-3, "{} of all pixels wrong at {signal_to_noise}", found.wrong * valid);
        last = valid;
    }
}

#[test]
fn noise_alone_and_even_light_have_no_depth() {
    let bench = Bench::new();
    for (ambient, noise) in [(300.0, 50.0), (300.0, 0.0), (1023.0, 0.0), (0.0, 0.0)] {
        let depth = bench.matcher.depth(&bench.infrared(|_, _| 1.0, 0.0, ambient, noise));
        let valid = depth.pixels().iter().filter(|&&raw| raw != NO_DEPTH).count();
        assert!(valid < 640 * 480 / 1000, "{valid} pixels with depth at {ambient} ± {noise}");
    }
}

#[test]
fn every_processor_finds_the_same() {
    let bench = Bench::new();
    let steps = |column: f64, row: f64| {
        if ((column / 50.0 + row / 70.0) as usize).is_multiple_of(3) { 0.9 } else { 1.5 + row / 200.0 }
    };
    let infrared = bench.infrared(steps, DOT, AMBIENT, 80.0);
    assert_eq!(bench.matcher.depth(&infrared), bench.matcher.depth_on(Arch::Scalar, &infrared));
}

#[test]
fn the_borders_have_no_depth() {
    let bench = Bench::new();
    let depth = bench.matcher.depth(&bench.infrared(|_, _| 1.2, DOT, AMBIENT, 0.0));
    assert!((0..480).all(|y| (632..640).all(|x| depth.at(x, y) == NO_DEPTH)), "the device's band at the right");
    assert!(depth.row(3).iter().all(|&raw| raw == NO_DEPTH) && depth.at(3, 240) == NO_DEPTH);
    assert!(depth.at(100, 4) != NO_DEPTH && depth.at(8, 240) != NO_DEPTH && depth.at(631, 240) != NO_DEPTH);
}
