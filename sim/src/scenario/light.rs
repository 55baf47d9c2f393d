//! `[light]`: what shines at the start, and how that changes.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Fault;
use super::check::{number, optional};
use super::error::nearest;
use crate::light::{self, BadDate, CAR_PLACES, Clock, HEADLIGHTS, LightState, daylight, headlights, moonlight};
use crate::world::{WINDOWS, World};

/// Direct sun on a window is some 30 times an overcast day.
const DAYLIGHT: std::ops::RangeInclusive<f64> = 0.0..=100.0;
const ELEVATION: std::ops::RangeInclusive<f64> = -90.0..=90.0;
const AZIMUTH: std::ops::RangeInclusive<f64> = -360.0..=360.0;
const SHARE: std::ops::RangeInclusive<f64> = 0.0..=1.0;
/// A lamp's brightness, in multiples of its own; a guess at what makes sense.
const BRIGHTNESS: std::ops::RangeInclusive<f64> = 0.0..=10.0;
/// An hour and a day: no run is longer.
const SECONDS: std::ops::RangeInclusive<f64> = 0.0..=90_000.0;

/// Seconds that a passing car takes from one of its places to the next: 4 to 6 m, at some 20 km/h through a bend.
const BETWEEN_PLACES: f64 = 0.8;

/// What shines at the start of a run. The day comes from `sun`, or from `place`, `date` and `time_utc`; without either it
/// is an overcast day of `daylight_scale`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Light {
    /// Whether the lamps are on.
    pub lamps: bool,
    /// Brightness of single groups of lamps, in multiples of their own: `{ street = 0.5 }`. The laboratory has `ceiling`,
    /// the yard `street`, the campus both and `tunnel`.
    pub lamp_brightness: BTreeMap<String, f64>,
    /// An overcast day, in multiples of one of 7,100 lx; 0 is night.
    pub daylight_scale: f64,
    /// Where the sun stands.
    pub sun: Option<Direction>,
    /// Where on Earth, for the sun's course.
    pub place: Option<Place>,
    /// The day there, "2026-06-21".
    pub date: Option<String>,
    /// UTC at the start, "09:30" or "09:30:15".
    pub time_utc: Option<String>,
    /// Share of the sky that is cloud, 0 to 1; counts where there is a sun or a moon.
    pub cloud_cover: f64,
    /// The moon, if it is up.
    pub moon: Option<Moon>,
    /// When a car comes along the street and shines through the yard's gate, seconds after the start; it passes in four.
    pub cars_at_s: Vec<f64>,
    /// What changes on the way, in the order of time.
    pub timeline: Vec<Change>,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            lamps: true,
            lamp_brightness: BTreeMap::new(),
            daylight_scale: 1.0,
            sun: None,
            place: None,
            date: None,
            time_utc: None,
            cloud_cover: 0.0,
            moon: None,
            cars_at_s: Vec::new(),
            timeline: Vec::new(),
        }
    }
}

/// A direction in the sky.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// Above the horizon.
    pub elevation_deg: f64,
    /// Clockwise from north; 90 is east.
    pub azimuth_deg: f64,
}

/// A place on Earth, at sea level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// North is positive.
    pub latitude_deg: f64,
    /// East is positive.
    pub longitude_deg: f64,
}

/// The moon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Moon {
    /// Above the horizon.
    pub elevation_deg: f64,
    /// Clockwise from north.
    pub azimuth_deg: f64,
    /// How much of its disc is lit, 0 to 1; 1 is a full moon.
    #[serde(default = "full")]
    pub lit_share: f64,
}

fn full() -> f64 {
    1.0
}

/// From `at_s` on, what is written here becomes so: evenly within `over_s` seconds, or at once without it. What is not
/// written stays.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// Seconds after the start.
    pub at_s: f64,
    /// How long the change takes, seconds.
    #[serde(default)]
    pub over_s: f64,
    /// All lamps on or off.
    pub lamps: Option<bool>,
    /// Brightness of groups of lamps.
    #[serde(default)]
    pub lamp_brightness: BTreeMap<String, f64>,
    /// The overcast day.
    pub daylight_scale: Option<f64>,
    /// Where the sun stands.
    pub sun: Option<Direction>,
    /// The clouds.
    pub cloud_cover: Option<f64>,
}

/// All that changes, at one instant.
struct Instant {
    lamps: f64,
    lamp_brightness: BTreeMap<String, f64>,
    daylight_scale: f64,
    sun: Option<Direction>,
    cloud_cover: f64,
}

