//! Where a run's results go.

use std::fs;
use std::io;
use std::path::Path;

use crate::new_folder::{FolderError, Kind, NewFolder};

/// The file by which an earlier run's folder is known.
const SUMMARY: &str = "summary.json";

static RUN: Kind = Kind { whose: "a run's", mark: "a folder with a run's summary.json", is: is_run };

fn is_run(folder: &Path) -> bool {
    fs::read_to_string(folder.join(SUMMARY))
        .is_ok_and(|text| ["\"schema\"", "\"digest\""].iter().all(|key| text.contains(key)))
}

/// Finds out before the work begins whether its result can be kept in `out`.
///
/// # Errors
/// As [`publish`].
pub(super) fn check(out: &Path) -> Result<(), FolderError> {
    NewFolder::begin(out, &RUN).map(drop)
}

/// Has `write` fill the folder `out`, and shows it only when that went well. An earlier run's folder is replaced.
///
/// # Errors
/// When something else is there, or the operating system refuses.
pub(super) fn publish(out: &Path, write: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), FolderError> {
    let folder = NewFolder::begin(out, &RUN)?;
    write(folder.path()).map_err(|source| FolderError::Unwritable { folder: out.to_owned(), source })?;
    folder.publish()
}

#[cfg(test)]
mod tests {
    use super::*;

    const OURS: &str = r#"{"schema": 1, "digest": "00"}"#;

    #[test]
    fn only_a_runs_summary_makes_a_runs_folder() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("out");
        publish(&out, |folder| fs::write(folder.join(SUMMARY), OURS)).unwrap();
        check(&out).unwrap();
        fs::write(out.join(SUMMARY), "{}").unwrap();
        assert!(matches!(check(&out), Err(FolderError::Foreign { .. })));
    }

    #[test]
    fn a_disk_that_fills_up_leaves_the_earlier_run() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("out");
        publish(&out, |folder| fs::write(folder.join(SUMMARY), OURS)).unwrap();
        let failed = publish(&out, |folder| {
            fs::write(folder.join("half"), "")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(matches!(failed, Err(FolderError::Unwritable { .. })));
        assert!(out.join(SUMMARY).exists());
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 1, "something was left beside");
    }
}
