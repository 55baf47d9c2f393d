//! Writes a recording: the TUM RGB-D layout with a `calibration.toml`.
//!
//! Everything is written into a hidden folder beside the wanted one, which takes its name only when it is whole:
//! a killed run leaves nothing that looks like a recording.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use nalgebra::Isometry3;
use sunblind_estimator::camera::{CameraModel, DepthEncoding};
use sunblind_estimator::image::{DepthImage, RgbImage};
use sunblind_estimator::{Rig, Timestamp};
use tempfile::TempDir;
use thiserror::Error;

use crate::evaluation::StampedPose;

/// What every recording holds; a folder with all of these may be replaced by a new recording.
const MARKS: [&str; 3] = ["rgb.txt", "depth.txt", "calibration.toml"];

/// A recording being written. Frames may come in any order and from any thread.
pub struct RecordingWriter {
    out: PathBuf,
    /// Deleted with all it holds when the writer is dropped.
    beside: TempDir,
    folder: PathBuf,
}

impl RecordingWriter {
    /// Begins a recording that will be at `out`, made with the cameras of `rig`.
    ///
    /// # Errors
    /// When `out` holds something else than a recording, or the disk refuses.
    pub fn create(out: &Path, rig: &Rig) -> Result<Self, WriteError> {
        refuse_foreign(out)?;
        let parent = match out.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        fs::create_dir_all(parent).map_err(|source| WriteError::io(parent, source))?;
        let beside = tempfile::Builder::new()
            .prefix(".recording-")
            .tempdir_in(parent)
            .map_err(|source| WriteError::io(parent, source))?;
        // A folder inside, because the temporary one itself is closed to other users.
        let folder = beside.path().join("recording");
        for images in ["rgb", "depth"] {
            let path = folder.join(images);
            fs::create_dir_all(&path).map_err(|source| WriteError::io(&path, source))?;
        }
        let writer = Self { out: out.to_owned(), beside, folder };
        writer.text("calibration.toml", &calibration_toml(rig)?)?;
        Ok(writer)
    }

    /// Writes the two images captured at `time`.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn write_frame(&self, time: Timestamp, rgb: &RgbImage, depth: &DepthImage) -> Result<(), WriteError> {
        let bytes: Vec<u8> = rgb.pixels().iter().flatten().copied().collect();
        self.png(&image_name("rgb", time), &bytes, rgb.size(), ExtendedColorType::Rgb8)?;
        // The encoder takes 16-bit samples in the machine's own byte order.
        let bytes: Vec<u8> = depth.pixels().iter().flat_map(|value| value.to_ne_bytes()).collect();
        self.png(&image_name("depth", time), &bytes, depth.size(), ExtendedColorType::L16)
    }

    /// Writes the lists and puts the recording in its place. `truth` holds the depth camera's pose at each frame that
    /// was written, in time order.
    ///
    /// # Errors
    /// When the disk refuses; then what was at the wanted place before is still there.
    pub fn finish(self, truth: &[StampedPose]) -> Result<(), WriteError> {
        let list = |head: &str, images: &str| {
            truth.iter().fold(format!("# {head}\n# timestamp filename\n"), |mut list, pose| {
                let _ = writeln!(list, "{} {}", stamp(pose.time), image_name(images, pose.time));
                list
            })
        };
        self.text("rgb.txt", &list("colour images", "rgb"))?;
        self.text("depth.txt", &list("depth maps, 16-bit PNG, 5000 per metre, 0 = no value", "depth"))?;
        self.text("groundtruth.txt", &truth_lines(truth))?;
        self.take_its_place()
    }

    fn take_its_place(self) -> Result<(), WriteError> {
        let failed = |source| WriteError::io(&self.out, source);
        refuse_foreign(&self.out)?;
        let previous = self.beside.path().join("previous");
        let replaces = self.out.exists();
        if replaces {
            fs::rename(&self.out, &previous).map_err(failed)?;
        }
        if let Err(source) = fs::rename(&self.folder, &self.out) {
            if replaces {
                fs::rename(&previous, &self.out).map_err(failed)?;
            }
            return Err(failed(source));
        }
        self.beside.close().map_err(failed)
    }

    fn png(&self, name: &str, bytes: &[u8], size: (usize, usize), colour: ExtendedColorType) -> Result<(), WriteError> {
        let mut png = Vec::with_capacity(bytes.len());
        PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Adaptive)
            .write_image(bytes, size.0 as u32, size.1 as u32, colour)
            .map_err(|source| WriteError::Encode { file: self.folder.join(name), source })?;
        self.bytes(name, &png)
    }

    fn text(&self, name: &str, text: &str) -> Result<(), WriteError> {
        self.bytes(name, text.as_bytes())
    }

    fn bytes(&self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        let path = self.folder.join(name);
        fs::write(&path, bytes).map_err(|source| WriteError::io(&path, source))
    }
}

/// Lets through what may be written to: nothing, an empty folder, or a recording.
fn refuse_foreign(out: &Path) -> Result<(), WriteError> {
    if !out.exists() {
        return Ok(());
    }
    let is_recording = MARKS.iter().all(|mark| out.join(mark).is_file());
    let is_empty = || fs::read_dir(out).map(|mut entries| entries.next().is_none());
    match is_recording || is_empty().map_err(|source| WriteError::io(out, source))? {
        true => Ok(()),
        false => Err(WriteError::NotARecording { folder: out.to_owned() }),
    }
}

