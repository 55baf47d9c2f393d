//! The `sunblind` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    without_display::restart();
    sunblind_sim::cli::run()
}

/// Mesa's layer that chooses among graphics cards asks the display for its own, and prints "error: XDG_RUNTIME_DIR is
/// invalid" for each adapter that is opened where there is no display: in containers and over ssh. Nothing is wrong then,
/// and nothing is shown here anyway. The layer is told to stay out by its environment variable, which has to be there when
/// the process starts.
#[cfg(target_os = "linux")]
mod without_display {
    use std::env;
    use std::os::unix::process::CommandExt;
    use std::process::Command;

    const STAY_OUT: &str = "NODEVICE_SELECT";

    /// Starts this process anew where the layer would complain. Does nothing if that fails.
    pub fn restart() {
        if env::var_os("XDG_RUNTIME_DIR").is_some() || env::var_os(STAY_OUT).is_some() {
            return;
        }
        if let Ok(program) = env::current_exe() {
            // Returns only if it fails.
            let _ = Command::new(program).args(env::args_os().skip(1)).env(STAY_OUT, "1").exec();
        }
    }
}
