//! Scenario files through the built command: checked, described, changed from the command line.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use sunblind_tests::command::{stderr_of, stdout_of, sunblind};

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name)
}

fn check(files: &[&Path], options: &[&str]) -> Output {
    sunblind().arg("check").args(files).args(options).output().expect("sunblind runs")
}

#[test]
fn every_shipped_scenario_is_ok_in_a_line() {
    let within = |folder| fs::read_dir(shipped(folder)).expect("scenarios").map(|entry| entry.unwrap().path());
    let files: Vec<_> =
        ["", "lights", "modes", "paper"].into_iter().flat_map(within).filter(|path| path.is_file()).collect();
    let files: Vec<_> = files.iter().map(PathBuf::as_path).collect();
    for options in [&[][..], &["--short", "--seed", "7"]] {
        let output = check(&files, options);
        assert_eq!(output.status.code(), Some(0), "{}", stdout_of(&output));
        let lines = stdout_of(&output);
        assert_eq!(lines.lines().count(), files.len(), "{lines}");
        assert!(lines.lines().all(|line| line.contains(".toml: ok, ")), "{lines}");
    }
}

#[test]
fn what_is_wrong_is_placed_and_the_others_are_checked_all_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let wrong = folder.path().join("wrong.toml");
    let good = fs::read_to_string(shipped("circle.toml")).expect("a scenario");
    for (from, to, problem) in [
        ("radius_m = 0.7", "radius_cm = 70", "unknown key `radius_cm`"),
        ("radius_m = 0.7", "radius_m = \"0.7 m\"", "expected a number"),
        ("duration_s = 90.0", "duration_s = 0", "write a number from 0.1 to 3600"),
        ("name = \"laboratory\"", "name = \"lab\"", "did you mean `laboratory`?"),
        ("floor = \"tile\"", "urdf = \"none.urdf\"", "no such file"),
        ("seed = 1", "seed = ", "expected"),
        ("start_m = [2.6, 4.5]", "start_m = [2.6, 7.0]", "the path is blocked near (2."),
    ] {
        fs::write(&wrong, good.replace(from, to)).expect("a file");
        let line = good.lines().position(|line| line == from).expect("a line to change") + 1;
        let output = check(&[&wrong, &shipped("circle.toml")], &[]);
        assert_eq!(output.status.code(), Some(2), "{to}");
        let lines = stdout_of(&output);
        let (first, second) = lines.trim_end().split_once('\n').expect("two lines");
        assert!(first.starts_with(&format!("{}:{line}:", wrong.display())) && first.contains(problem), "{first}");
        assert!(second.contains("circle.toml: ok"), "{second}");
        assert!(stderr_of(&output).contains("1 of 2 scenarios"), "{}", stderr_of(&output));
    }
    let nothing = check(&[&folder.path().join("nothing.toml")], &[]);
    assert_eq!(nothing.status.code(), Some(2));
    assert!(stdout_of(&nothing).contains("nothing.toml: can't be read"), "{}", stdout_of(&nothing));
}

#[test]
fn an_override_that_is_wrong_is_named() {
    let circle = shipped("circle.toml");
    let output = check(&[&circle], &["--set", "path.laps=2", "--set", "path.radus_m=2"]);
    assert_eq!(output.status.code(), Some(2));
    let line = stdout_of(&output);
    assert!(line.contains("circle.toml with --set path.radus_m=2: ") && line.contains("`radius_m`?"), "{line}");
    assert_eq!(check(&[&circle], &["--set", "path.laps=2"]).status.code(), Some(0));
}

#[test]
fn the_schema_is_json_that_names_every_section() {
    let output = sunblind().arg("schema").output().expect("sunblind runs");
    assert_eq!(output.status.code(), Some(0));
    let schema = stdout_of(&output);
    for part in ["\"$schema\"", "\"daylight_scale\"", "\"corner_radius_m\"", "\"max_features\"", "\"expect\""] {
        assert!(schema.contains(part), "no {part}");
    }
}
