//! Instants as text: decimal seconds, exact to the nanosecond both ways (an f64 is not, at today's Unix times).

use sunblind_estimator::Timestamp;

/// Seconds with all nine decimals.
pub(crate) fn decimal_seconds(time: Timestamp) -> String {
    let nanos = i128::from(time.as_nanos());
    let sign = if nanos < 0 { "-" } else { "" };
    format!("{sign}{}.{:09}", nanos.abs() / 1_000_000_000, nanos.abs() % 1_000_000_000)
}

/// A decimal number of seconds; digits below the nanosecond are dropped. Other notations (1.3e9) go through f64.
pub(super) fn parse(text: &str) -> Option<Timestamp> {
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
    fn every_nanosecond_is_kept() {
        for (nanos, text) in [
            (1_305_031_102_175_304_001, "1305031102.175304001"),
            (0, "0.000000000"),
            (-1, "-0.000000001"),
            (i64::MAX, "9223372036.854775807"),
        ] {
            let time = Timestamp::from_nanos(nanos);
            assert_eq!(decimal_seconds(time), text);
            assert_eq!(parse(text), Some(time));
        }
        assert_eq!(decimal_seconds(Timestamp::from_nanos(i64::MIN)), "-9223372036.854775808");
    }

    #[test]
    fn decimals_are_exact_to_the_nanosecond() {
        let nanos = |text| parse(text).map(Timestamp::as_nanos);
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
            assert_eq!(parse(text), None, "{text}");
        }
    }
}
