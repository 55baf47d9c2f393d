//! The `sunblind` command.

fn main() {}
