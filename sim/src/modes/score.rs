//! The switch's modes against the best ones.

use serde::Serialize;
use sunblind_estimator::{Mode, Timestamp};

use super::{StampedInformation, StampedReport};

/// About a change of the best mode no mode is right or wrong, seconds to each side.
const ABOUT_A_CHANGE: f64 = 1.0;
/// The switch should follow changes that last longer than this, seconds.
const LASTING: f64 = 2.0;

/// How well the modes were chosen. Times are those of the images: that they arrive later is not the switch's doing. What
/// can't be had (the latency of no change) is NaN, so that no bound on it holds, and `null` in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Score {
    /// Share of the time in which the mode was the best one, but for a second to each side of the best one's changes.
    pub accuracy_percent: f64,
    /// The longest that it took to follow the best mode where that changed for more than two seconds; where it was not
    /// followed at all, how long that change lasted.
    pub latency_s: f64,
    /// The mean of that.
    pub latency_mean_s: f64,
    /// How often the mode changed.
    pub switches: usize,
    /// How often the best one did.
    pub true_changes: usize,
    /// The longest time in a mode that rests on an image without information.
    pub useless_s: f64,
}

/// One instant: when, seconds; the mode; whether each of colour, infrared and depth holds something; the best mode.
#[derive(Clone, Copy, Debug)]
struct Moment {
    time: f64,
    mode: Mode,
    informed: [bool; 3],
    best: Mode,
}

/// Scores what the switch said; both in time order. `None` where nothing was said, or nothing is known.
pub fn score(said: &[StampedReport], truth: &[StampedInformation]) -> Option<Score> {
    let start = truth.first()?.time;
    let moments: Vec<Moment> = truth.iter().filter_map(|truth| moment(said, truth, start)).collect();
    (!moments.is_empty()).then(|| of(&moments))
}

/// When the mode changed: each time the instant of the first report with another one.
pub fn switches(said: &[StampedReport]) -> Vec<Timestamp> {
    said.windows(2).filter(|pair| pair[0].report.mode != pair[1].report.mode).map(|pair| pair[1].time).collect()
}

/// A mode stays until the next one is chosen; `None` before the first.
fn moment(
    said: &[StampedReport],
    StampedInformation { time, information }: &StampedInformation,
    start: Timestamp,
) -> Option<Moment> {
    let newest = said.partition_point(|report| report.time <= *time).checked_sub(1)?;
    let (mode, informed, best) = (said[newest].report.mode, information.informed(), information.best_mode());
    Some(Moment { time: time.since(start), mode, informed, best })
}

fn of(moments: &[Moment]) -> Score {
    let changes = changes_of(moments, |moment| moment.best);
    let latencies = latencies(moments);
    Score {
        accuracy_percent: accuracy(moments, &changes),
        latency_s: latencies.iter().copied().fold(f64::NAN, f64::max),
        latency_mean_s: latencies.iter().sum::<f64>() / latencies.len() as f64,
        switches: changes_of(moments, |moment| moment.mode).len(),
        true_changes: changes.len(),
        useless_s: useless(moments),
    }
}

/// The instants from which on it is another mode.
fn changes_of(moments: &[Moment], mode: impl Fn(&Moment) -> Mode) -> Vec<f64> {
    moments.windows(2).filter(|pair| mode(&pair[0]) != mode(&pair[1])).map(|pair| pair[1].time).collect()
}

fn accuracy(moments: &[Moment], changes: &[f64]) -> f64 {
    let is_judged = |moment: &&Moment| changes.iter().all(|change| (moment.time - change).abs() > ABOUT_A_CHANGE);
    let judged: Vec<_> = moments.iter().filter(is_judged).collect();
    let right = judged.iter().filter(|moment| moment.mode == moment.best).count();
    100.0 * right as f64 / judged.len() as f64
}

