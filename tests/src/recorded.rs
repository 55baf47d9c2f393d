//! Real recordings. They are not part of the project: tests that need them carry
//! `#[cfg_attr(not(recorded_data), ignore = "no recorded data")]`.

use std::path::{Path, PathBuf};

use sunblind_sim::record::{Frame, Recording};

/// The folder of the recording `name`, in `SUNBLIND_DATA` or `../shared/data` from the project's root.
///
/// Panics when it is not there.
pub fn folder(name: &str) -> PathBuf {
    let data = match std::env::var_os("SUNBLIND_DATA") {
        Some(folder) => folder.into(),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
    };
    let folder = data.join(name);
    assert!(folder.is_dir(), "no recorded data: {} is missing; say where it is with SUNBLIND_DATA", folder.display());
    folder
}

/// The recording `name`.
///
/// Panics when it can't be read.
pub fn open(name: &str) -> Recording {
    Recording::open(&folder(name), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Frame `index` of a recording.
///
/// Panics when it can't be read.
pub fn frame(recording: &Recording, index: usize) -> Frame {
    recording.frames[index].decode(&recording.rig).unwrap_or_else(|error| panic!("{error}"))
}
