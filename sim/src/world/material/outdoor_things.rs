//! What stands about in a yard: a car, its wheels, bins.

use super::canvas::{Canvas, Coat};
use super::glyph::{Running, write};
use super::noise::{fractal, hash};
use super::substance::*;

/// The car's paint: red, organic pigment over aluminium flakes. Guess: at 830 nm the flakes are left.
const CAR: Substance = [0.36, 0.028, 0.03, 0.42];
const BLACK: Coat = Coat::Opaque([0.022, 0.022, 0.023, 0.028]);
const SEAM: Coat = Coat::Opaque([0.06, 0.008, 0.008, 0.07]);
const LAMP: Coat = Coat::Opaque([0.62, 0.63, 0.63, 0.62]);

fn body(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CAR);
    // Dust below, a hint of mirrored sky above.
    canvas.shade(|x, y| 1.12 - 0.25 * y / size[1] + 0.08 * fractal(x / size[0], y / size[1], [6, 4], 3, seed));
    canvas
}

fn glass(canvas: &mut Canvas, corners: &[[f32; 2]]) {
    let (mut low, mut high) = (corners[0], corners[0]);
    for corner in corners {
        low = [0, 1].map(|i| low[i].min(corner[i]));
        high = [0, 1].map(|i| high[i].max(corner[i]));
    }
    // Convex, clockwise as seen (y down): inside is to the right of each edge.
    canvas.cover([low[0], low[1], high[0], high[1]], Coat::Opaque(PANE), |x, y| {
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        ends.map(|(a, b)| {
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            (dy * (x - a[0]) - dx * (y - a[1])) / dx.hypot(dy)
        })
        .fold(f32::NEG_INFINITY, f32::max)
    });
}

/// Painted sheet metal without features.
pub fn car_paint(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CAR);
    canvas.mottle(0.4, 3, 0.1, seed);
    canvas
}

/// A small car from its right side, 4.0 × 1.45 m, its nose to the right: windows, doors, wheel arches.
pub fn car_side(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = body(size, seed);
    let height = size[1];
    let at = |x: f32, z: f32| [x, height - z];
    glass(&mut canvas, &[at(0.62, 0.98), at(0.86, 1.36), at(1.62, 1.38), at(1.62, 0.96)]);
    glass(&mut canvas, &[at(1.72, 0.96), at(1.72, 1.38), at(2.3, 1.36), at(2.92, 0.94)]);
    for x in [0.62, 1.67, 2.9] {
        canvas.line(at(x, 0.95), at(x + if x < 1.0 { 0.25 } else { 0.0 }, 0.3), 0.012, SEAM);
    }
    canvas.line(at(0.8, 0.28), at(2.85, 0.28), 0.014, SEAM);
    canvas.line(at(0.3, 0.78), at(3.7, 0.72), 0.012, SEAM);
    for x in [1.5, 2.62] {
        canvas.rectangle([x - 0.16, height - 0.86, x, height - 0.82], Coat::Opaque(STEEL));
    }
    canvas.rectangle([0.9, height - 0.6, 3.0, height - 0.54], BLACK);
    canvas.rectangle([0.0, height - 0.26, 4.0, height], BLACK);
    for x in [0.72, 3.2] {
        canvas.disc(at(x, 0.31), 0.38, BLACK);
    }
    canvas.rectangle([3.72, height - 0.78, 3.97, height - 0.62], LAMP);
    canvas.rectangle([3.6, height - 0.72, 3.7, height - 0.66], Coat::Opaque([0.7, 0.3, 0.05, 0.6]));
    canvas.rectangle([0.03, height - 0.92, 0.2, height - 0.62], Coat::Ink(colour(0x7A0A10)));
    canvas
}

