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
        let calibration = Calibration::nominal();
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
        REFERENCE_RAW - STEPS_PER_PIXEL * 43.5 * (1.0 / z - 1.0 / 1.2)
    }
}

/// Raw values of the pixels that lie inside the dead margins.
fn inner(depth: &DepthImage) -> Vec<u16> {
    (8..472).flat_map(|y| depth.row(y)[24..616].to_vec()).collect()
}

fn share_valid(raw: &[u16]) -> f64 {
    raw.iter().filter(|&&raw| raw != NO_DEPTH).count() as f64 / raw.len() as f64
}

#[test]
fn what_the_matcher_does() {
    let bench = Bench::new();
    for z in [0.6, 1.2, 1.25, 1.3, 2.0, 2.05, 4.0] {
        for noise in [0.0, 10.0, 40.0, 80.0, 130.0, 200.0, 400.0, 3000.0] {
            let t = std::time::Instant::now();
            let image = bench.infrared(|_, _| z, 400.0, if noise > 0.0 { 300.0 } else { 0.0 }, noise);
            let t1 = t.elapsed();
            let t = std::time::Instant::now();
            let depth = bench.matcher.depth(&image);
            let t2 = t.elapsed();
            let values = inner(&depth);
            let valid: Vec<f64> = values.iter().filter(|&&r| r != NO_DEPTH).map(|&r| f64::from(r)).collect();
            let want = bench.raw(z);
            let good: Vec<f64> = valid.iter().copied().filter(|r| (r - want).abs() < 8.0).collect();
            let mean = good.iter().sum::<f64>() / good.len() as f64;
            let sd = (good.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / good.len() as f64).sqrt();
            println!(
                "z {z} noise {noise}: valid {:.4} wrong {:.5} bias {:+.3} sd {:.3} levels | {t1:?} {t2:?}",
                share_valid(&values),
                1.0 - good.len() as f64 / valid.len() as f64,
                mean - want,
                sd
            );
        }
    }
}

#[test]
fn locking() {
    let bench = Bench::new();
    for noise in [0.0, 40.0, 130.0] {
        let mut line = format!("noise {noise}:");
        for eighth in 0..5 {
            let shift = 5.0 + f64::from(eighth) / 8.0;
            let z = 1.0 / (1.0 / 1.2 + shift / 43.5);
            let image = bench.infrared(|_, _| z, 400.0, 400.0, noise);
            let live = Live::of(Residual::of(image.pixels(), 640, 480));
            let mut e = Vec::new();
            for y in 100..140 {
                bench.matcher.reference.refine_row(&live, y, &[41; 640], |_, s| e.push(f64::from(s) - shift));
            }
            let mean = e.iter().sum::<f64>() / e.len() as f64;
            let sd = (e.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / e.len() as f64).sqrt();
            line += &format!(" {:+.3}±{:.3}", mean * 8.0, sd * 8.0);
        }
        println!("{line}");
    }
}
