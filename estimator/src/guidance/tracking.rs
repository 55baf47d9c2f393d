//! Keeps a robot that can't move sideways on a path.

use nalgebra::{Point2, Vector2};
use serde::{Deserialize, Serialize};

use super::VelocityCommand;
use super::path::{Path, PathPoint};
use crate::fusion::{PlanarPose, wrap_angle};
use crate::params::ParamError;

/// Parameters of the tracking.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TrackingParams {
    /// Speed on a straight, m/s. A P3-AT reaches 0.7.
    #[serde(rename = "speed_m_per_s")]
    pub speed: f64,
    /// Fastest turn, rad/s. A P3-AT reaches 2.4; a camera likes less.
    #[serde(rename = "max_turn_rad_per_s")]
    pub max_turn: f64,
    /// Largest change of speed, m/s².
    #[serde(rename = "max_acceleration_m_per_s2")]
    pub max_acceleration: f64,
    /// Largest change of turn rate, rad/s².
    #[serde(rename = "max_turn_acceleration_rad_per_s2")]
    pub max_turn_acceleration: f64,
    /// Largest acceleration towards the inside of a bend, m/s².
    #[serde(rename = "max_side_acceleration_m_per_s2")]
    pub max_side_acceleration: f64,
    /// How far ahead a robot beside the path aims for it, metres.
    #[serde(rename = "look_ahead_m")]
    pub look_ahead: f64,
    /// Way in which a heading error falls to a third, metres.
    #[serde(rename = "heading_way_m")]
    pub heading_way: f64,
    /// A heading error beyond this is turned off on the spot before driving on, radians.
    #[serde(rename = "turn_in_place_rad")]
    pub turn_in_place: f64,
    /// The end, or a corner, is reached at this distance, metres.
    #[serde(rename = "reached_m")]
    pub reached: f64,
}

impl Default for TrackingParams {
    fn default() -> Self {
        Self {
            speed: 0.4,
            max_turn: 1.0,
            max_acceleration: 0.3,
            max_turn_acceleration: 2.0,
            max_side_acceleration: 0.3,
            look_ahead: 0.4,
            heading_way: 0.2,
            turn_in_place: 0.8,
            reached: 0.02,
        }
    }
}

impl TrackingParams {
    /// Checks every number once, so that the tracker need not.
    ///
    /// # Errors
    /// The first number outside its range.
    pub fn validate(&self) -> Result<(), ParamError> {
        let checks = [
            ("speed_m_per_s", self.speed),
            ("max_turn_rad_per_s", self.max_turn),
            ("max_acceleration_m_per_s2", self.max_acceleration),
            ("max_turn_acceleration_rad_per_s2", self.max_turn_acceleration),
            ("max_side_acceleration_m_per_s2", self.max_side_acceleration),
            ("look_ahead_m", self.look_ahead),
            ("heading_way_m", self.heading_way),
            ("turn_in_place_rad", self.turn_in_place),
            ("reached_m", self.reached),
        ];
        match checks.into_iter().find(|(_, value)| !(1e-3..1e3).contains(value)) {
            Some((key, value)) => Err(ParamError::OutOfRange { key, value, wanted: "between 0.001 and 1000" }),
            None => Ok(()),
        }
    }
}

/// Turning on the spot ends at this heading error, radians.
const ALIGNED: f64 = 0.1;
/// How far ahead of its last place on the path the robot is looked for, metres.
const SEARCH_AHEAD: f64 = 0.5;

/// Follows one path: commands are a function of the path, the poses so far and the times between them, nothing else.
#[derive(Clone, Debug)]
pub struct Tracker {
    path: Path,
    params: TrackingParams,
    /// Highest speed at each point of the path from which the bends ahead can be taken and the end be met.
    speeds: Vec<f64>,
    /// The part between corners that is being driven, and the arc length reached.
    section: usize,
    along: f64,
    turning: bool,
    finished: bool,
    last: VelocityCommand,
}

impl Tracker {
    /// At the start of a path, standing. The parameters have been [validated](TrackingParams::validate).
    pub fn new(path: Path, params: TrackingParams) -> Self {
        Self {
            speeds: speed_profile(&path, &params),
            path,
            params,
            section: 0,
            along: 0.0,
            turning: false,
            finished: false,
            last: VelocityCommand::default(),
        }
    }

