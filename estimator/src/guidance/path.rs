//! A path by its arc length.

use std::ops::Range;

use nalgebra::Point2;
use thiserror::Error;

use crate::fusion::wrap_angle;

/// A corner sharper than this, radians (about 9°), is driven by stopping and turning on the spot; a flatter one is
/// rounded by the robot itself.
const SHARP_CORNER: f64 = 0.15;
/// Places closer than this are one, metres.
pub(super) const SAME_PLACE: f64 = 1e-6;

/// One point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Arc length from the start, metres.
    pub along: f64,
    /// Where, metres.
    pub position: Point2<f64>,
    /// Where the path leads from here, radians.
    pub heading: f64,
    /// Counter-clockwise, 1/m.
    pub curvature: f64,
}

/// A path in the plane, made by one of its shapes ([`Path::straight`], [`Path::rounded`],
/// [`Path::spline`], [`Path::circle`], [`Path::figure_eight`]). It may cross itself, so a point of it is asked for by its arc length.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// At least two, `along` never falling; at a corner two points share one place.
    points: Vec<PathPoint>,
    /// The parts between sharp corners, as ranges of `points`; each begins and ends at a place of its own.
    sections: Vec<Range<usize>>,
}

/// A path that can't be driven.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PathError {
    /// Nothing to drive along.
    #[error("a path needs at least two waypoints that lie apart")]
    TooFewWaypoints,
    /// Arcs that would overlap.
    #[error("no room for corners of {radius} m between the waypoints ({from_x}, {from_y}) and ({to_x}, {to_y})")]
    NoRoom {
        /// Of the arcs, metres.
        radius: f64,
        /// Where the leg begins, metres.
        from_x: f64,
        /// Likewise.
        from_y: f64,
        /// Where the leg ends, metres.
        to_x: f64,
        /// Likewise.
        to_y: f64,
    },
    /// Nothing to drive round and round.
    #[error("a path of several laps must end where it starts")]
    NotClosed,
    /// Not a number, or further than any robot drives.
    #[error("{name} is {value}: {wanted}")]
    OutOfRange {
        /// What.
        name: &'static str,
        /// The value found.
        value: f64,
        /// What would do.
        wanted: &'static str,
    },
}

impl Path {
    /// From points in order, at least two.
    pub(super) fn from_points(points: Vec<PathPoint>) -> Self {
        let is_corner = |index: usize| {
            let (before, after) = (&points[index - 1], &points[index]);
            before.along == after.along && wrap_angle(after.heading - before.heading).abs() > SHARP_CORNER
        };
        let corners: Vec<usize> = (1..points.len()).filter(|&index| is_corner(index)).collect();
        let starts = std::iter::once(0).chain(corners.iter().copied());
        let ends = corners.iter().copied().chain(std::iter::once(points.len()));
        let sections = starts.zip(ends).map(|(start, end)| start..end).collect();
        Self { points, sections }
    }

    /// The same path driven so many times.
    ///
    /// # Errors
    /// [`PathError::NotClosed`] for several laps of a path that does not end where it starts.
    pub fn repeated(&self, laps: u32) -> Result<Self, PathError> {
        let (first, last) = (&self.points[0], &self.points[self.points.len() - 1]);
        if laps > 1 && (last.position - first.position).norm() > SAME_PLACE {
            return Err(PathError::NotClosed);
        }
        let lap = |lap: u32| {
            let driven = f64::from(lap) * self.length();
            self.points.iter().map(move |point| PathPoint { along: driven + point.along, ..*point })
        };
        Ok(Self::from_points((0..laps.max(1)).flat_map(lap).collect()))
    }

    /// Metres.
    pub fn length(&self) -> f64 {
        self.points[self.points.len() - 1].along
    }

    /// The points it is made of, about a centimetre apart.
    pub fn points(&self) -> &[PathPoint] {
        &self.points
    }

    /// Its parts between sharp corners, as ranges of [`points`](Self::points).
    pub fn sections(&self) -> &[Range<usize>] {
        &self.sections
    }

