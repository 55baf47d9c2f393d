//! `calibration.toml`: what is believed of a recording's sensors.
//!
//! ```toml
//! registered = false                       # true: depth images lie in the colour camera's pixels
//! alignment_sigma_px = 0.2                 # optional: how far, standard deviation, all this puts what one camera sees
//!                                          # from its place in the other's image; without it 2, as off the shelf
//!
//! [colour]
//! width_px = 640
//! height_px = 480
//! fx_px = 525.0
//! fy_px = 525.0
//! cx_px = 319.5
//! cy_px = 239.5
//! distortion = [0.0, 0.0, 0.0, 0.0, 0.0]   # k1 k2 p1 p2 k3
//!
//! [depth]                                  # the same keys, and
//! units_per_m = 5000.0                     # or, for raw disparity: raw_offset = 1090.0 and baseline_m = 0.075
//!
//! [colour_from_depth]                      # points in the depth camera's frame → the colour camera's
//! translation_m = [-0.025, 0.0, 0.0]
//! rotation_xyzw = [0.0, 0.0, 0.0, 1.0]
//!
//! [truth]                                  # optional: whose poses are wanted and groundtruth.txt gives
//! camera = "depth"                         # or "colour", which is also meant without this table
//!
//! [mount]                                  # instead of [truth]: the poses are those of a robot
//! robot_from_colour = { translation_m = [0.1, 0.0, 0.6], rotation_xyzw = [-0.5, 0.5, -0.5, 0.5] }
//!
//! [drive]                                  # optional, with [mount]: the robot's driven wheels, read by odometry.txt
//! ticks_per_m = 138000.0
//! effective_track_m = 0.588                # the track that a differential drive would need to turn like this robot
//!
//! [latency]                                # optional: from a reading's time stamp until the estimator can have it;
//! depth_s = 0.066666667                    # 0 where not given; likewise gyro_s, odometry_s, rgb_s, ir_s, …
//! ```

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use nalgebra::{Isometry3, Quaternion, Translation3};
use serde::Deserialize;
use sunblind_estimator::Rig;
use sunblind_estimator::camera::{CameraModel, DepthCamera, DepthEncoding, Distortion, RigError, UNCALIBRATED_SIGMA};
use sunblind_estimator::fusion::Drive;
use toml::Spanned;

use super::error::RecordError;
use super::list;
use super::place::Place;
use super::rotation::rotation;
use super::sensor::{Latency, Sensor};

/// How far a quaternion's norm may be from 1: what four decimals leave.
const NORM_TOLERANCE: f64 = 1e-3;
/// No reading takes longer to arrive, seconds.
const MAX_LATENCY: f64 = 60.0;

/// A recording's calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The sensors; the robot frame is that of `body`.
    pub rig: Rig,
    /// Whose poses are wanted, and whose the truth gives.
    pub body: Body,
    /// How long readings are under way.
    pub latency: Latency,
}

/// The body that a recording's poses are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// The colour camera.
    Colour,
    /// The depth camera.
    Depth,
    /// A robot that carries the cameras.
    Robot,
}

impl Body {
    /// As a reader would say it.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Colour => "the colour camera",
            Self::Depth => "the depth camera",
            Self::Robot => "the robot",
        }
    }
}

impl Calibration {
    /// What is assumed of a Kinect that nobody calibrated.
    pub fn kinect_default() -> Self {
        Self { rig: Rig::kinect_default(), body: Body::Colour, latency: Latency::default() }
    }
}

/// Reads `file`.
///
/// # Errors
/// No such file, no TOML, or the first number that no camera can have, with its line and column.
pub fn read(file: &Path) -> Result<Calibration, RecordError> {
    let text = list::read(file, "give the path of a calibration.toml, or leave --calibration out")?;
    parse(&text).map_err(|Fault { span, problem }| RecordError::Calibration {
        place: Place::at_offset(file, &text, span.start),
        problem,
    })
}

/// Something wrong with the bytes `span` of the file.
#[derive(Debug)]
struct Fault {
    span: Range<usize>,
    problem: String,
}

fn fault(span: Range<usize>, problem: impl Into<String>) -> Fault {
    Fault { span, problem: problem.into() }
}

