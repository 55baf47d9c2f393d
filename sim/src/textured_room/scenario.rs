//! Scenarios of the textured room: short ones, for a camera carried along the one path through it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scenario::Fault;

/// The longest recording, seconds: ten minutes are about 15 GB of images, and hardly meant.
const MAX_DURATION: f64 = 600.0;
/// The highest frame rate, Hz; file names have microseconds, a Kinect gives 30 frames a second.
const MAX_RATE: f64 = 1000.0;
/// Length of the short form, seconds: a second's standstill and a second's walk.
const SHORT_DURATION: f64 = 2.0;

/// What to simulate and record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "TexturedRoomScenario")]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Seed of every random number: equal scenarios give equal bytes.
    pub seed: u64,
    /// Length of the recording, seconds.
    #[serde(rename = "duration_s")]
    pub duration: f64,
    /// Frames a second.
    #[serde(rename = "rate_hz")]
    pub rate: f64,
    /// Where it happens.
    pub world: World,
    /// The sensor.
    #[serde(default)]
    pub kinect: Kinect,
}

/// Where it happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "TexturedRoomWorld")]
#[serde(deny_unknown_fields)]
pub struct World {
    /// Which world.
    pub name: WorldName,
}

/// The one world that is meant here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "TexturedRoomName")]
#[serde(rename_all = "snake_case")]
pub enum WorldName {
    /// The furnished room of [`textured_room`](crate::textured_room).
    TexturedRoom,
}

/// Switches of the simulated sensor; each exists for ablation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "TexturedRoomKinect")]
#[serde(deny_unknown_fields, default)]
pub struct Kinect {
    /// Photon and read noise of the colour image.
    pub colour_noise: bool,
    /// Noise, ragged edges and drop-outs of the depth image.
    pub depth_noise: bool,
}

impl Default for Kinect {
    fn default() -> Self {
        Self { colour_noise: true, depth_noise: true }
    }
}

impl Scenario {
    /// Checks every number.
    ///
    /// # Errors
    /// The first that makes no sense.
    pub fn check(&self) -> Result<(), Fault> {
        for (key, value, max) in [("duration_s", self.duration, MAX_DURATION), ("rate_hz", self.rate, MAX_RATE)] {
            if !(value > 0.0 && value <= max) {
                return Err(Fault::new(key, format!("{key} = {value}: write a number above 0 and up to {max}")));
            }
        }
        if self.frames() == 0 {
            let problem = format!("{} s at {} Hz hold no frame: write a longer duration_s", self.duration, self.rate);
            return Err(Fault::new("duration_s", problem));
        }
        Ok(())
    }

    /// The short form.
    pub fn shortened(self) -> Self {
        Self { duration: self.duration.min(SHORT_DURATION), ..self }
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        (self.duration * self.rate).round() as usize
    }

    /// When frame `index` is captured (middle of its exposure), seconds from the start.
    pub fn time_of(&self, index: usize) -> f64 {
        index as f64 / self.rate
    }
}
