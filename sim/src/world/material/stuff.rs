//! What furniture and things are made of.

use super::canvas::{Canvas, Coat};
use super::glyph::{Running, small_print, write};
use super::noise::{fractal, hash, smooth};
use super::substance::*;

/// Grain along x: bent growth rings, pores, a little figure.
fn wood(size: [f32; 2], base: Substance, depth: f32, seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, base);
    let [width, height] = size;
    canvas.each(|x, y, texel| {
        let (u, v) = (x / width, y / height);
        let bend = 0.06 * fractal(u, v, [2, 4], 3, seed);
        let rings = fractal(u, v + bend, [1, 14], 4, seed + 1) - 0.5;
        let stripe = ((v + bend) * 60.0 + 8.0 * smooth(u, v, [2, 6], seed + 2)).sin();
        let pore = if smooth(u, v, [40, 400], seed + 3) > 0.83 { -0.25 } else { 0.0 };
        let grain = depth * (1.4 * rings + 0.22 * stripe + pore);
        let [r, g, b, infrared] = texel;
        // Grain is tannin and pores: only the pores stay at 830 nm.
        let visible = (1.0 + grain).max(0.1);
        [r * visible, g * visible.powf(1.2), b * visible.powf(1.4), infrared * (1.0 + 0.35 * grain)]
    });
    canvas
}

pub fn oak(size: [f32; 2], seed: u32) -> Canvas {
    wood(size, OAK, 0.55, seed)
}

pub fn walnut(size: [f32; 2], seed: u32) -> Canvas {
    wood(size, WALNUT, 0.9, seed)
}

/// A laboratory worktop: black with dust, rings and scratches.
pub fn resin(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, RESIN);
    canvas.mottle(0.01, 2, 0.25, seed);
    canvas.mottle(0.3, 3, 0.25, seed + 5);
    for mark in 0..24 {
        let [x, y, dx, dy] = [0, 1, 2, 3].map(|i| hash(mark, i, seed + 7));
        let from = [x * size[0], y * size[1]];
        let to = [from[0] + 0.3 * (dx - 0.5), from[1] + 0.3 * (dy - 0.5)];
        canvas.line(from, to, 0.002, Coat::Opaque([0.2, 0.2, 0.2, 0.21]));
    }
    for ring in 0..3 {
        let [x, y] = [0, 1].map(|i| hash(ring, i, seed + 9));
        canvas.ring([x * size[0], y * size[1]], 0.045, 0.005, Coat::Opaque([0.18, 0.16, 0.14, 0.2]));
    }
    canvas
}

/// Brushed along x.
pub fn steel(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, STEEL);
    canvas.shade(|x, y| 0.75 + 0.5 * fractal(x / size[0], y / size[1], [3, 128], 2, seed));
    canvas.mottle(0.2, 3, 0.1, seed + 4);
    canvas
}

fn coated(size: [f32; 2], base: Substance, wear: f32, seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, base);
    canvas.mottle(0.004, 1, 0.08, seed);
    canvas.mottle(0.2, 4, wear, seed + 1);
    for mark in 0..12 {
        let [x, y, dx, dy] = [0, 1, 2, 3].map(|i| hash(mark, i, seed + 2));
        let from = [x * size[0], y * size[1]];
        let to = [from[0] + 0.06 * (dx - 0.5), from[1] + 0.03 * (dy - 0.5)];
        canvas.line(from, to, 0.002, Coat::Opaque(base.map(|albedo| 0.5 * albedo + 0.12)));
    }
    canvas
}

pub fn grey_coat(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, GREY_COAT, 0.08, seed)
}

pub fn dark_coat(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, DARK_COAT, 0.2, seed)
}

pub fn grey_plastic(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, GREY_PLASTIC, 0.08, seed)
}

pub fn black_plastic(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, CARBON_BLACK, 0.25, seed)
}

pub fn blue_plastic(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, BLUE_PLASTIC, 0.12, seed)
}

pub fn red_coat(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, RED_COAT, 0.1, seed)
}

pub fn green_coat(size: [f32; 2], seed: u32) -> Canvas {
    coated(size, coat(0x2F7D5B, 0.45), 0.12, seed)
}

