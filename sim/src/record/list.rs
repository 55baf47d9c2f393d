//! The text files of a TUM RGB-D folder: `#` begins a comment; every other line is a time stamp and what belongs to it,
//! in the order of time.

use std::fs;
use std::io;
use std::path::Path;
use std::str::FromStr;

use sunblind_estimator::Timestamp;

use super::error::RecordError;
use super::place::Place;
use super::stamp;

/// One line.
pub(super) struct Entry<'a> {
    /// Its time stamp.
    pub time: Timestamp,
    /// All that follows the time stamp, trimmed.
    pub rest: &'a str,
    text: &'a str,
    file: &'a Path,
}

impl Entry<'_> {
    /// The `N` values after the time stamp, each of which must be `valid`; `wanted` says what a line looks like.
    pub fn values<T: FromStr, const N: usize>(
        &self,
        kind: &str,
        valid: impl Fn(&T) -> bool,
        wanted: &'static str,
    ) -> Result<[T; N], RecordError> {
        let fault = |part: &str, problem: String| RecordError::Values { place: self.place_of(part), problem, wanted };
        let end = &self.rest[self.rest.len()..];
        let mut fields = self.rest.split_whitespace();
        let mut values = Vec::with_capacity(N);
        for index in 0..N {
            let missing = || fault(end, format!("{index} of {N} numbers after the time stamp"));
            let field = fields.next().ok_or_else(missing)?;
            let value = field.parse().ok().filter(&valid);
            values.push(value.ok_or_else(|| fault(field, format!("`{field}` is no {kind} number")))?);
        }
        match fields.next() {
            Some(extra) => Err(fault(extra, format!("`{extra}` is one field too many"))),
            None => Ok(values.try_into().unwrap_or_else(|_| unreachable!("as many as were asked for"))),
        }
    }

    /// As [`values`](Self::values), of finite numbers.
    pub fn numbers<const N: usize>(&self, wanted: &'static str) -> Result<[f64; N], RecordError> {
        self.values("finite", |value: &f64| value.is_finite(), wanted)
    }

    /// Where `part`, a slice of this line, stands.
    pub fn place_of(&self, part: &str) -> Place {
        place_of(self.file, self.text, part)
    }
}

fn place_of(file: &Path, text: &str, part: &str) -> Place {
    Place::at_offset(file, text, part.as_ptr() as usize - text.as_ptr() as usize)
}

/// The text of `file`; `wanted` says what to do when it is missing.
pub(super) fn read(file: &Path, wanted: &'static str) -> Result<String, RecordError> {
    fs::read_to_string(file).map_err(|source| match source.kind() {
        io::ErrorKind::NotFound => RecordError::NoFile { file: file.to_owned(), wanted },
        _ => RecordError::Unreadable { file: file.to_owned(), source },
    })
}

/// How the time stamps of a file follow each other.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// Each later than the one before.
    Rising,
    /// None earlier than the one before.
    NotFalling,
}

/// The entries of `text`, the content of `file`; `wanted` says what a line looks like.
pub(super) fn entries<'a>(
    file: &'a Path,
    text: &'a str,
    wanted: &'static str,
    order: Order,
) -> Result<Vec<Entry<'a>>, RecordError> {
    let mut entries: Vec<Entry> = Vec::new();
    let content = text.strip_prefix('\u{feff}').unwrap_or(text);
    for line in content.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (time, rest) = line.split_once(char::is_whitespace).unwrap_or((line, &line[line.len()..]));
        let place = || place_of(file, text, time);
        let time = stamp::parse(time).ok_or_else(|| RecordError::Time { place: place(), found: time.to_owned() })?;
        if let Some(previous) = entries.last().filter(|previous| !order.allows(previous.time, time)) {
            let (found, previous) = (time.as_secs(), previous.time.as_secs());
            return Err(RecordError::NotLater { place: place(), found, previous });
        }
        entries.push(Entry { time, rest: rest.trim_start(), text, file });
    }
    if entries.is_empty() { Err(RecordError::Empty { file: file.to_owned(), wanted }) } else { Ok(entries) }
}

impl Order {
    fn allows(self, previous: Timestamp, next: Timestamp) -> bool {
        next > previous || (self == Self::NotFalling && next == previous)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_blank_lines_and_windows_line_ends_are_skipped() {
        let text = "\u{feff}# colour\r\n\r\n0.5 rgb/a b.png\r\n  1.0\trgb/c.png  \r\n";
        let entries = entries(Path::new("rgb.txt"), text, "", Order::Rising).unwrap();
        let rest: Vec<_> = entries.iter().map(|entry| entry.rest).collect();
        assert_eq!(rest, ["rgb/a b.png", "rgb/c.png"]);
        assert_eq!(entries[1].place_of(entries[1].rest).to_string(), "rgb.txt:4:7");
    }

    #[test]
    fn time_must_move_on() {
        for text in ["1.0 a\n1.0 b\n", "2.0 a\n1.0 b\n"] {
            let error = entries(Path::new("rgb.txt"), text, "", Order::Rising).err().unwrap();
            assert!(error.to_string().starts_with("rgb.txt:2:1: "), "{error}");
        }
        let repeated = |text| entries(Path::new("groundtruth.txt"), text, "", Order::NotFalling).is_ok();
        assert!(repeated("1.0 a\n1.0 b\n") && !repeated("2.0 a\n1.0 b\n"));
    }
}
