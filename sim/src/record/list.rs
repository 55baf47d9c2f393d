//! The text files of a TUM RGB-D folder: `#` begins a comment; every other line is a time stamp and what belongs to it,
//! in the order of time.

use std::fs;
use std::io;
use std::path::Path;

use sunblind_estimator::Timestamp;

use super::error::RecordError;
use super::place::Place;

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
        let (stamp, rest) = line.split_once(char::is_whitespace).unwrap_or((line, &line[line.len()..]));
        let place = || place_of(file, text, stamp);
        let time = parse_time(stamp).ok_or_else(|| RecordError::Time { place: place(), found: stamp.to_owned() })?;
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

/// A decimal number of seconds, exact to the nanosecond (an f64 is not, at today's Unix times); digits below
/// that are dropped. Other notations (1.3e9) go through f64.
fn parse_time(text: &str) -> Option<Timestamp> {
    exact_nanos(text).map(Timestamp::from_nanos).or_else(|| Timestamp::from_secs(text.parse().ok()?))
}

fn exact_nanos(text: &str) -> Option<i64> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(digits) => (true, digits),
        None => (false, text),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if whole.is_empty() || !whole.bytes().chain(fraction.bytes()).all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let seconds: i64 = whole.parse().ok()?;
    let nanos = fraction.bytes().chain(std::iter::repeat(b'0')).take(9);
    let nanos = nanos.fold(0, |nanos, digit| nanos * 10 + i64::from(digit - b'0'));
    let total = seconds.checked_mul(1_000_000_000)?.checked_add(nanos)?;
    Some(if negative { -total } else { total })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact_to_the_nanosecond() {
        let nanos = |text| parse_time(text).map(Timestamp::as_nanos);
        assert_eq!(nanos("1305031102.175304"), Some(1_305_031_102_175_304_000));
        // The nearest f64 to this is 96 ns away.
        assert_eq!(nanos("1305031102.123456789"), Some(1_305_031_102_123_456_789));
        assert_eq!(nanos("0.0333333339"), Some(33_333_333));
        assert_eq!(nanos("-1.5"), Some(-1_500_000_000));
        assert_eq!(nanos("7"), Some(7_000_000_000));
        assert_eq!(nanos("1.5e3"), Some(1_500_000_000_000));
    }

    #[test]
    fn what_is_no_time_is_refused() {
        for text in ["", "-", "nan", "inf", "1.2.3", "12,5", "1_0", "99999999999999999999", "rgb/0.png"] {
            assert_eq!(parse_time(text), None, "{text}");
        }
    }

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
