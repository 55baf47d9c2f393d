//! What was measured, as a table.

use super::{Experiment, Finding};

/// The columns.
pub const HEADER: [&str; 7] = ["target", "what", "wanted", "accepted", "measured", "held", "source"];

/// A finding's cells, in the columns' order.
pub fn row(experiment: &Experiment, finding: &Finding) -> [String; HEADER.len()] {
    let held = if finding.held() { "yes" } else { "NO" };
    let (low, high) = (*finding.accepted.start(), *finding.accepted.end());
    let accepted = match high {
        f64::INFINITY => format!("from {}", number(low)),
        _ if low == high => "exactly that".to_owned(),
        _ => format!("{} to {}", number(low), number(high)),
    };
    [
        experiment.target.to_owned(),
        finding.what.clone(),
        number(finding.target),
        accepted,
        number(finding.measured),
        held.to_owned(),
        experiment.source.name().to_owned(),
    ]
}

/// Four digits that count, no zeros at the end.
fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let before_point = value.abs().log10().floor() as i32 + 1;
    let digits = (4 - before_point).clamp(0, 6) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

const PREAMBLE: &str = "\
# The simulated Kinect against the real one
Written by `sunblind validate --markdown VALIDATION.md`; a test holds the targets to it.

`published` targets were measured on real devices or follow from their published build. `model` targets come from photon
counts of the dots against the sun's, as nobody has published how much depth a Kinect v1 has by illuminance; they are
uncertain by a factor of two in light.

";

/// A page with everything measured.
pub fn markdown(measured: &[(&Experiment, Vec<Finding>)]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut page = PREAMBLE.to_owned();
    page += &line(&HEADER.map(str::to_owned));
    page += &line(&HEADER.map(|_| "---".to_owned()));
    for (experiment, findings) in measured {
        findings.iter().for_each(|finding| page += &line(&row(experiment, finding)));
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_count() {
        let cases = [(0.002873, "0.002873"), (34815.0, "34815"), (1.0, "1"), (23.456789, "23.46"), (0.0, "0")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
        assert_eq!((number(f64::NAN), number(-0.51)), ("NaN".into(), "-0.51".into()));
    }
}
