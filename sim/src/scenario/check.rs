//! Values that no scenario can have.

use std::ops::RangeInclusive;

use sunblind_estimator::ParamError;

use super::expect::Expectation;
use super::{Covered, Fault, FloorArea, Kinect, Scenario};

/// The longest run, seconds: an hour at 15 frames a second are 54 000 images.
const DURATION: RangeInclusive<f64> = 0.1..=3600.0;
/// A Kinect v1 gives 30 frames a second.
const RATE: RangeInclusive<f64> = 0.1..=30.0;
/// A Pioneer P3-AT reaches 0.7 m/s; below 1 cm/s nothing comes of a path.
const SPEED: RangeInclusive<f64> = 0.01..=0.7;
/// On the robot's deck or on a mast, metres.
const LENS_HEIGHT: RangeInclusive<f64> = 0.3..=2.0;
/// What the Kinect's motor reaches, degrees.
const TILT: RangeInclusive<f64> = -27.0..=27.0;
/// A switch that took longer would be a broken device, seconds.
const STREAM_SWITCH: RangeInclusive<f64> = 0.0..=10.0;
/// After a day everything is as warm as it gets, seconds.
const WARM_UP: RangeInclusive<f64> = 0.0..=86_400.0;
/// Beyond, nobody has calibrated anything: pixels, degrees.
const RESIDUAL_PX: RangeInclusive<f64> = 0.0..=50.0;
const RESIDUAL_DEG: RangeInclusive<f64> = 0.0..=5.0;
/// Worlds are smaller, metres.
const COORDINATE: RangeInclusive<f64> = -1000.0..=1000.0;
const HEADING: RangeInclusive<f64> = -360.0..=360.0;
/// Radii and sizes that a robot of half a metre can follow, metres.
const RADIUS: RangeInclusive<f64> = 0.1..=500.0;
const LAPS: RangeInclusive<f64> = 1.0..=100.0;

impl Scenario {
    /// Checks everything that can be known without the world.
    ///
    /// # Errors
    /// The first thing that makes no sense.
    pub fn check(&self) -> Result<(), Fault> {
        number("duration_s", self.duration, DURATION)?;
        self.check_world()?;
        self.light.check()?;
        self.kinect.check()?;
        self.check_robot()?;
        if self.duration * self.kinect.rate < 1.0 {
            let problem = format!("{} s hold no frame at {} Hz; write a longer one", self.duration, self.kinect.rate);
            return Err(Fault::new("duration_s", problem));
        }
        self.check_path()?;
        self.estimator.params.validate().map_err(|error| match &error {
            ParamError::OutOfRange { key, .. } => Fault::new(format!("estimator.params.{key}"), error.to_string()),
            ParamError::Rig(_) => Fault::new("estimator.params", error.to_string()),
        })?;
        if let Some(short) = self.short.duration {
            number("short.duration_s", short, *DURATION.start()..=self.duration)?;
        }
        all("expect", &self.expect, Expectation::check)?;
        all("short.expect", &self.short.expect, Expectation::check)
    }

    fn check_world(&self) -> Result<(), Fault> {
        match (self.world.name, &self.world.gltf) {
            // What the file holds is seen when it is read.
            (Some(_), None) | (None, Some(_)) => Ok(()),
            _ => self.world.build().map(drop),
        }
    }

    fn check_robot(&self) -> Result<(), Fault> {
        if let Some(urdf) = self.robot.urdf.as_ref().filter(|urdf| !urdf.is_file()) {
            let problem = format!(
                "{}: no such file; give a path relative to this scenario, or delete the key for the built-in robot",
                urdf.display()
            );
            return Err(Fault::new("robot.urdf", problem));
        }
        self.robot_model()?;
        all("robot.floor_areas", &self.robot.floor_areas, FloorArea::check)?;
        point("robot.start_m", self.robot.start)?;
        optional("robot.start_heading_deg", self.robot.start_heading_deg, HEADING)
    }

    fn check_path(&self) -> Result<(), Fault> {
        let path = &self.path;
        for (index, &at) in path.points.iter().flatten().enumerate() {
            point(&format!("path.points_m.{index}"), Some(at))?;
        }
        point("path.start_m", path.start)?;
        optional("path.start_heading_deg", path.start_heading_deg, HEADING)?;
        optional("path.corner_radius_m", path.corner_radius, RADIUS)?;
        if path.radius.is_some_and(|radius| !RADIUS.contains(&radius.abs())) {
            optional("path.radius_m", path.radius, RADIUS)?;
        }
        optional("path.size_m", path.size, RADIUS)?;
        number("path.laps", path.laps.into(), LAPS)?;
        number("path.speed_m_per_s", path.speed, SPEED)?;
        path.shape().map(drop)
    }
}

impl Kinect {
    fn check(&self) -> Result<(), Fault> {
        number("kinect.lens_height_m", self.lens_height, LENS_HEIGHT)?;
        number("kinect.tilt_deg", self.tilt_deg, TILT)?;
        number("kinect.rate_hz", self.rate, RATE)?;
        number("kinect.stream_switch_s", self.stream_switch, STREAM_SWITCH)?;
        optional("kinect.warm_up_s", self.warm_up, WARM_UP)?;
        number("kinect.residual_px", self.residual_px, RESIDUAL_PX)?;
        number("kinect.residual_deg", self.residual_deg, RESIDUAL_DEG)?;
        all("kinect.covered", &self.covered, Covered::check)
    }
}

impl Covered {
    fn check(&self) -> Result<(), Fault> {
        number("from_s", self.from_s, 0.0..=*DURATION.end())?;
        number("until_s", self.until_s, 0.0..=*DURATION.end())?;
        if self.from_s < self.until_s {
            return Ok(());
        }
        Err(Fault::new("until_s", "the hand is taken away before it comes: write a later until_s"))
    }
}

impl FloorArea {
    fn check(&self) -> Result<(), Fault> {
        point("min_m", Some(self.min))?;
        point("max_m", Some(self.max))?;
        if self.min[0] < self.max[0] && self.min[1] < self.max[1] {
            return Ok(());
        }
        Err(Fault::new("max_m", "max_m is the north-east corner: write both numbers larger than those of min_m"))
    }
}

/// Checks each of a list; a fault's key becomes that of the file.
fn all<T>(list: &str, items: &[T], check: impl Fn(&T) -> Result<(), Fault>) -> Result<(), Fault> {
    for (index, item) in items.iter().enumerate() {
        check(item).map_err(|fault| Fault { key: format!("{list}.{index}.{}", fault.key), ..fault })?;
    }
    Ok(())
}

pub(super) fn number(key: &str, value: f64, range: RangeInclusive<f64>) -> Result<(), Fault> {
    if range.contains(&value) {
        return Ok(());
    }
    // A number in a list has the list's name.
    let name = key.rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or(key);
    let problem = format!("{name} = {value}: write a number from {} to {}", range.start(), range.end());
    Err(Fault::new(key, problem))
}

pub(super) fn optional(key: &str, value: Option<f64>, range: RangeInclusive<f64>) -> Result<(), Fault> {
    value.map_or(Ok(()), |value| number(key, value, range))
}

fn point(key: &str, value: Option<[f64; 2]>) -> Result<(), Fault> {
    let Some(point) = value else { return Ok(()) };
    point.into_iter().enumerate().try_for_each(|(axis, value)| number(&format!("{key}.{axis}"), value, COORDINATE))
}
