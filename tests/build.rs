//! Tells the tests whether the real recordings are at hand (`cfg(recorded_data)`), so that those which need them count
//! as skipped where they are not. Where to look: `SUNBLIND_DATA`, else `../shared/data` from the project's root.

use std::path::Path;

fn main() {
    let folder = std::env::var("SUNBLIND_DATA").unwrap_or_else(|_| "../../shared/data".to_owned());
    println!("cargo::rerun-if-env-changed=SUNBLIND_DATA");
    println!("cargo::rerun-if-changed={folder}");
    println!("cargo::rustc-check-cfg=cfg(recorded_data)");
    if Path::new(&folder).is_dir() {
        println!("cargo::rustc-cfg=recorded_data");
    }
}
