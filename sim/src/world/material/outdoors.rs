//! What a window looks out on.

use super::canvas::{Canvas, Coat};
use super::noise::{fractal, hash};
use super::substance::*;

/// An overcast sky over trees, a lawn and a brick house.
pub fn park(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, SKY);
    canvas.shade(|x, y| 0.8 + 0.3 * fractal(x / width, y / height, [4, 5], 5, seed) * (1.0 - 0.4 * y / height));
    let horizon = 0.72 * height;
    let brick = Coat::Opaque([0.31, 0.17, 0.11, 0.35]);
    let (left, right, eaves) = (0.62 * width, 0.83 * width, 0.42 * height);
    canvas.rectangle([left, eaves, right, horizon], brick);
    canvas.rectangle([left - 0.2, eaves - 0.4, right + 0.2, eaves], Coat::Opaque([0.10, 0.09, 0.09, 0.14]));
    for row in 0..2 {
        for column in 0..4 {
            let (x, y) = (left + 0.45 + 0.9 * column as f32, eaves + 0.35 + 1.3 * row as f32);
            canvas.rectangle([x, y, x + 0.5, y + 0.8], Coat::Opaque([0.12, 0.15, 0.18, 0.12]));
            canvas.frame([x, y, x + 0.5, y + 0.8], 0.07, Coat::Opaque(ENAMEL));
        }
    }
    for tree in 0..9 {
        let pick = |i| hash(tree, i, seed + 1);
        let (x, crown) = (width * (tree as f32 + pick(0)) / 9.0, 0.8 + 1.1 * pick(1));
        let middle = horizon - 1.2 - 1.6 * pick(2);
        canvas.rectangle([x - 0.09, middle, x + 0.09, horizon + 0.2], Coat::Opaque([0.09, 0.065, 0.045, 0.3]));
        for puff in 0..220 {
            let [dx, dy, tone, r] = [0, 1, 2, 3].map(|i| hash(puff, i, seed + 10 + tree));
            let (dx, dy) = ((dx - 0.5) * 1.9 * crown, (dy - 0.5) * 1.9 * crown);
            if dx.hypot(dy) > crown {
                continue;
            }
            let light = (0.6 + 0.7 * tone) * (1.0 - 0.3 * dy / crown);
            let green = LEAF.map(|albedo| (albedo * light * 1.2).min(0.6));
            canvas.disc([x + dx, middle + dy], (0.04 + 0.13 * r) * crown, Coat::Opaque(green));
        }
    }
    canvas.rectangle([0.0, horizon, width, height], Coat::Opaque([0.06, 0.12, 0.045, 0.49]));
    canvas.rectangle([0.0, horizon + 0.7, width, horizon + 1.1], Coat::Opaque([0.33, 0.3, 0.26, 0.36]));
    canvas.mottle(0.3, 4, 0.25, seed + 2);
    canvas
}
