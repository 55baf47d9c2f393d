//! A localiser of your own, replayed and scored: this one always answers "no motion".
//!
//! `cargo run --release --example no_motion -- path/to/recording`

use nalgebra::{Isometry3, Matrix6};
use sunblind_estimator::{Disposition, Estimate, Health, Localizer, Measurement, Mode, Streams, Timestamp};
use sunblind_sim::evaluation::evaluate;
use sunblind_sim::record::Recording;
use sunblind_sim::runner::{Driven, ReplayOptions, replay};

struct NoMotion {
    time: Option<Timestamp>,
}

impl Localizer for NoMotion {
    fn handle(&mut self, measurement: Measurement) -> Disposition {
        self.time = Some(measurement.captured_at);
        Disposition::Used
    }

    fn estimate(&self) -> Estimate {
        let (odom_from_robot, covariance) = (Isometry3::identity(), Matrix6::identity());
        Estimate { time: self.time, odom_from_robot, covariance, mode: Mode::Odometer, health: Health::Good }
    }

    fn wanted_streams(&self) -> Streams {
        Streams { rgb: true, infrared: false, depth: false }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("give the path of a recording")?;
    let recording = Recording::open(folder.as_ref(), None)?;
    let localizer = Driven::own("no_motion", "no motion", Box::new(NoMotion { time: None }));
    let log = replay(&recording, vec![localizer], &ReplayOptions::default())?;
    match evaluate(&log.tracks[0].frames, &log.truth) {
        Some(score) => println!("ATE {:.3} m over {} frames", score.ate_m, log.truth.len()),
        None => println!("no ground truth to score against"),
    }
    Ok(())
}
