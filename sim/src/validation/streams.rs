//! When images come: the colour camera's rows one after the other, 30 frames a second, and of a device that has one
//! video stream, colour or infrared.

use sunblind_estimator::{MeasurementData, Timestamp};

use super::scene::{Light, wall_world};
use super::skew::colour_readout;
use super::statistics::mean;
use super::{Effort, Finding, Findings, ValidationError};
use crate::robot::VelocityCommand;
use crate::scenario::Scenario;
use crate::simulator::Simulator;

/// A robot that stands before a wall, its device having one video stream.
const STANDING: &str = "\
seed = 1
duration_s = 10.0
world = { name = \"laboratory\" }
path = { kind = \"circle\", start_m = [0.0, 0.0], start_heading_deg = 90.0, radius_m = 1.0 }
kinect = { rate_hz = 30.0, streams = \"exclusive\", stream_switch_s = 0.2 }
";

/// When images of each kind were captured, seconds.
#[derive(Default)]
struct Captured {
    colour: Vec<f64>,
    infrared: Vec<f64>,
    depth: Vec<f64>,
}

/// Asks for infrared after `first` seconds, for colour again after twice that, and ends after three times.
fn with_switches(first: f64) -> Result<Captured, ValidationError> {
    let scenario: Scenario = toml::from_str(STANDING).expect("a scenario");
    let mut simulator = Simulator::new(&scenario, &wall_world(2.0, 0.8, Light::LED))?;
    let mut captured = Captured::default();
    while simulator.now().as_secs() < 3.0 * first {
        simulator.want_infrared((first..2.0 * first).contains(&simulator.now().as_secs()));
        for measurement in simulator.step(VelocityCommand::default())? {
            let seconds = |time: Timestamp| time.as_secs();
            match measurement.data {
                MeasurementData::Rgb(_) => captured.colour.push(seconds(measurement.captured_at)),
                MeasurementData::Infrared(_) => captured.infrared.push(seconds(measurement.captured_at)),
                MeasurementData::Depth(_) => captured.depth.push(seconds(measurement.captured_at)),
                _ => (),
            }
        }
    }
    Ok(captured)
}

/// V17. libfreenect: 480 rows of 54.21 µs; one USB endpoint for colour and infrared.
pub(super) fn timing(effort: Effort) -> Findings {
    let Captured { colour, infrared, depth } = with_switches(if effort == Effort::Full { 1.0 } else { 0.5 })?;
    let gaps = |times: &[f64]| times.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>();
    let longest = |times: &[f64]| gaps(times).into_iter().fold(0.0, f64::max);
    let rate = 1.0 / mean(&gaps(&depth));
    let both = colour.iter().filter(|time| infrared.contains(time)).count();
    // From the last colour image to the first infrared one.
    let first_infrared = infrared.first().copied().unwrap_or(f64::INFINITY);
    let last_colour = colour.iter().copied().take_while(|time| *time < first_infrared).last().unwrap_or(0.0);
    Ok(vec![
        Finding::new("colour, first row to last, ms", 26.0, 23.0..=29.0, 1000.0 * colour_readout()?),
        Finding::new("frames a second", 30.0, 29.9..=30.1, rate),
        Finding::new("longest time without depth, ms", 33.3, 33.0..=34.0, 1000.0 * longest(&depth)),
        Finding::new("instants with colour and infrared, exclusive streams", 0.0, 0.0..=0.0, both as f64),
        Finding::new(
            "from the last colour to the first infrared image, switch of 200 ms, ms",
            233.0,
            200.0..=300.0,
            1000.0 * (first_infrared - last_colour),
        ),
    ])
}
