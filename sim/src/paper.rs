//! What the first paper's experiments gave its authors, and what they give here: tables side by side.

mod board;
mod corner;
mod experiment_2;
mod interval;
mod own_pose;
mod table_1;

use std::fmt::Write;

use sunblind_estimator::Mode;

use crate::evaluation::{Corrections, Evaluation, drift_in_mode, evaluate};
use crate::runner::log::{RunLog, Track};
use crate::scenario::expect::Bound;
use interval::{mean, mean_and_interval};

pub use experiment_2::Experiment2;
pub use own_pose::OwnPose;
pub use table_1::table_1;

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
/// The same of others by surroundings, in the order of [`MODES`].
const OTHERS: [&str; 3] = ["Chaib 6.33", "Beauvisage 6.87, Mouats 8.50", "Anoosheh 9.10"];
/// Odometry's RMSE of x and y in Table 4 give or take this share is how far wheels should drift.
const ODOMETRY_BAND: f64 = 0.3;
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
    /// The wheels' odometry without the gyro.
    without_gyro: Option<Evaluation>,
    /// Of MVO-SVSF; `None` where it never moved on.
    corrections: Option<Corrections>,
    /// Of visual odometry alone, in the order of [`MODES`], percent; NaN where the mode never was.
    drift_by_mode: Vec<f64>,
    /// Of visual odometry, CPU.
    ms_per_frame: f64,
}

