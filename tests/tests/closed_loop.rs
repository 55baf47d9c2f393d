//! A simulated robot that drives on its own estimate: nothing cheats, and nothing depends on how it is computed.

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Output;

use sunblind_estimator::Mode;
use sunblind_sim::record::Recording;
use sunblind_sim::record::writer::RecordingWriter;
use sunblind_sim::runner::log::RunLog;
use sunblind_sim::runner::{Driven, ReplayOptions, Run, replay};
use sunblind_sim::scenario::{AnyScenario, Scenario, load};
use sunblind_sim::simulator::Simulator;
use sunblind_tests::command::{stderr_of, stdout_of, sunblind};

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name)
}

fn two_seconds_of_the_loop() -> Scenario {
    let AnyScenario::Robot(scenario) = load(&shipped("lab_loop.toml")).unwrap() else { panic!("a robot's scenario") };
    Scenario { duration: 2.0, expect: Vec::new(), ..*scenario }
}

fn localizers(scenario: &Scenario, simulator_or_recording: &sunblind_estimator::Rig) -> Vec<Driven> {
    let params = scenario.estimator.params.clone();
    vec![Driven::product("mvo", "visual odometry", params, simulator_or_recording.clone()).unwrap()]
}

fn drive(scenario: &Scenario, recording: Option<&Path>) -> RunLog {
    let world = scenario.lit_world(&|_| {}).unwrap();
    let mut simulator = Simulator::new(scenario, &world).unwrap();
    let calibration = simulator.calibration().clone();
    let writer = recording.map(|folder| RecordingWriter::create(folder, &calibration).unwrap());
    let run = Run {
        name: "loop",
        scenario,
        world: &world,
        simulator: &mut simulator,
        localizers: localizers(scenario, &calibration.rig),
        recording: writer.as_ref(),
        on_frame: &|| {},
    };
    let log = run.drive().unwrap();
    if let Some(writer) = writer {
        writer.finish().unwrap();
    }
    log
}

#[test]
fn what_was_driven_and_what_is_replayed_without_the_truth_are_equal_to_the_bit() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("loop");
    let scenario = two_seconds_of_the_loop();
    let driven = drive(&scenario, Some(&folder));
    fs::remove_file(folder.join("groundtruth.txt")).expect("the truth was recorded");

    let recording = Recording::open(&folder, None).unwrap();
    let replayed =
        replay(&recording, localizers(&scenario, &recording.rig), &ReplayOptions::default()).expect("it is whole");
    // Over every measurement and every estimate, before any truth places them.
    assert_eq!(driven.digest, replayed.digest);
    let counts = |log: &RunLog| log.tracks.iter().map(|track| track.frames.len()).collect::<Vec<_>>();
    assert_eq!(counts(&driven), counts(&replayed));
    assert!(counts(&driven).iter().all(|&frames| frames > 10), "{:?}", counts(&driven));
    assert!(replayed.truth.is_empty() && !driven.truth.is_empty());

    let other = drive(&Scenario { seed: scenario.seed + 1, ..scenario }, None);
    assert_ne!(driven.digest, other.digest, "the seed decides nothing");
}

/// The campus' office by night, whose lamps go out.
const LAMPS_GO_OUT: &str = "\
seed = 3
duration_s = 3.0
[world]
name = \"campus\"
[light]
daylight_scale = 0.0
[[light.timeline]]
at_s = 1.2
lamps = false
[robot]
gyro = true
[path]
kind = \"waypoints\"
points_m = [[15.6, 25.0], [15.6, 22.0]]
";

#[test]
fn a_drive_across_a_change_of_the_mode_is_replayed_to_the_bit() {
    let place = tempfile::tempdir().unwrap();
    let (file, folder) = (place.path().join("lamps.toml"), place.path().join("lamps"));
    fs::write(&file, LAMPS_GO_OUT).unwrap();
    let AnyScenario::Robot(scenario) = load(&file).unwrap() else { panic!("a robot's scenario") };
    let driven = drive(&scenario, Some(&folder));
    let modes = |log: &RunLog| log.modes.iter().map(|said| (said.time, said.report)).collect::<Vec<_>>();
    let mut said: Vec<_> = modes(&driven).iter().map(|(_, report)| report.mode).collect();
    said.dedup();
    assert_eq!(said, [Mode::Indoor, Mode::Night]);

    let recording = Recording::open(&folder, None).unwrap();
    for threads in [1, 3] {
        let options = ReplayOptions { threads: NonZero::new(threads).unwrap(), ..ReplayOptions::default() };
        let replayed = replay(&recording, localizers(&scenario, &recording.rig), &options).unwrap();
        assert_eq!(replayed.digest, driven.digest, "{threads} threads");
        // The switch's own numbers are in no digest.
        assert!(modes(&replayed) == modes(&driven), "{threads} threads");
    }
}

fn run(scenarios: &[&str], out: &Path, options: &[&str], threads_of_the_renderer: Option<&str>) -> Output {
    let mut run = sunblind();
    run.arg("run").args(scenarios.iter().map(|name| shipped(name))).arg("--out").arg(out).args(options);
    if let Some(threads) = threads_of_the_renderer {
        run.env("LP_NUM_THREADS", threads);
    }
    run.output().expect("sunblind runs")
}

