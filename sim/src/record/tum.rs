//! A folder in the TUM RGB-D layout: `rgb.txt` and `depth.txt` list the images, `groundtruth.txt` (optional) the truth,
//! `calibration.toml` (optional) the cameras.

use std::path::Path;

use sunblind_estimator::{Rig, Timestamp};

use super::calibration::{self, Body, Calibration};
use super::error::RecordError;
use super::frame::{FrameFiles, ImageFile};
use super::list::{self, Order};
use super::truth;
use crate::evaluation::StampedPose;

/// How far apart in time a colour and a depth image may be and still be one frame.
const PAIR_WITHIN_MS: i64 = 20;
const IMAGE_LINE: &str = "`timestamp filename`";

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
        let Calibration { rig, body } = match calibration {
            Some(file) => calibration::read(file)?,
            None if folder.join("calibration.toml").exists() => calibration::read(&folder.join("calibration.toml"))?,
            None => {
                warnings.push("no calibration.toml: a Kinect's defaults are assumed (f 525 px, registered)".to_owned());
                Calibration::kinect_default()
            }
        };
        let rgb = images(folder, "rgb.txt", "it lists the colour images, one `timestamp filename` a line")?;
        let depth = images(folder, "depth.txt", "it lists the depth images, one `timestamp filename` a line")?;
        let frames = pairs(&rgb, &depth);
        if frames.is_empty() {
            return Err(RecordError::NoPairs { folder: folder.to_owned(), within_ms: PAIR_WITHIN_MS });
        }
        for (kind, count) in [("colour", rgb.len()), ("depth", depth.len())] {
            if count > frames.len() {
                let alone = count - frames.len();
                warnings.push(format!("{alone} of {count} {kind} images are left out: none of the other kind is within {PAIR_WITHIN_MS} ms"));
            }
        }
        let truth = truth::read(&folder.join("groundtruth.txt"))?;
        Ok(Self { name: name_of(folder), rig, body, frames, truth, warnings })
    }
}

/// The folder's own name, also where the user said `.` or `..`.
fn name_of(folder: &Path) -> String {
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    folder.file_name().map_or_else(|| "recording".to_owned(), |name| name.to_string_lossy().into_owned())
}

fn images(folder: &Path, list: &str, wanted: &'static str) -> Result<Vec<ImageFile>, RecordError> {
    let file = folder.join(list);
    let text = list::read(&file, wanted)?;
    list::entries(&file, &text, IMAGE_LINE, Order::Rising)?
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
