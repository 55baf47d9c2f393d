//! The projector's pattern against counts on Reichinger's map of the real one.

use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::pattern::{TILE_HEIGHT, TILE_WIDTH, Tile};
use sunblind_sim::kinect::projector::{PINCUSHION, PITCH, Projector, TILE_BRIGHTNESS};

use crate::bench::{Report, mean, spread};

fn dots_around(column: usize, row: usize, edge: usize) -> usize {
    let tile = Tile::kinect();
    let near = |at: usize, offset: usize, size: usize| (at + size + offset - edge / 2) % size;
    let places = (0..edge * edge).map(|place| (place % edge, place / edge));
    places.filter(|&(x, y)| tile.is_bright(near(column, x, TILE_WIDTH), near(row, y, TILE_HEIGHT))).count()
}

#[test]
fn a_tile_has_the_published_counts() {
    let positions = || (0..211 * 165).map(|position| (position % 211, position / 211));
    let tile = Tile::kinect();
    let dots: Vec<_> = positions().filter(|&(column, row)| tile.is_bright(column, row)).collect();
    let touching = dots.iter().filter(|&&(column, row)| dots_around(column, row, 3) > 1).count();
    let around: Vec<f64> = positions().map(|(column, row)| dots_around(column, row, 9) as f64).collect();
    let empty = positions().filter(|&(column, row)| dots_around(column, row, 5) == 0).count();
    let mut report = Report::default();
    report.expect("V9 grid positions of a tile", 34_815.0, 34_815.0..=34_815.0, (TILE_WIDTH * TILE_HEIGHT) as f64);
    report.expect("V9 dots of a tile", 3861.0, 3861.0..=3861.0, dots.len() as f64);
    report.expect("V9 dots with an 8-neighbour", 0.0, 0.0..=0.0, touching as f64);
    report.expect("V9 dots in 9×9, mean", 8.97, 8.92..=9.02, mean(&around));
    report.expect("V9 dots in 9×9, spread", 1.2, 1.1..=1.3, spread(&around));
    report.expect("V9 empty windows of 5×5", 0.0, 0.0..=0.0, empty as f64);
    report.finish();
}

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
