//! `[[expect]]`: what must hold at the end of a run.
//!
//! ```toml
//! [[expect]]
//! metric = "svsf.ate_m"
//! relative_to = "odometry.ate_m"   # optional: the ratio of the two is what is bounded
//! max = 0.5                        # in the metric's unit; or min, or both
//! ```

use std::collections::BTreeMap;
use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Fault;
use super::error::nearest;
use crate::evaluation::{Corrections, Evaluation};
use crate::modes::Score;

/// The estimates that a run with wheels gives; the last one if the scenario wants it.
const ESTIMATES: [&str; 5] = ["odometry", "mvo", "ekf", "svsf", "odometry_no_gyro"];
/// What is measured of each, as in [`Evaluation`].
const MEASURED: [&str; 11] = [
    "rmse_x_m",
    "rmse_y_m",
    "rmse_theta_deg",
    "ate_m",
    "rpe_m",
    "rpe_deg",
    "rpe_frame_m",
    "rpe_frame_deg",
    "drift_percent",
    "end_error_m",
    "anees",
];
/// What is measured of the fused ones beside, as in [`Corrections`].
const OF_THE_FUSED: [&str; 4] =
    ["max_correction_m", "max_correction_deg", "switch_correction_m", "switch_correction_deg"];
/// Which these are.
const FUSED: [&str; 2] = ["ekf", "svsf"];
/// What is measured of the run, as in `summary.json`.
const OF_THE_RUN: [&str; 3] = ["path_m", "duration_s", "frames"];
/// What is measured of the images, as in `summary.json`: the mean share of depth pixels with a value, mean energies.
pub const OF_THE_SENSOR: [&str; 4] =
    ["sensor.depth_valid_share", "sensor.energies.rgb", "sensor.energies.infrared", "sensor.energies.depth"];

/// What is measured of the mode switch, as in `summary.json` and [`Score`].
const OF_THE_MODES: [&str; 6] = [
    "modes.accuracy_percent",
    "modes.latency_s",
    "modes.latency_mean_s",
    "modes.switches",
    "modes.true_changes",
    "modes.useless_s",
];

/// Measured values by their keys: `svsf.ate_m`, `path_m`.
pub type Metrics = BTreeMap<String, f64>;

/// A bound on a metric, or on the ratio of two. It does not hold for what could not be measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Its key as in summary.json: an estimate, a dot, what is measured of it; or a value of the whole run, of its
    /// images or of its modes.
    pub metric: String,
    /// Another metric that it is divided by.
    pub relative_to: Option<String>,
    /// The smallest value that will do, in the metric's unit.
    pub min: Option<f64>,
    /// The largest value that will do, in the metric's unit.
    pub max: Option<f64>,
}

/// An expectation and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// The metric, or the two that are divided.
    pub name: String,
    /// What was measured; NaN where it could not be.
    pub value: f64,
    /// What would do.
    pub bound: Bound,
    /// Whether the value is within.
    pub held: bool,
}

/// What a value is held against; both ends belong to it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// The smallest that will do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// The largest that will do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
}

impl Bound {
    /// Whether a value is within.
    pub fn holds(&self, value: f64) -> bool {
        value.is_finite() && self.min.is_none_or(|min| value >= min) && self.max.is_none_or(|max| value <= max)
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.min, self.max) {
            (Some(min), Some(max)) => write!(out, "{min} to {max}"),
            (Some(min), None) => write!(out, "at least {min}"),
            (None, Some(max)) => write!(out, "at most {max}"),
            (None, None) => out.write_str("anything"),
        }
    }
}

/// Holds each expectation against what was measured, in their order.
pub fn judge(expectations: &[Expectation], metrics: &Metrics) -> Vec<Judged> {
    let value = |key: &str| metrics.get(key).copied().unwrap_or(f64::NAN);
    let judged = |expectation: &Expectation| {
        let Expectation { metric, relative_to, min, max } = expectation;
        let bound = Bound { min: *min, max: *max };
        let (name, value) = match relative_to {
            Some(other) => (format!("{metric} / {other}"), value(metric) / value(other)),
            None => (metric.clone(), value(metric)),
        };
        Judged { name, value, bound, held: bound.holds(value) }
    };
    expectations.iter().map(judged).collect()
}

/// The metrics of some estimates. Those of the whole run are for the caller to add.
pub fn metrics<'a>(evaluations: impl IntoIterator<Item = (&'a str, &'a Evaluation)>) -> Metrics {
    evaluations.into_iter().flat_map(|(estimate, evaluation)| numbers(estimate, evaluation, &MEASURED)).collect()
}

