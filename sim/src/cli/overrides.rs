//! `--set key=value` where there is no scenario: an estimator parameter changed for one run.

use sunblind_estimator::EstimatorParams;
use thiserror::Error;

use crate::record::Place;
use crate::scenario::Override;

/// How many keys are offered for one that does not exist.
const OFFERED: usize = 3;

/// A `--set` that can't be followed.
#[derive(Debug, Error)]
pub(super) enum OverrideError {
    /// No such parameter.
    #[error("--set {key}: no such parameter; did you mean {}?", offered.join(", "))]
    Unknown { key: String, offered: Vec<String> },
    /// Not a value of this parameter, or a key that was set before.
    #[error("--set {key}={value}: {problem}")]
    Value { key: String, value: String, problem: String },
}

/// The estimator's defaults with `overrides` applied.
pub(super) fn params(overrides: &[Override]) -> Result<EstimatorParams, OverrideError> {
    // One line each, so that the line of an error says whose it is.
    let document: String = overrides.iter().map(|Override { key, value, .. }| format!("{key} = {value}\n")).collect();
    toml::from_str(&document).map_err(|error| {
        let offset = error.span().map_or(0, |span| span.start);
        let line = Place::at_offset("--set".as_ref(), &document, offset).line;
        let Override { key, value, .. } = overrides[(line - 1).min(overrides.len() - 1)].clone();
        let valid = valid_keys();
        if valid.contains(&key) {
            OverrideError::Value { key, value, problem: error.message().replace('\n', ", ") }
        } else {
            OverrideError::Unknown { offered: nearest(&key, valid), key }
        }
    })
}

/// Every key with its groups, in the order of the parameters.
fn valid_keys() -> Vec<String> {
    fn collect(group: &str, table: &toml::Table, keys: &mut Vec<String>) {
        for (name, value) in table {
            let key = if group.is_empty() { name.clone() } else { format!("{group}.{name}") };
            match value {
                toml::Value::Table(table) => collect(&key, table, keys),
                _ => keys.push(key),
            }
        }
    }
    let defaults =
        toml::Table::try_from(EstimatorParams::default()).expect("the parameters are plain numbers and names");
    let mut keys = Vec::new();
    collect("", &defaults, &mut keys);
    keys
}

/// The keys most like `key`, the most alike first.
fn nearest(key: &str, mut valid: Vec<String>) -> Vec<String> {
    // The group is easily forgotten, so the last part counts on its own as well.
    let last = |key: &str| key.rsplit('.').next().unwrap_or_default().to_owned();
    let likeness = |other: &str| strsim::jaro_winkler(key, other).max(strsim::jaro_winkler(&last(key), &last(other)));
    valid.sort_by(|a, b| likeness(b).total_cmp(&likeness(a)));
    valid.truncate(OFFERED);
    valid
}

#[cfg(test)]
mod tests {
    use sunblind_estimator::params::Variant;

    use super::*;

    fn params_of(pairs: &[&str]) -> Result<EstimatorParams, OverrideError> {
        params(&pairs.iter().map(|pair| pair.parse().unwrap()).collect::<Vec<_>>())
    }

    #[test]
    fn a_name_needs_no_quotes() {
        assert_eq!(params_of(&[]).unwrap(), EstimatorParams::default());
        for pair in ["variant=paper", "variant = paper", "variant=\"paper\""] {
            assert_eq!(params_of(&[pair]).unwrap().variant, Variant::Paper);
        }
    }

    #[test]
    fn an_unknown_key_is_answered_with_the_nearest() {
        for pair in ["varient=paper", "odometry.variant=paper"] {
            let message = params_of(&["variant=paper", pair]).unwrap_err().to_string();
            assert!(message.contains(&pair[..7]) && message.contains("did you mean variant"), "{message}");
        }
    }

    #[test]
    fn a_wrong_value_is_shown_with_what_would_do() {
        let message = params_of(&["variant=fast"]).unwrap_err().to_string();
        assert!(message.contains("variant=\"fast\"") && message.contains("`keyframes`"), "{message}");
        assert!(params_of(&["variant=paper", "variant=keyframes"]).is_err());
        assert!(params_of(&["variant=1\nvariant=2"]).is_err());
    }
}
