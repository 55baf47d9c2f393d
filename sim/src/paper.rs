//! What the first paper's experiments gave its authors, and what they give here: tables side by side.

use std::fmt::Write;

use sunblind_estimator::Mode;

use crate::evaluation::{Evaluation, drift_in_mode, evaluate};
use crate::runner::log::{RunLog, Track};

/// Tracks in the order of the paper's Table 4, and what it calls them.
const COLUMNS: [(&str, &str); 4] = [("odometry", "odometry"), ("mvo", "MVO"), ("ekf", "MVO-EKF"), ("svsf", "MVO-SVSF")];
/// Table 4: RMSE of x and y, metres, and of the heading, degrees.
const TABLE_4: [[f64; 4]; 3] = [[1.08, 0.60, 0.095, 0.082], [0.60, 0.80, 0.30, 0.25], [0.90, 0.60, 0.80, 0.80]];
/// Table 5: error as a share of the way gone, percent.
const TABLE_5: [(&str, f64); 5] = [
    ("the paper, MVO-SVSF", 3.30),
    ("Beauvisage: visible, thermal and GPS, outdoors", 6.87),
    ("Mouats: visible and thermal stereo, outdoors", 8.50),
    ("Chaib: Kinect, indoors", 6.33),
    ("Anoosheh: at night", 9.10),
];
/// Milliseconds a frame.
const PAPER_MS: f64 = 64.86;
/// What visual odometry alone may drift by in each mode, percent.
const MODES: [(Mode, &str, f64); 3] =
    [(Mode::Indoor, "indoor", 1.5), (Mode::Outdoor, "outdoor", 4.0), (Mode::Night, "night", 2.0)];

/// What one run of experiment 1 gave.
pub struct Outcome {
    /// Of the run's random numbers.
    pub seed: u64,
    path: f64,
    duration: f64,
    /// In the order of [`COLUMNS`].
    tracks: Vec<Evaluation>,
    /// Of visual odometry alone, in the order of [`MODES`], percent; NaN where the mode never was.
    drift_by_mode: Vec<f64>,
    /// Of visual odometry, CPU.
    ms_per_frame: f64,
}

impl Outcome {
    /// `None` for a log without the four tracks, or without truth.
    pub fn of(log: &RunLog) -> Option<Self> {
        let track = |name: &str| log.tracks.iter().find(|track| track.name == name);
        let evaluated = |(name, _): &(&str, &str)| evaluate(&track(name)?.frames, &log.truth);
        let facts = log.facts.as_ref()?;
        let Track { frames, .. } = track("mvo")?;
        Some(Self {
            seed: facts.seed,
            path: facts.path,
            duration: facts.duration,
            tracks: COLUMNS.iter().map(evaluated).collect::<Option<_>>()?,
            drift_by_mode: MODES.iter().map(|(mode, _, _)| drift_in_mode(frames, &log.truth, *mode)).collect(),
            ms_per_frame: frames.iter().flat_map(|frame| frame.stage_ms).sum::<f64>() / frames.len().max(1) as f64,
        })
    }

    /// RMSE of x, y and heading.
    fn rmse(&self, row: usize, column: usize) -> f64 {
        let Evaluation { rmse_x_m, rmse_y_m, rmse_theta_deg, .. } = self.tracks[column];
        [rmse_x_m, rmse_y_m, rmse_theta_deg][row]
    }

    /// RMSE of the position.
    fn position(&self, column: usize) -> f64 {
        self.rmse(0, column).hypot(self.rmse(1, column))
    }
}

/// A figure that was aimed at.
pub struct Goal {
    what: String,
    measured: f64,
    most: f64,
}

impl Goal {
    /// Whether it was reached.
    pub fn held(&self) -> bool {
        self.measured <= self.most
    }
}

/// What was aimed at, by the means over the runs.
pub fn goals(outcomes: &[Outcome]) -> Vec<Goal> {
    let goal = |what: &str, most: f64, of: &dyn Fn(&Outcome) -> f64| Goal {
        what: what.into(),
        measured: mean(outcomes.iter().map(of)),
        most,
    };
    let [odometry, mvo, svsf] = [0, 1, 3];
    let mut goals = vec![
        goal("MVO-SVSF's drift, % (paper 3.30)", 1.0, &|outcome| outcome.tracks[svsf].drift_percent),
        goal("position, MVO-SVSF's RMSE by odometry's", 0.2, &|o| o.position(svsf) / o.position(odometry)),
        goal("position, MVO-SVSF's RMSE by MVO's", 0.5, &|o| o.position(svsf) / o.position(mvo)),
    ];
    for (index, (_, name, most)) in MODES.iter().enumerate() {
        goals.push(goal(&format!("MVO alone, drift, %, {name}"), *most, &|o| o.drift_by_mode[index]));
    }
    goals.push(goal("CPU a frame, ms (paper 64.86)", PAPER_MS, &|outcome| outcome.ms_per_frame));
    goals
}