/// The metrics of how the fused estimates were corrected.
pub fn of_corrections<'a>(corrections: impl IntoIterator<Item = (&'a str, Corrections)>) -> Metrics {
    corrections.into_iter().flat_map(|(estimate, corrections)| numbers(estimate, &corrections, &OF_THE_FUSED)).collect()
}

/// Some of a struct's numbers as metrics of an estimate. A value that could not be measured is null, and absent here.
fn numbers(estimate: &str, measured: &impl Serialize, keys: &[&str]) -> Metrics {
    let values = serde_json::to_value(measured).expect("measured are plain numbers");
    let number = |key: &&str| Some((format!("{estimate}.{key}"), values.get(key)?.as_f64()?));
    keys.iter().filter_map(number).collect()
}

/// The metrics of the mode switch.
pub fn of_the_modes(score: &Score) -> Metrics {
    let Score { accuracy_percent, latency_s, latency_mean_s, switches, true_changes, useless_s } = *score;
    let values = [accuracy_percent, latency_s, latency_mean_s, switches as f64, true_changes as f64, useless_s];
    OF_THE_MODES.map(str::to_owned).into_iter().zip(values).filter(|(_, value)| value.is_finite()).collect()
}

impl Expectation {
    /// A fault's key is relative to the expectation.
    pub(super) fn check(&self) -> Result<(), Fault> {
        check_metric("metric", &self.metric)?;
        if let Some(other) = &self.relative_to {
            check_metric("relative_to", other)?;
        }
        for (key, bound) in [("min", self.min), ("max", self.max)] {
            if bound.is_some_and(|bound| !bound.is_finite()) {
                return Err(Fault::new(key, format!("{key} must be a finite number; delete it if there is no bound")));
            }
        }
        match (self.min, self.max) {
            (None, None) => Err(Fault::new("metric", "nothing is expected of it; write max = …, min = … or both")),
            (Some(min), Some(max)) if min > max => {
                Err(Fault::new("min", format!("no value is at least {min} and at most {max}; exchange min and max")))
            }
            _ => Ok(()),
        }
    }
}

