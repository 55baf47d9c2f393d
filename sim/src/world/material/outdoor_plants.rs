//! Leaves, bark, blossoms. Leaves are dark in visible light and bright at 830 nm. The gaps between them are dark in
//! visible light; at 830 nm leaves pass on nearly half of what they get, so gaps are half as dark.

use super::canvas::{Canvas, Coat};
use super::noise::{fractal, hash};
use super::outdoor_ground::repeated;
use super::substance::*;

/// Green that gets a share of the light: at 830 nm what passes through leaves fills in half of the shade. A guess.
pub fn shaded(green: Substance, share: f32) -> Substance {
    let [r, g, b, infrared] = green;
    [r * share, g * share, b * share, infrared * (0.5 + 0.5 * share)]
}

/// Leaves of about `length` metres, the later the nearer and the brighter.
fn leaves(size: [f32; 2], green: Substance, count: u32, length: f32, seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, shaded(green, 0.16));
    let [width, height] = size;
    for leaf in 0..count {
        let [x, y, turn, tone] = [0, 1, 2, 3].map(|i| hash(leaf, i, seed));
        let (sin, cos) = (6.3 * turn).sin_cos();
        let [long, wide] = [0.5, 0.27].map(|share| share * length * (0.7 + 0.6 * hash(leaf, 4, seed)));
        // Deep ones are in the shade of those above.
        let depth = leaf as f32 / count as f32;
        let lit = (0.22 + 0.95 * depth) * (0.7 + 0.6 * tone);
        let [r, g, b, infrared] = shaded(green, lit);
        let yellow = 0.6 * hash(leaf, 5, seed);
        let coat = Coat::Opaque([r * (0.8 + yellow), g, b * (1.1 - 0.5 * yellow), infrared.min(0.62)]);
        let rib = Coat::Opaque([r * 1.5, g * 1.4, b * 1.3, infrared.min(0.6)]);
        repeated(size, [x * width, y * height], length, |[x, y]| {
            let area = [x - length, y - length, x + length, y + length];
            canvas.cover(area, coat, |px, py| {
                let (dx, dy) = (px - x, py - y);
                let (along, across) = (dx * cos + dy * sin, dy * cos - dx * sin);
                // Pointed at both ends: two arcs.
                across.abs() - wide * (1.0 - (along / long).powi(2))
            });
            canvas.line([x - long * cos, y - long * sin], [x + long * cos, y + long * sin], 0.002, rib);
        });
    }
    canvas
}

/// A lime's crown.
pub fn foliage(size: [f32; 2], seed: u32) -> Canvas {
    leaves(size, [0.063, 0.115, 0.037, 0.54], 1500, 0.062, seed)
}

/// A clipped hornbeam hedge.
pub fn hedge(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = leaves(size, [0.048, 0.09, 0.03, 0.50], 2600, 0.036, seed);
    canvas.mottle(0.25, 3, 0.3, seed + 8);
    canvas
}

/// Sprays of a conifer: bluish, narrow.
pub fn needles(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, shaded(NEEDLES, 0.15));
    let [width, height] = size;
    for needle in 0..7000 {
        let [x, y, turn, tone] = [0, 1, 2, 3].map(|i| hash(needle, i, seed));
        let (sin, cos) = (1.57 + 1.6 * (turn - 0.5)).sin_cos();
        let lit = (0.2 + 0.9 * needle as f32 / 7000.0) * (0.6 + 0.8 * tone);
        let coat = Coat::Opaque(shaded(NEEDLES, lit));
        repeated(size, [x * width, y * height], 0.04, |[x, y]| {
            canvas.line([x, y], [x + 0.03 * cos, y + 0.03 * sin], 0.004, coat);
        });
    }
    canvas
}

/// Furrowed bark; moss on one side.
pub fn bark(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, BARK);
    let [width, height] = size;
    canvas.shade(|x, y| {
        let bend = 0.08 * fractal(x / width, y / height, [3, 4], 3, seed);
        let ridge = fractal(x / width + bend, y / height, [16, 4], 4, seed + 1);
        0.3 + 1.4 * ((ridge - 0.32) * 2.4).clamp(0.0, 1.0)
    });
    canvas.each(|x, y, texel| {
        let moss = (fractal(x / width, y / height, [2, 5], 4, seed + 2) - 0.62).max(0.0) * 4.0;
        let green = [0.07, 0.10, 0.03, 0.4];
        [0, 1, 2, 3].map(|i| texel[i] + moss.min(0.7) * (green[i] * 0.8 - texel[i]))
    });
    canvas
}

/// How many colours of blossom there are, side by side in the texture.
pub const BLOSSOM_COLOURS: u32 = 6;

/// Petals in [`BLOSSOM_COLOURS`] upright stripes. Their dyes vanish at 830 nm.
pub fn blossom(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PAPER);
    let stripe = size[0] / BLOSSOM_COLOURS as f32;
    let petals = [0xC22A2E, 0xF2C12E, 0xF4F0F2, 0x8B4FB0, 0xE8709A, 0xE9742B].map(colour);
    canvas.each(|x, _, _| {
        let [r, g, b] = petals[((x / stripe) as usize).min(petals.len() - 1)];
        [r, g, b, 0.6]
    });
    canvas.mottle(0.02, 3, 0.3, seed);
    canvas
}