fn parse(text: &str) -> Result<Calibration, Fault> {
    let file: File = toml::from_str(text)
        .map_err(|error| fault(error.span().unwrap_or(0..0), error.message().replace('\n', ", ")))?;
    let colour_from_depth = file.colour_from_depth.isometry()?;
    let (body, robot_from_colour) = match (&file.truth, &file.mount) {
        (Some(truth), Some(_)) => {
            return Err(fault(
                truth.span(),
                "[truth] and [mount] exclude each other; with [mount] the poses and the truth are the robot's, \
                 so delete one of them",
            ));
        }
        (None, Some(mount)) => (Body::Robot, mount.robot_from_colour.isometry()?),
        (Some(truth), None) if truth.get_ref().camera == Camera::Depth => (Body::Depth, colour_from_depth.inverse()),
        _ => (Body::Colour, Isometry3::identity()),
    };
    if let Some(key) = file.colour.get_ref().depth_key() {
        return Err(fault(key, "this belongs into [depth]; move it there"));
    }
    let rig = Rig {
        colour: file.colour.get_ref().model(&file.colour.span(), "colour")?,
        depth: DepthCamera {
            model: file.depth.get_ref().model(&file.depth.span(), "depth")?,
            encoding: file.depth.get_ref().encoding(&file.depth.span())?,
            registered_to_colour: *file.registered.get_ref(),
        },
        colour_from_depth,
        alignment_sigma: file.alignment_sigma_px.as_ref().map_or(UNCALIBRATED_SIGMA, |sigma| *sigma.get_ref()),
        robot_from_colour,
        drive: file.drive.as_ref().map(|drive| wheels(drive, body)).transpose()?,
    };
    rig.validate().map_err(|error| {
        let place = match error {
            RigError::Drive { .. } => file.drive.as_ref().map(Spanned::span),
            RigError::Alignment { .. } => file.alignment_sigma_px.as_ref().map(Spanned::span),
            _ => None,
        };
        match place {
            Some(place) => fault(place, error.to_string()),
            // What is left to find concerns both cameras: registered depth of another size than colour.
            None => fault(file.registered.span(), format!("{error}; write registered = false")),
        }
    })?;
    Ok(Calibration { rig, body, latency: latency(&file.latency)? })
}

fn wheels(drive: &Spanned<Wheels>, body: Body) -> Result<Drive, Fault> {
    if body != Body::Robot {
        return Err(fault(
            drive.span(),
            "[drive] needs to know where the camera sits on the robot; write [mount] with robot_from_colour",
        ));
    }
    let Wheels { ticks_per_m, effective_track_m } = drive.get_ref();
    Ok(Drive {
        ticks_per_metre: positive("ticks_per_m", ticks_per_m, "138000.0 (a P3-AT's)")?,
        effective_track: positive("effective_track_m", effective_track_m, "0.588 (a P3-AT's)")?,
    })
}

