//! How well a robot kept to the path that it was to drive.

use nalgebra::Vector2;

use super::{StampedPose, root_mean_square};

/// Distances of the true positions from the planned path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tracking {
    /// Root mean square, metres.
    pub rms: f64,
    /// The largest, metres.
    pub max: f64,
}

impl Tracking {
    /// `path`: x and y of points on it in the world, metres, straight in between. `None` without truth, or without a path.
    pub fn of(truth: &[StampedPose], path: &[[f64; 2]]) -> Option<Self> {
        let distance = |pose: &StampedPose| distance(&pose.world_from_body.translation.vector.xy(), path);
        let distances: Vec<f64> = truth.iter().map(distance).collect::<Option<_>>()?;
        let max = distances.iter().copied().reduce(f64::max)?;
        Some(Self { rms: root_mean_square(distances.into_iter()), max })
    }
}

/// From a point to the nearest of all pieces.
fn distance(from: &Vector2<f64>, path: &[[f64; 2]]) -> Option<f64> {
    let to_piece = |piece: &[[f64; 2]]| {
        let (start, along) = (Vector2::from(piece[0]), Vector2::from(piece[1]) - Vector2::from(piece[0]));
        let share = ((from - start).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (start + along * share - from).norm()
    };
    path.windows(2).map(to_piece).reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;
    use sunblind_estimator::Timestamp;

    use super::*;

    #[test]
    fn the_nearest_piece_counts_and_its_ends_belong_to_it() {
        let path = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        let at =
            |x, y| StampedPose { time: Timestamp::from_nanos(0), world_from_body: Isometry3::translation(x, y, 0.3) };
        // Beside the first piece, on the second, beyond its end.
        let found = Tracking::of(&[at(1.0, 0.3), at(2.0, 1.0), at(2.0, 2.4)], &path).unwrap();
        assert!((found.max - 0.4).abs() < 1e-12 && (found.rms - 0.5 / 3.0_f64.sqrt()).abs() < 1e-12, "{found:?}");
        assert_eq!(Tracking::of(&[], &path), None);
        assert_eq!(Tracking::of(&[at(0.0, 0.0)], &path[..1]), None);
    }
}