/// The page. `form`: what was driven, in words.
pub fn page(outcomes: &[Outcome], form: &str) -> String {
    let (path, duration) = (mean(outcomes.iter().map(|o| o.path)), mean(outcomes.iter().map(|o| o.duration)));
    let seeds: Vec<String> = outcomes.iter().map(|outcome| outcome.seed.to_string()).collect();
    let mut page = format!(
        "# The first paper's experiments, there and here\n\n\
         Experiment 1, {form}: one drive through lamplight, sun and darkness, {path:.1} m in {duration:.0} s, seed{} {}. A \
         person steers. The paper says neither how long its way was nor how it slipped: its metres are another \
         way's. Of several runs the mean, and from the least to the largest. Made by `sunblind paper a`.\n\n## Table 4: RMSE\n\n",
        if seeds.len() == 1 { "" } else { "s" },
        seeds.join(", ")
    );
    let names = COLUMNS.map(|(_, name)| format!("{name}, paper | here"));
    let _ = writeln!(page, "| | {} |\n|---|{}", names.join(" | "), "--:|".repeat(2 * COLUMNS.len()));
    for (row, name) in ["x, m", "y, m", "heading, °"].into_iter().enumerate() {
        let cells: Vec<String> = (0..COLUMNS.len())
            .map(|column| {
                format!("{} | {}", TABLE_4[row][column], spread(outcomes.iter().map(|o| o.rmse(row, column))))
            })
            .collect();
        let _ = writeln!(page, "| {name} | {} |", cells.join(" | "));
    }
    let _ = write!(page, "\n## Table 5: error by the way gone\n\n| | % |\n|---|--:|\n");
    for (who, percent) in TABLE_5 {
        let _ = writeln!(page, "| {who} | {percent:.2} |");
    }
    for (column, (_, name)) in COLUMNS.iter().enumerate() {
        let drift = spread(outcomes.iter().map(|outcome| outcome.tracks[column].drift_percent));
        let _ = writeln!(page, "| here, {name} | {drift} |");
    }
    let _ = write!(page, "\n## Goals\n\n| | at most | measured | |\n|---|--:|--:|---|\n");
    for goal in goals(outcomes) {
        let verdict = if goal.held() { "held" } else { "**missed**" };
        let _ = writeln!(page, "| {} | {} | {:.2} | {verdict} |", goal.what, goal.most, goal.measured);
    }
    page
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The mean, and with several values the least and the largest.
fn spread(values: impl ExactSizeIterator<Item = f64> + Clone) -> String {
    let mean = mean(values.clone());
    if values.len() == 1 {
        return format!("{mean:.3}");
    }
    let (least, largest) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
    format!("{mean:.3} ({least:.3}–{largest:.3})")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(seed: u64, scale: f64) -> Outcome {
        let evaluation = |rmse: f64| Evaluation {
            rmse_x_m: 3.0 * rmse,
            rmse_y_m: 4.0 * rmse,
            rmse_theta_deg: rmse,
            ate_m: rmse,
            rpe_delta_frames: 15,
            rpe_m: rmse,
            rpe_deg: rmse,
            rpe_frame_m: rmse,
            rpe_frame_deg: rmse,
            drift_percent: rmse,
            end_error_m: rmse,
            anees: 30.0 * rmse,
            path_m: 100.0,
        };
        Outcome {
            seed,
            path: 100.0,
            duration: 1000.0,
            tracks: [1.0, 0.5, 0.2, 0.1 * scale].map(evaluation).into(),
            drift_by_mode: vec![1.0, f64::NAN, 1.0],
            ms_per_frame: 30.0,
        }
    }

    #[test]
    fn a_goal_is_held_by_the_mean_and_what_never_was_is_missed() {
        let goals = goals(&[outcome(1, 1.0), outcome(2, 2.0)]);
        let verdict = |what: &str| goals.iter().find(|goal| goal.what.contains(what)).expect(what).held();
        assert!(verdict("by odometry's") && verdict("by MVO's") && verdict("indoor") && verdict("SVSF's drift"));
        assert!(!verdict("outdoor"), "no mean of nothing");
        assert!((goals[1].measured - 0.15).abs() < 1e-12);
    }

    #[test]
    fn the_page_has_both_sides_of_each_table() {
        let page = page(&[outcome(1, 1.0), outcome(2, 2.0)], "in full");
        assert!(page.contains("| x, m | 1.08 | 3.000 (3.000–3.000) | 0.6 |"), "{page}");
        assert!(page.contains("| 0.082 | 0.450 (0.300–0.600) |"), "{page}");
        assert!(page.contains("seeds 1, 2") && page.contains("Beauvisage") && page.contains("**missed**"), "{page}");
    }
}
