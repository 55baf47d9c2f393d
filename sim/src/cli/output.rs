//! A run's folder appears whole or not at all: everything is written beside it and renamed into place.

use std::fs;
use std::io;
use std::path::{Path, PathBuf, absolute};
use std::process;

use thiserror::Error;

/// The file by which an earlier run's folder is known.
const SUMMARY: &str = "summary.json";

/// A folder that can't be written to, or must not.
#[derive(Debug, Error)]
pub(super) enum OutputError {
    /// Something that is no folder stands there.
    #[error("{}: is a file; give another folder with --out, or remove it", .0.display())]
    File(PathBuf),
    /// Somebody's files, which a run must not replace.
    #[error(
        "{}: holds other files than a run's; give an empty or a new folder with --out (only a folder with a run's \
         summary.json is replaced)",
        .0.display()
    )]
    Foreign(PathBuf),
    /// The operating system refuses.
    #[error("{}: can't be written: {source}; give another folder with --out", folder.display())]
    Unwritable { folder: PathBuf, source: io::Error },
}

/// A folder to be, known to be writable.
#[derive(Debug)]
pub(super) struct OutputFolder {
    /// As the user named it.
    shown: PathBuf,
    /// Absolute, with links followed.
    folder: PathBuf,
}

impl OutputFolder {
    /// Finds out before the work begins whether its result can be kept.
    pub fn check(out: &Path) -> Result<Self, OutputError> {
        let unwritable = |source| OutputError::Unwritable { folder: out.to_owned(), source };
        let folder = out.canonicalize().or_else(|_| absolute(out)).map_err(unwritable)?;
        let output = Self { shown: out.to_owned(), folder };
        output.check_replaceable()?;
        let parent = output.folder.parent().ok_or_else(|| unwritable(io::ErrorKind::InvalidInput.into()))?;
        fs::create_dir_all(parent).map_err(unwritable)?;
        output.beside("partial").map_err(unwritable)?;
        Ok(output)
    }

    /// Has `write` fill the folder, and shows it only when that went well. An earlier run's folder is replaced.
    pub fn publish(self, write: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), OutputError> {
        self.check_replaceable()?;
        let publish = || {
            let partial = self.beside("partial")?;
            write(&partial.0)?;
            // Onto an empty folder a folder can be renamed.
            let earlier = if self.folder.exists() { Some(self.beside("earlier")?) } else { None };
            if let Some(earlier) = &earlier {
                fs::rename(&self.folder, &earlier.0)?;
            }
            fs::rename(&partial.0, &self.folder).inspect_err(|_| {
                if let Some(earlier) = &earlier {
                    let _ = fs::rename(&earlier.0, &self.folder);
                }
            })
        };
        publish().map_err(|source| OutputError::Unwritable { folder: self.shown.clone(), source })
    }

    /// Only nothing, an empty folder and an earlier run's folder may be replaced.
    fn check_replaceable(&self) -> Result<(), OutputError> {
        let entries = match fs::read_dir(&self.folder) {
            Ok(mut entries) => entries.next(),
            Err(error) => match error.kind() {
                io::ErrorKind::NotFound => return Ok(()),
                io::ErrorKind::NotADirectory if self.folder.exists() => {
                    return Err(OutputError::File(self.shown.clone()));
                }
                _ => return Err(OutputError::Unwritable { folder: self.shown.clone(), source: error }),
            },
        };
        let ours = fs::read_to_string(self.folder.join(SUMMARY))
            .is_ok_and(|text| ["\"schema\"", "\"digest\""].iter().all(|key| text.contains(key)));
        if entries.is_none() || ours { Ok(()) } else { Err(OutputError::Foreign(self.shown.clone())) }
    }

    /// A new folder beside this one, hidden, on the same file system.
    fn beside(&self, suffix: &str) -> io::Result<Temporary> {
        let name = self.folder.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        let (name, process) = (name.to_string_lossy(), process::id());
        // A killed run leaves its folder behind, and in containers process ids come back.
        for attempt in 0.. {
            let folder = self.folder.with_file_name(format!(".{name}.{suffix}-{process}-{attempt}"));
            match fs::create_dir(&folder) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                created => return created.map(|()| Temporary(folder)),
            }
        }
        unreachable!("a file system holds fewer names than there are attempts")
    }
}

/// A folder that is gone with its owner.
struct Temporary(PathBuf);

impl Drop for Temporary {
    fn drop(&mut self) {
        // After a rename it is gone already; and a leftover is hidden and named as partial.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OURS: &str = r#"{"schema": 1, "digest": "00"}"#;

    fn publish(out: &Path, text: &str) -> Result<(), OutputError> {
        OutputFolder::check(out)?.publish(|folder| fs::write(folder.join(SUMMARY), text))
    }

    fn names(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.collect()
    }

    #[test]
    fn a_new_an_empty_and_an_earlier_runs_folder_are_taken() {
        let place = tempfile::tempdir().unwrap();
        let new = place.path().join("a/b/new");
        publish(&new, OURS).unwrap();
        fs::write(new.join("stale"), "").unwrap();
        publish(&new, OURS).unwrap();
        assert_eq!(names(&new), [SUMMARY]);
        assert_eq!(names(new.parent().unwrap()), ["new"]);

        let empty = place.path().join("empty");
        fs::create_dir(&empty).unwrap();
        publish(&empty, OURS).unwrap();
        assert_eq!(names(&empty), [SUMMARY]);
    }

    #[test]
    fn what_a_killed_run_left_is_no_hindrance() {
        let place = tempfile::tempdir().unwrap();
        let leftover = format!(".out.partial-{}-0", process::id());
        fs::create_dir(place.path().join(&leftover)).unwrap();
        publish(&place.path().join("out"), OURS).unwrap();
        assert!(place.path().join("out").join(SUMMARY).exists() && place.path().join(leftover).exists());
    }

    #[test]
    fn somebody_elses_files_are_left_alone() {
        let place = tempfile::tempdir().unwrap();
        let theirs = place.path().join("theirs");
        fs::create_dir(&theirs).unwrap();
        fs::write(theirs.join(SUMMARY), "{}").unwrap();
        assert!(matches!(publish(&theirs, OURS), Err(OutputError::Foreign(_))));
        assert_eq!(fs::read_to_string(theirs.join(SUMMARY)).unwrap(), "{}");

        let file = place.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(matches!(publish(&file, OURS), Err(OutputError::File(_))));
        assert!(matches!(publish(&file.join("out"), OURS), Err(OutputError::Unwritable { .. })));
        assert!(matches!(publish(Path::new("/"), OURS), Err(OutputError::Foreign(_))));
    }

    #[test]
    fn what_fails_half_way_leaves_the_earlier_run_and_nothing_beside_it() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("out");
        publish(&out, OURS).unwrap();
        let failing = OutputFolder::check(&out).unwrap().publish(|folder| {
            fs::write(folder.join("half"), "")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(matches!(failing, Err(OutputError::Unwritable { .. })));
        assert_eq!(names(&out), [SUMMARY]);
        assert_eq!(names(place.path()), ["out"]);
    }
}
