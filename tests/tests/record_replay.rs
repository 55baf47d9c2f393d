//! From a scenario to a report through the built command.

use std::fs;
use std::path::Path;

use sunblind_tests::command::{stderr_of, sunblind};

/// A second and a half of the textured room at 10 Hz, the end of it in motion.
const SCENARIO: &str = "seed = 7\nduration_s = 1.5\nrate_hz = 10.0\n[world]\nname = \"textured_room\"\n";

fn run(arguments: &[&Path]) {
    let output = sunblind().args(arguments).output().expect("sunblind runs");
    assert!(output.status.success(), "{}", stderr_of(&output));
}

fn summary(folder: &Path) -> String {
    fs::read_to_string(folder.join("summary.json")).expect("a summary")
}

/// The value of a top-level text field.
fn text_field(summary: &str, name: &str) -> String {
    let after = summary.split(&format!("\"{name}\": \"")).nth(1).unwrap_or_else(|| panic!("no {name} in {summary}"));
    after.split('"').next().expect("a closing quote").to_owned()
}

#[test]
fn without_the_truth_the_estimates_are_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("room.toml"), SCENARIO).expect("a scenario");
    run(&["record".as_ref(), &at("room.toml"), "--out".as_ref(), &at("room")]);

    run(&["replay".as_ref(), &at("room"), "--out".as_ref(), &at("with")]);
    fs::remove_file(at("room/groundtruth.txt")).expect("the truth was there");
    run(&["replay".as_ref(), &at("room"), "--out".as_ref(), &at("without")]);

    let (with, without) = (summary(&at("with")), summary(&at("without")));
    assert!(with.contains("\"ate_m\": 0."), "{with}");
    assert!(!without.contains("\"ate_m\": 0."), "{without}");
    assert_eq!(text_field(&with, "digest"), text_field(&without, "digest"));
    assert!(at("with/truth.tum").is_file() && !at("without/truth.tum").is_file());

    // The digest can differ: other images, other digest.
    let list = fs::read_to_string(at("room/rgb.txt")).expect("a list");
    let shorter: Vec<_> = list.lines().take(12).collect();
    fs::write(at("room/rgb.txt"), shorter.join("\n")).expect("a shorter list");
    run(&["replay".as_ref(), &at("room"), "--out".as_ref(), &at("shorter")]);
    assert_ne!(text_field(&summary(&at("shorter")), "digest"), text_field(&with, "digest"));
}
