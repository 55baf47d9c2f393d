//! Where the sun stands at a place and a time.

use solar_positioning::time::JulianDate;
use solar_positioning::{Location, RefractionCorrection, SolarPosition, SolarPositions};
use thiserror::Error;

/// Earth's rotation against atomic time, seconds: 69 to 72 in this century's twenties; a minute is 0.25°.
const DELTA_T: f64 = 70.0;
const SECONDS_A_DAY: f64 = 86_400.0;

/// On Earth, at sea level. Degrees; north and east positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// −90 to 90.
    pub latitude: f64,
    /// −180 to 180.
    pub longitude: f64,
}

/// An instant in UTC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    julian: f64,
}

/// A day or time that no calendar has.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct BadDate(String);

impl Clock {
    /// Year, month, day; seconds since midnight, which may run into other days.
    ///
    /// # Errors
    /// There is no such day, or the sun's course is not known for its year.
    pub fn utc([year, month, day]: [u32; 3], seconds: f64) -> Result<Self, BadDate> {
        let bad = |error: solar_positioning::Error| BadDate(error.to_string());
        let midnight = JulianDate::from_utc(year as i32, month, day, 0, 0, 0.0, DELTA_T).map_err(bad)?;
        let clock = Self { julian: midnight.julian_date() + seconds / SECONDS_A_DAY };
        clock.position(Place { latitude: 0.0, longitude: 0.0 }).map_err(bad)?;
        Ok(clock)
    }

    /// Elevation and azimuth (clockwise from north) of the sun, radians, refraction included: the NREL's solar position
    /// algorithm.
    pub fn sun(self, place: Place) -> [f64; 2] {
        // No error is left: the day was tried, and a place out of range has no sun.
        self.position(place).map_or([-std::f64::consts::FRAC_PI_2, 0.0], |position| {
            [position.elevation_angle().to_radians(), position.azimuth().to_radians()]
        })
    }

    fn position(self, Place { latitude, longitude }: Place) -> Result<SolarPosition, solar_positioning::Error> {
        let date = JulianDate::new(self.julian, DELTA_T)?;
        let refraction = Some(RefractionCorrection::standard());
        SolarPositions::new().at_from_julian(date, Location { latitude, longitude }, 0.0, refraction)
    }
}
