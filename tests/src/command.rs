//! The built `sunblind` command.

use std::path::PathBuf;
use std::process::{Command, Output};

/// The command, which `cargo build --release` puts beside the tests' folder.
///
/// Panics when it is missing: a test that ran nothing would say that all is well.
pub fn sunblind() -> Command {
    let test = std::env::current_exe().expect("the test knows its own path");
    let name = format!("sunblind{}", std::env::consts::EXE_SUFFIX);
    let binary: PathBuf = test.ancestors().nth(2).expect("target/<profile>/deps/<test>").join(name);
    assert!(binary.is_file(), "{} is missing: run `cargo build` with the tests' profile first", binary.display());
    Command::new(binary)
}

/// What a process wrote to standard error.
pub fn stderr_of(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What a process wrote to standard output.
pub fn stdout_of(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}