impl Light {
    /// What shines `at` seconds after the start, in a world whose lamps have these [groups](lamp_groups).
    pub fn at(&self, at: f64, groups: &[String]) -> LightState {
        let now = self.instant(at);
        let sun =
            now.sun.map(|sun| [sun.elevation_deg, sun.azimuth_deg].map(f64::to_radians)).or_else(|| self.course(at));
        let mut state = match sun {
            Some([elevation, azimuth]) => daylight(elevation, azimuth, now.cloud_cover),
            None => LightState::overcast_day(now.daylight_scale as f32),
        };
        if let Some(moon) = &self.moon {
            let [elevation, azimuth] = [moon.elevation_deg, moon.azimuth_deg].map(f64::to_radians);
            state = state.and(&moonlight(elevation, azimuth, moon.lit_share, now.cloud_cover));
        }
        let brightness = |group: &String| {
            let of_group = now.lamp_brightness.get(group).copied().unwrap_or(1.0);
            (group.clone(), (now.lamps * of_group) as f32)
        };
        let lamps = groups.iter().map(brightness).chain(self.headlights(at)).collect();
        LightState { lamps, ..state }
    }

    /// Of the cars that are passing: from one place to the next the one light fades into the other.
    fn headlights(&self, at: f64) -> impl Iterator<Item = (String, f32)> {
        let nearness = move |place: usize, came: f64| 1.0 - ((at - came) / BETWEEN_PLACES - 1.0 - place as f64).abs();
        (0..CAR_PLACES).filter_map(move |place| {
            let brightness: f64 = self.cars_at_s.iter().map(|&came| nearness(place, came).max(0.0)).sum();
            (brightness > 0.0).then(|| (headlights(place), brightness as f32))
        })
    }

    /// Checks everything that can be known without the world.
    ///
    /// # Errors
    /// The first thing that makes no sense.
    pub(super) fn check(&self) -> Result<(), Fault> {
        number("light.daylight_scale", self.daylight_scale, DAYLIGHT)?;
        number("light.cloud_cover", self.cloud_cover, SHARE)?;
        self.cars_at_s.iter().try_for_each(|&at| number("light.cars_at_s", at, SECONDS))?;
        check_brightness("light", &self.lamp_brightness)?;
        if let Some(sun) = &self.sun {
            sun.check("light.sun")?;
        }
        if let Some(Moon { elevation_deg, azimuth_deg, lit_share }) = self.moon {
            Direction { elevation_deg, azimuth_deg }.check("light.moon")?;
            number("light.moon.lit_share", lit_share, SHARE)?;
        }
        self.check_place()?;
        let mut before = 0.0;
        for (index, change) in self.timeline.iter().enumerate() {
            let key = format!("light.timeline.{index}");
            change.check(&key)?;
            if change.at_s < before {
                let problem =
                    format!("at_s = {} comes after {before}: write changes in the order of time", change.at_s);
                return Err(Fault::new(format!("{key}.at_s"), problem));
            }
            if change.sun.is_some() && self.sun.is_none() {
                let problem =
                    "there is no sun to move: write sun = { elevation_deg = 40, azimuth_deg = 180 } in [light]";
                return Err(Fault::new(format!("{key}.sun"), problem));
            }
            before = change.at_s;
        }
        Ok(())
    }

    /// Whether every group of lamps that is named is one of the world's.
    ///
    /// # Errors
    /// The first that is not, with those there are.
    pub fn check_groups(&self, groups: &[String]) -> Result<(), Fault> {
        let start = self.lamp_brightness.keys().map(|group| ("light".to_owned(), group));
        let later = (self.timeline.iter().enumerate()).flat_map(|(index, change)| {
            change.lamp_brightness.keys().map(move |group| (format!("light.timeline.{index}"), group))
        });
        for (table, group) in start.chain(later) {
            if !groups.contains(group) {
                let known = groups.iter().map(|known| format!("`{known}`")).collect::<Vec<_>>().join(", ");
                let meant = nearest(group, groups.iter().map(String::as_str));
                let advice = meant.map_or("delete the key".to_owned(), |near| format!("did you mean `{near}`?"));
                let problem = format!("this world has no lamps called `{group}`, but {known}; {advice}");
                return Err(Fault::new(format!("{table}.lamp_brightness.{group}"), problem));
            }
        }
        Ok(())
    }

    fn check_place(&self) -> Result<(), Fault> {
        let parts = [self.place.is_some(), self.date.is_some(), self.time_utc.is_some()];
        if parts == [false; 3] {
            return Ok(());
        }
        if self.sun.is_some() {
            return Err(Fault::new("light.sun", "a sun's direction beside a place and a time: delete one of them"));
        }
        if parts != [true; 3] {
            let problem = "the sun's course needs all of place = { latitude_deg = 48, longitude_deg = 11 }, \
                           date = \"2026-06-21\" and time_utc = \"11:30\"";
            return Err(Fault::new("light", problem));
        }
        if let Some(Place { latitude_deg, longitude_deg }) = self.place {
            number("light.place.latitude_deg", latitude_deg, -90.0..=90.0)?;
            number("light.place.longitude_deg", longitude_deg, -180.0..=180.0)?;
        }
        let time = self.seconds_of_day().ok_or_else(|| {
            Fault::new("light.time_utc", "write hours and minutes in UTC, from \"00:00\" to \"23:59\"")
        })?;
        match self.clock(time) {
            Some(Ok(_)) => Ok(()),
            Some(Err(error)) => Err(Fault::new("light.date", format!("{error}; write a day as \"2026-06-21\""))),
            None => Err(Fault::new("light.date", "write a day as \"2026-06-21\"")),
        }
    }

