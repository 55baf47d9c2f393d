//! Means, spreads and lines.

/// The arithmetic mean; NaN of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The standard deviation; NaN of nothing.
pub fn spread(values: &[f64]) -> f64 {
    let middle = mean(values);
    (values.iter().map(|value| (value - middle).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

/// The line through points (x, y) with least squares: intercept and slope.
pub fn line(points: &[[f64; 2]]) -> [f64; 2] {
    let of = |axis: usize| points.iter().map(|point| point[axis]).collect::<Vec<_>>();
    let [x, y] = [mean(&of(0)), mean(&of(1))];
    let products: f64 = points.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
    let squares: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    [y - products / squares * x, products / squares]
}

/// Where values at growing places fall below a level for the first time, linear in between; the last place when they
/// never do, the first when they are below from the start.
pub fn falls_below(level: f64, values: &[[f64; 2]]) -> f64 {
    let Some(after) = values.iter().position(|&[_, value]| value < level) else {
        return values.last().map_or(f64::NAN, |last| last[0]);
    };
    let [end, low] = values[after];
    let Some(&[start, high]) = after.checked_sub(1).map(|before| &values[before]) else { return end };
    start + (high - level) / (high - low) * (end - start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_and_a_fall_is_placed() {
        let [intercept, slope] = line(&[[0.0, 1.0], [1.0, 3.0], [2.0, 5.0]]);
        assert!((intercept - 1.0).abs() < 1e-12 && (slope - 2.0).abs() < 1e-12);
        let falling = [[1.0, 1.0], [2.0, 0.9], [3.0, 0.5]];
        assert!((falls_below(0.8, &falling) - 2.25).abs() < 1e-12);
        assert_eq!((falls_below(1.5, &falling), falls_below(0.1, &falling)), (1.0, 3.0));
    }
}
