//! A mean over several runs, and how well they tell it.

/// Student's t below which 97.5 % lie, for 1 to 30 degrees of freedom: NIST/SEMATECH e-Handbook of Statistical Methods,
/// §1.3.6.7.2.
const STUDENT_975: [f64; 30] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
    2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
];
/// The same of the normal distribution.
const NORMAL_975: f64 = 1.959_964;

pub(super) fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The mean, and with several values half its 95 % interval: `0.082 ± 0.013`. A dash for what was not measured.
pub(super) fn mean_and_interval(values: impl ExactSizeIterator<Item = f64> + Clone) -> String {
    let mean = mean(values.clone());
    match half_interval(values) {
        _ if mean.is_nan() => "–".into(),
        Some(half) => format!("{mean:.3} ± {half:.3}"),
        None => format!("{mean:.3}"),
    }
}

/// Half the interval that holds the mean of all runs with 95 % confidence, as far as runs are normally distributed:
/// t s / √n. `None` of fewer than two values.
fn half_interval(values: impl ExactSizeIterator<Item = f64> + Clone) -> Option<f64> {
    let freedom = values.len().checked_sub(1).filter(|freedom| *freedom > 0)?;
    let mean = mean(values.clone());
    let variance = values.map(|value| (value - mean).powi(2)).sum::<f64>() / freedom as f64;
    Some(student_975(freedom) * (variance / (freedom + 1) as f64).sqrt())
}

/// Beyond the table by Abramowitz & Stegun, eq. 26.7.5, to its second term.
fn student_975(freedom: usize) -> f64 {
    let (z, n) = (NORMAL_975, freedom as f64);
    let series = || z + (z.powi(3) + z) / (4.0 * n) + (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / (96.0 * n * n);
    STUDENT_975.get(freedom - 1).copied().unwrap_or_else(series)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_runs_tell_a_mean_badly() {
        // s = 1, t = 4.303.
        assert_eq!(mean_and_interval([1.0, 2.0, 3.0].into_iter()), "2.000 ± 2.484");
        assert_eq!(mean_and_interval([2.0; 5].into_iter()), "2.000 ± 0.000");
        assert_eq!(mean_and_interval([2.0].into_iter()), "2.000");
        assert_eq!(mean_and_interval([2.0, f64::NAN].into_iter()), "–");
    }

    #[test]
    fn the_table_goes_over_into_the_series() {
        // As tables have them.
        for (freedom, t) in [(30, 2.042), (31, 2.0395), (40, 2.0211), (100, 1.9840)] {
            assert!((student_975(freedom) - t).abs() < 5e-4, "{freedom}");
        }
    }
}
