//! A folder that appears whole or not at all: everything is written beside its place, hidden, and renamed into it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf, absolute};
use std::process;

use thiserror::Error;

/// A kind of folder that a new one of it may replace.
#[derive(Debug)]
pub(crate) struct Kind {
    /// Whose files it holds: "a run's".
    pub whose: &'static str,
    /// How one is known: "a folder with a run's summary.json".
    pub mark: &'static str,
    /// Whether a folder is one.
    pub is: fn(&Path) -> bool,
}

/// A folder that can't be written to, or must not.
#[derive(Debug, Error)]
pub enum FolderError {
    /// Something that is no folder stands there.
    #[error("{}: is a file; give another folder with --out, or remove it", .0.display())]
    File(PathBuf),
    /// Somebody's files, which must not be replaced.
    #[error(
        "{}: holds other files than {whose}; give an empty or a new folder with --out (only {mark} is replaced)",
        folder.display()
    )]
    Foreign {
        /// The folder.
        folder: PathBuf,
        /// Whose files would be in their place.
        whose: &'static str,
        /// What may be replaced.
        mark: &'static str,
    },
    /// The operating system refuses.
    #[error("{}: can't be written: {source}; give another folder with --out", folder.display())]
    Unwritable {
        /// The folder.
        folder: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// A folder being filled. It is gone with this value unless it was [published](Self::publish).
#[derive(Debug)]
pub(crate) struct NewFolder {
    kind: &'static Kind,
    /// As the user named it.
    shown: PathBuf,
    /// Absolute, with links followed.
    place: PathBuf,
    partial: Temporary,
}

impl NewFolder {
    /// Finds out whether a folder of this kind can be at `out`, and begins one beside it.
    ///
    /// # Errors
    /// When something else is there, or the operating system refuses.
    pub fn begin(out: &Path, kind: &'static Kind) -> Result<Self, FolderError> {
        let unwritable = |source| FolderError::Unwritable { folder: out.to_owned(), source };
        let place = out.canonicalize().or_else(|_| absolute(out)).map_err(unwritable)?;
        check_replaceable(&place, out, kind)?;
        let parent = place.parent().ok_or_else(|| unwritable(io::ErrorKind::InvalidInput.into()))?;
        fs::create_dir_all(parent).map_err(unwritable)?;
        let partial = Temporary::beside(&place, "partial").map_err(unwritable)?;
        Ok(Self { kind, shown: out.to_owned(), place, partial })
    }

    /// Where to write until it is published.
    pub fn path(&self) -> &Path {
        &self.partial.0
    }

    /// Puts the folder in its place; an earlier one of its kind is replaced.
    ///
    /// # Errors
    /// When something else has come there meanwhile, or the operating system refuses; then what was there still is.
    pub fn publish(self) -> Result<(), FolderError> {
        check_replaceable(&self.place, &self.shown, self.kind)?;
        let rename = || {
            // Onto an empty folder a folder can be renamed.
            let earlier = if self.place.exists() { Some(Temporary::beside(&self.place, "earlier")?) } else { None };
            if let Some(earlier) = &earlier {
                fs::rename(&self.place, &earlier.0)?;
            }
            fs::rename(self.path(), &self.place).inspect_err(|_| {
                if let Some(earlier) = &earlier {
                    let _ = fs::rename(&earlier.0, &self.place);
                }
            })
        };
        rename().map_err(|source| FolderError::Unwritable { folder: self.shown.clone(), source })
    }
}

/// Only nothing, an empty folder and an earlier one of its kind may be replaced.
fn check_replaceable(place: &Path, shown: &Path, kind: &Kind) -> Result<(), FolderError> {
    let folder = || shown.to_owned();
    let entries = match fs::read_dir(place) {
        Ok(mut entries) => entries.next(),
        Err(source) => match source.kind() {
            io::ErrorKind::NotFound => return Ok(()),
            io::ErrorKind::NotADirectory if place.exists() => return Err(FolderError::File(folder())),
            _ => return Err(FolderError::Unwritable { folder: folder(), source }),
        },
    };
    if entries.is_none() || (kind.is)(place) {
        return Ok(());
    }
    Err(FolderError::Foreign { folder: folder(), whose: kind.whose, mark: kind.mark })
}

/// A folder that is gone with its owner.
#[derive(Debug)]
struct Temporary(PathBuf);

impl Temporary {
    /// A new one beside `place`, hidden, on the same file system.
    fn beside(place: &Path, suffix: &str) -> io::Result<Self> {
        let name = place.file_name().ok_or(io::ErrorKind::InvalidInput)?;
        let (name, process) = (name.to_string_lossy(), process::id());
        // A killed run leaves its folder behind, and in containers process ids come back.
        for attempt in 0.. {
            let folder = place.with_file_name(format!(".{name}.{suffix}-{process}-{attempt}"));
            match fs::create_dir(&folder) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                created => return created.map(|()| Self(folder)),
            }
        }
        unreachable!("a file system holds fewer names than there are attempts")
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // After a rename it is gone already; and a leftover is hidden and named as partial.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MARK: &str = "ours";
    static OURS: Kind = Kind { whose: "our", mark: "a folder with our mark", is: |folder| folder.join(MARK).is_file() };

    fn publish(out: &Path) -> Result<(), FolderError> {
        let folder = NewFolder::begin(out, &OURS)?;
        fs::write(folder.path().join(MARK), "").unwrap();
        folder.publish()
    }

    fn names(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.collect()
    }

    #[test]
    fn a_new_an_empty_and_an_earlier_folder_are_taken() {
        let place = tempfile::tempdir().unwrap();
        let new = place.path().join("a/b/new");
        publish(&new).unwrap();
        fs::write(new.join("stale"), "").unwrap();
        publish(&new).unwrap();
        assert_eq!(names(&new), [MARK]);
        assert_eq!(names(new.parent().unwrap()), ["new"]);

        let empty = place.path().join("empty");
        fs::create_dir(&empty).unwrap();
        publish(&empty).unwrap();
        assert_eq!(names(&empty), [MARK]);
    }

    #[test]
    fn what_a_killed_run_left_is_no_hindrance() {
        let place = tempfile::tempdir().unwrap();
        let leftover = format!(".out.partial-{}-0", process::id());
        fs::create_dir(place.path().join(&leftover)).unwrap();
        publish(&place.path().join("out")).unwrap();
        assert!(place.path().join("out").join(MARK).exists() && place.path().join(leftover).exists());
    }

    #[test]
    fn somebody_elses_files_are_left_alone() {
        let place = tempfile::tempdir().unwrap();
        let theirs = place.path().join("theirs");
        fs::create_dir(&theirs).unwrap();
        fs::write(theirs.join("thesis.tex"), "years of work").unwrap();
        assert!(matches!(publish(&theirs), Err(FolderError::Foreign { .. })));
        assert_eq!(names(&theirs), ["thesis.tex"]);

        let file = place.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(matches!(publish(&file), Err(FolderError::File(_))));
        assert!(matches!(publish(&file.join("out")), Err(FolderError::Unwritable { .. })));
        assert!(matches!(publish(Path::new("/")), Err(FolderError::Foreign { .. })));
    }

    #[test]
    fn what_is_given_up_half_way_leaves_the_earlier_one_and_nothing_beside_it() {
        let place = tempfile::tempdir().unwrap();
        let out = place.path().join("out");
        publish(&out).unwrap();
        let given_up = NewFolder::begin(&out, &OURS).unwrap();
        fs::write(given_up.path().join("half"), "").unwrap();
        drop(given_up);
        assert_eq!(names(&out), [MARK]);
        assert_eq!(names(place.path()), ["out"]);
    }
}