/// Woven cloth: threads over and under; the dye hides two tones that vanish at 830 nm.
fn fabric(size: [f32; 2], warp: u32, weft: u32, seed: u32) -> Canvas {
    let (warp, weft) = (coat(warp, CLOTH_AT_830), coat(weft, CLOTH_AT_830));
    let mut canvas = Canvas::new(size, warp);
    let thread = size[0] / 128.0;
    canvas.each(|x, y, _| {
        let (column, row) = ((x / thread) as u32, (y / thread) as u32);
        let over = (column + row) % 2 == 0;
        let (s, t) = ((x / thread).fract() - 0.5, (y / thread).fract() - 0.5);
        let round = 1.0 - 1.4 * if over { s * s } else { t * t };
        let own = 0.8 + 0.4 * if over { hash(column, 0, seed) } else { hash(row, 1, seed) };
        (if over { warp } else { weft }).map(|albedo| albedo * round * own)
    });
    canvas.mottle(0.05, 4, 0.18, seed + 2);
    canvas
}

pub fn blue_fabric(size: [f32; 2], seed: u32) -> Canvas {
    fabric(size, 0x2F4F7F, 0x1E355C, seed)
}

pub fn grey_fabric(size: [f32; 2], seed: u32) -> Canvas {
    fabric(size, 0x8A8F94, 0x5C656E, seed)
}

pub fn cardboard(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CARDBOARD);
    canvas.shade(|x, y| 0.95 + 0.1 * smooth(x / size[0], y / size[1], [100, 2], seed));
    canvas.mottle(0.02, 3, 0.12, seed + 1);
    canvas.mottle(0.3, 3, 0.1, seed + 2);
    canvas
}

/// A parcel's side: tape, a label, arrows, a stamp.
pub fn box_side(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = cardboard(size, seed);
    let [width, height] = size;
    let black = Coat::Opaque(CARBON_BLACK);
    canvas.rectangle([0.0, 0.0, width, 0.05], Coat::Opaque([0.55, 0.42, 0.25, 0.62]));
    canvas.rectangle([0.27, 0.1, 0.46, 0.24], Coat::Opaque(PAPER));
    small_print(&mut canvas, [0.28, 0.12, 0.40, 0.18], 0.011, black, seed);
    for bar in 0..24 {
        let x = 0.28 + 0.007 * bar as f32;
        canvas.rectangle([x, 0.19, x + 0.001 + 0.005 * hash(bar, 0, seed), 0.225], black);
    }
    let ink = Coat::Ink(colour(0x4A2E1A));
    write(
        &mut canvas,
        [0.03, 0.28],
        0.05,
        ["FRAGILE", "THIS UP", "SPARES", "SENSORS"][(seed % 4) as usize],
        Running::Across,
        ink,
    );
    for x in [0.06, 0.14] {
        canvas.polyline(&[[x - 0.02, 0.13], [x, 0.1], [x + 0.02, 0.13]], 0.008, ink);
        canvas.line([x, 0.1], [x, 0.2], 0.008, ink);
    }
    canvas.rectangle([0.0, height - 0.008, width, height], Coat::Opaque([0.2, 0.13, 0.08, 0.4]));
    canvas
}

/// Leaf green with veins.
pub fn leaf(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, LEAF);
    canvas.mottle(0.03, 4, 0.45, seed);
    let [width, height] = size;
    for vein in 0..8 {
        let y = height * (vein as f32 + 0.5) / 8.0;
        for x in [0.0, width] {
            canvas.line([0.5 * width, y], [x, y - 0.03], 0.0016, Coat::Opaque([0.13, 0.2, 0.09, 0.5]));
        }
    }
    canvas.line([0.5 * width, 0.0], [0.5 * width, height], 0.003, Coat::Opaque([0.18, 0.26, 0.12, 0.5]));
    canvas
}

pub fn soil(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, SOIL);
    canvas.mottle(0.02, 4, 0.8, seed);
    canvas
}

pub fn clay(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CLAY);
    canvas.mottle(0.15, 5, 0.2, seed);
    canvas
}
