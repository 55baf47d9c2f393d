//! How long matching across spectra takes for 640×480, on one core: `cargo bench -p sunblind-tests --bench cross_spectral`.
//! The "infrared" is the colour image's negative moved by nine columns: how much there is to match decides nothing.

use std::time::Instant;

use sunblind_estimator::features::cross_spectral::{Band, CrossSpectral, CrossSpectralParams};
use sunblind_estimator::image::GrayImage;
use sunblind_tests::recorded;

/// As many as the odometry takes of an image.
const POINTS: usize = 700;
const RUNS: usize = 21;

fn main() {
    let recording = recorded::open("kinect1_redkitchen");
    let colour = recorded::frame(&recording, 0).rgb.to_luma();
    let (width, height) = colour.size();
    let negative = |index: usize| 255 - colour.at((index % width).saturating_sub(9), index / width);
    let infrared = GrayImage::from_pixels(width, height, (0..width * height).map(negative).collect());
    let infrared = infrared.expect("as many pixels");
    let mut params = CrossSpectralParams::default();
    params.points.max_features = POINTS;
    let mut matcher = CrossSpectral::new(params);
    let band = Band { rows: 2.0, columns: (0.0, 20.0) };
    for (name, band) in [("along a band", Some(&band)), ("anywhere", None)] {
        let mut found = 0;
        let mut run = || {
            let start = Instant::now();
            found = matcher.match_images(&colour, &infrared, band).len();
            start.elapsed().as_secs_f64() * 1e3
        };
        // The first run allocates.
        run();
        let mut ms: Vec<f64> = (0..RUNS).map(|_| run()).collect();
        ms.sort_by(f64::total_cmp);
        println!("{name:>12}: min {:.1} ms, median {:.1} ms, {found} matches", ms[0], ms[RUNS / 2]);
    }
}
