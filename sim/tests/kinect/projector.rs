//! Where the projector's light goes.

use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::projector::{PINCUSHION, PITCH, Projector, TILE_BRIGHTNESS};

#[test]
fn nine_equal_tiles_are_thrown() {
    let projector = Projector::of(&Calibration::nominal());
    // Into the lens: the grid's tangent, stretched by the pincushion.
    let light = |column: f64, row: f64| {
        let (x, y) = ((column - 316.0) * PITCH, (row - 247.0) * PITCH);
        let stretch = 1.0 + PINCUSHION * (x * x + y * y);
        projector.light_towards(x * stretch - projector.toe_in, y * stretch)
    };
    for (across, down) in (0..9).map(|tile| (tile % 3, tile / 3)) {
        let brightness = TILE_BRIGHTNESS[down][across];
        for (column, row) in (0..211 * 165).step_by(37).map(|position| (position % 211, position / 211)) {
            let there = light((across * 211 + column) as f64, (down * 165 + row) as f64) / brightness;
            let middle = light((211 + column) as f64, (165 + row) as f64) / TILE_BRIGHTNESS[1][1];
            assert!((there - middle).abs() < 0.02, "tile ({across}, {down}), position ({column}, {row})");
        }
    }
    let outside = [light(-1.0, 200.0), light(633.0, 200.0), light(300.0, -1.0), light(300.0, 495.0)];
    assert_eq!(outside, [0.0; 4], "633 × 495 positions and no more");
}
