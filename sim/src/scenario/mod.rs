//! Scenario files: TOML that says the world, the light, the robot's way, and what must hold. Every number has its unit
//! in its key, unknown keys are refused, and every error says where it stands and what to write instead.
//!
//! The structs here are the file: field by field they are read, written and described in the JSON Schema. A few units
//! are not SI; such fields keep the unit in their name. From top to bottom: `load` reads a file with its `overrides`,
//! `source` knows where each key stands, `check` finds numbers that make no sense, `light` knows what shines when, `path` makes a path of what is
//! written, `meaning` the world, the floors and the robot, `expect` judges a run.

mod check;
pub mod error;
pub mod expect;
pub mod light;
mod load;
pub mod meaning;
pub mod overrides;
pub mod path;
pub mod schema;
mod source;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sunblind_estimator::fusion::PlanarPose;
use sunblind_estimator::{EstimatorParams, PoseSource};

pub use crate::kinect::InfraredExposure;
pub use error::{Fault, ScenarioError};
pub use expect::Expectation;
pub use light::Light;
pub use load::{AnyScenario, load};
pub use overrides::Override;
pub use path::PathSpec;
pub use source::Source;

/// Length of a short form that says nothing else, seconds.
const SHORT_DURATION: f64 = 5.0;

/// A robot with a Kinect drives through a world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Seed of every random number: equal scenarios give equal bytes.
    pub seed: u64,
    /// The run ends after so many seconds, or earlier at the end of the path.
    #[serde(rename = "duration_s")]
    pub duration: f64,
    /// Where.
    pub world: World,
    /// What shines.
    #[serde(default)]
    pub light: Light,
    /// The Pioneer P3-AT and the floor under it.
    #[serde(default)]
    pub robot: Robot,
    /// The sensor.
    #[serde(default)]
    pub kinect: Kinect,
    /// The way.
    pub path: PathSpec,
    /// The estimator under test.
    #[serde(default)]
    pub estimator: Estimator,
    /// What must hold at the end.
    #[serde(default)]
    pub expect: Vec<Expectation>,
    /// The same scenario for the hurried, on `--short`.
    #[serde(default)]
    pub short: Short,
}

/// Where a scenario happens.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct World {
    /// Which world.
    pub name: Option<WorldName>,
    /// A world of one's own instead: a glTF 2.0 file (.glb, .gltf), relative to the scenario's. It lies under the open
    /// sky. A material's extras may hold `"albedo_830nm": 0.4`; else it is the largest of its visible albedos.
    pub gltf: Option<PathBuf>,
}

/// The worlds that a robot can drive through.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WorldName {
    /// A tiled laboratory room, a carpeted office and a corridor, 12 × 9 m.
    Laboratory,
    /// A yard between houses, 25 × 20 m: asphalt, slabs, lawn and gravel, not quite level.
    Yard,
    /// The laboratory, the yard before its door and a tunnel behind the yard, 26 × 40 m in all.
    Campus,
}

/// The robot and the floor under it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Robot {
    /// A robot description to use instead of the built-in Pioneer P3-AT; relative to the scenario's file.
    pub urdf: Option<PathBuf>,
    /// One floor everywhere, instead of what lies in the world.
    pub floor: Option<Floor>,
    /// Other floors, upon `floor` or the world's own; where two overlap, the later one counts.
    pub floor_areas: Vec<FloorArea>,
    /// Whether a gyro is fitted.
    pub gyro: bool,
    /// Where the robot starts, x and y in metres, if not at the path's start.
    #[serde(rename = "start_m")]
    pub start: Option<[f64; 2]>,
    /// Which way it looks at the start, counter-clockwise from x, if not along the path.
    pub start_heading_deg: Option<f64>,
}

/// A kind of floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Floor {
    /// Ceramic tile.
    Tile,
    /// Short-pile carpet.
    Carpet,
    /// Bare concrete.
    Concrete,
    /// Asphalt, some years old.
    Asphalt,
    /// A mown lawn, dry.
    Grass,
    /// Loose gravel.
    Gravel,
    /// Even everywhere; tyres slip only as far as turning makes them.
    Ideal,
}

/// A rectangle of one floor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FloorArea {
    /// What lies there.
    pub floor: Floor,
    /// South-west corner, x and y in metres.
    #[serde(rename = "min_m")]
    pub min: [f64; 2],
    /// North-east corner, x and y in metres.
    #[serde(rename = "max_m")]
    pub max: [f64; 2],
}

