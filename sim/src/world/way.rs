//! Ways to drive through a world.

use std::f64::consts::PI;

/// Distance of neighbouring points, metres, at most.
const STEP: f64 = 0.1;

/// A closed way from `start` round `corners` and back: x, y in metres, at most 10 cm apart, the last point the first.
/// Its corners are arcs of `radius` metres, the start is on a straight.
pub fn rounded_loop(start: [f64; 2], corners: &[[f64; 2]], radius: f64) -> Vec<[f64; 2]> {
    let mut points = vec![start];
    for (index, &corner) in corners.iter().enumerate() {
        let before = if index == 0 { start } else { corners[index - 1] };
        let after = corners.get(index + 1).copied().unwrap_or(start);
        let (arrive, leave) = (heading(before, corner), heading(corner, after));
        let turn = (leave - arrive + PI).rem_euclid(2.0 * PI) - PI;
        let cut_off = radius * (turn.abs() / 2.0).tan();
        let from = ahead(corner, arrive, -cut_off);
        walk(&mut points, from);
        let centre = ahead(from, arrive + turn.signum() * PI / 2.0, radius);
        let steps = (radius * turn.abs() / STEP).ceil();
        for step in 1..=steps as u32 {
            let heading = arrive + turn * f64::from(step) / steps;
            points.push(ahead(centre, heading - turn.signum() * PI / 2.0, radius));
        }
    }
    walk(&mut points, start);
    points
}

fn heading(from: [f64; 2], to: [f64; 2]) -> f64 {
    (to[1] - from[1]).atan2(to[0] - from[0])
}

fn ahead([x, y]: [f64; 2], heading: f64, distance: f64) -> [f64; 2] {
    let (sin, cos) = heading.sin_cos();
    [x + distance * cos, y + distance * sin]
}

/// Straight on, to a point.
fn walk(points: &mut Vec<[f64; 2]>, to: [f64; 2]) {
    let from = points[points.len() - 1];
    let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP).ceil().max(1.0);
    let between = |step: u32| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * f64::from(step) / steps);
    points.extend((1..steps as u32).map(between));
    points.push(to);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_is_closed_evenly_walked_and_as_long_as_it_should_be() {
        // A square of 4 m with a notch: left and right turns, and a corner of 45°.
        let corners = [[4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [2.0, 3.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0]];
        let points = rounded_loop([2.0, 0.0], &corners, 0.3);
        assert_eq!(points.first(), points.last());
        let steps: Vec<f64> =
            points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).collect();
        assert!(steps.iter().all(|step| (0.02..0.101).contains(step)), "{steps:?}");
        // Each right angle saves 2 − π/2 radii, each half of one 2·tan 22.5° − π/4.
        let saved = 0.3 * (5.0 * (2.0 - PI / 2.0) + 2.0 * (2.0 * (PI / 8.0).tan() - PI / 4.0));
        let straight = 2.0 + 4.0 + 2.0 + 1.0 + 2f64.sqrt() + 1.0 + 2.0 + 2.0;
        assert!((steps.iter().sum::<f64>() - (straight - saved)).abs() < 0.02);
    }
}