fn digest_of(folder: &Path) -> String {
    let summary = fs::read_to_string(folder.join("summary.json")).expect("a summary");
    let digest = summary.split("\"digest\": \"").nth(1).and_then(|rest| rest.split('"').next());
    digest.expect("a digest").to_owned()
}

#[test]
fn the_digest_is_the_same_in_every_run_with_any_number_of_threads() {
    let place = tempfile::tempdir().unwrap();
    let short = ["--short", "--set", "short.duration_s=1.5", "--set", "short.expect=[]"];
    let scenarios = ["lab_loop.toml", "yard_noon.toml", "campus.toml"];
    let digests = [("again", None), ("one thread", Some("1")), ("three threads", Some("3"))].map(|(name, threads)| {
        let out = place.path().join(name);
        let output = run(&scenarios, &out, &short, threads);
        assert_eq!(output.status.code(), Some(0), "{}", stderr_of(&output));
        scenarios.map(|name| digest_of(&out.join(name.trim_end_matches(".toml"))))
    });
    assert!(digests.iter().all(|digest| *digest == digests[0]), "{digests:?}");
    assert!(digests[0].iter().all(|digest| digest.len() == 64), "{digests:?}");
}

#[test]
fn a_fast_run_says_so_has_a_digest_of_its_own_and_is_localised_all_the_same() {
    let place = tempfile::tempdir().unwrap();
    let short = ["--short", "--set", "short.duration_s=1.5", "--set", "short.expect=[]"];
    let digests = ["fast", "full", "fast"].map(|quality| {
        let out = place.path().join(quality);
        let output = run(&["lab_loop.toml"], &out, &[&short[..], &["--quality", quality]].concat(), None);
        assert_eq!(output.status.code(), Some(0), "{}", stderr_of(&output));
        let summary = fs::read_to_string(out.join("summary.json")).expect("a summary");
        assert!(summary.contains(&format!("\"quality\": \"{quality}\"")) && summary.contains("\"lost_frames\": 0"));
        digest_of(&out)
    });
    assert!(digests[0] == digests[2] && digests[0] != digests[1], "{digests:?}");
    let output = run(&["lab_loop.toml"], &place.path().join("quick"), &["--quality", "quick"], None);
    assert!(output.status.code() == Some(2) && stderr_of(&output).contains("fast, full"), "{}", stderr_of(&output));
}

#[test]
fn every_scenario_holds_in_its_short_form() {
    let place = tempfile::tempdir().unwrap();
    let names = [
        "lab_loop",
        "circle",
        "figure_eight",
        "lab",
        "yard_noon",
        "yard_overcast",
        "yard_low_sun",
        "night",
        "doorway",
        "campus",
        "modes/flicker",
        "modes/clouds",
        "modes/headlights",
        "modes/hand",
        "modes/threshold",
    ];
    let files = names.map(|name| format!("{name}.toml"));
    let output = run(&files.each_ref().map(String::as_str), place.path(), &["--short"], None);
    assert_eq!(output.status.code(), Some(0), "{}{}", stdout_of(&output), stderr_of(&output));
    for name in names {
        let stem = name.trim_start_matches("modes/");
        assert!(place.path().join(stem).join("report.html").is_file(), "{name}");
        assert!(stdout_of(&output).contains(&format!("{stem}: ")), "{}", stdout_of(&output));
    }
}

#[test]
fn what_must_fail_fails() {
    let place = tempfile::tempdir().unwrap();
    let output = run(&["canary.toml"], &place.path().join("out"), &["--short"], None);
    assert_eq!(output.status.code(), Some(1), "{}", stderr_of(&output));
    assert!(stdout_of(&output).contains("missed") && stderr_of(&output).contains("1 expectation was missed"));
    // The results of a run that missed something are there all the same.
    assert!(place.path().join("out/report.html").is_file());
}

#[test]
fn of_several_scenarios_it_is_said_which_missed() {
    let place = tempfile::tempdir().unwrap();
    let second = place.path().join("second.toml");
    fs::copy(shipped("canary.toml"), &second).unwrap();
    let second = second.to_str().expect("a path of text");
    let output = run(&["canary.toml", second], place.path(), &["--short"], None);
    assert_eq!(output.status.code(), Some(1), "{}", stderr_of(&output));
    assert!(stdout_of(&output).ends_with("missed: canary, second\n"), "{}", stdout_of(&output));
    assert!(stderr_of(&output).contains("2 expectations were missed"), "{}", stderr_of(&output));
}

#[test]
fn two_scenarios_of_one_name_do_not_write_into_one_folder() {
    let place = tempfile::tempdir().unwrap();
    let output = run(&["night.toml", "lights/night.toml"], place.path(), &["--short"], None);
    assert_eq!(output.status.code(), Some(2), "{}", stderr_of(&output));
    assert!(stderr_of(&output).contains("two scenarios are called night"), "{}", stderr_of(&output));
    assert_eq!(fs::read_dir(place.path()).unwrap().count(), 0);
}
