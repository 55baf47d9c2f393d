//! The result in one sentence.

use sunblind_estimator::Health;

use super::format::{duration, length};
use super::judged::{Judged, tracked_frames};

/// What a reader wants to know first: how much was tracked, over how much, how well.
pub(super) fn headline(judged: &Judged) -> String {
    let (tracked, frames) = (tracked_frames(judged.track), judged.track.frames.len());
    if frames == 0 {
        return "The recording has no frames.".into();
    }
    if tracked == 0 {
        let reason = judged.track.frames.iter().find_map(|frame| match frame.health {
            Health::Lost(failure) => Some(format!(" The first was lost because of {failure}.")),
            Health::Initialising | Health::Good => None,
        });
        return format!("Tracked none of {frames} frames.{}", reason.unwrap_or_default());
    }
    let tracked = format!("Tracked {tracked} of {frames} frames");
    match judged.evaluation() {
        Some(evaluation) => format!(
            "{tracked} over {}: typically {} from the true path once aligned, {} off at the end.",
            length(evaluation.path_m),
            length(evaluation.ate_m),
            length(evaluation.end_error_m),
        ),
        None if judged.log.truth.is_empty() => format!(
            "{tracked} in {}, a path of {} by its own account; the recording has no truth to compare with.",
            duration(judged.duration()),
            length(judged.path()),
        ),
        None => format!("{tracked}; too few of them have truth to compare with."),
    }
}
