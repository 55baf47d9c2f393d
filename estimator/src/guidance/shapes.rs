//! The shapes that a path can have.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::path::{Path, PathError, PathPoint, SAME_PLACE};
use crate::fusion::PlanarPose;

/// Distance between the points of a path, metres; a chord of it misses a bend of 0.3 m radius by 0.04 mm.
const SPACING: f64 = 0.01;
/// No path has more points than this: a longer one has them further apart.
const MAX_POINTS: f64 = 200_000.0;
/// No coordinate is larger, metres.
const MAX_COORDINATE: f64 = 1e5;

/// Position and its first two derivatives by a curve's own parameter.
struct Local {
    position: Point2<f64>,
    first: Vector2<f64>,
    second: Vector2<f64>,
}

impl Path {
    /// Straight from waypoint to waypoint, turning on the spot at corners.
    ///
    /// # Errors
    /// [`PathError`] for fewer than two places, or coordinates that are none.
    pub fn straight(waypoints: &[Point2<f64>]) -> Result<Self, PathError> {
        let waypoints = distinct(waypoints)?;
        let length: f64 = waypoints.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let mut points = Vec::new();
        let mut along = 0.0;
        for pair in waypoints.windows(2) {
            let chord = pair[1] - pair[0];
            let count = (chord.norm() / spacing(length)).ceil().max(1.0) as usize;
            points.extend((0..=count).map(|index| {
                let share = index as f64 / count as f64;
                PathPoint {
                    along: along + chord.norm() * share,
                    position: pair[0] + chord * share,
                    heading: chord.y.atan2(chord.x),
                    curvature: 0.0,
                }
            }));
            along += chord.norm();
        }
        Ok(Self::from_points(points))
    }

    /// Straight from waypoint to waypoint, with an arc of `radius` metres at each corner.
    ///
    /// # Errors
    /// As [`straight`](Self::straight), and where a leg is too short for the arcs at its ends.
    pub fn rounded(waypoints: &[Point2<f64>], radius: f64) -> Result<Self, PathError> {
        within("radius", radius, 0.01, MAX_COORDINATE)?;
        let waypoints = distinct(waypoints)?;
        let legs: Vec<Vector2<f64>> = waypoints.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let spacing = spacing(legs.iter().map(Vector2::norm).sum());
        // At each waypoint; none at the first and the last.
        let mut turns = vec![0.0; waypoints.len()];
        for (turn, pair) in turns[1..].iter_mut().zip(legs.windows(2)) {
            *turn = pair[0].perp(&pair[1]).atan2(pair[0].dot(&pair[1]));
        }
        let cut = |waypoint: usize| radius * (turns[waypoint] / 2.0).abs().tan();
        let (mut points, mut along) = (Vec::new(), 0.0);
        for (index, leg) in legs.iter().enumerate() {
            let (from, to, turn) = (waypoints[index], waypoints[index + 1], turns[index + 1]);
            let straight = leg.norm() - cut(index) - cut(index + 1);
            if straight < -SAME_PLACE {
                return Err(PathError::NoRoom { radius, from_x: from.x, from_y: from.y, to_x: to.x, to_y: to.y });
            }
            let forward = leg.normalize();
            let start = from + forward * cut(index);
            if straight > SAME_PLACE {
                let local = |u: f64| Local { position: start + forward * u, first: forward, second: Vector2::zeros() };
                append(&mut points, local, straight, spacing, &mut along);
            }
            let inwards = Vector2::new(-forward.y, forward.x) * turn.signum();
            let local = |angle: f64| {
                let (sin, cos) = angle.sin_cos();
                Local {
                    position: start + forward * straight + (forward * sin + inwards * (1.0 - cos)) * radius,
                    first: (forward * cos + inwards * sin) * radius,
                    second: (inwards * cos - forward * sin) * radius,
                }
            };
            if turn.abs() * radius > SAME_PLACE {
                append(&mut points, local, turn.abs(), spacing, &mut along);
            }
        }
        Ok(Self::from_points(points))
    }