    /// Whether the end has been reached and the robot told to stand.
    pub fn finished(&self) -> bool {
        self.finished && self.last == VelocityCommand::default()
    }

    /// The point of the path that the robot is at.
    pub fn reference(&self) -> PathPoint {
        self.path.at_within(self.along, &self.path.sections()[self.section])
    }

    /// The command for the next `dt` seconds at a pose in the path's frame. A pose that is none, or no time, slows the
    /// robot down.
    pub fn command(&mut self, robot: &PlanarPose, dt: f64) -> VelocityCommand {
        let dt = if dt.is_finite() { dt.clamp(0.0, 1.0) } else { 0.0 };
        let wanted = if robot.to_vector().iter().all(|value| value.is_finite()) {
            self.wanted(robot)
        } else {
            Default::default()
        };
        let step = self.params.max_acceleration * dt;
        let turn_step = self.params.max_turn_acceleration * dt;
        self.last = VelocityCommand {
            linear: wanted.linear.clamp(self.last.linear - step, self.last.linear + step),
            angular: wanted.angular.clamp(self.last.angular - turn_step, self.last.angular + turn_step),
        };
        self.last
    }

    /// The command without regard to what was commanded before.
    fn wanted(&mut self, robot: &PlanarPose) -> VelocityCommand {
        let position = Point2::new(robot.x, robot.y);
        let range = self.path.sections()[self.section].clone();
        let here = self.path.closest(&position, self.along, SEARCH_AHEAD, &range);
        self.along = here.along;
        let end = self.path.points()[range.end - 1];
        // Within reach of the end, or past it.
        let to_end = (end.position - position).dot(&direction(end.heading));
        if self.finished || (end.along - here.along < self.params.reached && to_end < self.params.reached) {
            return self.leave_section();
        }
        // Line of sight: the further the robot is to the left of the path (e > 0), the more it aims to the right, up to
        // straight at it. ψ = θ_path − atan(e / Δ).
        let tangent = direction(here.heading);
        let aside = tangent.perp(&(position - here.position));
        let look_ahead = self.params.look_ahead;
        let error = wrap_angle(robot.heading - here.heading + (aside / look_ahead).atan());
        if error.abs() > self.params.turn_in_place {
            self.turning = true;
        } else if error.abs() < ALIGNED {
            self.turning = false;
        }
        if self.turning {
            return VelocityCommand { linear: 0.0, angular: self.turn_off(error) };
        }
        let (sin, cos) = wrap_angle(robot.heading - here.heading).sin_cos();
        let limit = self.speed_at(here.along) * error.cos().max(0.0);
        // ω = dψ/dt − (v/ℓ)·error, so that the heading error dies out over the way ℓ: the path's own bend, at the pace of
        // the point beside the robot (Samson 1995), is fed forward.
        let pace = cos / (1.0 - here.curvature * aside).max(0.2);
        let aim_rate = here.curvature * pace - look_ahead / (look_ahead * look_ahead + aside * aside) * sin;
        let turn_per_metre = aim_rate - error / self.params.heading_way;
        // A turn that is too fast is made slower, not wider.
        let linear = limit.min(self.params.max_turn / turn_per_metre.abs().max(1e-9));
        VelocityCommand { linear, angular: turn_per_metre * linear }
    }

    /// At the end of a section: stand, then go on with the next.
    fn leave_section(&mut self) -> VelocityCommand {
        if self.section + 1 == self.path.sections().len() {
            self.finished = true;
        } else if self.last.linear <= 0.0 {
            self.section += 1;
            self.along = self.path.points()[self.path.sections()[self.section].start].along;
        }
        VelocityCommand::default()
    }

    /// The turn rate that takes an error off on the spot and stops at it.
    fn turn_off(&self, error: f64) -> f64 {
        let braking = (self.params.max_turn_acceleration * error.abs()).sqrt();
        -error.signum() * braking.min(self.params.max_turn)
    }

