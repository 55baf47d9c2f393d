//! Where in a text file something stands.

use std::fmt;
use std::path::{Path, PathBuf};

/// A spot in a text file, shown as `file:line:column`. Lines and columns count from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, as the user named it.
    pub file: PathBuf,
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

impl Place {
    /// The spot `offset` bytes into `text`, the content of `file`.
    pub fn at_offset(file: &Path, text: &str, offset: usize) -> Self {
        let before = &text[..text.floor_char_boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}:{}:{}", self.file.display(), self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_not_bytes() {
        let text = "a\nµµ = 1\n";
        let place = Place::at_offset(Path::new("f"), text, text.find('=').unwrap());
        assert_eq!(place.to_string(), "f:2:4");
        assert_eq!(Place::at_offset(Path::new("f"), text, 999).to_string(), "f:3:1");
        assert_eq!(Place::at_offset(Path::new("f"), "", 0).to_string(), "f:1:1");
    }
}