/// Of every change of the best mode that lasted.
fn latencies(moments: &[Moment]) -> Vec<f64> {
    let end = moments.last().map_or(0.0, |moment| moment.time);
    let stretches: Vec<&[Moment]> = moments.chunk_by(|one, next| one.best == next.best).collect();
    let mut latencies = Vec::new();
    for (index, stretch) in stretches.iter().enumerate().skip(1) {
        let since = stretch[0].time;
        let until = stretches.get(index + 1).map_or(end, |next| next[0].time);
        let followed = stretch.iter().find(|moment| moment.mode == moment.best).map_or(until, |moment| moment.time);
        if until - since > LASTING {
            latencies.push(followed - since);
        }
    }
    latencies
}

fn useless(moments: &[Moment]) -> f64 {
    let mut longest = 0.0;
    let mut since: Option<f64> = None;
    for moment in moments {
        let before = since;
        since = (!is_of_use(moment.mode, moment.informed)).then(|| before.unwrap_or(moment.time));
        longest = f64::max(longest, before.map_or(0.0, |since| moment.time - since));
    }
    longest
}

/// Whether all images that a mode rests on hold something.
fn is_of_use(mode: Mode, [rgb, infrared, depth]: [bool; 3]) -> bool {
    match mode {
        Mode::Indoor => rgb && depth,
        Mode::Outdoor => rgb && infrared,
        Mode::Night => infrared && depth,
        Mode::Odometer => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::Information;

    /// A frame every tenth of a second.
    fn moments(length: f64, mode: impl Fn(f64) -> Mode, informed: impl Fn(f64) -> [bool; 3]) -> Vec<Moment> {
        let moment = |tenth: u32| {
            let time = f64::from(tenth) / 10.0;
            let informed = informed(time);
            let as_share = |is: bool| f64::from(u8::from(is));
            let [rgb, infrared, depth] = informed.map(as_share);
            Moment { time, mode: mode(time), informed, best: Information { rgb, infrared, depth }.best_mode() }
        };
        (0..(10.0 * length) as u32).map(moment).collect()
    }

    /// The lamps go out after 10 s and on again after 20.
    fn lamps(time: f64) -> [bool; 3] {
        [!(10.0..20.0).contains(&time), true, true]
    }

    fn close(value: f64, expected: f64) -> bool {
        (value - expected).abs() < 1e-6
    }

    #[test]
    fn a_switch_that_follows_is_as_late_as_its_dwell() {
        let late = |time: f64| if (10.35..20.35).contains(&time) { Mode::Night } else { Mode::Indoor };
        let score = of(&moments(30.0, late, lamps));
        assert!(close(score.accuracy_percent, 100.0) && close(score.latency_s, 0.4), "{score:?}");
        assert!(close(score.latency_mean_s, 0.4) && close(score.useless_s, 0.4), "{score:?}");
        assert_eq!((score.switches, score.true_changes), (2, 2));
    }

    #[test]
    fn one_that_stays_is_wrong_for_as_long_as_the_change_lasts() {
        let score = of(&moments(30.0, |_| Mode::Indoor, lamps));
        // Of 10 s in the dark 8 are judged, of 20 s in the light 18, each but for a frame at either end.
        assert!((68.0..71.0).contains(&score.accuracy_percent), "{score:?}");
        assert!(close(score.latency_s, 10.0) && close(score.latency_mean_s, 5.0), "{score:?}");
        assert!(close(score.useless_s, 10.0));
        assert_eq!((score.switches, score.true_changes), (0, 2));
    }

    #[test]
    fn what_does_not_last_need_not_be_followed() {
        let hand = |time: f64| [!(10.0..11.5).contains(&time); 3];
        let score = of(&moments(30.0, |_| Mode::Indoor, hand));
        // Its end is a change that lasts, and the switch is there already.
        assert!(close(score.latency_s, 0.0) && close(score.accuracy_percent, 100.0), "{score:?}");
        assert!(close(score.useless_s, 1.5), "in a mode without images");
    }

    #[test]
    fn wheels_are_never_useless_but_seldom_the_best() {
        let score = of(&moments(10.0, |_| Mode::Odometer, |_| [true; 3]));
        assert_eq!((score.accuracy_percent, score.useless_s), (0.0, 0.0));
        assert!(score.latency_s.is_nan() && score.latency_mean_s.is_nan(), "nothing changed");
    }

    #[test]
    fn nothing_said_or_known_is_no_score() {
        assert_eq!(score(&[], &[]), None);
    }
}