/// How the Kinect is mounted and what it delivers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Kinect {
    /// Height of the lenses above the floor, metres.
    #[serde(rename = "lens_height_m")]
    pub lens_height: f64,
    /// Positive looks up, as the Kinect's own motor counts it.
    pub tilt_deg: f64,
    /// Frames a second.
    #[serde(rename = "rate_hz")]
    pub rate: f64,
    /// How finely it looks.
    pub quality: Quality,
    /// Which images it delivers at a time.
    pub streams: StreamMode,
    /// Of `exclusive` streams: how long neither colour nor infrared comes when one takes the other's place, seconds.
    /// The default is a guess; nobody has published it.
    #[serde(rename = "stream_switch_s")]
    pub stream_switch: f64,
    /// Sensor noise; false for an ideal sensor.
    pub noise: bool,
    /// What moves while an image is exposed is blurred; false for an ideal sensor.
    pub motion_blur: bool,
    /// An image's rows are exposed one after the other; false for an ideal sensor.
    pub rolling_shutter: bool,
    /// The colour camera balances white by itself, as the device does unless it is told not to.
    pub white_balance: bool,
    /// How the infrared camera follows the light; which of them the device does is not known.
    pub infrared_exposure: InfraredExposure,
    /// How long the device has been on at the start, seconds: distances drift for an hour. Without the key it is warm.
    #[serde(rename = "warm_up_s")]
    pub warm_up: Option<f64>,
    /// Which unit it is: each number is another one, as far from the nominal unit as real units are. Without the key it
    /// is the nominal one.
    pub unit_seed: Option<u64>,
    /// What the calibration leaves of the cameras' centres and of their image's edge, standard deviation, pixels.
    pub residual_px: f64,
    /// What the calibration leaves of the turn between the cameras, standard deviation about each axis.
    pub residual_deg: f64,
    /// True depth instead of what the device makes of its infrared image: for comparison only.
    pub truth_depth: bool,
    /// When a hand lies on the device's front.
    pub covered: Vec<Covered>,
}

/// A time in which a hand lies on the Kinect's front: its cameras see the palm and nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Covered {
    /// Seconds after the start.
    pub from_s: f64,
    /// Seconds after the start.
    pub until_s: f64,
}

impl Covered {
    /// Whether it is now, `at` seconds after the start.
    pub fn contains(&self, at: f64) -> bool {
        (self.from_s..self.until_s).contains(&at)
    }
}

impl Default for Kinect {
    fn default() -> Self {
        Self {
            lens_height: 0.6,
            tilt_deg: 0.0,
            rate: 15.0,
            quality: Quality::Full,
            streams: StreamMode::Simultaneous,
            stream_switch: 0.5,
            noise: true,
            motion_blur: true,
            rolling_shutter: true,
            white_balance: true,
            infrared_exposure: InfraredExposure::default(),
            warm_up: None,
            unit_seed: None,
            residual_px: 0.1,
            residual_deg: 0.01,
            truth_depth: false,
            covered: Vec::new(),
        }
    }
}

/// What a frame may cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// 320 × 240 pixels, a pattern twice as wide and depth twice as coarse, in a third of the time: to see that all
    /// works, not to judge how well.
    Fast,
    /// 640 × 480 pixels, as the device has.
    Full,
}

impl Quality {
    /// Pixels of the full image's edge in one of the image's.
    pub fn coarseness(self) -> f64 {
        match self {
            Self::Fast => 2.0,
            Self::Full => 1.0,
        }
    }

    /// As it is written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Full => "full",
        }
    }
}

/// Which images a Kinect delivers at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StreamMode {
    /// Colour, infrared and depth at once, as the papers assume.
    Simultaneous,
    /// Colour or infrared, never both, as the device has it; a switch costs time.
    Exclusive,
}

/// The estimator under test.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Estimator {
    /// On whose pose the robot follows the path.
    pub drives: Drives,
    /// Whether the wheels' odometry without the gyro is wanted as well, beside the one with it, as the track
    /// `odometry_no_gyro`.
    pub odometry_without_gyro: bool,
    /// What differs from the estimator's defaults.
    #[schemars(schema_with = "schema::estimator_params")]
    pub params: EstimatorParams,
}

/// On whose pose the robot follows its path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Drives {
    /// Wheels and visual odometry in the smooth variable structure filter.
    #[default]
    Svsf,
    /// The same in the extended Kalman filter.
    Ekf,
    /// Visual odometry.
    Mvo,
    /// Wheels, and a gyro where there is one.
    Odometry,
    /// The true pose: the robot keeps to its path, however wrong the estimates are.
    Truth,
}

impl Drives {
    /// The estimate that drives; `None` for the truth.
    pub fn pose_source(self) -> Option<PoseSource> {
        match self {
            Self::Svsf => Some(PoseSource::Svsf),
            Self::Ekf => Some(PoseSource::Ekf),
            Self::Mvo => Some(PoseSource::Mvo),
            Self::Odometry => Some(PoseSource::Odometry),
            Self::Truth => None,
        }
    }
}

/// The short form of a scenario. It is judged by its own expectations only: what holds after 20 m need not after 2.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Short {
    /// Seconds; 5, or the whole scenario where that is shorter, unless it is said.
    #[serde(rename = "duration_s")]
    pub duration: Option<f64>,
    /// What must hold at its end.
    pub expect: Vec<Expectation>,
}

impl Scenario {
    /// The short form.
    pub fn shortened(self) -> Self {
        let duration = self.short.duration.unwrap_or(SHORT_DURATION).min(self.duration);
        Self { duration, expect: self.short.expect.clone(), ..self }
    }

    /// Where the robot stands at the start, in the world.
    ///
    /// # Errors
    /// When the path can't be driven.
    pub fn start(&self) -> Result<PlanarPose, Fault> {
        let path = self.path.shape()?;
        let first = path.points()[0];
        let [x, y] = self.robot.start.unwrap_or(first.position.into());
        let heading = self.robot.start_heading_deg.map_or(first.heading, f64::to_radians);
        Ok(PlanarPose::new(x, y, heading))
    }
}
