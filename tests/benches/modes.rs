//! How long the estimator takes for a frame in each mode, CPU time of the one thread that it runs on:
//! `cargo bench -p sunblind-tests --bench modes`. The frames are a simulated robot's, rendered once and kept; those of a
//! real Kinect, which has colour and depth only, are indoor's where they are at hand.

use std::path::Path;

use cpu_time::ThreadTime;
use sunblind_estimator::mode::ModeChoice;
use sunblind_estimator::odometry::OutdoorMethod;
use sunblind_estimator::{
    Estimate, Estimator, EstimatorParams, Health, Localizer, Measurement, MeasurementData, PoseSource, Rig, Timestamp,
};
use sunblind_sim::robot::VelocityCommand;
use sunblind_sim::scenario::{AnyScenario, Override, Source};
use sunblind_sim::simulator::Simulator;
use sunblind_tests::recorded;

/// Frames of each drive; enough for stable medians.
const FRAMES: usize = 75;
/// A walk, m/s.
const SPEED: f64 = 0.4;
/// What the first paper's estimator takes, milliseconds.
const PAPER_MS: f64 = 64.86;

/// What is driven through, with what the images hold, and the modes that are timed on it: name, limit in milliseconds.
type Drive =
    (&'static str, &'static str, &'static [&'static str], &'static [(&'static str, ModeChoice, OutdoorMethod, f64)]);
const DRIVES: [Drive; 3] = [
    (
        "office, lit",
        "lab_loop.toml",
        &["robot.start_m=[9.6, 2.8]", "robot.start_heading_deg=90.0"],
        &[("indoor", ModeChoice::Indoor, OutdoorMethod::Temporal, 45.0)],
    ),
    (
        "office, dark",
        "lab_loop.toml",
        &["robot.start_m=[9.6, 2.8]", "robot.start_heading_deg=90.0", "light={daylight_scale=0.0, lamps=false}"],
        &[("night", ModeChoice::Night, OutdoorMethod::Temporal, 45.0)],
    ),
    (
        "yard at noon",
        "yard_noon.toml",
        &[],
        &[
            ("RGB/IR, temporal", ModeChoice::Outdoor, OutdoorMethod::Temporal, 90.0),
            ("RGB/IR, stereo", ModeChoice::Outdoor, OutdoorMethod::Stereo, 90.0),
        ],
    ),
];

fn main() {
    println!("CPU milliseconds a frame of 640×480; the paper's estimator took {PAPER_MS}");
    println!(
        "{:<15} {:<17} {:>7} {:>6} {:>6} {:>6} {:>8}",
        "frames of", "mode", "median", "95 %", "most", "limit", "tracked"
    );
    for (place, file, changes, modes) in DRIVES {
        let (rig, measurements) = driven(file, changes);
        for (name, mode, method, limit) in modes {
            time(place, name, *limit, params(*mode, *method), &rig, &measurements);
        }
    }
    if cfg!(recorded_data) {
        let (rig, measurements) = replayed("kinect1_redkitchen");
        let params = params(ModeChoice::Indoor, OutdoorMethod::Temporal);
        time("a real kitchen", "indoor", 45.0, params, &rig, &measurements);
    }
}

fn params(mode: ModeChoice, method: OutdoorMethod) -> EstimatorParams {
    let mut params = EstimatorParams { mode, ..EstimatorParams::default() };
    params.outdoor.method = method;
    params
}

/// All that a robot measures that drives straight on.
fn driven(file: &str, changes: &[&str]) -> (Rig, Vec<Measurement>) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(file);
    let changes: Vec<Override> = changes.iter().map(|change| change.parse().expect("key=value")).collect();
    let source = Source::read(&file, &changes).unwrap_or_else(|error| panic!("{error}"));
    let AnyScenario::Robot(scenario) = source.scenario().unwrap_or_else(|error| panic!("{error}")) else {
        panic!("{} has no robot", file.display())
    };
    let world = scenario.lit_world(&|_| {}).expect("a world of ours");
    let mut simulator = Simulator::new(&scenario, &world).unwrap_or_else(|error| panic!("{error}"));
    let end = (FRAMES + 2) as f64 / scenario.kinect.rate;
    let mut measurements = Vec::new();
    while simulator.now().as_secs() < end {
        let command = VelocityCommand { speed: SPEED, turn_rate: 0.0 };
        measurements.extend(simulator.step(command).unwrap_or_else(|error| panic!("{error}")));
    }
    (simulator.calibration().rig.clone(), measurements)
}

/// The first frames of a real recording.
fn replayed(name: &str) -> (Rig, Vec<Measurement>) {
    let recording = recorded::open(name);
    let count = recording.frames.len().min(FRAMES);
    let images = |index| {
        let frame = recorded::frame(&recording, index);
        let taken = |data| Measurement { captured_at: frame.rgb_time, available_at: frame.rgb_time, data };
        [taken(MeasurementData::Rgb(frame.rgb)), taken(MeasurementData::Depth(frame.depth))]
    };
    let measurements = (0..count).flat_map(images).collect();
    (recording.rig, measurements)
}

/// Prints what one mode takes.
fn time(place: &str, name: &str, limit: f64, params: EstimatorParams, rig: &Rig, measurements: &[Measurement]) {
    let mut estimator = Estimator::new(params, rig.clone()).expect("the defaults hold");
    let mut frames: Vec<(Timestamp, f64)> = Vec::new();
    let mut tracked = 0;
    let mut last = None;
    for measurement in measurements {
        let start = ThreadTime::now();
        estimator.handle(measurement.clone());
        let ms = 1e3 * start.elapsed().as_secs_f64();
        // What the wheels take belongs to the frame before.
        let is_image = !matches!(measurement.data, MeasurementData::WheelTicks { .. } | MeasurementData::Gyro(_));
        match frames.last_mut() {
            Some((time, spent)) if !is_image || *time == measurement.captured_at => *spent += ms,
            _ if is_image => frames.push((measurement.captured_at, ms)),
            _ => {}
        }
        let report = estimator.last_frame().map(|report| report.time);
        if report != last {
            last = report;
            let is_good = |(source, estimate): &(PoseSource, Estimate)| {
                *source == PoseSource::Mvo && estimate.health == Health::Good
            };
            tracked += usize::from(estimator.estimates().iter().any(is_good));
        }
    }
    let mut spent: Vec<f64> = frames.iter().map(|(_, spent)| *spent).collect();
    spent.sort_by(f64::total_cmp);
    // Stereo is asked at keyframes only: few, and what takes most.
    let [median, high, most] = [50, 95, 100].map(|percent| spent[(spent.len() * percent / 100).min(spent.len() - 1)]);
    println!(
        "{place:<15} {name:<17} {median:>7.1} {high:>6.1} {most:>6.1} {limit:>6.0} {:>8}",
        format!("{tracked}/{}", frames.len())
    );
}
