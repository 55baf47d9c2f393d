//! The paper's experiment 2: wheels against visual odometry over a large area, indoors and outdoors.

use std::fmt::Write;

use crate::evaluation::{Evaluation, evaluate};
use crate::runner::log::RunLog;

/// What is compared, and what the paper calls it.
const COLUMNS: [(&str, &str); 2] = [("odometry", "odometry"), ("mvo", "MVO")];

/// What a run of experiment 2 gave.
pub struct Experiment2 {
    path: f64,
    duration: f64,
    /// In the order of [`COLUMNS`].
    tracks: Vec<Evaluation>,
}

impl Experiment2 {
    /// `None` for a log without the two tracks, or without truth.
    pub fn of(log: &RunLog) -> Option<Self> {
        let facts = log.facts.as_ref()?;
        let evaluated = |(name, _): &(&str, &str)| evaluate(&log.track(name)?.frames, &log.truth);
        let tracks = COLUMNS.iter().map(evaluated).collect::<Option<_>>()?;
        Some(Self { path: facts.path, duration: facts.duration, tracks })
    }

    /// Its part of the page. `form`: what was driven, in words.
    pub fn section(&self, form: &str) -> String {
        let mut section = format!(
            "\n## Experiment 2: wheels and visual odometry\n\n{form}: {:.1} m in {:.0} s at noon, seed 1, without a gyro.\n\n\
             | RMSE | x, m | y, m | heading, ° | drift, % |\n|---|--:|--:|--:|--:|\n",
            self.path, self.duration
        );
        for ((_, name), of) in COLUMNS.iter().zip(&self.tracks) {
            let Evaluation { rmse_x_m, rmse_y_m, rmse_theta_deg, drift_percent, .. } = of;
            let _ = writeln!(
                section,
                "| {name} | {rmse_x_m:.3} | {rmse_y_m:.3} | {rmse_theta_deg:.3} | {drift_percent:.2} |"
            );
        }
        section
    }
}
