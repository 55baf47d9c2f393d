//! Scenarios as they are written, and what is said of those that can't be run.

mod errors;
mod round_trip;
mod structure;

use std::fs;
use std::path::{Path, PathBuf};

use super::*;

const GOOD: &str = "\
seed = 1
duration_s = 60.0
[world]
name = \"laboratory\"
[path]
kind = \"circle\"
start_m = [4.0, 1.0]
radius_m = 0.5
";

fn parse(text: &str) -> Result<AnyScenario, ScenarioError> {
    Source::new(text, Path::new("s.toml"), &[]).scenario()
}

pub(super) fn robot(text: &str) -> Scenario {
    match parse(text).unwrap() {
        AnyScenario::Robot(scenario) => *scenario,
        AnyScenario::TexturedRoom(_) => panic!("the textured room has no robot"),
    }
}

/// Every file of `scenarios/`.
pub(super) fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let folders = ["", "lights", "modes", "paper"].map(|name| folder.join(name));
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let files: Vec<_> = files.filter(|file| file.extension().is_some_and(|extension| extension == "toml")).collect();
    assert!(files.len() >= 5, "{files:?}");
    files
}

#[test]
fn every_shipped_scenario_is_valid_and_has_a_head_comment_and_a_short_form() {
    for file in shipped() {
        let scenario = load(&file).unwrap_or_else(|error| panic!("{error}"));
        assert!(fs::read_to_string(&file).unwrap().starts_with("# "), "{}", file.display());
        if let (AnyScenario::Robot(short), AnyScenario::Robot(long)) = (scenario.clone().shortened(), &scenario) {
            assert!(short.duration <= 10.0 && short.duration < long.duration, "{}", file.display());
            assert!(!short.expect.is_empty(), "{}: the short form expects nothing", file.display());
        }
    }
}

#[test]
fn what_is_not_written_has_its_default() {
    let scenario = robot(GOOD);
    assert_eq!(scenario.kinect, Kinect::default());
    assert_eq!((scenario.kinect.lens_height, scenario.kinect.rate), (0.6, 15.0));
    assert_eq!(scenario.estimator.params, EstimatorParams::default());
    assert_eq!(scenario.estimator.drives.pose_source(), Some(PoseSource::Svsf));
    assert_eq!(scenario.shortened().duration, 5.0);
    assert_eq!(robot(&GOOD.replace("60.0", "3")).shortened().duration, 3.0);
}

#[test]
fn the_short_form_is_judged_by_its_own_expectations() {
    let text = format!(
        "{GOOD}[[expect]]\nmetric = \"path_m\"\nmin = 9\n[short]\nduration_s = 2\n\
         [[short.expect]]\nmetric = \"frames\"\nmin = 29\n"
    );
    let short = robot(&text).shortened();
    assert_eq!((short.duration, short.expect.len(), short.expect[0].metric.as_str()), (2.0, 1, "frames"));
}

#[test]
fn the_robot_starts_on_the_path_unless_it_is_said_where() {
    let start = robot(GOOD).start().unwrap();
    assert_eq!((start.x, start.y, start.heading), (4.0, 1.0, 0.0));
    let start = robot(&format!("{GOOD}[robot]\nstart_m = [3.0, 1.2]\nstart_heading_deg = 90\n")).start().unwrap();
    assert_eq!((start.x, start.y, start.heading), (3.0, 1.2, std::f64::consts::FRAC_PI_2));
}

#[test]
fn laps_go_round_and_round() {
    let length = |text: &str| robot(text).path.shape().unwrap().length();
    assert!((length(&format!("{GOOD}laps = 3\n")) - 3.0 * length(GOOD)).abs() < 1e-9);
    let (path, _) = GOOD.split_once("kind").unwrap();
    let spline = format!("{path}kind = \"spline\"\npoints_m = [[0, 0], [2, 0], [2, 2], [0, 0]]\n");
    let twice = robot(&format!("{spline}laps = 2\n")).path.shape().unwrap();
    assert_eq!(twice.sections().len(), 1, "it stops between the laps");
    assert!((twice.length() / length(&spline) - 2.0).abs() < 0.2);
}

#[test]
fn a_wall_in_the_way_is_found_and_placed() {
    let text = format!("{GOOD}[robot]\nstart_m = [4.0, 0.0]\n");
    let (scenario, source) = (robot(&text), Source::new(text.clone(), Path::new("s.toml"), &[]));
    assert_eq!(scenario.check_way(|_, _| true), Ok(()));
    // The circle reaches up to y = 2.
    let wall_at = |y: f64| scenario.check_way(|from, to| (from.y < y) == (to.y < y)).unwrap_err();
    let message = source.blame(wall_at(1.9)).to_string();
    assert!(message.starts_with("s.toml:7:11: the path is blocked near (4.") && message.contains(", 1.9"), "{message}");
    assert!(source.blame(wall_at(0.5)).to_string().starts_with("s.toml:10:11: something stands between"));
    let steps_are_short = |from: &nalgebra::Point2<f64>, to: &nalgebra::Point2<f64>| (to - from).norm() < 0.1001;
    assert_eq!(robot(GOOD).check_way(steps_are_short), Ok(()));
}
