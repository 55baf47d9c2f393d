//! A localiser whose estimate depends on every pixel that it was given, and on nothing else.

use nalgebra::{Isometry3, Matrix6, Vector3};
use sunblind_estimator::{
    Disposition, Estimate, Health, Localizer, Measurement, MeasurementData, Mode, Rejection, Streams, Timestamp,
};

/// Moves by what the images' mean values say: any change in what reaches it, or in which order, moves it elsewhere.
#[derive(Default)]
pub struct FakeLocalizer {
    /// Of the newest image of either kind.
    newest: Option<Timestamp>,
    /// Of the newest colour image, at which its pose is.
    time: Option<Timestamp>,
    odom_from_robot: Isometry3<f64>,
    frames: u32,
}

impl FakeLocalizer {
    fn step(&mut self, value: f64, turn: Vector3<f64>) {
        self.odom_from_robot *= Isometry3::new(Vector3::new(value, 0.0, 0.1 * value), turn * value);
    }
}

impl Localizer for FakeLocalizer {
    fn handle(&mut self, measurement: Measurement) -> Disposition {
        if self.newest.is_some_and(|newest| measurement.captured_at <= newest) {
            return Disposition::Rejected(Rejection::OutOfOrder);
        }
        self.newest = Some(measurement.captured_at);
        match measurement.data {
            MeasurementData::Rgb(image) => {
                let sum: u64 = image.pixels().as_flattened().iter().map(|&value| u64::from(value)).sum();
                self.step(sum as f64 / image.pixels().len() as f64 * 1e-3, Vector3::x());
                self.frames += 1;
                self.time = self.newest;
            }
            MeasurementData::Depth(image) => {
                let sum: u64 = image.pixels().iter().map(|&value| u64::from(value)).sum();
                self.step(sum as f64 / image.pixels().len() as f64 * 1e-5, Vector3::y());
            }
            _ => return Disposition::Rejected(Rejection::Unsupported),
        }
        Disposition::Used
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.time,
            odom_from_robot: self.odom_from_robot,
            covariance: Matrix6::from_diagonal_element(1e-4 * f64::from(self.frames)),
            mode: Mode::Indoor,
            health: if self.frames < 2 { Health::Initialising } else { Health::Good },
        }
    }

    fn wanted_streams(&self) -> Streams {
        Streams { rgb: true, infrared: false, depth: true }
    }
}
