//! How long the colour camera takes from its first row to its last: an upright edge leans while the camera turns.

use glam::{DAffine3, Vec3};

use super::bench::{Bench, Seen};
use super::scene::{Light, even, looking_north, object, panel, world};
use super::statistics::line;
use crate::kinect::{FRAME_INTERVAL, Imaging};
use crate::render::{RenderError, Sweep};

/// Turn during a frame, radians: some 11 pixels.
const TURN: f64 = 0.02;
/// Columns about the edge.
const AROUND: std::ops::Range<usize> = 260..400;

/// Column of the edge between dark (left) and bright (right) in a row, from how much of the row is dark.
fn edge(seen: &Seen, y: usize) -> f64 {
    let light = |x: usize| (f64::from(seen.frame.rgb.at(x, y)[1]) / 255.0).powf(2.2);
    let (dark, bright) = (light(AROUND.start), light(AROUND.end - 1));
    let share = |x: usize| ((bright - light(x)) / (bright - dark)).clamp(0.0, 1.0);
    AROUND.start as f64 + AROUND.map(share).sum::<f64>()
}

/// From the colour image's first row to its last, seconds.
pub(super) fn colour_readout() -> Result<f64, RenderError> {
    let half = |left: f32| panel(Vec3::new(left, 2.0, -3.0), [4.0 * Vec3::X, 6.0 * Vec3::Z], 4, Light::LED);
    let materials = vec![even("dark", [60, 60, 60], 0.3), even("bright", [200, 200, 200], 0.3)];
    let world = world("edge", vec![object("dark", half(-4.0), 0), object("bright", half(0.0), 1)], materials);
    let mut bench = Bench::with(&world, Imaging { noise: false, motion_blur: false, ..Imaging::default() })?;
    let rest = bench.look()?;
    let turned = |angle: f64| looking_north() * DAffine3::from_rotation_y(angle);
    let moving = bench.look_along(&Sweep { start: turned(-TURN / 2.0), end: turned(TURN / 2.0) })?;
    // What the lens bends is the same in both.
    let rows: Vec<_> = (60..420).map(|y| [y as f64, edge(&rest, y) - edge(&moving, y)]).collect();
    let [_, pixels_a_row] = line(&rows);
    let pixels_a_second = 525.0 * TURN / FRAME_INTERVAL;
    Ok(479.0 * pixels_a_row.abs() / pixels_a_second)
}
