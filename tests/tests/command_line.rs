//! What the command line promises: help that teaches, exit codes, and a table.

use std::process::{Command, Stdio};

use sunblind_sim::cli::bug::exit_on_panic;
use sunblind_tests::command::{stderr_of, stdout_of, sunblind};
use sunblind_tests::tiny_recording::TinyRecording;

#[test]
fn help_teaches() {
    let help = sunblind().arg("--help").output().unwrap();
    assert_eq!(help.status.code(), Some(0));
    assert!(stdout_of(&help).contains("Exit codes:"));
    let help = stdout_of(&sunblind().args(["replay", "--help"]).output().unwrap());
    for part in ["Examples:", "sunblind replay ", "groundtruth.txt", "report.html", "seconds, metres", "ATE"] {
        assert!(help.contains(part), "no {part:?} in: {help}");
    }
}

#[test]
fn bad_usage_is_2() {
    for arguments in [vec![], vec!["reply"], vec!["replay"], vec!["replay", "x", "--threads", "0"]] {
        assert_eq!(sunblind().args(&arguments).output().unwrap().status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn an_unknown_parameter_is_answered_with_the_nearest() {
    let recording = TinyRecording::new(1);
    let run = sunblind().arg("replay").arg(recording.folder()).args(["--set", "varient=paper"]).output().unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(stderr_of(&run).contains("did you mean variant"), "{}", stderr_of(&run));
}

#[test]
fn a_run_ends_with_a_row_for_each_track_and_the_report() {
    let recording = TinyRecording::new(20);
    let run = |arguments: &[&str]| {
        let mut run = sunblind();
        run.arg("replay").arg(recording.folder()).arg("--out").arg(recording.out()).args(arguments);
        let run = run.output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr_of(&run));
        stdout_of(&run)
    };
    let both = run(&[]);
    for part in ["tiny: 20 frames, poses of the colour camera", "ATE m", "mvo_paper", "out/report.html"] {
        assert!(both.contains(part), "no {part:?} in: {both}");
    }
    assert!(!run(&["--set", "variant=paper"]).contains("mvo_paper"), "the same track twice");
}

#[test]
fn the_difficulty_of_recordings_is_shown_side_by_side() {
    let recording = TinyRecording::new(5);
    let run = sunblind().arg("difficulty").args([recording.folder(), recording.folder()]).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr_of(&run));
    let table = stdout_of(&run);
    let row = |label: &str| table.lines().find(|line| line.contains(label)).unwrap_or_default().to_owned();
    assert!(row("median of the frames").contains("tiny / tiny"), "{table}");
    assert!(row("│ frames ").matches('5').count() == 2 && row("│ frames ").contains("1.00"), "{table}");
    assert!(row("keypoints").contains('┆') && row("RMSE of motion, mm").contains('┆'), "{table}");
}

#[test]
fn a_closed_standard_output_is_no_bug() {
    let recording = TinyRecording::new(2);
    let mut run = sunblind();
    run.arg("replay").arg(recording.folder()).arg("--out").arg(recording.out());
    let mut run = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(run.stdout.take());
    drop(run.stderr.take());
    assert_eq!(run.wait().unwrap().code(), Some(0));
}

#[test]
fn a_panic_is_a_bug_and_70() {
    const PANIC: &str = "SUNBLIND_TEST_PANIC";
    if std::env::var_os(PANIC).is_some() {
        exit_on_panic();
        std::thread::spawn(|| panic!("the sky fell")).join().unwrap();
    }
    let test = std::env::current_exe().unwrap();
    let arguments = ["--exact", "a_panic_is_a_bug_and_70", "--nocapture"];
    let child = Command::new(test).args(arguments).env(PANIC, "1").output().unwrap();
    assert_eq!(child.status.code(), Some(70));
    let stderr = stderr_of(&child);
    assert!(stderr.contains("this is a bug") && stderr.contains("the sky fell"), "{stderr}");
    assert!(stderr.contains("command_line.rs:"), "{stderr}");
}
