//! A panic is a bug, and the user is told so.

use std::io::{self, Write};
use std::panic::PanicHookInfo;
use std::process::exit;

/// `EX_SOFTWARE` of sysexits.h: an internal error.
const BUG: i32 = 70;

/// From here on a panic in any thread says where it happened and ends the process with exit code 70.
pub fn exit_on_panic() {
    std::panic::set_hook(Box::new(|panic| {
        let _ = writeln!(io::stderr(), "{}", message(panic));
        exit(BUG);
    }));
}

fn message(panic: &PanicHookInfo) -> String {
    let what = panic.payload_as_str().unwrap_or("no message");
    let place = panic.location().map_or_else(|| "an unknown place".to_owned(), ToString::to_string);
    format!(
        "sunblind {}: this is a bug, not your mistake. Please report this line and your command line: {what} ({place})",
        env!("CARGO_PKG_VERSION")
    )
}