/// Seconds with microseconds, as the TUM files have them.
fn stamp(time: Timestamp) -> String {
    format!("{:.6}", time.as_secs())
}

fn image_name(folder: &str, time: Timestamp) -> String {
    format!("{folder}/{}.png", stamp(time))
}

fn truth_lines(truth: &[StampedPose]) -> String {
    let mut lines =
        "# ground truth of the depth camera: world from camera\n# timestamp tx ty tz qx qy qz qw\n".to_owned();
    for StampedPose { time, world_from_body } in truth {
        let t = world_from_body.translation.vector;
        let q = world_from_body.rotation.coords;
        let _ = writeln!(
            lines,
            "{} {:.6} {:.6} {:.6} {:.8} {:.8} {:.8} {:.8}",
            stamp(*time),
            t.x,
            t.y,
            t.z,
            q.x,
            q.y,
            q.z,
            q.w
        );
    }
    lines
}

fn calibration_toml(rig: &Rig) -> Result<String, WriteError> {
    let DepthEncoding::Linear { units_per_metre } = rig.depth.encoding else {
        return Err(WriteError::RawDepth);
    };
    let Isometry3 { rotation, translation } = rig.colour_from_depth;
    Ok(format!(
        "registered = {}\n\n[colour]\n{}\n[depth]\n{}units_per_m = {units_per_metre:?}\n\n\
         [colour_from_depth]\ntranslation_m = {:?}\nrotation_xyzw = {:?}\n\n\
         [truth]\ncamera = \"depth\"\n",
        rig.depth.registered_to_colour,
        camera_toml(&rig.colour),
        camera_toml(&rig.depth.model),
        translation.vector.as_slice(),
        rotation.coords.as_slice(),
    ))
}

fn camera_toml(camera: &CameraModel) -> String {
    let CameraModel { width, height, fx, fy, cx, cy, distortion: d } = camera;
    format!(
        "width_px = {width}\nheight_px = {height}\nfx_px = {fx:?}\nfy_px = {fy:?}\ncx_px = {cx:?}\ncy_px = {cy:?}\n\
         distortion = {:?}   # k1 k2 p1 p2 k3\n",
        [d.k1, d.k2, d.p1, d.p2, d.k3]
    )
}

/// A recording that could not be written.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The place is taken by something that is not ours to delete.
    #[error("{}: holds something that is no recording; give another folder or an empty one", folder.display())]
    NotARecording {
        /// The folder.
        folder: PathBuf,
    },
    /// The layout has no raw disparity.
    #[error("raw disparity can't be written; give the depth camera a linear encoding")]
    RawDepth,
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
mod tests {
    use super::*;

    fn write(out: &Path, seconds: &[f64]) -> Result<(), WriteError> {
        let writer = RecordingWriter::create(out, &Rig::kinect_default())?;
        let mut truth = Vec::new();
        for &seconds in seconds {
            let time = Timestamp::from_secs(seconds).unwrap();
            writer.write_frame(time, &RgbImage::filled(4, 3, [1, 2, 3]), &DepthImage::filled(4, 3, 5001))?;
            truth.push(StampedPose { time, world_from_body: Isometry3::translation(1.0, 2.0, seconds) });
        }
        writer.finish(&truth)
    }

    #[test]
    fn the_layout_is_the_documented_one() {
        let scratch = tempfile::tempdir().unwrap();
        let out = scratch.path().join("deep/demo");
        write(&out, &[0.0, 1.0 / 30.0]).unwrap();
        let read = |name| fs::read_to_string(out.join(name)).unwrap();
        assert!(read("rgb.txt").ends_with("\n0.033333 rgb/0.033333.png\n"));
        assert!(read("groundtruth.txt").contains("\n0.033333 1.000000 2.000000 0.033333 0.0"));
        let depth = image::open(out.join("depth/0.000000.png")).unwrap().into_luma16();
        assert_eq!(depth.get_pixel(3, 2).0, [5001]);
        let calibration: toml::Table = read("calibration.toml").parse().unwrap();
        assert_eq!(calibration["depth"]["units_per_m"].as_float(), Some(5000.0));
        assert_eq!(calibration["colour"]["fx_px"].as_float(), Some(525.0));
        assert_eq!(calibration["colour_from_depth"]["rotation_xyzw"][3].as_float(), Some(1.0));
        assert_eq!(fs::read_dir(out.parent().unwrap()).unwrap().count(), 1, "something was left beside");
    }

    #[test]
    fn a_recording_is_replaced_whole() {
        let scratch = tempfile::tempdir().unwrap();
        let out = scratch.path().join("demo");
        write(&out, &[0.0, 0.5]).unwrap();
        write(&out, &[0.25]).unwrap();
        assert!(!out.join("rgb/0.500000.png").exists() && out.join("rgb/0.250000.png").exists());
    }

    #[test]
    fn what_is_no_recording_is_left_alone() {
        let scratch = tempfile::tempdir().unwrap();
        fs::write(scratch.path().join("thesis.tex"), "years of work").unwrap();
        assert!(matches!(write(scratch.path(), &[0.0]), Err(WriteError::NotARecording { .. })));
        assert!(scratch.path().join("thesis.tex").exists());
    }

    #[test]
    fn an_unfinished_recording_leaves_nothing() {
        let scratch = tempfile::tempdir().unwrap();
        let out = scratch.path().join("demo");
        drop(RecordingWriter::create(&out, &Rig::kinect_default()).unwrap());
        assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 0);
    }
}
