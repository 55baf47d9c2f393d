//! How long the parts of the work took.

use serde::Serialize;

use crate::runner::log::Track;

/// The stages in the order of `FrameLog::stage_ms`.
pub(super) const STAGES: [&str; 4] = ["registration", "features", "matching", "motion"];

/// Of one stage over all frames.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct StageTime {
    pub median_ms: f64,
    /// 95th percentile.
    pub p95_ms: f64,
}

/// Of one track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Timing {
    pub stages: [StageTime; 4],
    pub total: StageTime,
    /// Mean time a frame, milliseconds.
    pub mean_ms: f64,
}

impl Timing {
    /// `None` when nobody held a clock to the track.
    pub(super) fn of(track: &Track) -> Option<Self> {
        let totals: Vec<f64> = track.frames.iter().map(|frame| frame.stage_ms.iter().sum()).collect();
        let sum: f64 = totals.iter().sum();
        (sum > 0.0).then(|| Self {
            stages: std::array::from_fn(|stage| {
                stage_time(track.frames.iter().map(|frame| frame.stage_ms[stage]).collect())
            }),
            mean_ms: sum / totals.len() as f64,
            total: stage_time(totals),
        })
    }
}

fn stage_time(mut times_ms: Vec<f64>) -> StageTime {
    times_ms.sort_by(f64::total_cmp);
    StageTime { median_ms: quantile(&times_ms, 0.5), p95_ms: quantile(&times_ms, 0.95) }
}

/// The value of `sorted` that the share `share` of all don't exceed (nearest rank). Panics on nothing.
pub(super) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted[rank.clamp(1, sorted.len()) - 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_that_occurred() {
        let hundred: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(quantile(&hundred, 0.5), 50.0);
        assert_eq!(quantile(&hundred, 0.95), 95.0);
        assert_eq!(quantile(&[7.0], 0.95), 7.0);
    }
}
