//! Writes a recording as it is measured: images at once, lists line by line. Whatever the length, hardly more is kept
//! in memory than the images being written.
//!
//! Everything goes into a hidden folder beside the wanted one, which takes its name only when it is whole: a killed run
//! leaves nothing that looks like a recording.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use sunblind_estimator::camera::DepthEncoding;
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};
use thiserror::Error;

use super::calibration::{Body, Calibration};
use super::sensor::{Latency, Sensor};
use super::stamp::decimal_seconds;
use crate::evaluation::StampedPose;
use crate::new_folder::{FolderError, Kind, NewFolder};

static RECORDING: Kind =
    Kind { whose: "a recording's", mark: "a folder with rgb.txt, depth.txt and calibration.toml", is: is_recording };

fn is_recording(folder: &Path) -> bool {
    ["rgb.txt", "depth.txt", "calibration.toml"].iter().all(|mark| folder.join(mark).is_file())
}

const TRUTH: &str = "groundtruth.txt";
/// What every recording has, even without an image.
const CAMERAS: [Sensor; 2] = [Sensor::Colour, Sensor::Depth];

/// A recording being written.
///
/// Images may come in any order and from any thread; the readings of every other sensor, and the truth, in the order of
/// their time.
pub struct RecordingWriter {
    folder: NewFolder,
    depth: DepthEncoding,
    body: Body,
    latency: Latency,
    /// The images that are on disk.
    images: Mutex<BTreeSet<(Sensor, Timestamp)>>,
    series: Mutex<BTreeMap<String, Series>>,
}

/// A list that grows.
struct Series {
    file: BufWriter<File>,
    last: Timestamp,
}

impl RecordingWriter {
    /// Begins a recording that will be at `out`, made with sensors as `calibration` says.
    ///
    /// # Errors
    /// When `out` holds something else than a recording, or the disk refuses.
    pub fn create(out: &Path, calibration: &Calibration) -> Result<Self, WriteError> {
        let writer = Self {
            folder: NewFolder::begin(out, &RECORDING)?,
            depth: calibration.rig.depth.encoding,
            body: calibration.body,
            latency: calibration.latency.clone(),
            images: Mutex::default(),
            series: Mutex::default(),
        };
        for sensor in CAMERAS {
            writer.make_folder(sensor)?;
        }
        writer.file("calibration.toml", calibration.to_string().as_bytes())?;
        Ok(writer)
    }

    /// Writes one measurement.
    ///
    /// # Errors
    /// When the disk refuses, or the measurement can't be told by a recording: it arrived at another time than the
    /// calibration's latency says, or was captured no later than the one before.
    pub fn write(&self, measurement: &Measurement) -> Result<(), WriteError> {
        let Measurement { captured_at: time, available_at, data } = measurement;
        let sensor = Sensor::of(data);
        if self.latency.available_at(sensor, *time) != *available_at {
            return Err(WriteError::Latency { sensor: sensor.stem(), time: *time });
        }
        match data {
            MeasurementData::Rgb(image) => {
                let bytes: Vec<u8> = image.pixels().as_flattened().to_vec();
                self.image(sensor, *time, &bytes, image.size(), ExtendedColorType::Rgb8)
            }
            MeasurementData::Infrared(image) | MeasurementData::Depth(image) => {
                // The encoder takes 16-bit samples in the machine's own byte order.
                let bytes: Vec<u8> = image.pixels().iter().flat_map(|value| value.to_ne_bytes()).collect();
                self.image(sensor, *time, &bytes, image.size(), ExtendedColorType::L16)
            }
            MeasurementData::WheelTicks { left, right } => {
                self.line(&sensor.list(), sensor.line(), *time, &format!("{left} {right}"))
            }
            MeasurementData::Gyro(vector) | MeasurementData::Accelerometer(vector) => {
                self.line(&sensor.list(), sensor.line(), *time, &spaced(vector.as_slice()))
            }
            MeasurementData::AmbientLight(illuminance) => {
                self.line(&sensor.list(), sensor.line(), *time, &spaced(&[*illuminance]))
            }
        }
    }

    /// Writes where the calibration's body truly was.
    ///
    /// # Errors
    /// When the disk refuses, or the pose is no later than the one before.
    pub fn write_truth(&self, truth: &StampedPose) -> Result<(), WriteError> {
        let t = truth.world_from_body.translation.vector;
        let q = truth.world_from_body.rotation.coords;
        let head =
            format!("where {} truly was, world from body\n# timestamp tx ty tz qx qy qz qw", self.body.in_words());
        self.line(TRUTH, &head, truth.time, &spaced(&[t.x, t.y, t.z, q.x, q.y, q.z, q.w]))
    }

