//! Real recordings in the TUM RGB-D layout, with colour and depth paired line by line. They are not part of the
//! project: where they are missing, tests skip. Where they are present, a file that cannot be read is a panic.

use std::fs;
use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde::Deserialize;
use sunblind_estimator::Rig;
use sunblind_estimator::camera::{CameraModel, DepthCamera, DepthEncoding, Distortion};
use sunblind_estimator::image::{DepthImage, Image, RgbImage};

/// Where the recordings lie: `SUNBLIND_DATA`, or `../shared/data` from the project's root.
pub fn data_folder() -> PathBuf {
    match std::env::var_os("SUNBLIND_DATA") {
        Some(folder) => folder.into(),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
    }
}

/// One recording: its calibration, and where its images lie.
pub struct Recording {
    /// The published calibration.
    pub rig: Rig,
    frames: Vec<(PathBuf, PathBuf)>,
}

impl Recording {
    /// Opens the recording in the folder `name`; `None`, said on standard error, when it is not there.
    pub fn open(name: &str) -> Option<Self> {
        let folder = data_folder().join(name);
        if !folder.is_dir() {
            eprintln!("skipped: no recorded data ({})", folder.display());
            return None;
        }
        let calibration: Calibration =
            toml::from_str(&text(&folder.join("calibration.toml"))).unwrap_or_else(|error| panic!("{name}: {error}"));
        let images = |list: &str| second_column(&folder.join(list)).into_iter().map(|name| folder.join(name));
        Some(Self { frames: images("rgb.txt").zip(images("depth.txt")).collect(), rig: calibration.rig() })
    }

    /// The colour image of frame `index`.
    pub fn colour(&self, index: usize) -> RgbImage {
        let image = decode(&self.frames[index].0).into_rgb8();
        let pixels = image.pixels().map(|pixel| pixel.0).collect();
        Image::from_pixels(image.width() as usize, image.height() as usize, pixels).expect("one value a pixel")
    }

    /// The depth image of frame `index`.
    pub fn depth(&self, index: usize) -> DepthImage {
        let image = decode(&self.frames[index].1).into_luma16();
        let (width, height) = (image.width() as usize, image.height() as usize);
        Image::from_pixels(width, height, image.into_raw()).expect("one value a pixel")
    }
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn decode(path: &Path) -> image::DynamicImage {
    image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The file name in every line that is no comment.
fn second_column(path: &Path) -> Vec<String> {
    let name = |line: &str| line.split_whitespace().nth(1).expect("time stamp and file name").to_owned();
    text(path).lines().filter(|line| !line.starts_with('#')).map(name).collect()
}

#[derive(Deserialize)]
struct Calibration {
    registered: bool,
    colour: Optics,
    depth: Depth,
    colour_from_depth: Transform,
}

#[derive(Deserialize)]
struct Optics {
    width_px: usize,
    height_px: usize,
    fx_px: f64,
    fy_px: f64,
    cx_px: f64,
    cy_px: f64,
    distortion: [f64; 5],
}

#[derive(Deserialize)]
struct Depth {
    #[serde(flatten)]
    optics: Optics,
    units_per_m: f64,
}

#[derive(Deserialize)]
struct Transform {
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

impl Optics {
    fn model(&self) -> CameraModel {
        let [k1, k2, p1, p2, k3] = self.distortion;
        CameraModel {
            width: self.width_px,
            height: self.height_px,
            fx: self.fx_px,
            fy: self.fy_px,
            cx: self.cx_px,
            cy: self.cy_px,
            distortion: Distortion { k1, k2, p1, p2, k3 },
        }
    }
}

impl Calibration {
    fn rig(&self) -> Rig {
        let [x, y, z] = self.colour_from_depth.translation_m;
        let rotation = UnitQuaternion::from_quaternion(Quaternion::from(self.colour_from_depth.rotation_xyzw));
        Rig {
            colour: self.colour.model(),
            depth: DepthCamera {
                model: self.depth.optics.model(),
                encoding: DepthEncoding::Linear { units_per_metre: self.depth.units_per_m },
                registered_to_colour: self.registered,
            },
            colour_from_depth: Isometry3::from_parts(Translation3::new(x, y, z), rotation),
            robot_from_colour: Isometry3::identity(),
        }
    }
}
