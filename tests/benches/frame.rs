//! How long the estimator takes for a frame, on one core, decoding excluded:
//! `cargo bench -p sunblind-tests --bench frame [-- MEMORY_FRAMES]`.
//!
//! With a number it also loops the recording until that many frames went in, and says how the memory grew.

use std::fs;
use std::sync::{Arc, Mutex};
use std::time::Instant;

use sunblind_estimator::params::Variant;
use sunblind_estimator::{Estimator, EstimatorParams, Localizer, Measurement, MeasurementData, Rig, Stage, Timestamp};
use sunblind_sim::record::Frame;
use sunblind_tests::recorded;

/// Frames decoded once and kept; enough for stable medians.
const FRAMES: usize = 150;
const STAGES: [&str; 4] = ["registration", "features", "matching", "motion"];

fn main() {
    let recording = recorded::open("kinect1_redkitchen");
    let count = recording.frames.len().min(FRAMES);
    let frames: Vec<Frame> = (0..count).map(|index| recorded::frame(&recording, index)).collect();
    println!("{count} frames of 640×480, milliseconds a frame on one core, median and 95 %");
    for (name, variant) in [("keyframes", Variant::Keyframes), ("paper", Variant::Paper)] {
        let params = EstimatorParams { variant, ..EstimatorParams::default() };
        time(name, &params, &recording.rig, &frames);
    }
    if let Some(wanted) = std::env::args().skip(1).find_map(|argument| argument.parse().ok()) {
        memory(wanted, &recording.rig, &frames);
    }
}

fn feed(estimator: &mut Estimator, frame: &Frame, time: Timestamp) {
    for data in [MeasurementData::Rgb(Arc::clone(&frame.rgb)), MeasurementData::Depth(Arc::clone(&frame.depth))] {
        estimator.handle(Measurement { captured_at: time, available_at: time, data });
    }
}

fn time(name: &str, params: &EstimatorParams, rig: &Rig, frames: &[Frame]) {
    let mut estimator = Estimator::new(params.clone(), rig.clone()).expect("the defaults hold");
    let marks: Arc<Mutex<Vec<(Stage, Instant)>>> = Arc::default();
    let observed = Arc::clone(&marks);
    estimator.observe_stages(Box::new(move |stage| observed.lock().expect("one thread").push((stage, Instant::now()))));
    let mut whole = Vec::new();
    for frame in frames {
        let start = Instant::now();
        feed(&mut estimator, frame, frame.rgb_time);
        whole.push(start.elapsed().as_secs_f64() * 1e3);
    }
    let (median, high) = spread(whole);
    println!("{name:>12}: {median:6.1} {high:6.1}");
    let marks = marks.lock().expect("one thread");
    for (stage, name) in STAGES.iter().enumerate() {
        let spent = marks.windows(2).filter(|pair| pair[0].0 as usize == stage);
        let (median, high) = spread(spent.map(|pair| (pair[1].1 - pair[0].1).as_secs_f64() * 1e3).collect());
        println!("{name:>18}: {median:6.1} {high:6.1}");
    }
}

fn spread(mut values: Vec<f64>) -> (f64, f64) {
    values.sort_by(f64::total_cmp);
    (values[values.len() / 2], values[values.len() * 95 / 100])
}

/// Feeds the recording to and fro, so that it never jumps, and prints the resident memory as it goes.
fn memory(wanted: usize, rig: &Rig, frames: &[Frame]) {
    let mut estimator = Estimator::new(EstimatorParams::default(), rig.clone()).expect("the defaults hold");
    println!("memory over {wanted} frames, MiB:");
    let to_and_fro = frames.iter().chain(frames.iter().rev()).cycle();
    for (index, frame) in to_and_fro.take(wanted).enumerate() {
        feed(&mut estimator, frame, Timestamp::from_nanos(index as i64 * 33_333_333));
        if index % (wanted / 5).max(1) == 0 || index + 1 == wanted {
            println!("{:>12}: {:6.1}", index + 1, resident_mib());
        }
    }
}

/// Resident memory from /proc/self/statm, in pages of 4 KiB; 0 where there is no such file.
fn resident_mib() -> f64 {
    let pages =
        fs::read_to_string("/proc/self/statm").ok().and_then(|text| text.split(' ').nth(1)?.parse::<f64>().ok());
    pages.unwrap_or(0.0) * 4096.0 / (1024.0 * 1024.0)
}