fn check_metric(key: &str, metric: &str) -> Result<(), Fault> {
    let of = |estimates: &[&str], measured: &[&str]| -> Vec<String> {
        estimates.iter().flat_map(|estimate| measured.iter().map(move |key| format!("{estimate}.{key}"))).collect()
    };
    let known: Vec<String> = [of(&ESTIMATES, &MEASURED), of(&FUSED, &OF_THE_FUSED)]
        .concat()
        .into_iter()
        .chain([&OF_THE_RUN[..], &OF_THE_SENSOR, &OF_THE_MODES].concat().into_iter().map(str::to_owned))
        .collect();
    if known.iter().any(|known| known == metric) {
        return Ok(());
    }
    let nearest = nearest(metric, known.iter().map(String::as_str)).unwrap_or_default();
    Err(Fault::new(key, format!("unknown metric `{metric}`; did you mean `{nearest}`?")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expectation(metric: &str, relative_to: Option<&str>, min: Option<f64>, max: Option<f64>) -> Expectation {
        Expectation { metric: metric.into(), relative_to: relative_to.map(str::to_owned), min, max }
    }

    fn held(expectation: Expectation) -> bool {
        let metrics = [("svsf.ate_m", 0.1), ("odometry.ate_m", 0.4), ("mvo.ate_m", 0.0), ("ekf.ate_m", f64::NAN)];
        let metrics = metrics.map(|(key, value)| (key.to_owned(), value)).into();
        judge(&[expectation], &metrics)[0].held
    }

    #[test]
    fn a_bound_belongs_to_what_it_allows() {
        assert!(held(expectation("svsf.ate_m", None, None, Some(0.1))));
        assert!(held(expectation("svsf.ate_m", None, Some(0.1), None)));
        assert!(!held(expectation("svsf.ate_m", None, None, Some(0.099))));
        assert!(!held(expectation("svsf.ate_m", None, Some(0.2), Some(0.3))));
    }

    #[test]
    fn a_ratio_is_of_two_metrics() {
        let judged = expectation("svsf.ate_m", Some("odometry.ate_m"), None, Some(0.5));
        assert!(held(judged.clone()));
        assert!(!held(expectation("odometry.ate_m", Some("svsf.ate_m"), None, Some(0.5))));
        let judged = &judge(&[judged], &Metrics::new())[0];
        assert_eq!(
            (judged.name.as_str(), judged.bound.to_string()),
            ("svsf.ate_m / odometry.ate_m", "at most 0.5".into())
        );
    }

    #[test]
    fn what_could_not_be_measured_never_holds() {
        for metric in ["ekf.ate_m", "svsf.rpe_m"] {
            assert!(!held(expectation(metric, None, Some(-1e300), Some(1e300))), "{metric}");
            assert!(!held(expectation(metric, None, None, None)), "{metric}");
        }
        // Zero by zero, and something by zero.
        for metric in ["mvo.ate_m", "svsf.ate_m"] {
            assert!(!held(expectation(metric, Some("mvo.ate_m"), Some(0.0), None)), "{metric}");
        }
    }

    #[test]
    fn every_metric_of_an_estimate_is_measured() {
        let evaluation = Evaluation {
            rmse_x_m: 1.0,
            rmse_y_m: 2.0,
            rmse_theta_deg: 3.0,
            ate_m: 4.0,
            rpe_delta_frames: 15,
            rpe_m: 5.0,
            rpe_deg: 6.0,
            rpe_frame_m: 7.0,
            rpe_frame_deg: 8.0,
            drift_percent: f64::NAN,
            end_error_m: 10.0,
            anees: 3.0,
            path_m: 11.0,
        };
        let metrics = metrics([("svsf", &evaluation)]);
        assert_eq!(metrics.len(), MEASURED.len() - 1, "all but what is NaN");
        assert_eq!(metrics["svsf.end_error_m"], 10.0);
        let json = serde_json::to_value(judge(&[expectation("svsf.drift_percent", None, None, Some(1.5))], &metrics));
        let expected = serde_json::json!([{ "name": "svsf.drift_percent", "value": null, "bound": { "max": 1.5 }, "held": false }]);
        assert_eq!(json.unwrap(), expected);
    }

    #[test]
    fn every_correction_is_measured_of_what_is_fused() {
        let corrections = Corrections {
            max_correction_m: 0.03,
            max_correction_deg: 2.0,
            switch_correction_m: 0.01,
            switch_correction_deg: f64::NAN,
        };
        let metrics = of_corrections([("ekf", corrections)]);
        assert_eq!(metrics.len(), OF_THE_FUSED.len() - 1, "all but what is NaN");
        assert_eq!(metrics["ekf.max_correction_deg"], 2.0);
        for key in metrics.keys() {
            expectation(key, None, None, Some(1.0)).check().unwrap();
        }
        let of_wheels = expectation("odometry.max_correction_m", None, None, Some(1.0)).check();
        assert!(of_wheels.unwrap_err().problem.contains("did you mean"));
    }

    #[test]
    fn every_metric_of_the_modes_is_measured_and_may_be_expected() {
        let score = Score {
            accuracy_percent: 99.0,
            latency_s: 0.4,
            latency_mean_s: f64::NAN,
            switches: 3,
            true_changes: 4,
            useless_s: 0.5,
        };
        let metrics = of_the_modes(&score);
        assert_eq!(metrics.len(), OF_THE_MODES.len() - 1, "all but what is NaN");
        let in_summary = serde_json::to_value(score).unwrap();
        for (key, value) in &metrics {
            assert_eq!(in_summary[key.strip_prefix("modes.").unwrap()].as_f64(), Some(*value), "{key}");
            expectation(key, None, None, Some(1.0)).check().unwrap();
        }
        let ratio = expectation("modes.switches", Some("modes.true_changes"), None, Some(0.75));
        assert!(judge(&[ratio], &metrics)[0].held);
    }

    #[test]
    fn an_expectation_that_means_nothing_is_refused() {
        let problem = |expectation: Expectation| expectation.check().unwrap_err().problem;
        assert!(problem(expectation("svfs.ate_m", None, None, Some(1.0))).contains("did you mean `svsf.ate_m`?"));
        assert!(problem(expectation("svsf.ate_m", Some("odometry.ate"), None, Some(1.0))).contains("`odometry.ate_m`"));
        assert!(problem(expectation("svsf.ate_m", None, None, None)).contains("max = "));
        assert!(problem(expectation("svsf.ate_m", None, Some(2.0), Some(1.0))).contains("exchange"));
        assert!(problem(expectation("svsf.ate_m", None, None, Some(f64::NAN))).contains("finite"));
    }
}
