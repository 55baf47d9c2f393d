//! One reading on disk: a line of a list, or an image that a line names.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nalgebra::Vector3;
use sunblind_estimator::{Measurement, MeasurementData, Rig, Timestamp};

use super::error::RecordError;
use super::frame::{self, ImageFile};
use super::list::{self, Order};
use super::sensor::{Arrival, Latency, Sensor};

/// A reading that may still be on disk.
#[derive(Clone, Debug)]
pub struct Reading {
    captured_at: Timestamp,
    available_at: Timestamp,
    content: Content,
}

#[derive(Clone, Debug)]
enum Content {
    Read(MeasurementData),
    Image(Sensor, PathBuf),
}

impl Reading {
    /// An image of one of the cameras.
    pub(super) fn image(sensor: Sensor, image: ImageFile, latency: &Latency) -> Self {
        Self {
            captured_at: image.time,
            available_at: latency.available_at(sensor, image.time),
            content: Content::Image(sensor, image.path),
        }
    }

    /// Its place among all others.
    pub fn arrival(&self) -> Arrival {
        let sensor = match &self.content {
            Content::Read(data) => Sensor::of(data),
            Content::Image(sensor, _) => *sensor,
        };
        Arrival::new(self.available_at, sensor, self.captured_at)
    }

    /// Whether it has to be decoded.
    pub fn is_image(&self) -> bool {
        matches!(self.content, Content::Image(..))
    }

    /// The measurement, its image decoded.
    ///
    /// # Errors
    /// An image that is damaged, of another size than the rig's, or (depth and infrared) not 16-bit grey.
    pub fn load(&self, rig: &Rig) -> Result<Measurement, RecordError> {
        let data = match &self.content {
            Content::Read(data) => data.clone(),
            Content::Image(Sensor::Colour, file) => {
                MeasurementData::Rgb(Arc::new(frame::colour(file, rig.colour.size())?))
            }
            Content::Image(Sensor::Infrared, file) => {
                MeasurementData::Infrared(Arc::new(frame::infrared(file, rig.depth.model.size())?))
            }
            Content::Image(_, file) => MeasurementData::Depth(Arc::new(frame::depth(file, rig.depth.model.size())?)),
        };
        Ok(Measurement { captured_at: self.captured_at, available_at: self.available_at, data })
    }
}

/// The lines of `sensor`'s list in `folder`; none where there is no such list.
pub(super) fn series(folder: &Path, sensor: Sensor, latency: &Latency) -> Result<Vec<Reading>, RecordError> {
    let file = folder.join(sensor.list());
    if !file.exists() {
        return Ok(Vec::new());
    }
    let line = sensor.line();
    let text = list::read(&file, line)?;
    let entries = list::entries(&file, &text, line, Order::Rising)?;
    let readings = entries.iter().map(|entry| {
        let data = match sensor {
            Sensor::Gyro => MeasurementData::Gyro(Vector3::from(entry.numbers(line)?)),
            Sensor::Accelerometer => MeasurementData::Accelerometer(Vector3::from(entry.numbers(line)?)),
            Sensor::AmbientLight => {
                let [illuminance] = entry.numbers(line)?;
                MeasurementData::AmbientLight(illuminance)
            }
            Sensor::Wheels => {
                let [left, right] = entry.values("whole", |_| true, line)?;
                MeasurementData::WheelTicks { left, right }
            }
            Sensor::Colour | Sensor::Infrared | Sensor::Depth => unreachable!("a camera's list names images"),
        };
        let available_at = latency.available_at(sensor, entry.time);
        Ok(Reading { captured_at: entry.time, available_at, content: Content::Read(data) })
    });
    readings.collect()
}
