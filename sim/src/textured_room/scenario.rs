//! Scenario files: TOML, every number with its unit in its key, unknown keys refused.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use crate::record::Place;

/// The longest recording, seconds: ten minutes are about 15 GB of images, and hardly meant.
const MAX_DURATION: f64 = 600.0;
/// The highest frame rate, Hz; file names have microseconds, a Kinect gives 30 frames a second.
const MAX_RATE: f64 = 1000.0;

/// What to simulate and record.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Seed of every random number: equal scenarios give equal bytes.
    pub seed: u64,
    /// Length of the recording, seconds.
    pub duration: f64,
    /// Frames a second.
    pub rate: f64,
    /// Where it happens.
    pub world: World,
    /// The sensor.
    pub kinect: Kinect,
}

/// Where a scenario happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum World {
    /// The furnished room of [`textured_room`](crate::textured_room).
    TexturedRoom,
}

/// Switches of the simulated sensor; each exists for ablation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
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
    /// Reads and checks a scenario file.
    ///
    /// # Errors
    /// The first thing wrong, with file, line, column and what to write instead.
    pub fn load(file: &Path) -> Result<Self, ScenarioError> {
        let text =
            fs::read_to_string(file).map_err(|source| ScenarioError::Unreadable { file: file.to_owned(), source })?;
        Self::parse(&text, file)
    }

    /// As [`load`](Self::load), from text; `file` only names it in errors.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(text: &str, file: &Path) -> Result<Self, ScenarioError> {
        let invalid = |offset, problem| ScenarioError::Invalid { place: Place::at_offset(file, text, offset), problem };
        let keys: Keys = toml::from_str(text)
            .map_err(|error| invalid(error.span().map_or(0, |span| span.start), explain(error.message())))?;
        let in_range = |value: &Spanned<f64>, key, max| {
            let number = *value.as_ref();
            if number > 0.0 && number <= max {
                return Ok(number);
            }
            Err(invalid(value.span().start, format!("{key} = {number}: write a number above 0 and up to {max}")))
        };
        let duration = in_range(&keys.duration_s, "duration_s", MAX_DURATION)?;
        let rate = in_range(&keys.rate_hz, "rate_hz", MAX_RATE)?;
        let scenario = Self { seed: keys.seed, duration, rate, world: keys.world.name, kinect: keys.kinect };
        if scenario.frames() == 0 {
            let problem = format!("{duration} s at {rate} Hz hold no frame: write a longer duration_s");
            return Err(invalid(keys.duration_s.span().start, problem));
        }
        Ok(scenario)
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

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    seed: u64,
    duration_s: Spanned<f64>,
    rate_hz: Spanned<f64>,
    world: WorldKeys,
    #[serde(default)]
    kinect: Kinect,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WorldKeys {
    name: World,
}

/// The parser's message, with the nearest valid word appended where it names an unknown one. Serde writes
/// "unknown field `x`, expected one of `a`, `b`": the first word in backticks is the one found.
fn explain(message: &str) -> String {
    let mut words = message.split('`').skip(1).step_by(2);
    let nearest = words.next().filter(|_| message.starts_with("unknown")).and_then(|found| {
        words.max_by(|a, b| strsim::jaro_winkler(found, a).total_cmp(&strsim::jaro_winkler(found, b)))
    });
    match nearest {
        Some(nearest) => format!("{message}; did you mean `{nearest}`?"),
        None => message.to_owned(),
    }
}

/// A scenario that can't be run.
#[derive(Debug, Error)]
pub enum ScenarioError {
    /// No such file, or no text.
    #[error("{}: can't be read: {source}", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Not TOML, an unknown or missing key, or a value out of range.
    #[error("{place}: {problem}")]
    Invalid {
        /// Where.
        place: Place,
        /// What, and what to write instead.
        problem: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "seed = 1\nduration_s = 6.0\nrate_hz = 30.0\n[world]\nname = \"textured_room\"\n";

    fn error_of(text: &str) -> String {
        Scenario::parse(text, Path::new("s.toml")).unwrap_err().to_string()
    }

    #[test]
    fn the_shipped_scenario_is_valid() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/textured_room.toml");
        assert_eq!(Scenario::load(&file).unwrap().frames(), 180);
    }

    #[test]
    fn an_unknown_key_is_placed_and_the_nearest_valid_one_named() {
        let message = error_of(&GOOD.replace("duration_s", "durration_s"));
        assert!(message.starts_with("s.toml:2:1: "), "{message}");
        assert!(message.ends_with("did you mean `duration_s`?"), "{message}");
        let message = error_of(&format!("{GOOD}[kinect]\ndepth_nois = true\n"));
        assert!(message.starts_with("s.toml:7:1: ") && message.contains("mean `depth_noise`"), "{message}");
    }

    #[test]
    fn impossible_numbers_are_refused_where_they_stand() {
        for number in ["0.0", "-1.0", "nan", "inf", "1e9"] {
            let message = error_of(&GOOD.replace("6.0", number));
            assert!(message.starts_with("s.toml:2:14: duration_s"), "{message}");
            assert!(error_of(&GOOD.replace("30.0", number)).starts_with("s.toml:3:11: rate_hz"));
        }
        assert!(error_of(&GOOD.replace("6.0", "0.01")).contains("no frame"));
    }

    #[test]
    fn a_missing_key_and_an_unknown_world_are_named() {
        assert!(error_of(&GOOD.replace("seed = 1\n", "")).contains("missing field `seed`"));
        let message = error_of(&GOOD.replace("textured_room", "textured_rom"));
        assert!(message.starts_with("s.toml:5:8: ") && message.contains("`textured_room`"), "{message}");
        assert!(Scenario::load(Path::new("nowhere.toml")).unwrap_err().to_string().contains("nowhere.toml"));
    }
}