    /// The point at an arc length; beyond the ends, the ends.
    pub fn at(&self, along: f64) -> PathPoint {
        self.at_within(along, &(0..self.points.len()))
    }

    /// The point at an arc length within a range of [`points`](Self::points); beyond its ends, its ends.
    pub fn at_within(&self, along: f64, range: &Range<usize>) -> PathPoint {
        let points = &self.points[range.clone()];
        let after = points.partition_point(|point| point.along <= along);
        match after {
            0 => points[0],
            after if after == points.len() => points[after - 1],
            after => between(&points[after - 1], &points[after], along),
        }
    }

    /// The point nearest to `position` no further than `window` metres beyond the arc length `from`, within a range of
    /// [`points`](Self::points). Only ahead and only near, because a path that crosses itself is near itself elsewhere.
    pub fn closest(&self, position: &Point2<f64>, from: f64, window: f64, range: &Range<usize>) -> PathPoint {
        let points = &self.points[range.clone()];
        let first = points.partition_point(|point| point.along <= from).saturating_sub(1);
        let mut best = self.at_within(from, range);
        let mut least = (best.position - position).norm_squared();
        for pair in points[first..].windows(2).take_while(|pair| pair[0].along <= from + window) {
            let chord = pair[1].position - pair[0].position;
            let squared = chord.norm_squared();
            if squared == 0.0 {
                continue;
            }
            let share = ((position - pair[0].position).dot(&chord) / squared).clamp(0.0, 1.0);
            let along = pair[0].along + share * (pair[1].along - pair[0].along);
            let distance = (pair[0].position + chord * share - position).norm_squared();
            if distance < least && (from..=from + window).contains(&along) {
                least = distance;
                best = between(&pair[0], &pair[1], along);
            }
        }
        best
    }

    /// The point `distance` metres further on, or the end.
    pub fn look_ahead(&self, from: &PathPoint, distance: f64) -> PathPoint {
        self.at(from.along + distance)
    }
}

/// The point between two neighbours.
fn between(before: &PathPoint, after: &PathPoint, along: f64) -> PathPoint {
    let length = after.along - before.along;
    let share = if length > 0.0 { ((along - before.along) / length).clamp(0.0, 1.0) } else { 1.0 };
    PathPoint {
        along,
        position: before.position + (after.position - before.position) * share,
        heading: wrap_angle(before.heading + wrap_angle(after.heading - before.heading) * share),
        curvature: before.curvature + (after.curvature - before.curvature) * share,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::PlanarPose;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_corner_parts_a_path() {
        let path = Path::straight(&[Point2::new(0.0, 0.0), Point2::new(2.0, 0.0), Point2::new(2.0, 1.0)]).unwrap();
        assert_eq!((path.length(), path.sections().len()), (3.0, 2));
        assert_eq!(path.at(1.0).position, Point2::new(1.0, 0.0));
        assert_eq!(path.at(2.5).heading, FRAC_PI_2);
        assert_eq!(path.look_ahead(&path.at(2.5), 9.0).position, Point2::new(2.0, 1.0));
        // From the first section nothing is seen of the second, however near it is.
        let first = path.sections()[0].clone();
        let closest = path.closest(&Point2::new(2.1, 0.9), 1.5, 1.0, &first);
        assert_eq!((closest.position, closest.heading), (Point2::new(2.0, 0.0), 0.0));
    }

    #[test]
    fn a_crossing_path_is_searched_ahead_only() {
        let path = Path::figure_eight(&PlanarPose::default(), 2.0).unwrap();
        let all = 0..path.points().len();
        let crossing = Point2::new(0.01, 0.0);
        assert!(path.closest(&crossing, 0.0, 0.5, &all).along < 0.05);
        let half = path.length() / 2.0;
        assert!((path.closest(&crossing, half - 0.2, 0.5, &all).along - half).abs() < 0.05);
    }
}
