//! A small recording in the TUM RGB-D layout, to be replayed as it is or damaged first.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use image::{ImageBuffer, Luma, Rgb};
use tempfile::TempDir;

/// Width of its images, pixels.
pub const WIDTH: u32 = 64;
/// Height of its images, pixels.
pub const HEIGHT: u32 = 48;

const CALIBRATION: &str = "\
registered = true

[colour]
width_px = 64
height_px = 48
fx_px = 52.5
fy_px = 52.5
cx_px = 31.5
cy_px = 23.5
distortion = [0.0, 0.0, 0.0, 0.0, 0.0]

[depth]
width_px = 64
height_px = 48
fx_px = 52.5
fy_px = 52.5
cx_px = 31.5
cy_px = 23.5
distortion = [0.0, 0.0, 0.0, 0.0, 0.0]
units_per_m = 5000.0

[colour_from_depth]
translation_m = [0.0, 0.0, 0.0]
rotation_xyzw = [0.0, 0.0, 0.0, 1.0]
";

/// A recording in a folder of its own, which is gone with it.
pub struct TinyRecording {
    place: TempDir,
}

impl TinyRecording {
    /// `frames` frames at 10 Hz, colour and depth 1 ms apart, every image another; the body moves along x by 0.1 m a
    /// frame while it turns about z by 0.05 rad.
    pub fn new(frames: u32) -> Self {
        let recording = Self { place: tempfile::tempdir().expect("a temporary folder") };
        for folder in ["rgb", "depth"] {
            fs::create_dir_all(recording.path(folder)).expect("a folder");
        }
        let [mut rgb, mut depth, mut truth] =
            ["# timestamp filename\n", "# timestamp filename\n", ""].map(String::from);
        for frame in 0..frames {
            save_colour(&recording.path(&format!("rgb/{frame}.png")), frame);
            save_depth(&recording.path(&format!("depth/{frame}.png")), frame);
            let time = 100.0 + f64::from(frame) * 0.1;
            writeln!(rgb, "{time:.3} rgb/{frame}.png").expect("strings take all");
            writeln!(depth, "{:.3} depth/{frame}.png", time + 0.001).expect("strings take all");
            let (x, half_yaw) = (2.0 + f64::from(frame) * 0.1, f64::from(frame) * 0.025);
            writeln!(truth, "{time:.3} {x} 1 0.5 0 0 {} {}", half_yaw.sin(), half_yaw.cos()).expect("strings take all");
        }
        recording.write("rgb.txt", &rgb);
        recording.write("depth.txt", &depth);
        recording.write("groundtruth.txt", &truth);
        recording.write("calibration.toml", CALIBRATION);
        recording
    }

    /// The recording's folder.
    pub fn folder(&self) -> PathBuf {
        self.place.path().join("tiny")
    }

    /// A place beside the recording where nothing is yet.
    pub fn out(&self) -> PathBuf {
        self.place.path().join("out")
    }

    /// A file of the recording.
    pub fn path(&self, file: &str) -> PathBuf {
        self.folder().join(file)
    }

    /// Writes a file of the recording.
    pub fn write(&self, file: &str, text: impl AsRef<[u8]>) {
        fs::write(self.path(file), text).expect("a writable file");
    }

    /// Removes a file of the recording.
    pub fn remove(&self, file: &str) {
        fs::remove_file(self.path(file)).expect("an existing file");
    }

    /// Replaces the first `from` in a text file of the recording, which must be there.
    pub fn replace(&self, file: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.path(file)).expect("a text file");
        assert!(text.contains(from), "{file} has no {from:?}");
        self.write(file, text.replacen(from, to, 1));
    }

    /// Keeps the first `share` (0–1) of a file's bytes.
    pub fn truncate(&self, file: &str, share: f64) {
        let bytes = fs::read(self.path(file)).expect("a file");
        let kept = (bytes.len() as f64 * share) as usize;
        self.write(file, &bytes[..kept]);
    }
}

fn save_colour(file: &Path, frame: u32) {
    let pixel = |x: u32, y: u32| Rgb([x * 4 + frame, y * 5, (x * y) ^ frame].map(|value| value as u8));
    ImageBuffer::from_fn(WIDTH, HEIGHT, pixel).save(file).expect("a writable image");
}

fn save_depth(file: &Path, frame: u32) {
    let pixel = |x: u32, y: u32| Luma([(5000 + 50 * x + 10 * y + frame) as u16]);
    ImageBuffer::from_fn(WIDTH, HEIGHT, pixel).save(file).expect("a writable image");
}