    /// Smoothly through every waypoint: the natural cubic spline over the chords' lengths, whose curvature has no jumps.
    ///
    /// # Errors
    /// As [`straight`](Self::straight).
    pub fn spline(waypoints: &[Point2<f64>]) -> Result<Self, PathError> {
        let waypoints = distinct(waypoints)?;
        let chords: Vec<f64> = waypoints.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        let bends = natural_second_derivatives(&waypoints, &chords);
        let length: f64 = chords.iter().sum();
        let mut knot = 0.0;
        let mut points = Vec::new();
        for (index, &chord) in chords.iter().enumerate() {
            let (from, to, bend_from, bend_to) =
                (waypoints[index], waypoints[index + 1], bends[index], bends[index + 1]);
            // On one chord of length h, with a = (h − u)/h and b = u/h (Press et al., Numerical Recipes, §3.3).
            let local = |u: f64| {
                let (a, b) = ((chord - u) / chord, u / chord);
                let cubic = |w: f64| (w.powi(3) - w) * chord * chord / 6.0;
                let slope = |w: f64| (3.0 * w * w - 1.0) * chord / 6.0;
                Local {
                    position: Point2::from(from.coords * a + to.coords * b + bend_from * cubic(a) + bend_to * cubic(b)),
                    first: (to - from) / chord - bend_from * slope(a) + bend_to * slope(b),
                    second: bend_from * a + bend_to * b,
                }
            };
            append(&mut points, local, chord, spacing(length), &mut knot);
        }
        Ok(Self::from_points(points))
    }

    /// A circle that leaves `start` along its heading, to the left for a positive radius, and goes round so many times.
    ///
    /// # Errors
    /// [`PathError`] for a radius or a number of turns that is none.
    pub fn circle(start: &PlanarPose, radius: f64, turns: f64) -> Result<Self, PathError> {
        within("radius", radius.abs(), 0.01, MAX_COORDINATE)?;
        within("turns", turns, 1e-3, 1e3)?;
        check_start(start)?;
        let local = |angle: f64| Local {
            position: Point2::new(radius.abs() * angle.sin(), radius * (1.0 - angle.cos())),
            first: Vector2::new(radius.abs() * angle.cos(), radius * angle.sin()),
            second: Vector2::new(-radius.abs() * angle.sin(), radius * angle.cos()),
        };
        Ok(Self::placed(start, local, turns * TAU, radius.abs() * turns * TAU))
    }

    /// A figure eight, Bernoulli's lemniscate, that leaves its crossing at `start` along the heading, goes round its left
    /// loop first and ends at the crossing. `half_width` is the distance from the crossing to a loop's far end, metres;
    /// the tightest bend has a third of it as radius.
    ///
    /// # Errors
    /// [`PathError`] for a size that is none.
    pub fn figure_eight(start: &PlanarPose, half_width: f64) -> Result<Self, PathError> {
        within("half_width", half_width, 0.03, MAX_COORDINATE)?;
        check_start(start)?;
        let local = |t: f64| {
            // Parametrised from the crossing: x = a sin t / (1 + cos² t), y = −a sin t cos t / (1 + cos² t).
            let (sin, cos) = t.sin_cos();
            let w = 1.0 + cos * cos;
            let (x, y) = (sin / w, -sin * cos / w);
            // w' = −2 sin cos; quotient rule, twice.
            let dw = -2.0 * sin * cos;
            let ddw = -2.0 * (cos * cos - sin * sin);
            let dx = (cos - x * dw) / w;
            let dy = (sin * sin - cos * cos - y * dw) / w;
            let ddx = (-sin - 2.0 * dx * dw - x * ddw) / w;
            let ddy = (4.0 * sin * cos - 2.0 * dy * dw - y * ddw) / w;
            // Turned by 45°, so that it leaves the crossing along x.
            let turned = |x: f64, y: f64| Vector2::new(x - y, x + y) * (half_width * std::f64::consts::FRAC_1_SQRT_2);
            Local { position: Point2::from(turned(x, y)), first: turned(dx, dy), second: turned(ddx, ddy) }
        };
        // Its length is 5.244 a, a being half the width.
        Ok(Self::placed(start, local, TAU, 5.244 * half_width))
    }

    /// A curve of about `length` metres given in the frame of `start`.
    fn placed(start: &PlanarPose, local: impl Fn(f64) -> Local, end: f64, length: f64) -> Self {
        let (sin, cos) = start.heading.sin_cos();
        let turn = |v: Vector2<f64>| Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
        let mut points = Vec::new();
        let placed = |u: f64| {
            let Local { position, first, second } = local(u);
            let position = Point2::new(start.x, start.y) + turn(position.coords);
            Local { position, first: turn(first), second: turn(second) }
        };
        append(&mut points, placed, end, spacing(length), &mut 0.0);
        Self::from_points(points)
    }
}

