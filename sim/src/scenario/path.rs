//! `[path]`: the way the robot is to drive.

use nalgebra::Point2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sunblind_estimator::fusion::PlanarPose;
use sunblind_estimator::guidance::{Path, PathError};

use super::{Fault, Scenario};

/// A way and how fast it is driven. Which of the keys a path has depends on its kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathSpec {
    /// Its shape.
    pub kind: PathKind,
    /// `waypoints` and `spline`: x and y of each point in the world, metres.
    #[serde(rename = "points_m")]
    pub points: Option<Vec<[f64; 2]>>,
    /// `waypoints`: radius of the corners, metres. Without it the robot stops at a corner and turns on the spot.
    #[serde(rename = "corner_radius_m")]
    pub corner_radius: Option<f64>,
    /// `circle` and `figure_eight`: where it begins, x and y in the world, metres.
    #[serde(rename = "start_m")]
    pub start: Option<[f64; 2]>,
    /// `circle` and `figure_eight`: which way it leads at first, counter-clockwise from x; 0 if not said.
    pub start_heading_deg: Option<f64>,
    /// `circle`: metres; positive goes round to the left, negative to the right.
    #[serde(rename = "radius_m")]
    pub radius: Option<f64>,
    /// `figure_eight`: from the far end of one loop to that of the other, metres. It begins at the crossing and goes
    /// round the left loop first.
    #[serde(rename = "size_m")]
    pub size: Option<f64>,
    /// How often it is driven; a path of several laps ends where it starts.
    #[serde(default = "one_lap")]
    pub laps: u32,
    /// Speed on a straight, m/s.
    #[serde(rename = "speed_m_per_s", default = "default_speed")]
    pub speed: f64,
}

/// The shape of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PathKind {
    /// Straight from point to point.
    Waypoints,
    /// Smoothly through every point.
    Spline,
    /// Round and round.
    Circle,
    /// Bernoulli's lemniscate.
    FigureEight,
}

fn one_lap() -> u32 {
    1
}

/// A walk in a crowded room: 0.4 m/s.
fn default_speed() -> f64 {
    0.4
}

impl PathSpec {
    /// The path in the world, all laps.
    ///
    /// # Errors
    /// A key is missing or belongs to another kind, or there is no such path.
    pub fn shape(&self) -> Result<Path, Fault> {
        let one_lap = match self.kind {
            PathKind::Waypoints => {
                self.allow("waypoints", &["points_m", "corner_radius_m"])?;
                let points = self.points()?;
                match self.corner_radius {
                    Some(radius) => Path::rounded(&points, radius).map_err(fault_of("path.corner_radius_m"))?,
                    None => Path::straight(&points).map_err(fault_of("path.points_m"))?,
                }
            }
            PathKind::Spline => {
                self.allow("a spline", &["points_m"])?;
                return self.spline();
            }
            PathKind::Circle => {
                self.allow("a circle", &["start_m", "start_heading_deg", "radius_m"])?;
                let radius = need(self.radius, "a circle", "radius_m", "1.5")?;
                Path::circle(&self.start("a circle")?, radius, 1.0).map_err(fault_of("path.radius_m"))?
            }
            PathKind::FigureEight => {
                self.allow("a figure eight", &["start_m", "start_heading_deg", "size_m"])?;
                let size = need(self.size, "a figure eight", "size_m", "3.0")?;
                let start = self.start("a figure eight")?;
                Path::figure_eight(&start, size / 2.0).map_err(fault_of("path.size_m"))?
            }
        };
        one_lap.repeated(self.laps).map_err(fault_of("path.laps"))
    }

    /// One curve through the points of all laps, so that it does not bend where a lap begins.
    fn spline(&self) -> Result<Path, Fault> {
        let points = self.points()?;
        if self.laps > 1 && points.first() != points.last() {
            return Err(fault_of("path.laps")(PathError::NotClosed));
        }
        let laps = (0..self.laps).flat_map(|_| points.iter().copied()).collect::<Vec<_>>();
        Path::spline(&laps).map_err(fault_of("path.points_m"))
    }

    fn points(&self) -> Result<Vec<Point2<f64>>, Fault> {
        let points = need(self.points.as_ref(), "a path of points", "points_m", "[[0.0, 0.0], [2.0, 1.0]]")?;
        Ok(points.iter().copied().map(Point2::from).collect())
    }

    fn start(&self, kind: &str) -> Result<PlanarPose, Fault> {
        let [x, y] = need(self.start, kind, "start_m", "[3.0, 2.0]")?;
        Ok(PlanarPose::new(x, y, self.start_heading_deg.unwrap_or(0.0).to_radians()))
    }

    /// Refuses keys of other kinds.
    fn allow(&self, kind: &str, allowed: &[&str]) -> Result<(), Fault> {
        let written = [
            ("points_m", self.points.is_some()),
            ("corner_radius_m", self.corner_radius.is_some()),
            ("start_m", self.start.is_some()),
            ("start_heading_deg", self.start_heading_deg.is_some()),
            ("radius_m", self.radius.is_some()),
            ("size_m", self.size.is_some()),
        ];
        match written.iter().find(|(key, written)| *written && !allowed.contains(key)) {
            Some((key, _)) => {
                let problem = format!("{key} says nothing of {kind}; delete it (instead: {})", allowed.join(", "));
                Err(Fault::new(format!("path.{key}"), problem))
            }
            None => Ok(()),
        }
    }
}

fn need<T>(value: Option<T>, kind: &str, key: &str, example: &str) -> Result<T, Fault> {
    value.ok_or_else(|| Fault::new(format!("path.{key}"), format!("{kind} needs {key}; write {key} = {example}")))
}

fn fault_of(key: &'static str) -> impl Fn(PathError) -> Fault {
    move |error| {
        let advice = match error {
            PathError::TooFewWaypoints => "; write points_m = [[0.0, 0.0], [2.0, 1.0]]",
            PathError::NoRoom { .. } => "; write a smaller corner_radius_m",
            PathError::NotClosed => "; repeat the first point at the end, or write laps = 1",
            PathError::OutOfRange { .. } => "",
        };
        Fault::new(key, format!("{error}{advice}"))
    }
}

/// How far apart the path is held against the world, metres.
const STEP: f64 = 0.1;

impl Scenario {
    /// Holds the way against a world, from the robot's start on: `is_free` says whether the robot, as wide as it is,
    /// can drive straight from one point to another, no more than a tenth of a metre apart along the path.
    ///
    /// # Errors
    /// The first place where something stands in the way.
    pub fn check_way(&self, is_free: impl Fn(&Point2<f64>, &Point2<f64>) -> bool) -> Result<(), Fault> {
        let path = self.path.shape()?;
        let steps = (path.length() / STEP).ceil().max(1.0);
        let along = |step: f64| path.at(path.length() * step / steps).position;
        if let Some(start) = self.robot.start.map(Point2::from)
            && !is_free(&start, &along(0.0))
        {
            let problem = "something stands between the robot's start and the path's; move one of them";
            return Err(Fault::new("robot.start_m", problem));
        }
        match (1..=steps as usize).find(|&step| !is_free(&along(step as f64 - 1.0), &along(step as f64))) {
            Some(step) => {
                let (at, way) = (along(step as f64), path.length() * step as f64 / steps);
                let problem = format!(
                    "the path is blocked near ({:.2}, {:.2}) m, {way:.1} m from its start: lead it round what stands \
                     there",
                    at.x, at.y
                );
                let key = if self.path.points.is_some() { "path.points_m" } else { "path.start_m" };
                Err(Fault::new(key, problem))
            }
            None => Ok(()),
        }
    }
}
