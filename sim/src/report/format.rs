//! Numbers as people read them.

/// Between a number and its unit: no line breaks there.
const NARROW: char = '\u{202f}';
const MISSING: &str = "–";

/// A length in the unit that suits it: `0.32 mm`, `3.4 mm`, `2.1 cm`, `12.30 m`; a dash for what isn't finite.
pub(super) fn length(metres: f64) -> String {
    match metres.abs() {
        size if !size.is_finite() => MISSING.into(),
        size if size < 0.001 => format!("{:.2}{NARROW}mm", metres * 1e3),
        size if size < 0.01 => format!("{:.1}{NARROW}mm", metres * 1e3),
        size if size < 1.0 => format!("{:.1}{NARROW}cm", metres * 1e2),
        _ => format!("{metres:.2}{NARROW}m"),
    }
}

/// An angle: `1.05°`, `0.031°`.
pub(super) fn angle(degrees: f64) -> String {
    match degrees.abs() {
        size if !size.is_finite() => MISSING.into(),
        size if size < 0.1 => format!("{degrees:.3}°"),
        _ => format!("{degrees:.2}°"),
    }
}

/// A percentage: `2.3 %`.
pub(super) fn percent(value: f64) -> String {
    if value.is_finite() { format!("{value:.1}{NARROW}%") } else { MISSING.into() }
}

/// A number without a unit: `2.7`, `134`.
pub(super) fn plain_number(value: f64) -> String {
    match value.abs() {
        size if !size.is_finite() => MISSING.into(),
        size if size < 100.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}

/// A time of work: `4.2 ms`, `48 ms`, `1.3 s`.
pub(super) fn milliseconds(value: f64) -> String {
    match value {
        value if !value.is_finite() => MISSING.into(),
        value if value < 10.0 => format!("{value:.1}{NARROW}ms"),
        value if value < 1000.0 => format!("{value:.0}{NARROW}ms"),
        value => format!("{:.1}{NARROW}s", value * 1e-3),
    }
}

/// A duration: `9.97 s`, `12.4 s`, `3 min 20 s`.
pub(super) fn duration(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 10.0 => format!("{seconds:.2}{NARROW}s"),
        seconds if seconds < 120.0 => format!("{seconds:.1}{NARROW}s"),
        seconds => format!("{:.0}{NARROW}min {:.0}{NARROW}s", (seconds / 60.0).floor(), (seconds % 60.0).floor()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_one_would_say_them() {
        let plain = |text: String| text.replace(NARROW, " ");
        assert_eq!(plain(length(0.00032)), "0.32 mm");
        assert_eq!(plain(length(0.0034)), "3.4 mm");
        assert_eq!(plain(length(0.0213)), "2.1 cm");
        assert_eq!(plain(length(2.1111)), "2.11 m");
        assert_eq!(length(f64::NAN), MISSING);
        assert_eq!(angle(0.0312), "0.031°");
        assert_eq!(plain(milliseconds(3.04)), "3.0 ms");
        assert_eq!(plain(milliseconds(1250.0)), "1.2 s");
        assert_eq!(plain(duration(200.4)), "3 min 20 s");
    }
}
