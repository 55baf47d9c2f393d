//! The paper's §7.1: the robot goes by its own filter.

use std::fmt::Write;

use crate::evaluation::{Evaluation, Tracking, evaluate};
use crate::runner::log::RunLog;

/// What a drive gave that was steered by the robot's own MVO-EKF pose.
pub struct OwnPose {
    /// Length of the path, metres.
    planned: f64,
    /// Of it driven, metres.
    driven: f64,
    tracking: Tracking,
    ekf: Evaluation,
}

impl OwnPose {
    /// `None` for a log without truth or path.
    pub fn of(log: &RunLog) -> Option<Self> {
        let piece = |piece: &[[f64; 2]]| (piece[1][0] - piece[0][0]).hypot(piece[1][1] - piece[0][1]);
        Some(Self {
            planned: log.planned_path.windows(2).map(piece).sum(),
            driven: log.facts.as_ref()?.path,
            tracking: Tracking::of(&log.truth, &log.planned_path)?,
            ekf: evaluate(&log.track("ekf")?.frames, &log.truth)?,
        })
    }

    /// Its part of the page.
    pub fn section(&self) -> String {
        let Self { planned, driven, tracking, ekf } = self;
        let mut section = String::from(
            "\n## Driven by its own EKF\n\nThe paper's §7.1: a quarter of the way at twice the pace, seed 1, steered by the \
             robot's own MVO-EKF pose through doors of 0.9 m.\n\n| | |\n|---|--:|\n",
        );
        let rows = [
            ("way gone, m (path)", format!("{driven:.1} ({planned:.1})")),
            ("off the path, RMS, m", format!("{:.3}", tracking.rms)),
            ("off the path, largest, m", format!("{:.3}", tracking.max)),
            ("MVO-EKF's RMSE, x, m", format!("{:.3}", ekf.rmse_x_m)),
            ("MVO-EKF's RMSE, y, m", format!("{:.3}", ekf.rmse_y_m)),
            ("MVO-EKF's RMSE, heading, °", format!("{:.3}", ekf.rmse_theta_deg)),
            ("MVO-EKF's drift, %", format!("{:.2}", ekf.drift_percent)),
        ];
        for (what, value) in rows {
            let _ = writeln!(section, "| {what} | {value} |");
        }
        section
    }
}
