//! A recording's folder as a whole: which files there are, which images make a frame, and what comes in which order.

use std::path::Path;

use sunblind_estimator::{Rig, Timestamp};

use super::calibration::{self, Body, Calibration};
use super::error::RecordError;
use super::frame::{FrameFiles, ImageFile};
use super::list::{self, Order};
use super::reading::{self, Reading};
use super::sensor::{Latency, Sensor};
use super::truth;
use crate::evaluation::StampedPose;

/// How far apart in time a colour and a depth image may be and still be one frame.
const PAIR_WITHIN_MS: i64 = 20;

/// A recording, its images still on disk.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Its name: the folder's.
    pub name: String,
    /// What is believed of the sensors.
    pub rig: Rig,
    /// Whose poses are wanted, and whose the truth gives.
    pub body: Body,
    /// Its frames in time order; every image of one frame is earlier than every image of the next.
    pub frames: Vec<FrameFiles>,
    /// What else was measured, sensor by sensor.
    pub readings: Vec<Reading>,
    /// How long readings are under way.
    pub latency: Latency,
    /// The truth as recorded, in time order (a time may repeat); empty when there is none.
    pub truth: Vec<StampedPose>,
    /// What a reader should know first, one sentence each.
    pub warnings: Vec<String>,
}

impl Recording {
    /// Reads all of `folder` but the images, whose existence it checks. `calibration` replaces the folder's own
    /// `calibration.toml`; with neither, a Kinect's defaults are assumed and a warning says so.
    ///
    /// # Errors
    /// The first thing that makes the recording unusable.
    pub fn open(folder: &Path, calibration: Option<&Path>) -> Result<Self, RecordError> {
        if !folder.is_dir() {
            return Err(RecordError::NoFolder { folder: folder.to_owned() });
        }
        let mut warnings = Vec::new();
        let Calibration { rig, body, latency } = match calibration {
            Some(file) => calibration::read(file)?,
            None if folder.join("calibration.toml").exists() => calibration::read(&folder.join("calibration.toml"))?,
            None => {
                warnings.push("no calibration.toml: a Kinect's defaults are assumed (f 525 px, registered)".to_owned());
                Calibration::kinect_default()
            }
        };
        let rgb = images(folder, Sensor::Colour, "it lists the colour images, one `timestamp filename` a line")?;
        let depth = images(folder, Sensor::Depth, "it lists the depth images, one `timestamp filename` a line")?;
        let frames = pairs(&rgb, &depth);
        if frames.is_empty() {
            return Err(RecordError::NoPairs { folder: folder.to_owned(), within_ms: PAIR_WITHIN_MS });
        }
        let mut readings = Vec::new();
        for (sensor, kind, mut images) in [(Sensor::Colour, "colour", rgb), (Sensor::Depth, "depth", depth)] {
            let count = images.len();
            images.retain(|image| !is_in_a_frame(image, sensor, &frames));
            if images.is_empty() {
                continue;
            }
            // A robot gets its images one by one and can't know which of them will have a partner.
            let on_robot = rig.drive.is_some();
            let (alone, fate) = (images.len(), if on_robot { "make no frame" } else { "are left out" });
            warnings.push(format!(
                "{alone} of {count} {kind} images {fate}: none of the other kind is within {PAIR_WITHIN_MS} ms"
            ));
            if on_robot {
                readings.extend(images.into_iter().map(|image| Reading::image(sensor, image, &latency)));
            }
        }
        readings.extend(beside_the_frames(folder, &rig, &latency, &mut warnings)?);
        let truth = truth::read(&folder.join("groundtruth.txt"))?;
        Ok(Self { name: name_of(folder), rig, body, frames, readings, latency, truth, warnings })
    }

    /// Every reading, in the order in which a localiser gets them.
    pub fn stream(&self) -> Vec<Reading> {
        let frame_images = self.frames.iter().flat_map(|FrameFiles { rgb, depth }| {
            [(Sensor::Colour, rgb), (Sensor::Depth, depth)]
                .map(|(sensor, image)| Reading::image(sensor, image.clone(), &self.latency))
        });
        let mut stream: Vec<_> = frame_images.chain(self.readings.iter().cloned()).collect();
        stream.sort_by_key(Reading::arrival);
        stream
    }
}

