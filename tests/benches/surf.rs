//! How long SURF takes, ours and dlib's, on the same image, in turns, on one core:
//! `cargo bench -p sunblind-tests --bench surf`, after `make -C tests/oracle`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use std::{env, fs};

use sunblind_estimator::features::surf::{Surf, SurfParams};
use sunblind_estimator::image::GrayImage;
use sunblind_tests::pgm;
use sunblind_tests::recorded;

/// Features that both must describe.
const FEATURES: usize = 600;
/// Low enough that both find more than that.
const THRESHOLD: f32 = 1.0;
/// Turns, and runs in each.
const TURNS: usize = 7;
const RUNS: usize = 15;

/// Milliseconds of a series of runs.
#[derive(Clone, Copy)]
struct Time {
    min: f64,
    median: f64,
}

fn main() {
    let recording = recorded::open("kinect1_redkitchen");
    let image = recorded::frame(&recording, 0).rgb.to_luma();
    let dlib = Dlib::built(&image);

    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..TURNS {
        ours.push(time_ours(&image));
        theirs.extend(dlib.as_ref().map(Dlib::time));
    }
    let ours = summary(&ours);
    println!("ours: min {:.2} ms, median {:.2} ms for {FEATURES} features", ours.min, ours.median);
    if dlib.is_some() {
        let theirs = summary(&theirs);
        println!("dlib: min {:.2} ms, median {:.2} ms", theirs.min, theirs.median);
        println!("ours / dlib: min {:.2}, median {:.2}", ours.min / theirs.min, ours.median / theirs.median);
    } else {
        println!("dlib: not built (make -C tests/oracle)");
    }
}

fn time_ours(image: &GrayImage) -> Time {
    let mut surf = Surf::new(SurfParams { max_features: FEATURES, min_response: THRESHOLD, ..SurfParams::default() });
    let mut run = || {
        let start = Instant::now();
        let features = surf.detect(image);
        let elapsed = start.elapsed();
        assert_eq!(features.len(), FEATURES);
        elapsed.as_secs_f64() * 1e3
    };
    // The first run allocates.
    run();
    let mut ms: Vec<f64> = (0..RUNS).map(|_| run()).collect();
    ms.sort_by(f64::total_cmp);
    Time { min: ms[0], median: ms[RUNS / 2] }
}

/// The best of all turns, and the median of their medians.
fn summary(turns: &[Time]) -> Time {
    let mut medians: Vec<f64> = turns.iter().map(|turn| turn.median).collect();
    medians.sort_by(f64::total_cmp);
    Time { min: turns.iter().map(|turn| turn.min).fold(f64::INFINITY, f64::min), median: medians[medians.len() / 2] }
}

/// dlib's SURF as a program, with an image of its own to read.
struct Dlib {
    program: PathBuf,
    image: PathBuf,
}

impl Dlib {
    /// `None` when nobody built it.
    fn built(image: &GrayImage) -> Option<Self> {
        let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("oracle/dlib_surf");
        let path = env::temp_dir().join(format!("sunblind_surf_bench_{}.pgm", std::process::id()));
        program.is_file().then(|| {
            pgm::write(&path, image).expect("the temporary folder takes an image");
            Self { program, image: path }
        })
    }

    fn time(&self) -> Time {
        let arguments = [FEATURES.to_string(), THRESHOLD.to_string(), RUNS.to_string()];
        let output = Command::new(&self.program).arg("time").arg(&self.image).args(arguments).output();
        let output = output.expect("dlib_surf runs").stdout;
        let text = String::from_utf8_lossy(&output);
        let words: Vec<_> = text.split_whitespace().collect();
        let ["points", points, "min_ms", min, "median_ms", median] = words[..] else { panic!("dlib_surf: {text:?}") };
        assert_eq!(points, FEATURES.to_string());
        let ms = |number: &str| number.parse().expect("milliseconds");
        Time { min: ms(min), median: ms(median) }
    }
}

impl Drop for Dlib {
    fn drop(&mut self) {
        // A file left in the temporary folder harms nobody.
        let _ = fs::remove_file(&self.image);
    }
}