fn latency(delays: &BTreeMap<Sensor, Spanned<f64>>) -> Result<Latency, Fault> {
    delays.iter().try_fold(Latency::default(), |latency, (&sensor, delay)| {
        let seconds = *delay.get_ref();
        if !(0.0..=MAX_LATENCY).contains(&seconds) {
            let problem = format!("{}_s is {seconds}; write 0 to {MAX_LATENCY} s, such as 0.05", sensor.stem());
            return Err(fault(delay.span(), problem));
        }
        Ok(latency.with(sensor, seconds))
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    registered: Spanned<bool>,
    alignment_sigma_px: Option<Spanned<f64>>,
    colour: Spanned<Optics>,
    depth: Spanned<Optics>,
    colour_from_depth: Transform,
    truth: Option<Spanned<Truth>>,
    mount: Option<Mount>,
    drive: Option<Spanned<Wheels>>,
    #[serde(default)]
    latency: BTreeMap<Sensor, Spanned<f64>>,
}

/// A camera's table. Every key is optional here, so that a missing one can be answered with what to write.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Optics {
    width_px: Option<Spanned<usize>>,
    height_px: Option<Spanned<usize>>,
    fx_px: Option<Spanned<f64>>,
    fy_px: Option<Spanned<f64>>,
    cx_px: Option<Spanned<f64>>,
    cy_px: Option<Spanned<f64>>,
    distortion: Option<Spanned<[f64; 5]>>,
    units_per_m: Option<Spanned<f64>>,
    raw_offset: Option<Spanned<f64>>,
    baseline_m: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Transform {
    translation_m: Spanned<[f64; 3]>,
    rotation_xyzw: Spanned<[f64; 4]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Truth {
    camera: Camera,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Camera {
    Colour,
    Depth,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Mount {
    robot_from_colour: Transform,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wheels {
    ticks_per_m: Spanned<f64>,
    effective_track_m: Spanned<f64>,
}

impl Optics {
    /// The camera of the table `[name]`, which stands at `table`.
    fn model(&self, table: &Range<usize>, name: &str) -> Result<CameraModel, Fault> {
        let missing = |key: &str, example: &str| {
            fault(table.clone(), format!("[{name}] has no {key}; write {key} = {example} if this is a Kinect v1"))
        };
        let size = |key: &str, value: &Option<Spanned<usize>>, example: &str| {
            let value = value.as_ref().ok_or_else(|| missing(key, example))?;
            let positive = (*value.get_ref() > 0).then_some(*value.get_ref());
            positive
                .ok_or_else(|| fault(value.span(), format!("{key} is 0; write the image's size, such as {example}")))
        };
        let number = |key: &str, value: &Option<Spanned<f64>>, example: &str| {
            finite(key, value.as_ref().ok_or_else(|| missing(key, example))?, example)
        };
        let focal_length = |key: &str, value: &Option<Spanned<f64>>| {
            positive(
                key,
                value.as_ref().ok_or_else(|| missing(key, "525.0"))?,
                "525.0 (a Kinect's focal length in pixels)",
            )
        };
        let distortion = self.distortion.as_ref().ok_or_else(|| missing("distortion", "[0.0, 0.0, 0.0, 0.0, 0.0]"))?;
        let [k1, k2, p1, p2, k3] = all_finite("distortion", distortion)?;
        Ok(CameraModel {
            width: size("width_px", &self.width_px, "640")?,
            height: size("height_px", &self.height_px, "480")?,
            fx: focal_length("fx_px", &self.fx_px)?,
            fy: focal_length("fy_px", &self.fy_px)?,
            cx: number("cx_px", &self.cx_px, "319.5")?,
            cy: number("cy_px", &self.cy_px, "239.5")?,
            distortion: Distortion { k1, k2, p1, p2, k3 },
        })
    }

    fn encoding(&self, table: &Range<usize>) -> Result<DepthEncoding, Fault> {
        match (&self.units_per_m, &self.raw_offset, &self.baseline_m) {
            (Some(units), None, None) => Ok(DepthEncoding::Linear {
                units_per_metre: positive("units_per_m", units, "5000.0 (TUM RGB-D files) or 1000.0 (millimetres)")?,
            }),
            (None, Some(offset), Some(baseline)) => Ok(DepthEncoding::KinectDisparity {
                offset: positive("raw_offset", offset, "1090.0")?,
                baseline: positive("baseline_m", baseline, "0.075")?,
            }),
            _ => Err(fault(
                table.clone(),
                "[depth] does not say what a value means; write units_per_m = 5000.0 (linear depth) or both \
                 raw_offset = 1090.0 and baseline_m = 0.075 (a Kinect's raw disparity)",
            )),
        }
    }

    /// Where a key stands that only a depth camera can have.
    fn depth_key(&self) -> Option<Range<usize>> {
        [&self.units_per_m, &self.raw_offset, &self.baseline_m].into_iter().flatten().map(Spanned::span).next()
    }
}

impl Transform {
    fn isometry(&self) -> Result<Isometry3<f64>, Fault> {
        let [tx, ty, tz] = all_finite("translation_m", &self.translation_m)?;
        let [qx, qy, qz, qw] = all_finite("rotation_xyzw", &self.rotation_xyzw)?;
        let quaternion = Quaternion::new(qw, qx, qy, qz);
        let rotation = rotation(quaternion, NORM_TOLERANCE).ok_or_else(|| {
            let norm = quaternion.norm();
            let instead = if norm > NORM_TOLERANCE { quaternion.coords / norm } else { Quaternion::identity().coords };
            let [x, y, z, w] = instead.into();
            fault(
                self.rotation_xyzw.span(),
                format!("rotation_xyzw has length {norm:.4}, not 1; write [{x:.6}, {y:.6}, {z:.6}, {w:.6}]"),
            )
        })?;
        Ok(Isometry3::from_parts(Translation3::new(tx, ty, tz), rotation))
    }
}

fn finite(key: &str, value: &Spanned<f64>, example: &str) -> Result<f64, Fault> {
    let number = *value.get_ref();
    let finite = number.is_finite().then_some(number);
    finite.ok_or_else(|| fault(value.span(), format!("{key} is {number}; write a finite number, such as {example}")))
}

fn positive(key: &str, value: &Spanned<f64>, example: &str) -> Result<f64, Fault> {
    let number = *value.get_ref();
    let positive = (number.is_finite() && number > 0.0).then_some(number);
    positive
        .ok_or_else(|| fault(value.span(), format!("{key} is {number}; write a positive number, such as {example}")))
}

fn all_finite<const N: usize>(key: &str, values: &Spanned<[f64; N]>) -> Result<[f64; N], Fault> {
    let finite = values.get_ref().iter().all(|value| value.is_finite());
    finite
        .then_some(*values.get_ref())
        .ok_or_else(|| fault(values.span(), format!("{key} must hold {N} finite numbers")))
}

mod text;

#[cfg(test)]
mod tests;
