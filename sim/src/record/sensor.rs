//! The sensors of a recording: what each is called on disk, and whose reading comes first of those that arrive together.

use serde::Deserialize;
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};

/// A kind of reading. Of readings that arrive at one instant, those of a kind that stands further up are handed over
/// first: a gyro's turn belongs to the wheels' way that ends with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sensor {
    /// Angular velocity.
    #[serde(rename = "gyro_s")]
    Gyro,
    /// Accelerometer.
    #[serde(rename = "specific_force_s")]
    Accelerometer,
    /// Encoders.
    #[serde(rename = "odometry_s")]
    Wheels,
    /// Illuminance.
    #[serde(rename = "light_s")]
    AmbientLight,
    /// Colour images.
    #[serde(rename = "rgb_s")]
    Colour,
    /// Infrared images.
    #[serde(rename = "ir_s")]
    Infrared,
    /// Depth images.
    #[serde(rename = "depth_s")]
    Depth,
}

impl Sensor {
    /// All, in the order in which readings of one instant are handed over.
    pub const ALL: [Self; 7] =
        [Self::Gyro, Self::Accelerometer, Self::Wheels, Self::AmbientLight, Self::Colour, Self::Infrared, Self::Depth];

    /// Whose reading it is.
    pub fn of(data: &MeasurementData) -> Self {
        match data {
            MeasurementData::Gyro(_) => Self::Gyro,
            MeasurementData::Accelerometer(_) => Self::Accelerometer,
            MeasurementData::WheelTicks { .. } => Self::Wheels,
            MeasurementData::AmbientLight(_) => Self::AmbientLight,
            MeasurementData::Rgb(_) => Self::Colour,
            MeasurementData::Infrared(_) => Self::Infrared,
            MeasurementData::Depth(_) => Self::Depth,
        }
    }

    /// What its list (`<stem>.txt`), its folder of images and its latency (`<stem>_s`) are named after. TUM's
    /// `accelerometer.txt` holds a camera's accelerometer in the camera's frame: another name for another thing.
    pub fn stem(self) -> &'static str {
        match self {
            Self::Gyro => "gyro",
            Self::Accelerometer => "specific_force",
            Self::Wheels => "odometry",
            Self::AmbientLight => "light",
            Self::Colour => "rgb",
            Self::Infrared => "ir",
            Self::Depth => "depth",
        }
    }

    /// The file that lists its readings.
    pub fn list(self) -> String {
        format!("{}.txt", self.stem())
    }

    /// What a line of its list looks like.
    pub fn line(self) -> &'static str {
        match self {
            Self::Gyro => "`timestamp wx wy wz`: seconds, rad/s in the robot's frame",
            Self::Accelerometer => "`timestamp fx fy fz`: seconds, m/s² in the robot's frame",
            Self::Wheels => "`timestamp left_ticks right_ticks`: seconds, encoder counts",
            Self::AmbientLight => "`timestamp illuminance`: seconds, lux",
            Self::Colour | Self::Infrared | Self::Depth => "`timestamp filename`",
        }
    }
}

/// When a reading reaches the estimator, among all others: by time, then by kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Arrival {
    available_at: Timestamp,
    sensor: Sensor,
    captured_at: Timestamp,
}

impl Arrival {
    /// Of a reading of `sensor`.
    pub fn new(available_at: Timestamp, sensor: Sensor, captured_at: Timestamp) -> Self {
        Self { available_at, sensor, captured_at }
    }

    /// Of a measurement.
    pub fn of(measurement: &Measurement) -> Self {
        Self::new(measurement.available_at, Sensor::of(&measurement.data), measurement.captured_at)
    }
}

/// How long each sensor's readings take from their capture until the estimator can have them: one constant time a
/// sensor, none by default.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Latency {
    nanos: [i64; Sensor::ALL.len()],
}

impl Latency {
    /// With `seconds`, rounded to the nanosecond, for `sensor`.
    #[must_use]
    pub fn with(mut self, sensor: Sensor, seconds: f64) -> Self {
        self.nanos[sensor as usize] = (seconds * 1e9).round() as i64;
        self
    }

    /// Whole nanoseconds.
    pub fn nanos(&self, sensor: Sensor) -> i64 {
        self.nanos[sensor as usize]
    }

    /// When the estimator can have what `sensor` captured.
    pub fn available_at(&self, sensor: Sensor, captured_at: Timestamp) -> Timestamp {
        Timestamp::from_nanos(captured_at.as_nanos().saturating_add(self.nanos(sensor)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_of_one_instant_have_an_order() {
        let at = |ms: i64, sensor| {
            let captured_at = Timestamp::from_nanos(ms * 1_000_000);
            Arrival::new(
                Latency::default().with(Sensor::Depth, 0.05).available_at(sensor, captured_at),
                sensor,
                captured_at,
            )
        };
        let mut arrivals = [
            at(0, Sensor::Depth),
            at(50, Sensor::Colour),
            at(50, Sensor::Wheels),
            at(50, Sensor::Gyro),
            at(49, Sensor::Colour),
        ];
        arrivals.sort();
        let sensors = arrivals.map(|arrival| arrival.sensor);
        assert_eq!(sensors, [Sensor::Colour, Sensor::Gyro, Sensor::Wheels, Sensor::Colour, Sensor::Depth]);
        assert!(Sensor::ALL.is_sorted());
    }
}
