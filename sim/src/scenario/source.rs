//! A scenario as it was written, which knows where each key stands.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::error::{Fault, ScenarioError, Spot, explain};
use super::overrides::Override;
use crate::record::Place;

/// A file's text, and what the command line changes of it.
#[derive(Clone, Debug)]
pub struct Source {
    file: PathBuf,
    text: String,
    /// Each with its line of TOML. The line begins with as many spaces as there are bytes in the text and in the lines
    /// before, so that an offset belongs either to the text or to one override.
    overrides: Vec<(Override, String)>,
}

impl Source {
    /// Reads a file.
    ///
    /// # Errors
    /// No such file, or no text.
    pub fn read(file: &Path, overrides: &[Override]) -> Result<Self, ScenarioError> {
        let text =
            fs::read_to_string(file).map_err(|source| ScenarioError::Unreadable { file: file.to_owned(), source })?;
        Ok(Self::new(text, file, overrides))
    }

    /// From text; `file` only names it in errors, and says what its paths are relative to.
    pub fn new(text: impl Into<String>, file: &Path, overrides: &[Override]) -> Self {
        let text = text.into();
        let mut end = text.len();
        let mut line = |change: &Override| {
            let line = format!("{}{} = {}", " ".repeat(end + 1), change.key, change.value);
            end = line.len();
            (change.clone(), line)
        };
        let overrides = overrides.iter().map(&mut line).collect();
        Self { file: file.to_owned(), text, overrides }
    }

    /// The file, as the user named it.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// What is written, as a `T`.
    ///
    /// # Errors
    /// Not TOML, an unknown or missing key, or a value of the wrong type.
    pub(super) fn parse<T: DeserializeOwned>(&self) -> Result<T, ScenarioError> {
        T::deserialize(Deserializer::from(self.tree()?)).map_err(|error| self.not_understood(&error))
    }

    /// The text at a dotted key, if there is one.
    pub(super) fn text_at(&self, key: &str) -> Result<Option<String>, ScenarioError> {
        let tree = self.tree()?;
        let mut value = None;
        for part in key.split('.') {
            let table = value.map_or(Some(tree.get_ref()), |value: &Spanned<DeValue>| value.get_ref().as_table());
            value = table.and_then(|table| table.get(part));
            if value.is_none() {
                return Ok(None);
            }
        }
        Ok(value.and_then(|value| value.get_ref().as_str()).map(str::to_owned))
    }

    /// The error that a fault is, at the place where its key stands; where it is missing, at its table.
    pub fn blame(&self, fault: Fault) -> ScenarioError {
        let offset = self.tree().map_or(0, |tree| span_of(&fault.key, tree.get_ref()).start);
        ScenarioError::Invalid { spot: self.spot(offset), problem: fault.problem }
    }

    /// The text with the overrides in it; the last of those with one key counts.
    fn tree(&self) -> Result<Spanned<DeTable<'_>>, ScenarioError> {
        let parse = |text| DeTable::parse(text).map_err(|error| self.not_understood(&error));
        let mut tree = parse(&self.text)?;
        for (_, line) in &self.overrides {
            merge(tree.get_mut(), parse(line)?.into_inner());
        }
        Ok(tree)
    }

    fn not_understood(&self, error: &toml::de::Error) -> ScenarioError {
        let offset = error.span().map_or(0, |span| span.start);
        ScenarioError::Invalid { spot: self.spot(offset), problem: explain(error.message()) }
    }

    fn spot(&self, offset: usize) -> Spot {
        if offset > self.text.len()
            && let Some((change, _)) = self.overrides.iter().find(|(_, line)| offset <= line.len())
        {
            return Spot::CommandLine { file: self.file.clone(), option: change.to_string() };
        }
        Spot::File(Place::at_offset(&self.file, &self.text, offset))
    }
}

fn merge<'a>(into: &mut DeTable<'a>, from: DeTable<'a>) {
    for (key, value) in from {
        let span = value.span();
        match (into.get_mut(key.get_ref().as_ref()).map(Spanned::get_mut), value.into_inner()) {
            (Some(DeValue::Table(into)), DeValue::Table(from)) => merge(into, from),
            (_, value) => drop(into.insert(key, Spanned::new(span, value))),
        }
    }
}

/// Where the value of a dotted key stands, or the nearest thing around it.
fn span_of(key: &str, table: &DeTable) -> Range<usize> {
    let (first, rest) = key.split_once('.').unwrap_or((key, ""));
    let Some(mut value) = table.get(first) else { return 0..0 };
    for part in rest.split('.') {
        let inner = match value.get_ref() {
            DeValue::Table(table) => table.get(part),
            DeValue::Array(array) => part.parse().ok().and_then(|index: usize| array.get(index)),
            _ => None,
        };
        let Some(inner) = inner else { break };
        value = inner;
    }
    value.span()
}
