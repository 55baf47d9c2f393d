//! `--set key=value`, `--seed N` and `--quality HOW`: what is changed for one run.

use std::fmt;
use std::str::FromStr;

/// One `key=value`; the key of a value in a table is dotted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// From the root.
    pub key: String,
    /// The value as TOML; what is no TOML is a string, so that names need no quotes.
    pub value: String,
    option: &'static str,
}

impl Override {
    /// `--seed N`.
    pub fn seed(seed: u64) -> Self {
        Self { key: "seed".into(), value: seed.to_string(), option: "--seed" }
    }

    /// `--set KEY=VALUE`.
    pub fn set(key: &str, value: &str) -> Self {
        Self { key: key.into(), value: as_toml(value), option: "--set" }
    }

    /// `--quality HOW`.
    pub fn quality(quality: &str) -> Self {
        Self { key: "kinect.quality".into(), value: as_toml(quality), option: "--quality" }
    }
}

impl FromStr for Override {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (key, value) = text.split_once('=').ok_or("write key=value")?;
        let is_key =
            |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        let key = key.trim();
        if !key.split('.').all(is_key) {
            return Err("a key has letters, digits and underscores, with dots between groups");
        }
        Ok(Self { key: key.to_owned(), value: as_toml(value.trim()), option: "--set" })
    }
}

/// As on the command line.
impl fmt::Display for Override {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, value, option } = self;
        if *option == "--set" { write!(out, "{option} {key}={value}") } else { write!(out, "{option} {value}") }
    }
}

fn as_toml(value: &str) -> String {
    match toml::from_str::<toml::Table>(&format!("value = {value}")) {
        Ok(table) if table.len() == 1 => table["value"].to_string(),
        _ => toml::Value::from(value).to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_needs_a_key_and_an_equals_sign() {
        for text in ["variant", "=paper", "a..b=1", "[x]\na=1", ""] {
            assert!(text.parse::<Override>().is_err(), "{text:?}");
        }
    }

    #[test]
    fn a_name_needs_no_quotes_and_is_shown_as_it_counts() {
        for text in ["path.kind=circle", "path.kind = \"circle\""] {
            assert_eq!(text.parse::<Override>().unwrap().to_string(), "--set path.kind=\"circle\"");
        }
        assert_eq!(Override::seed(7).to_string(), "--seed 7");
        assert_eq!(Override::quality("fast").to_string(), "--quality \"fast\"");
    }
}