/// Appends a curve over 0..=`end` of its parameter, in parts of about `spacing` metres; `along` is the arc length so
/// far.
fn append(points: &mut Vec<PathPoint>, local: impl Fn(f64) -> Local, end: f64, spacing: f64, along: &mut f64) {
    let speed = |u: f64| local(u).first.norm();
    let coarse: f64 = (0..100).map(|index| speed((f64::from(index) + 0.5) * end / 100.0)).sum::<f64>() * end / 100.0;
    let count = (coarse / spacing).ceil().max(2.0) as usize;
    let step = end / count as f64;
    let skip = usize::from(!points.is_empty());
    for index in 0..=count {
        let u = index as f64 * step;
        if index > 0 {
            // Simpson's rule.
            *along += (speed(u - step) + 4.0 * speed(u - step / 2.0) + speed(u)) * step / 6.0;
        }
        if index < skip {
            continue;
        }
        let Local { position, first, second } = local(u);
        let cubed = first.norm().powi(3);
        points.push(PathPoint {
            along: *along,
            position,
            heading: first.y.atan2(first.x),
            // Where a spline stands still for a point it has no curvature to speak of.
            curvature: if cubed > 1e-12 { first.perp(&second) / cubed } else { 0.0 },
        });
    }
}

/// Second derivatives at the knots, zero at both ends; the tridiagonal system by elimination.
fn natural_second_derivatives(waypoints: &[Point2<f64>], chords: &[f64]) -> Vec<Vector2<f64>> {
    let count = waypoints.len();
    let (mut diagonal, mut right) = (vec![1.0; count], vec![Vector2::zeros(); count]);
    for i in 1..count - 1 {
        let (before, after) = (chords[i - 1], chords[i]);
        let jump = (waypoints[i + 1] - waypoints[i]) / after - (waypoints[i] - waypoints[i - 1]) / before;
        // The first knot's value is zero, so that the first row has nothing to eliminate.
        let ratio = if i > 1 { before / diagonal[i - 1] } else { 0.0 };
        diagonal[i] = 2.0 * (before + after) - ratio * before;
        right[i] = jump * 6.0 - right[i - 1] * ratio;
    }
    let mut bends = vec![Vector2::zeros(); count];
    for i in (1..count - 1).rev() {
        bends[i] = (right[i] - bends[i + 1] * chords[i]) / diagonal[i];
    }
    bends
}

fn spacing(length: f64) -> f64 {
    SPACING.max(length / MAX_POINTS)
}

/// The waypoints without those that repeat the one before.
fn distinct(waypoints: &[Point2<f64>]) -> Result<Vec<Point2<f64>>, PathError> {
    let mut distinct: Vec<Point2<f64>> = Vec::new();
    for waypoint in waypoints {
        check_coordinates(waypoint.x, waypoint.y)?;
        if distinct.last().is_none_or(|last| (waypoint - last).norm() > SAME_PLACE) {
            distinct.push(*waypoint);
        }
    }
    if distinct.len() < 2 { Err(PathError::TooFewWaypoints) } else { Ok(distinct) }
}

fn check_start(start: &PlanarPose) -> Result<(), PathError> {
    check_coordinates(start.x, start.y)?;
    within("heading", start.heading, -TAU, TAU)
}

fn check_coordinates(x: f64, y: f64) -> Result<(), PathError> {
    within("x", x, -MAX_COORDINATE, MAX_COORDINATE)?;
    within("y", y, -MAX_COORDINATE, MAX_COORDINATE)
}

