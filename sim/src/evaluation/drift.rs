//! Drift as a share of the way gone.

use super::{PosePair, relative_error, translation};

/// The sub-paths' lengths, metres: KITTI's idea (100–800 m for a car) at the lengths that a robot drives.
const SUB_PATHS: [f64; 5] = [5.0, 10.0, 20.0, 50.0, 100.0];

/// The length of the true path from the first pair to each, metres.
pub(super) fn path_lengths(pairs: &[PosePair]) -> Vec<f64> {
    let steps =
        pairs.windows(2).map(|pair| (pair[1].truth.translation.vector - pair[0].truth.translation.vector).norm());
    std::iter::once(0.0)
        .chain(steps.scan(0.0, |length, step| {
            *length += step;
            Some(*length)
        }))
        .collect()
}

/// Mean of translation error / true length over the sub-paths from every frame to the first that lies each length
/// further on; over the whole path where it is shorter than all. NaN when the truth never moves.
pub(super) fn mean_drift(pairs: &[PosePair], lengths: &[f64]) -> f64 {
    let drift =
        |from: usize, to: usize| translation(&relative_error(&pairs[from], &pairs[to])) / (lengths[to] - lengths[from]);
    let (mut sum, mut count) = (0.0, 0);
    for sub_path in SUB_PATHS {
        for from in 0..pairs.len() {
            let to = lengths.partition_point(|&length| length < lengths[from] + sub_path);
            if to == pairs.len() {
                break;
            }
            sum += drift(from, to);
            count += 1;
        }
    }
    match count {
        0 if lengths.last() == Some(&0.0) => f64::NAN,
        0 => drift(0, pairs.len() - 1),
        _ => sum / f64::from(count),
    }
}
