//! Reports of runs that were simulated.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};
use sunblind_estimator::image::InfraredImage;

use super::*;
use crate::runner::log::{RunFacts, SimulationCost};
use crate::scenario::Quality;
use crate::scenario::expect::{Expectation, Judged, Metrics, judge};
use crate::world::plan::Plan;

fn expected() -> Vec<Judged> {
    let expectation = |metric: &str, max| Expectation { metric: metric.into(), relative_to: None, min: None, max };
    let metrics = Metrics::from([("svsf.ate_m".into(), 0.04567), (HOSTILE.into(), 2.0)]);
    let of = [("svsf.ate_m", Some(0.1)), (HOSTILE, Some(1.0)), ("ekf.ate_m", Some(0.1))];
    judge(&of.map(|(metric, max)| expectation(metric, max)), &metrics)
}

/// A robot's run in a room of 4 × 3 m with a table.
fn simulated_log() -> RunLog {
    let mut log = made_up_log(300);
    let infrared = |value| InfraredImage::filled(192, 144, value);
    let thumbnail = |index: u32| Snapshot {
        infrared: Some(infrared(100 + index as u16)),
        tracks: Vec::new(),
        ..snapshot(index, [192, 144])
    };
    log.has_wheels = true;
    log.thumbnails = (0..60).map(|index| thumbnail(5 * index)).collect();
    log.snapshots.iter_mut().for_each(|snapshot| snapshot.infrared = Some(infrared(100)));
    log.plan = Some(Plan {
        walls: vec![[[1.0, -2.0], [5.0, -2.0]], [[1.0, 1.0], [5.0, 1.0]]],
        furniture: vec![vec![[1.5, -1.0], [2.0, -1.0], [2.0, 0.0], [1.5, 0.0]]],
    });
    log.planned_path = vec![[3.0, -1.0], [3.5, 1.0]];
    log.expectations = expected();
    log.facts = Some(RunFacts {
        seed: 42,
        quality: Quality::Fast,
        duration: 10.5,
        path: 2.25,
        adapter: Some(HOSTILE.into()),
        driver: Some("Mesa 25.0".into()),
        cpu_ms_per_frame: SimulationCost { render: 120.0, depth: 30.0, physics: 2.0 },
    });
    log
}

/// What the page hands to its script.
fn run_of(page: &str) -> Value {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(page, options).unwrap();
    let run = document.descendants().find_map(|node| node.attribute("data-run")).unwrap();
    serde_json::from_str(run).unwrap()
}

#[test]
fn a_simulated_run_is_summarised_with_its_facts() {
    let (_, page, summary) = written(&simulated_log());
    assert_eq!((&summary["seed"], &summary["driver"]), (&Value::from(42), &Value::from("Mesa 25.0")));
    assert_eq!((&summary["adapter"], &summary["quality"]), (&Value::from(HOSTILE), &Value::from("fast")));
    assert_eq!((summary["duration_s"].as_f64(), summary["path_m"].as_f64()), (Some(10.5), Some(2.25)));
    assert!((summary["real_time_factor"].as_f64().unwrap() - 10.5 / 11.5).abs() < 1e-12);
    assert_eq!(summary["cpu_ms_per_frame"]["render"], 120.0);
    let share = summary["sensor"]["depth_valid_share"].as_f64().unwrap();
    assert!((0.6..0.8).contains(&share), "{share}");
    let energies = serde_json::json!({ "rgb": 0.21, "infrared": null, "depth": 0.3 });
    assert_eq!(summary["sensor"]["energies"], energies);
    assert_eq!(
        summary["expectations"][0],
        serde_json::json!({ "name": "svsf.ate_m", "value": 0.04567, "bound": { "max": 0.1 }, "held": true })
    );
    assert!(page.contains("<h2>2 of 3 expectations missed</h2>"));
    for cells in ["<td>0.04567</td><td>at most 0.1</td>", "<td>not measured</td><td>at most 0.1</td>"] {
        assert!(page.contains(cells), "{cells}");
    }
    assert_eq!(page.matches("✗ missed").count(), 2);
    assert!(page.contains("Simulated time") && page.contains("images 120"));
}

#[test]
fn the_world_lies_under_both_maps() {
    let (_, page, _) = written(&simulated_log());
    for class in ["class=\"wall\"", "class=\"furniture\"", "line planned\" d="] {
        assert_eq!(page.matches(class).count(), 2, "{class}");
    }
    // The axes reach as far as the walls.
    assert!(page.contains(">5</text>"));
}

#[test]
fn the_animation_knows_the_run_from_start_to_end() {
    let log = simulated_log();
    let (_, page, _) = written(&log);
    assert!(page.contains("<h2>The run</h2>"));
    // Three sheets, and six instants of three images.
    assert_eq!(page.matches("data:image/jpeg;base64,").count(), 3 + 18);
    let run = run_of(&page);
    let list = |key: &str| run[key].as_array().unwrap().clone();
    assert_eq!([list("times").len(), list("robot").len(), list("estimate").len()], [300; 3]);
    assert_eq!((list("images").len(), &run["columns"]), (60, &Value::from(8)));
    let turned = list("robot")[299][2].as_f64().unwrap() - list("robot")[0][2].as_f64().unwrap();
    assert!((turned + 0.2 * 299.0 / 30.0 * 180.0 / std::f64::consts::PI).abs() < 5.0, "{turned}° clockwise");
    // A run of 10 s at five times its speed would be over before one has looked.
    assert!((run["speed"].as_f64().unwrap() - 9.966 / 6.0).abs() < 0.01, "{run}");
}

#[test]
fn a_heading_goes_on_beyond_a_full_turn() {
    let mut log = simulated_log();
    let about_z = |turns: f64| UnitQuaternion::from_euler_angles(0.0, 0.0, TAU * turns);
    for (index, pose) in log.truth.iter_mut().enumerate() {
        pose.world_from_body.rotation = about_z(index as f64 / 100.0);
    }
    let robot = run_of(&written(&log).1)["robot"].as_array().unwrap().clone();
    let headings: Vec<f64> = robot.iter().map(|pose| pose[2].as_f64().unwrap()).collect();
    assert!(headings.windows(2).all(|pair| (pair[1] - pair[0] + 3.6).abs() < 0.2), "{headings:?}");
}

#[test]
fn the_page_runs_its_own_script_and_no_other() {
    let (_, page, _) = written(&simulated_log());
    let script = page.split("<script>").nth(1).unwrap().split("</script>").next().unwrap();
    assert!(page.contains(&format!("script-src 'sha256-{}'", STANDARD.encode(Sha256::digest(script)))));
    assert!(page.contains("default-src 'none'"));
    let (_, page, _) = written(&made_up_log(60));
    assert!(!page.contains("<script>"), "nothing to animate");
}

#[test]
fn images_of_other_sizes_are_left_out_of_the_animation() {
    let mut log = simulated_log();
    log.thumbnails[3] = snapshot(15, [96, 72]);
    log.thumbnails[4].infrared = None;
    log.thumbnails[5].rgb = RgbImage::from_pixels(0, 0, Vec::new()).unwrap();
    let run = run_of(&written(&log).1);
    assert_eq!(run["images"].as_array().unwrap().len(), 57);
}

#[test]
fn a_camera_without_truth_has_no_above() {
    let mut log = simulated_log();
    (log.has_wheels, log.truth) = (false, Vec::new());
    assert!(!written(&log).1.contains("<h2>The run</h2>"));
    log.has_wheels = true;
    let (_, page, _) = written(&log);
    assert!(page.contains("<h2>The run</h2>") && !page.contains("truth trail"));
}
