//! What had to hold, and whether it did.

use serde::Serialize;

use crate::scenario::expect::Judged;

#[derive(Serialize)]
pub(super) struct Expectations<'a> {
    /// "All 3 expectations held".
    pub title: String,
    pub held: bool,
    pub rows: Vec<Row<'a>>,
}

#[derive(Serialize)]
pub(super) struct Row<'a> {
    pub name: &'a str,
    pub value: String,
    pub bound: String,
    pub held: bool,
}

/// `None` when nothing was expected.
pub(super) fn expectations(judged: &[Judged]) -> Option<Expectations<'_>> {
    if judged.is_empty() {
        return None;
    }
    let missed = judged.iter().filter(|expectation| !expectation.held).count();
    let title = match (missed, judged.len()) {
        (0, 1) => "What was expected held".into(),
        (0, all) => format!("All {all} expectations held"),
        (1, 1) => "What was expected was missed".into(),
        (missed, all) => format!("{missed} of {all} expectations missed"),
    };
    let rows = judged
        .iter()
        .map(|Judged { name, value, bound, held }| Row {
            name,
            value: number(*value),
            bound: bound.to_string(),
            held: *held,
        })
        .collect();
    Some(Expectations { title, held: missed == 0, rows })
}

/// With four significant digits, in the metric's own unit, which its name ends with.
fn number(value: f64) -> String {
    if !value.is_finite() {
        return "not measured".into();
    }
    let magnitude = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    format!("{value:.*}", (3.0 - magnitude).clamp(0.0, 9.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        let all = [0.0, 0.012345, 0.5, 12.3456, 12345.6, -0.1, f64::NAN].map(number);
        assert_eq!(all, ["0.000", "0.01235", "0.5000", "12.35", "12346", "-0.1000", "not measured"]);
    }
}
