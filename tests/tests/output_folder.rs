//! A run's folder is whole or absent, and nothing of the user's is replaced.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use sunblind_tests::command::{stderr_of, sunblind};
use sunblind_tests::tiny_recording::TinyRecording;

fn replay(recording: &TinyRecording, out: &Path) -> Command {
    let mut command = sunblind();
    command.arg("replay").arg(recording.folder()).arg("--out").arg(out);
    command
}

fn refused(output: &Output, part: &str) {
    assert_eq!(output.status.code(), Some(2));
    let stderr = stderr_of(output);
    assert!(stderr.contains(part) && stderr.contains("--out") && stderr.trim_end().lines().count() == 1, "{stderr}");
}

#[test]
fn a_killed_run_leaves_nothing_that_looks_whole() {
    let recording = TinyRecording::new(1);
    // The same two images over and over: long enough to be killed on the way.
    let list = |folder: &str| {
        (0..100_000).map(|frame| format!("{}.{:02} {folder}/0.png\n", frame / 20, frame % 20 * 5)).collect::<String>()
    };
    recording.write("rgb.txt", list("rgb"));
    recording.write("depth.txt", list("depth"));
    let mut run = replay(&recording, &recording.out()).stderr(Stdio::null()).stdout(Stdio::null()).spawn().unwrap();
    sleep(Duration::from_secs(2));
    assert!(run.try_wait().unwrap().is_none(), "the run ended before it could be killed");
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(!recording.out().exists());
}

#[test]
fn a_file_in_the_place_of_the_output_folder() {
    let recording = TinyRecording::new(2);
    fs::write(recording.out(), "mine").unwrap();
    refused(&replay(&recording, &recording.out()).output().unwrap(), "out: is a file");
    refused(&replay(&recording, &recording.out().join("deeper")).output().unwrap(), "deeper: can't be written");
    assert_eq!(fs::read_to_string(recording.out()).unwrap(), "mine");
}

#[test]
fn the_users_own_files_are_left_alone() {
    let recording = TinyRecording::new(2);
    fs::create_dir(recording.out()).unwrap();
    fs::write(recording.out().join("thesis.tex"), "mine").unwrap();
    refused(&replay(&recording, &recording.out()).output().unwrap(), "holds other files");
    refused(&replay(&recording, &recording.folder()).output().unwrap(), "holds other files");
    assert_eq!(fs::read_to_string(recording.out().join("thesis.tex")).unwrap(), "mine");
}

#[test]
fn a_failed_run_leaves_the_earlier_one() {
    let recording = TinyRecording::new(2);
    fs::create_dir(recording.out()).unwrap();
    let summary = recording.out().join("summary.json");
    fs::write(&summary, r#"{"schema": 1, "digest": "00"}"#).unwrap();
    recording.truncate("rgb/1.png", 0.5);
    let failed = replay(&recording, &recording.out()).output().unwrap();
    assert_eq!(failed.status.code(), Some(2));
    assert!(summary.exists());
}

#[test]
fn the_recordings_name_is_the_default() {
    let recording = TinyRecording::new(2);
    let elsewhere = tempfile::tempdir().unwrap();
    let run = sunblind().arg("replay").arg(recording.folder()).current_dir(&elsewhere).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr_of(&run));
    assert!(elsewhere.path().join("out/tiny").is_dir());
}
