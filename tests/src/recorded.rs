//! Real recordings. They are not part of the project: where they are missing, tests skip. Where they are present, a
//! recording that cannot be read is a panic.

use std::path::{Path, PathBuf};

use sunblind_sim::record::{Frame, Recording};

/// Where the recordings lie: `SUNBLIND_DATA`, or `../shared/data` from the project's root.
pub fn data_folder() -> PathBuf {
    match std::env::var_os("SUNBLIND_DATA") {
        Some(folder) => folder.into(),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data"),
    }
}

/// The folder of the recording `name`; `None`, said on standard error, when it is not there.
pub fn folder(name: &str) -> Option<PathBuf> {
    let folder = data_folder().join(name);
    if !folder.is_dir() {
        eprintln!("skipped: no recorded data ({})", folder.display());
        return None;
    }
    Some(folder)
}

/// The recording `name`; `None`, said on standard error, when it is not there.
pub fn open(name: &str) -> Option<Recording> {
    folder(name).map(|folder| Recording::open(&folder, None).unwrap_or_else(|error| panic!("{error}")))
}

/// Frame `index` of a recording.
pub fn frame(recording: &Recording, index: usize) -> Frame {
    recording.frames[index].decode(&recording.rig).unwrap_or_else(|error| panic!("{error}"))
}