    /// Writes the lists of the images and puts the recording in its place.
    ///
    /// # Errors
    /// When the disk refuses; then what was at the wanted place before is still there.
    pub fn finish(self) -> Result<(), WriteError> {
        for (name, mut series) in std::mem::take(&mut *lock(&self.series)) {
            series.file.flush().map_err(|source| WriteError::io(&self.folder.path().join(name), source))?;
        }
        let images = std::mem::take(&mut *lock(&self.images));
        let listed: BTreeSet<Sensor> = images.iter().map(|(sensor, _)| *sensor).chain(CAMERAS).collect();
        for sensor in listed {
            let mut list = format!("# {}\n# timestamp filename\n", self.describe(sensor));
            for (_, time) in images.iter().filter(|(of, _)| *of == sensor) {
                let _ = writeln!(list, "{} {}", decimal_seconds(*time), image_name(sensor, *time));
            }
            self.file(&sensor.list(), list.as_bytes())?;
        }
        Ok(self.folder.publish()?)
    }

    /// What a camera's images are.
    fn describe(&self, sensor: Sensor) -> String {
        match (sensor, self.depth) {
            (Sensor::Depth, DepthEncoding::Linear { units_per_metre }) => {
                format!("depth images, 16-bit PNG, {units_per_metre} per metre, 0 = no value")
            }
            (Sensor::Depth, DepthEncoding::KinectDisparity { .. }) => {
                "depth images, 16-bit PNG, raw 11-bit disparity, 2047 = no value".to_owned()
            }
            (Sensor::Infrared, _) => "infrared images, 16-bit PNG, 10-bit values".to_owned(),
            _ => "colour images, 8-bit PNG".to_owned(),
        }
    }

    fn image(
        &self,
        sensor: Sensor,
        time: Timestamp,
        bytes: &[u8],
        (width, height): (usize, usize),
        colour: ExtendedColorType,
    ) -> Result<(), WriteError> {
        if !lock(&self.images).insert((sensor, time)) {
            return Err(WriteError::NotLater { list: sensor.list(), time });
        }
        self.make_folder(sensor)?;
        let name = image_name(sensor, time);
        let mut png = Vec::with_capacity(bytes.len());
        PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Adaptive)
            .write_image(bytes, width as u32, height as u32, colour)
            .map_err(|source| WriteError::Encode { file: self.folder.path().join(&name), source })?;
        self.file(&name, &png)
    }

    /// Appends a line to a list, which is begun with `head` where it is new.
    fn line(&self, list: &str, head: &str, time: Timestamp, values: &str) -> Result<(), WriteError> {
        let path = self.folder.path().join(list);
        let failed = |source| WriteError::io(&path, source);
        let mut all = lock(&self.series);
        let series = match all.get_mut(list) {
            Some(series) if time <= series.last => return Err(WriteError::NotLater { list: list.to_owned(), time }),
            Some(series) => series,
            None => {
                let mut file = BufWriter::new(File::create(&path).map_err(failed)?);
                writeln!(file, "# {head}").map_err(failed)?;
                all.entry(list.to_owned()).or_insert(Series { file, last: time })
            }
        };
        series.last = time;
        writeln!(series.file, "{} {values}", decimal_seconds(time)).map_err(failed)
    }

    fn make_folder(&self, sensor: Sensor) -> Result<(), WriteError> {
        let folder = self.folder.path().join(sensor.stem());
        fs::create_dir_all(&folder).map_err(|source| WriteError::io(&folder, source))
    }

    fn file(&self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        let path = self.folder.path().join(name);
        fs::write(&path, bytes).map_err(|source| WriteError::io(&path, source))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn image_name(sensor: Sensor, time: Timestamp) -> String {
    format!("{}/{}.png", sensor.stem(), decimal_seconds(time))
}

/// Numbers with as many digits as bring their bits back.
fn spaced(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

/// A recording that could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The place is taken, or not writable.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A measurement that was longer or shorter under way than the calibration says.
    #[error(
        "{sensor}: what was captured at {} s did not arrive after the latency that the calibration gives it; a recording \
         has one latency a sensor",
        time.as_secs()
    )]
    Latency {
        /// Its name in files.
        sensor: &'static str,
        /// When it was captured.
        time: Timestamp,
    },
    /// A list's times must rise.
    #[error("{list}: {} s is not later than the time before it", time.as_secs())]
    NotLater {
        /// The list.
        list: String,
        /// The time.
        time: Timestamp,
    },
    /// The disk refuses.
    #[error("{}: {source}", path.display())]
    Io {
        /// What was being written.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The image can't be encoded.
    #[error("{}: {source}", file.display())]
    Encode {
        /// The image.
        file: PathBuf,
        /// What the encoder says.
        source: ImageError,
    },
}

impl WriteError {
    fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }
}

#[cfg(test)]
mod tests;