impl Outcome {
    /// `None` for a log without the four tracks, or without truth.
    pub fn of(log: &RunLog) -> Option<Self> {
        let evaluated = |name: &str| evaluate(&log.track(name)?.frames, &log.truth);
        let facts = log.facts.as_ref()?;
        let Track { frames, .. } = log.track("mvo")?;
        Some(Self {
            seed: facts.seed,
            path: facts.path,
            duration: facts.duration,
            tracks: COLUMNS.iter().map(|(name, _)| evaluated(name)).collect::<Option<_>>()?,
            without_gyro: evaluated("odometry_no_gyro"),
            corrections: log.corrections().into_iter().find_map(|(name, of)| (name == "svsf").then_some(of)),
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
    wanted: Bound,
}

/// A part of the page that is measured by itself.
pub struct Section {
    /// Its heading and all below, with an empty line at the end.
    pub text: String,
    /// What was aimed at there.
    pub goals: Vec<Goal>,
}

impl Goal {
    /// A figure that shall not be larger than `most`.
    fn at_most(what: String, most: f64, measured: f64) -> Self {
        Self { what, measured, wanted: Bound { min: None, max: Some(most) } }
    }

    /// Whether it was reached.
    pub fn held(&self) -> bool {
        self.wanted.holds(self.measured)
    }
}

/// What was aimed at, by the means over the runs; of corrections the largest counts.
pub fn goals(outcomes: &[Outcome]) -> Vec<Goal> {
    let goal = |what: &str, most: f64, of: &dyn Fn(&Outcome) -> f64| {
        Goal::at_most(what.into(), most, mean(outcomes.iter().map(of)))
    };
    let between = |min: f64, max: f64| Bound { min: Some(min), max: Some(max) };
    let [odometry, mvo, ekf, svsf] = [0, 1, 2, 3];
    let mut goals = vec![
        goal("MVO-SVSF's drift, % (paper 3.30)", 1.0, &|outcome| outcome.tracks[svsf].drift_percent),
        goal("position, MVO-SVSF's RMSE by odometry's", 0.2, &|o| o.position(svsf) / o.position(odometry)),
        goal("position, MVO-SVSF's RMSE by MVO's", 0.5, &|o| o.position(svsf) / o.position(mvo)),
    ];
    for (index, (_, name, most)) in MODES.iter().enumerate() {
        goals.push(goal(&format!("MVO alone, drift, %, {name}"), *most, &|o| o.drift_by_mode[index]));
    }
    for (row, axis) in ["x", "y"].into_iter().enumerate() {
        let paper = TABLE_4[row][odometry];
        let rounded = |value: f64| (1e3 * value).round() / 1e3;
        goals.push(Goal {
            wanted: between(rounded(paper * (1.0 - ODOMETRY_BAND)), rounded(paper * (1.0 + ODOMETRY_BAND))),
            ..goal(&format!("odometry's RMSE, {axis}, m (paper {paper:.2})"), 0.0, &|o| o.rmse(row, odometry))
        });
    }
    let leap = |what: &str, most: f64, of: fn(&Corrections) -> f64| Goal {
        measured: outcomes.iter().filter_map(|o| o.corrections.as_ref()).map(of).fold(f64::NAN, f64::max),
        ..goal(what, most, &|_| 0.0)
    };
    goals.push(leap("correction in one step at a switch, MVO-SVSF, m", 0.02, |c| c.switch_correction_m));
    goals.push(leap("correction in one step at a switch, MVO-SVSF, °", 1.0, |c| c.switch_correction_deg));
    for column in [ekf, svsf] {
        let what = format!("ANEES of {}, 3 if its covariance is right", COLUMNS[column].1);
        goals.push(Goal { wanted: between(1.5, 6.0), ..goal(&what, 0.0, &|o| o.tracks[column].anees) });
    }
    goals.push(goal("CPU a frame, ms (paper 64.86)", PAPER_MS, &|outcome| outcome.ms_per_frame));
    goals
}

/// The page. `form`: what was driven, in words.
pub fn page(outcomes: &[Outcome], form: &str, table_1: &Section) -> String {
    let (path, duration) = (mean(outcomes.iter().map(|o| o.path)), mean(outcomes.iter().map(|o| o.duration)));
    let seeds: Vec<String> = outcomes.iter().map(|outcome| outcome.seed.to_string()).collect();
    let mut page = format!(
        "# The first paper's experiments, there and here\n\n\
         Experiment 1, {form}: one drive through lamplight, sun and darkness, {path:.1} m in {duration:.0} s, seed{} {}. A \
         person steers. The paper says neither how long its way was nor how it slipped: its metres are another \
         way's. Of several runs the mean with its 95 % interval (Student's t). Made by `sunblind paper a`.\n\n{}## Table 4: RMSE\n\n",
        if seeds.len() == 1 { "" } else { "s" },
        seeds.join(", "),
        table_1.text
    );
    let names = COLUMNS.map(|(_, name)| format!("{name}, paper | here"));
    let _ = writeln!(page, "| | {} |\n|---|{}", names.join(" | "), "--:|".repeat(2 * COLUMNS.len()));
    for (row, name) in ["x, m", "y, m", "heading, °"].into_iter().enumerate() {
        let cells: Vec<String> = (0..COLUMNS.len())
            .map(|column| {
                format!(
                    "{} | {}",
                    TABLE_4[row][column],
                    mean_and_interval(outcomes.iter().map(|o| o.rmse(row, column)))
                )
            })
            .collect();
        let _ = writeln!(page, "| {name} | {} |", cells.join(" | "));
    }
    page += &gyro_section(outcomes);
    let _ = write!(page, "\n## Table 5: error by the way gone\n\n| | % |\n|---|--:|\n");
    for (who, percent) in TABLE_5 {
        let _ = writeln!(page, "| {who} | {percent:.2} |");
    }
    for (column, (_, name)) in COLUMNS.iter().enumerate() {
        let drift = mean_and_interval(outcomes.iter().map(|outcome| outcome.tracks[column].drift_percent));
        let _ = writeln!(page, "| here, {name} | {drift} |");
    }
    let _ = write!(page, "\n| surroundings | here, MVO alone, % | others, % |\n|---|--:|--:|\n");
    for (index, (_, name, _)) in MODES.iter().enumerate() {
        let drift = mean_and_interval(outcomes.iter().map(|outcome| outcome.drift_by_mode[index]));
        let _ = writeln!(page, "| {name} | {drift} | {} |", OTHERS[index]);
    }
    let _ = write!(page, "\n## Goals\n\n| | wanted | measured | |\n|---|--:|--:|---|\n");
    for goal in table_1.goals.iter().chain(&goals(outcomes)) {
        let verdict = if goal.held() { "held" } else { "**missed**" };
        let measured = if goal.measured.is_finite() { format!("{:.3}", goal.measured) } else { "–".into() };
        let _ = writeln!(page, "| {} | {} | {measured} | {verdict} |", goal.what, goal.wanted);
    }
    page
}

/// What the gyro is worth to the wheels, in the same drives; nothing where nobody looked.
fn gyro_section(outcomes: &[Outcome]) -> String {
    let Some(without) = outcomes.iter().map(|outcome| outcome.without_gyro).collect::<Option<Vec<_>>>() else {
        return String::new();
    };
    let with: Vec<_> = outcomes.iter().map(|outcome| outcome.tracks[0]).collect();
    let mut section = String::from("\n| odometry | x, m | y, m | heading, ° | drift, % |\n|---|--:|--:|--:|--:|\n");
    let [x, y, heading] = TABLE_4.map(|row| row[0]);
    let _ = writeln!(section, "| paper | {x:.2} | {y:.2} | {heading:.2} | |");
    for (name, of) in [("here, with a gyro", with), ("here, the gyro left out", without)] {
        let cell = |value: fn(&Evaluation) -> f64| mean_and_interval(of.iter().map(value));
        let [x, y] = [cell(|e| e.rmse_x_m), cell(|e| e.rmse_y_m)];
        let [heading, drift] = [cell(|e| e.rmse_theta_deg), cell(|e| e.drift_percent)];
        let _ = writeln!(section, "| {name} | {x} | {y} | {heading} | {drift} |");
    }
    section
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
            without_gyro: Some(evaluation(2.0)),
            corrections: Some(Corrections {
                max_correction_m: 0.5,
                max_correction_deg: 3.0,
                switch_correction_m: 0.01 * scale,
                switch_correction_deg: 0.9 * scale,
            }),
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
    fn the_largest_leap_counts_and_a_band_has_two_ends() {
        let goals = goals(&[outcome(1, 1.0), outcome(2, 2.0)]);
        let goal = |what: &str| goals.iter().find(|goal| goal.what.contains(what)).expect(what);
        assert!(goal("switch, MVO-SVSF, m").held() && !goal("switch, MVO-SVSF, °").held());
        // 3 m and 4 m where 1.08 m and 0.6 m were.
        assert_eq!(goal("RMSE, x").wanted.to_string(), "0.756 to 1.404");
        assert!(!goal("RMSE, x").held() && !goal("RMSE, y").held());
        assert!(goal("ANEES of MVO-EKF").held() && goal("ANEES of MVO-SVSF").held());
    }

    #[test]
    fn the_page_has_both_sides_of_each_table() {
        let goals = vec![Goal::at_most("σ".into(), 30.0, 31.0)];
        let table_1 = Section { text: "## Table 1\n\n".into(), goals };
        let page = page(&[outcome(1, 1.0), outcome(2, 2.0)], "in full", &table_1);
        assert!(page.contains("\n## Table 1\n\n## Table 4"), "{page}");
        assert!(page.contains("| σ | at most 30 | 31.000 | **missed** |"), "{page}");
        assert!(page.contains("| x, m | 1.08 | 3.000 ± 0.000 | 0.6 |"), "{page}");
        assert!(page.contains("| 0.082 | 0.450 ± 1.906 |"), "{page}");
        assert!(page.contains("seeds 1, 2") && page.contains("Beauvisage") && page.contains("**missed**"), "{page}");
        assert!(page.contains("| here, the gyro left out | 6.000 ± 0.000 |"), "{page}");
        assert!(page.contains("| at most 4 | – | **missed** |"), "{page}");
        assert!(page.contains("| outdoor | – | Beauvisage 6.87, Mouats 8.50 |"), "{page}");
    }
}
