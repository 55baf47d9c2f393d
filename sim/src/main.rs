//! The `sunblind` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    sunblind_sim::cli::run()
}