    /// The speed profile between the path's points; its square is linear in the way.
    fn speed_at(&self, along: f64) -> f64 {
        let range = self.path.sections()[self.section].clone();
        let points = &self.path.points()[range.clone()];
        let after = points.partition_point(|point| point.along <= along).clamp(1, points.len() - 1);
        let (from, to) = (&points[after - 1], &points[after]);
        let share = ((along - from.along) / (to.along - from.along).max(1e-12)).clamp(0.0, 1.0);
        let (slow, fast) = (self.speeds[range.start + after - 1], self.speeds[range.start + after]);
        (slow * slow * (1.0 - share) + fast * fast * share).sqrt()
    }
}

fn direction(heading: f64) -> Vector2<f64> {
    Vector2::new(heading.cos(), heading.sin())
}

/// What each point's bend allows, lowered backwards from the end of each section to what the brakes can do.
fn speed_profile(path: &Path, params: &TrackingParams) -> Vec<f64> {
    // Half of the brakes, the other half is for what the robot does otherwise.
    let brake = 0.5 * params.max_acceleration;
    let mut speeds: Vec<f64> = path
        .points()
        .iter()
        .map(|point| {
            let curvature = point.curvature.abs().max(1e-9);
            let in_bend = (0.8 * params.max_turn / curvature).min((params.max_side_acceleration / curvature).sqrt());
            params.speed.min(in_bend)
        })
        .collect();
    for section in path.sections() {
        // Not zero, or the last millimetres would take for ever.
        speeds[section.end - 1] = speeds[section.end - 1].min(0.02);
        for index in section.clone().rev().skip(1) {
            let way = path.points()[index + 1].along - path.points()[index].along;
            speeds[index] = speeds[index].min((speeds[index + 1].powi(2) + 2.0 * brake * way).sqrt());
        }
    }
    speeds
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    const DT: f64 = 0.05;

    /// An ideal unicycle in closed loop; its way, and the pose in which it was told to stand. Checks every limit.
    fn drive(path: &Path, start: PlanarPose) -> (Vec<PlanarPose>, PlanarPose) {
        let params = TrackingParams::default();
        let mut tracker = Tracker::new(path.clone(), params);
        let (mut robot, mut last) = (start, VelocityCommand::default());
        let mut way = vec![robot];
        let patience = (20.0 + 10.0 * (path.length() + 5.0) / params.speed) / DT;
        while !tracker.finished() {
            assert!((way.len() as f64) < patience, "does not arrive: {robot:?} at {:?}", tracker.reference());
            let command = tracker.command(&robot, DT);
            assert!((-1e-9..=params.speed + 1e-9).contains(&command.linear), "{command:?}");
            assert!(command.angular.abs() <= params.max_turn + 1e-9, "{command:?}");
            assert!((command.linear - last.linear).abs() <= params.max_acceleration * DT + 1e-9);
            assert!((command.angular - last.angular).abs() <= params.max_turn_acceleration * DT + 1e-9);
            let arc =
                crate::fusion::Arc { distance: command.linear * DT, turn: command.angular * DT, ..Default::default() };
            robot = robot * arc.motion().pose;
            last = command;
            way.push(robot);
        }
        (way, robot)
    }

    /// Distance from a position to the nearest point of the path.
    fn off(path: &Path, robot: &PlanarPose) -> f64 {
        let position = Point2::new(robot.x, robot.y);
        path.points().iter().map(|point| (point.position - position).norm()).fold(f64::INFINITY, f64::min)
    }

    fn end_error(path: &Path, robot: &PlanarPose) -> f64 {
        (path.at(path.length()).position - Point2::new(robot.x, robot.y)).norm()
    }

    fn paths() -> Vec<(&'static str, Path)> {
        let points = |list: &[(f64, f64)]| list.iter().map(|&(x, y)| Point2::new(x, y)).collect::<Vec<_>>();
        let start = PlanarPose::default();
        vec![
            ("straight", Path::straight(&points(&[(0.0, 0.0), (4.0, 0.0)])).unwrap()),
            ("square", Path::straight(&points(&[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0), (0.0, 0.0)])).unwrap()),
            ("there and back", Path::straight(&points(&[(0.0, 0.0), (3.0, 0.0), (0.0, 0.0)])).unwrap()),
            ("spline", Path::spline(&points(&[(0.0, 0.0), (2.0, 0.5), (3.0, 2.0), (1.0, 3.0), (0.0, 5.0)])).unwrap()),
            ("circle", Path::circle(&start, 1.0, 2.0).unwrap()),
            ("circle to the right", Path::circle(&start, -2.0, 1.0).unwrap()),
            ("figure eight", Path::figure_eight(&start, 2.0).unwrap()),
        ]
    }

    #[test]
    fn every_shape_is_followed_to_its_end() {
        for (name, path) in paths() {
            let first = path.at(0.0);
            let start = PlanarPose::new(first.position.x, first.position.y, first.heading);
            let (way, end) = drive(&path, start);
            let furthest = way.iter().map(|robot| off(&path, robot)).fold(0.0, f64::max);
            assert!(furthest < 0.05, "{name}: {furthest} m off");
            assert!(end_error(&path, &end) < 0.05, "{name}: ends {} m off", end_error(&path, &end));
            // All of it was driven, not a short cut of it.
            let driven: f64 = way.windows(2).map(|pair| pair[1].distance(&pair[0])).sum();
            assert!((driven / path.length() - 1.0).abs() < 0.03, "{name}: {driven} m of {}", path.length());
        }
    }

    #[test]
    fn a_robot_beside_the_path_finds_it() {
        for (name, path) in paths() {
            for (x, y, turned) in [(0.0, 0.6, 0.0), (-0.5, -0.5, FRAC_PI_2), (0.0, 0.0, PI), (0.3, -0.4, -2.5)] {
                let heading = path.at(0.0).heading + turned;
                let (way, end) = drive(&path, PlanarPose::new(x, y, heading));
                assert!(end_error(&path, &end) < 0.05, "{name} from {x} {y} {turned}");
                // Within 2 m it is on the path and stays there.
                let mut driven = 0.0;
                for pair in way.windows(2) {
                    driven += pair[1].distance(&pair[0]);
                    assert!(driven < 2.0 || off(&path, &pair[1]) < 0.05, "{name} from {x} {y} {turned}: {:?}", pair[1]);
                }
            }
        }
    }

    #[test]
    fn a_robot_that_faces_away_turns_first() {
        let (_, path) = paths().swap_remove(0);
        let (way, _) = drive(&path, PlanarPose::new(0.0, 0.0, PI));
        assert!(way.iter().all(|robot| robot.x > -0.01));
    }

    #[test]
    fn a_speed_that_is_none_is_refused() {
        assert_eq!(TrackingParams::default().validate(), Ok(()));
        let wrong = TrackingParams { look_ahead: 0.0, ..TrackingParams::default() };
        assert!(wrong.validate().unwrap_err().to_string().starts_with("look_ahead_m = 0"));
    }

    #[test]
    fn it_slows_down_before_a_bend() {
        let path = Path::figure_eight(&PlanarPose::default(), 1.0).unwrap();
        let tracker = Tracker::new(path.clone(), TrackingParams::default());
        let slowest = tracker.speeds.iter().copied().fold(f64::INFINITY, |a, b| if b > 0.05 { a.min(b) } else { a });
        assert!(slowest < TrackingParams::default().speed);
        for (pair, point) in tracker.speeds.windows(2).zip(path.points().windows(2)) {
            let braking = (pair[0].powi(2) - pair[1].powi(2)) / (2.0 * (point[1].along - point[0].along));
            assert!(braking < TrackingParams::default().max_acceleration);
        }
    }

    proptest! {
        #[test]
        fn any_pose_gets_a_command(poses in prop::collection::vec((any::<f64>(), any::<f64>(), any::<f64>(), any::<f64>()), 1..30)) {
            let mut tracker = Tracker::new(Path::figure_eight(&PlanarPose::default(), 1.0).unwrap(), Default::default());
            for (x, y, heading, dt) in poses {
                let command = tracker.command(&PlanarPose { x, y, heading }, dt);
                prop_assert!(command.linear.is_finite() && command.angular.is_finite());
            }
        }
    }
}