/// Its front below the bonnet, 1.64 × 0.6 m: lamps, grille, number plate.
pub fn car_front(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = body(size, seed);
    let [width, height] = size;
    for left in [0.06, width - 0.42] {
        canvas.rectangle([left, 0.07, left + 0.36, 0.23], LAMP);
        canvas.disc([left + 0.18, 0.15], 0.06, Coat::Opaque([0.3, 0.31, 0.32, 0.3]));
        canvas.frame([left, 0.07, left + 0.36, 0.23], 0.012, BLACK);
    }
    canvas.rectangle([0.48, 0.09, width - 0.48, 0.2], BLACK);
    canvas.disc([0.5 * width, 0.145], 0.055, Coat::Opaque(STEEL));
    canvas.rectangle([0.2, height - 0.2, width - 0.2, height - 0.06], BLACK);
    plate(&mut canvas, [0.5 * width, 0.33], "KN-V1-830");
    canvas
}

/// Its tail below the rear window: lamps, plate, seams.
pub fn car_rear(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = body(size, seed);
    let [width, height] = size;
    for left in [0.05, width - 0.27] {
        canvas.rectangle([left, 0.06, left + 0.22, 0.36], Coat::Opaque([0.38, 0.02, 0.02, 0.5]));
        canvas.rectangle([left, 0.26, left + 0.22, 0.31], Coat::Opaque([0.7, 0.3, 0.05, 0.6]));
        canvas.frame([left, 0.06, left + 0.22, 0.36], 0.01, BLACK);
    }
    canvas.frame([0.3, 0.0, width - 0.3, 0.46], 0.012, SEAM);
    plate(&mut canvas, [0.5 * width, 0.22], "KN-V1-830");
    canvas.rectangle([0.1, height - 0.22, width - 0.1, height - 0.17], BLACK);
    canvas.rectangle([0.0, height - 0.07, width, height], BLACK);
    canvas
}

fn plate(canvas: &mut Canvas, [x, y]: [f32; 2], text: &str) {
    canvas.rectangle([x - 0.26, y - 0.055, x + 0.26, y + 0.055], Coat::Opaque(PAPER));
    canvas.frame([x - 0.26, y - 0.055, x + 0.26, y + 0.055], 0.008, BLACK);
    write(canvas, [x - 0.22, y - 0.03], 0.06, text, Running::Across, BLACK);
}

/// Dark windscreens.
pub fn pane(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PANE);
    canvas.shade(|x, y| 0.6 + 1.2 * fractal(x / size[0], y / size[1], [2, 3], 3, seed));
    canvas
}

/// A wheel from the side: tyre, rim with five spokes.
pub fn wheel(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CARBON_BLACK);
    let middle = [0.5 * size[0], 0.5 * size[1]];
    let rim = 0.33 * size[0];
    canvas.disc(middle, rim, Coat::Opaque(STEEL));
    for spoke in 0..5 {
        let (sin, cos) = (1.256_637 * (spoke as f32 + 0.5)).sin_cos();
        let at = [middle[0] + 0.62 * rim * cos, middle[1] + 0.62 * rim * sin];
        canvas.disc(at, 0.25 * rim, BLACK);
    }
    canvas.ring(middle, rim, 0.015, Coat::Opaque([0.3, 0.3, 0.3, 0.32]));
    canvas.disc(middle, 0.16 * rim, Coat::Opaque([0.2, 0.2, 0.2, 0.22]));
    canvas
}

/// A wheeled bin's front: ribs, an embossed label, a sticker.
pub fn bin_front(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, [0.10, 0.105, 0.11, 0.13]);
    let [width, height] = size;
    for rib in 0..4 {
        let x = width * (0.2 + 0.2 * rib as f32);
        canvas.rectangle([x - 0.008, 0.3, x + 0.008, height - 0.08], Coat::Opaque([0.06, 0.062, 0.065, 0.08]));
    }
    canvas.rectangle([0.24 * width, 0.1, 0.76 * width, 0.24], Coat::Opaque(PAPER));
    let word = ["PAPER", "GLASS", "WASTE"][(hash(0, 0, seed) * 3.0) as usize % 3];
    write(&mut canvas, [0.29 * width, 0.14], 0.055, word, Running::Across, Coat::Opaque(CARBON_BLACK));
    canvas.mottle(0.15, 4, 0.25, seed);
    canvas
}
