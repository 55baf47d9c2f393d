//! What can be wrong with a scenario, and how it is said.

use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::record::Place;

/// A key whose value, or absence, makes no sense. [`Source::blame`](super::Source::blame) knows where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// From the file's root, with dots; elements of lists by number: `expect.0.metric`.
    pub key: String,
    /// What is wrong, and what to write instead.
    pub problem: String,
}

impl Fault {
    /// A fault of `key`.
    pub fn new(key: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { key: key.into(), problem: problem.into() }
    }
}

/// Where something stands that the user wrote.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Spot {
    /// In the file.
    File(Place),
    /// On the command line.
    CommandLine {
        /// The scenario that it changes.
        file: PathBuf,
        /// The option, as it was written.
        option: String,
    },
}

impl fmt::Display for Spot {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(place) => place.fmt(out),
            Self::CommandLine { file, option } => write!(out, "{} with {option}", file.display()),
        }
    }
}

/// A scenario that can't be run.
#[derive(Debug, Error)]
pub enum ScenarioError {
    /// No such file, or no text.
    #[error("{}: can't be read: {source}", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Not TOML, an unknown or missing key, or a value out of range.
    #[error("{spot}: {problem}")]
    Invalid {
        /// Where.
        spot: Spot,
        /// What, and what to write instead.
        problem: String,
    },
}

/// Key and what a reader can copy, for keys that a scenario can't do without.
const EXAMPLES: [(&str, &str); 12] = [
    ("seed", "seed = 1"),
    ("duration_s", "duration_s = 60.0"),
    ("rate_hz", "rate_hz = 30.0"),
    ("world", "[world] and name = \"laboratory\""),
    ("name", "name = \"laboratory\""),
    ("path", "[path] and kind = \"circle\""),
    ("kind", "kind = \"circle\""),
    ("floor", "floor = \"carpet\""),
    ("min_m", "min_m = [0.0, 0.0]"),
    ("max_m", "max_m = [5.0, 3.0]"),
    ("metric", "metric = \"svsf.ate_m\""),
    ("expect", "[[expect]]"),
];

/// Rust's names of types, and what they are to someone who writes TOML.
const TYPES: [(&str, &str); 5] = [
    ("expected f64", "expected a number"),
    ("expected f32", "expected a number"),
    ("expected u64", "expected a whole number, 0 or more"),
    ("expected u32", "expected a whole number, 0 or more"),
    ("expected usize", "expected a whole number, 0 or more"),
];

/// The parser's message in one line, in the user's words, with what to write instead. Serde writes "unknown field `x`,
/// expected one of `a`, `b`" (the first word in backticks is the one found) and "missing field `x`".
pub(super) fn explain(message: &str) -> String {
    let mut words = message.split('`').skip(1).step_by(2);
    let instead = words.next().and_then(|found| {
        if message.starts_with("unknown") {
            nearest(found, words).map(|nearest| format!("; did you mean `{nearest}`?"))
        } else if message.starts_with("missing") {
            let example = EXAMPLES.iter().find(|(key, _)| *key == found);
            example.map(|(_, example)| format!("; write {example}"))
        } else {
            None
        }
    });
    let line = message.trim_end().replace('\n', ", ").replace(" field `", " key `");
    let line =
        line.split_once("expected struct ").map_or(line.clone(), |(found, _)| format!("{found}expected a table"));
    let line = TYPES.iter().fold(line, |line, (rust, plain)| line.replace(rust, plain));
    line + &instead.unwrap_or_default()
}

/// The word most like `found`.
pub(super) fn nearest<'a>(found: &str, words: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = |word: &str| strsim::jaro_winkler(found, word);
    words.into_iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)))
}