/// What the optional lists hold.
fn beside_the_frames(
    folder: &Path,
    rig: &Rig,
    latency: &Latency,
    warnings: &mut Vec<String>,
) -> Result<Vec<Reading>, RecordError> {
    let mut readings = Vec::new();
    if folder.join(Sensor::Infrared.list()).exists() {
        let infrared = images(folder, Sensor::Infrared, "it lists the infrared images")?;
        readings.extend(infrared.into_iter().map(|image| Reading::image(Sensor::Infrared, image, latency)));
    }
    let has_odometry = folder.join(Sensor::Wheels.list()).exists();
    if has_odometry && rig.drive.is_none() {
        // Nobody knows what a count means then, and the file may be of another make.
        warnings.push("odometry.txt is left out: calibration.toml has no [drive]".to_owned());
    } else if !has_odometry && rig.drive.is_some() {
        warnings.push("no odometry.txt: the wheels of [drive] say nothing".to_owned());
    }
    let counts = rig.drive.is_some().then_some(Sensor::Wheels);
    for sensor in [Sensor::Gyro, Sensor::Accelerometer, Sensor::AmbientLight].into_iter().chain(counts) {
        readings.extend(reading::series(folder, sensor, latency)?);
    }
    Ok(readings)
}

/// The folder's own name, also where the user said `.` or `..`.
fn name_of(folder: &Path) -> String {
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    folder.file_name().map_or_else(|| "recording".to_owned(), |name| name.to_string_lossy().into_owned())
}

fn images(folder: &Path, sensor: Sensor, wanted: &'static str) -> Result<Vec<ImageFile>, RecordError> {
    let file = folder.join(sensor.list());
    let text = list::read(&file, wanted)?;
    list::entries(&file, &text, sensor.line(), Order::Rising)?
        .iter()
        .map(|entry| {
            let place = || entry.place_of(entry.rest);
            if entry.rest.is_empty() {
                return Err(RecordError::NoFileName { place: place() });
            }
            let path = folder.join(entry.rest);
            if !path.is_file() {
                return Err(RecordError::NoImage { place: place(), image: path });
            }
            Ok(ImageFile { time: entry.time, path })
        })
        .collect()
}

/// Pairs each colour image with the depth image that is nearest to it, if it is nearest to that one too.
/// Both being nearest means that pairs never interleave in time.
fn pairs(rgb: &[ImageFile], depth: &[ImageFile]) -> Vec<FrameFiles> {
    rgb.iter()
        .filter_map(|colour| {
            let partner = nearest(depth, colour.time)?;
            let apart = (i128::from(partner.time.as_nanos()) - i128::from(colour.time.as_nanos())).abs();
            let close = apart <= i128::from(PAIR_WITHIN_MS) * 1_000_000;
            let mutual = nearest(rgb, partner.time) == Some(colour);
            (close && mutual).then(|| FrameFiles { rgb: colour.clone(), depth: partner.clone() })
        })
        .collect()
}

fn is_in_a_frame(image: &ImageFile, sensor: Sensor, frames: &[FrameFiles]) -> bool {
    let time = |frame: &FrameFiles| if sensor == Sensor::Colour { frame.rgb.time } else { frame.depth.time };
    frames.binary_search_by_key(&image.time, time).is_ok()
}

/// The image nearest in time, the earlier of two that are equally near.
fn nearest(images: &[ImageFile], time: Timestamp) -> Option<&ImageFile> {
    let after = images.partition_point(|image| image.time < time);
    let around = images.get(after.saturating_sub(1)..images.len().min(after + 1))?;
    around.iter().min_by(|a, b| a.time.since(time).abs().total_cmp(&b.time.since(time).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_ms(times: &[i64]) -> Vec<ImageFile> {
        let image = |&ms| ImageFile { time: Timestamp::from_nanos(ms * 1_000_000), path: "image.png".into() };
        times.iter().map(image).collect()
    }

    fn paired_ms(rgb: &[i64], depth: &[i64]) -> Vec<(i64, i64)> {
        let ms = |image: &ImageFile| image.time.as_nanos() / 1_000_000;
        pairs(&at_ms(rgb), &at_ms(depth)).iter().map(|frame| (ms(&frame.rgb), ms(&frame.depth))).collect()
    }

    #[test]
    fn the_nearest_within_20_ms_is_taken_once() {
        assert_eq!(paired_ms(&[0, 33, 66], &[5, 30, 90]), [(0, 5), (33, 30)]);
        // 20 is within 20 ms of 0, but belongs to 33.
        assert_eq!(paired_ms(&[0, 33], &[20, 54]), [(33, 20)]);
        // Twice as much depth as colour: each colour image keeps its nearest.
        assert_eq!(paired_ms(&[0, 33, 66], &[0, 16, 33, 50, 66]), [(0, 0), (33, 33), (66, 66)]);
        assert_eq!(paired_ms(&[0, 10], &[5]), [(0, 5)]);
        assert_eq!(paired_ms(&[0], &[]), []);
    }
}