    /// Elevation and azimuth of the sun by its course, radians.
    fn course(&self, at: f64) -> Option<[f64; 2]> {
        let Place { latitude_deg, longitude_deg } = self.place?;
        let clock = self.clock(self.seconds_of_day()? + at)?.ok()?;
        Some(clock.sun(light::Place { latitude: latitude_deg, longitude: longitude_deg }))
    }

    fn clock(&self, seconds: f64) -> Option<Result<Clock, BadDate>> {
        let parts: Option<Vec<u32>> = self.date.as_ref()?.split('-').map(|part| part.parse().ok()).collect();
        Some(Clock::utc(parts?.try_into().ok()?, seconds))
    }

    fn seconds_of_day(&self) -> Option<f64> {
        let parts: Option<Vec<u32>> = self.time_utc.as_ref()?.split(':').map(|part| part.parse().ok()).collect();
        match parts?[..] {
            [hours @ ..24, minutes @ ..60] => Some(f64::from(3600 * hours + 60 * minutes)),
            [hours @ ..24, minutes @ ..60, seconds @ ..60] => Some(f64::from(3600 * hours + 60 * minutes + seconds)),
            _ => None,
        }
    }

    fn instant(&self, at: f64) -> Instant {
        let mut now = Instant {
            lamps: f64::from(u8::from(self.lamps)),
            lamp_brightness: self.lamp_brightness.clone(),
            daylight_scale: self.daylight_scale,
            sun: self.sun,
            cloud_cover: self.cloud_cover,
        };
        for change in self.timeline.iter().take_while(|change| change.at_s <= at) {
            let share = if change.over_s > 0.0 { ((at - change.at_s) / change.over_s).min(1.0) } else { 1.0 };
            let towards = |from: f64, to: Option<f64>| to.map_or(from, |to| from + share * (to - from));
            now.lamps = towards(now.lamps, change.lamps.map(|on| f64::from(u8::from(on))));
            now.daylight_scale = towards(now.daylight_scale, change.daylight_scale);
            now.cloud_cover = towards(now.cloud_cover, change.cloud_cover);
            for (group, &brightness) in &change.lamp_brightness {
                let now = now.lamp_brightness.entry(group.clone()).or_insert(1.0);
                *now = towards(*now, Some(brightness));
            }
            now.sun = now.sun.zip(change.sun).map_or(now.sun, |(from, to)| {
                Some(Direction {
                    elevation_deg: towards(from.elevation_deg, Some(to.elevation_deg)),
                    azimuth_deg: towards(from.azimuth_deg, Some(to.azimuth_deg)),
                })
            });
        }
        now
    }
}

impl Direction {
    fn check(&self, key: &str) -> Result<(), Fault> {
        number(&format!("{key}.elevation_deg"), self.elevation_deg, ELEVATION)?;
        number(&format!("{key}.azimuth_deg"), self.azimuth_deg, AZIMUTH)
    }
}

impl Change {
    fn check(&self, key: &str) -> Result<(), Fault> {
        number(&format!("{key}.at_s"), self.at_s, SECONDS)?;
        number(&format!("{key}.over_s"), self.over_s, SECONDS)?;
        check_brightness(key, &self.lamp_brightness)?;
        optional(&format!("{key}.daylight_scale"), self.daylight_scale, DAYLIGHT)?;
        optional(&format!("{key}.cloud_cover"), self.cloud_cover, SHARE)?;
        self.sun.map_or(Ok(()), |sun| sun.check(&format!("{key}.sun")))
    }
}

/// The groups of lamps that a world has; what its windows let in is no lamp's, and cars pass when they do.
pub fn lamp_groups(world: &World) -> Vec<String> {
    let fixed = |group: &&str| *group != WINDOWS && !group.starts_with(HEADLIGHTS);
    world.lamp_groups().into_iter().filter(fixed).map(str::to_owned).collect()
}

fn check_brightness(table: &str, brightness: &BTreeMap<String, f64>) -> Result<(), Fault> {
    let mut all = brightness.iter();
    all.try_for_each(|(group, &value)| number(&format!("{table}.lamp_brightness.{group}"), value, BRIGHTNESS))
}

#[cfg(test)]
mod tests;