fn within(name: &'static str, value: f64, low: f64, high: f64) -> Result<(), PathError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(PathError::OutOfRange { name, value, wanted: "a number that a robot can drive, within 100 km" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::wrap_angle;
    use proptest::prelude::*;

    /// Headings, curvatures and arc lengths must be what the positions say.
    fn assert_consistent(path: &Path) {
        for triple in path.points().windows(3) {
            let (before, here, after) = (&triple[0], &triple[1], &triple[2]);
            let chord = after.position - before.position;
            let length = after.along - before.along;
            assert!((chord.norm() - length).abs() < 1e-3 * length, "{here:?}");
            assert!(wrap_angle(chord.y.atan2(chord.x) - here.heading).abs() < 1e-2, "{here:?}");
            let curvature = wrap_angle(after.heading - before.heading) / length;
            // Where a straight becomes an arc it is in between.
            let [low, .., high] = sorted([before.curvature, here.curvature, after.curvature]);
            let tolerance = 0.02 * (1.0 + here.curvature.abs());
            assert!((low - tolerance..high + tolerance).contains(&curvature), "{here:?} {curvature}");
        }
    }

    fn sorted(mut values: [f64; 3]) -> [f64; 3] {
        values.sort_by(f64::total_cmp);
        values
    }

    #[test]
    fn circles_and_eights_are_what_they_say() {
        let start = PlanarPose::new(1.0, -2.0, 2.5);
        for path in [
            Path::circle(&start, 1.5, 2.0).unwrap(),
            Path::circle(&start, -0.7, 1.0).unwrap(),
            Path::figure_eight(&start, 1.5).unwrap(),
        ] {
            assert_consistent(&path);
            let (first, last) = (path.points()[0], path.at(path.length()));
            assert!((last.position - Point2::new(1.0, -2.0)).norm() < 1e-9);
            assert!(wrap_angle(first.heading - 2.5).abs() < 1e-9);
            assert_eq!(path.sections().len(), 1);
        }
        assert!((Path::circle(&start, 1.5, 2.0).unwrap().length() - 6.0 * std::f64::consts::PI).abs() < 1e-9);
        let eight = Path::figure_eight(&start, 1.5).unwrap();
        assert!((eight.length() - 5.244_115 * 1.5).abs() < 1e-4);
        // The left loop comes first, and its tightest bend has a third of the half width as radius.
        let far = eight.at(eight.length() / 4.0);
        assert!(
            (far.curvature - 2.0).abs() < 1e-3 && ((far.position - Point2::new(1.0, -2.0)).norm() - 1.5).abs() < 1e-3
        );
    }

    #[test]
    fn rounded_corners_are_arcs_of_their_radius() {
        let corners = [[4.0, 1.0], [9.0, 1.0], [9.0, 5.0], [2.0, 5.0], [2.0, 1.0], [4.0, 1.0]].map(Point2::from);
        let path = Path::rounded(&corners, 0.7).unwrap();
        assert_consistent(&path);
        assert_eq!(path.sections().len(), 1);
        assert!((path.length() - (22.0 - 8.0 * 0.7 + TAU * 0.7)).abs() < 1e-6, "{}", path.length());
        assert!((path.at(4.3 + 0.5).curvature - 1.0 / 0.7).abs() < 1e-6);
        let twice = path.repeated(2).unwrap();
        assert!(twice.sections().len() == 1 && (twice.length() - 2.0 * path.length()).abs() < 1e-9);
        assert!((twice.at(path.length() + 1.0).position - path.at(1.0).position).norm() < 1e-9);

        let dog_leg = [[0.0, 0.0], [1.0, 0.0], [0.5, 2.0]].map(Point2::from);
        assert_consistent(&Path::rounded(&dog_leg, 0.3).unwrap());
        assert!(matches!(Path::rounded(&dog_leg, 1.0), Err(PathError::NoRoom { from_x: 0.0, to_x: 1.0, .. })));
        let back = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]].map(Point2::from);
        assert!(matches!(Path::rounded(&back, 0.1), Err(PathError::NoRoom { .. })));
        assert_eq!(Path::straight(&dog_leg).unwrap().repeated(2), Err(PathError::NotClosed));
    }

    proptest! {
        #[test]
        fn a_spline_meets_every_waypoint(ys in prop::collection::vec(-1.0..1.0_f64, 2..8)) {
            let waypoints: Vec<_> = ys.iter().enumerate().map(|(i, &y)| Point2::new(1.5 * i as f64, y)).collect();
            let path = Path::spline(&waypoints).unwrap();
            assert_consistent(&path);
            for waypoint in &waypoints {
                let nearest = path.points().iter().map(|point| (point.position - waypoint).norm()).fold(9.0, f64::min);
                prop_assert!(nearest < 1e-9);
            }
        }

        #[test]
        fn any_waypoints_give_a_path_or_a_reason(waypoints in prop::collection::vec((any::<f64>(), any::<f64>()), 0..5)) {
            let waypoints: Vec<_> = waypoints.into_iter().map(|(x, y)| Point2::new(x, y)).collect();
            let _ = (Path::straight(&waypoints), Path::spline(&waypoints));
        }
    }

    #[test]
    fn what_is_no_path_is_refused() {
        let here = Point2::new(1.0, 1.0);
        assert_eq!(Path::straight(&[here, here]), Err(PathError::TooFewWaypoints));
        assert!(Path::spline(&[here, Point2::new(f64::NAN, 0.0)]).unwrap_err().to_string().starts_with("x is NaN"));
        assert!(Path::circle(&PlanarPose::default(), 0.0, 1.0).is_err());
        assert!(Path::figure_eight(&PlanarPose::default(), f64::INFINITY).is_err());
    }
}
