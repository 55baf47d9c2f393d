//! Printed things: lettering, sheets, book spines and covers. Albedo (linear RGB) at a spot, metres from the lower
//! left corner.

use glam::{Vec2, Vec3};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::material::linear;
use super::noise::{cell, fractal, hash, smoothstep};

/// Width of a letter over the height of a line.
pub const LETTER: f32 = get_raster_width(FontWeight::Bold, RasterHeight::Size32) as f32 / 32.0;

/// Ink, 0–1, of a line of text whose upper left corner is the origin: x to the right, y **down**, in line heights.
pub fn ink(text: &str, at: Vec2) -> f32 {
    if !(0.0..1.0).contains(&at.y) || at.x < 0.0 {
        return 0.0;
    }
    let position = at.x / LETTER;
    let letter = text.as_bytes().get(position as usize).map(|&byte| char::from(byte));
    let Some(glyph) = letter.and_then(|letter| get_raster(letter, FontWeight::Bold, RasterHeight::Size32)) else {
        return 0.0;
    };
    let (column, row) = ((position.fract() * glyph.width() as f32) as usize, (at.y * glyph.height() as f32) as usize);
    glyph.pixel(column, row).map_or(0.0, |ink| f32::from(ink) / 255.0)
}

/// Ink of text set at a place in a picture: `corner` is its upper left corner and `height` that of a line, metres.
pub fn set(text: &str, corner: Vec2, height: f32, at: Vec2) -> f32 {
    ink(text, Vec2::new(at.x - corner.x, corner.y - at.y) / height)
}

const PROSE: [&str; 12] = [
    "The robot did not know where it was, and neither did we.",
    "At noon the sun came round the corner of the building and the",
    "depth image emptied from left to right. What remained were the",
    "wheels, which slip, and a gyroscope, which drifts.",
    "A filter that trusts its sensors equally at every hour is wrong",
    "at most of them. Let the innovation speak first: when it grows",
    "beyond its bound, something has changed, and seldom the robot.",
    "Figure 3 shows the residuals before and after the gate.",
    "Table 2: drift in percent of the distance travelled.",
    "We drove forty metres over tiles, carpet and wet grass.",
    "Reprinted with the permission of nobody in particular.",
    "Turn the page to see how the story of the lost robot ends.",
];

const TITLES: [&str; 16] = [
    "LOST ROBOTS",
    "ON SUNLIGHT",
    "KALMAN & SONS",
    "THE GAUSSIANS",
    "ODOMETRY",
    "A HISTORY OF DUST",
    "WHEEL SLIP",
    "NOON",
    "COVARIANCE",
    "THE LONG CORRIDOR",
    "INFRARED",
    "SMALL ERRORS",
    "QUATERNION COOKING",
    "RANSAC",
    "MAPS FOR NO ONE",
    "THE PRIOR",
];

/// Cloth and paper that books are bound in.
const BINDINGS: [u32; 12] = [
    0x8c2f28, 0x1f3f5f, 0x2d5a43, 0xd9c9a0, 0x202226, 0xc46f2b, 0x5b3a66, 0xe8e4da, 0x2c7a86, 0x6d6a5e, 0xb93a4a,
    0x31457a,
];

fn pick<T: Copy>(from: &[T], seed: u32) -> T {
    from[hash(seed) as usize % from.len()]
}

/// The cloth a book is bound in.
pub fn binding(seed: u32, at: Vec2) -> Vec3 {
    linear(pick(&BINDINGS, seed)) * (0.85 + 0.3 * fractal(at * 90.0, 3, seed))
}

/// The back of a book, lettered from top to bottom.
pub fn spine(seed: u32, at: Vec2, size: Vec2) -> Vec3 {
    let cloth = binding(seed, at);
    let dark = cloth.element_sum() > 0.8;
    let foil = linear(if dark { 0x22_20_20 } else { pick(&[0xe8_d8_a0, 0xf4_f2_ea, 0xd0_a0_40], seed ^ 9) });
    let top = size.y - at.y;
    let band = |from: f32, to: f32| (from..to).contains(&top) || (from..to).contains(&at.y);
    if band(0.014, 0.018) || (seed.is_multiple_of(3) && band(0.022, 0.030)) {
        return foil;
    }
    let title = pick(&TITLES, seed ^ 0x3c);
    let height = (0.8 * size.x).min((size.y - 0.07) / (title.len() as f32 * LETTER));
    let turned = Vec2::new(top - 0.04, at.x - (size.x - height) / 2.0);
    let lettering = ink(title, Vec2::new(turned.x, height - turned.y) / height);
    cloth.lerp(foil, lettering)
}

/// A cover: title above a picture of soft shapes.
pub fn cover(seed: u32, at: Vec2, size: Vec2) -> Vec3 {
    let ground = linear(pick(&BINDINGS, seed));
    let second = linear(pick(&BINDINGS, seed ^ 0x1f));
    let uv = at / size;
    let shapes = fractal(at * 16.0 + 3.0 * Vec2::splat(fractal(at * 9.0, 3, seed)), 4, seed ^ 2);
    let mut colour = ground;
    if (0.12..0.66).contains(&uv.y) && (0.1..0.9).contains(&uv.x) {
        colour = second.lerp(linear(0xf0_d8_a8), smoothstep(0.35, 0.65, shapes));
        colour *= 0.7 + 0.6 * smoothstep(0.44, 0.48, (shapes * 7.0).fract());
    }
    let title = pick(&TITLES, seed ^ 0x77);
    let height = 0.8 * size.x / (title.len() as f32 * LETTER);
    let paper = linear(if ground.element_sum() > 0.8 { 0x1c_1c_20 } else { 0xf6_f0_e0 });
    let lettering = set(title, Vec2::new(0.1 * size.x, 0.9 * size.y), height.min(0.04), at)
        + set("a novel of uncertainty", Vec2::new(0.1, 0.09) * size, 0.8 * size.x / (22.0 * LETTER), at);
    colour.lerp(paper, lettering.min(1.0))
}

/// A sheet of prose with a heading, and a figure on some.
pub fn sheet(seed: u32, at: Vec2, size: Vec2) -> Vec3 {
    let margin = 0.09 * size.x;
    let width = size.x - 2.0 * margin;
    let paper = linear(0xf2_f0_ea) * (0.95 + 0.06 * fractal(at * 12.0, 3, seed));
    let height = width / (44.0 * LETTER);
    let from_top = size.y - margin - at.y;
    let mut darkness = set(pick(&TITLES, seed), Vec2::new(margin, size.y - margin), 2.2 * height, at);
    let line = ((from_top - 3.0 * height) / (1.25 * height)).floor();
    let inside = at.x < size.x - margin && at.y > margin;
    let figure = (at - size * Vec2::new(0.15, 0.14)) / (size * Vec2::new(0.7, 0.27));
    if seed.is_multiple_of(2) && figure.min_element() > 0.0 && figure.max_element() < 1.0 {
        let curve = fractal(Vec2::new(figure.x * 5.0, 0.0), 3, seed) - figure.y;
        let frame = figure.min(1.0 - figure).min_element() < 0.015;
        return if frame || curve.abs() < 0.02 {
            linear(0x30_30_38)
        } else {
            paper.lerp(linear(0x8c_b4_d4), if curve > 0.0 { 0.7 } else { 0.0 })
        };
    }
    let above_figure = !seed.is_multiple_of(2) || at.y > 0.44 * size.y;
    if line >= 0.0 && inside && above_figure {
        let text = PROSE[(hash(seed) as usize + line as usize) % PROSE.len()];
        // Now and then a paragraph ends.
        let full = cell(line as i32, 7, seed) > 0.12;
        if full || at.x < 0.6 * size.x {
            let corner = Vec2::new(margin, size.y - margin - 3.0 * height - line * 1.25 * height);
            darkness += set(text, corner, height, at);
        }
    }
    paper.lerp(linear(0x26_26_2a), darkness.min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_leave_ink_where_they_stand() {
        let share = |text| {
            let inked = (0..400)
                .filter(|i| ink(text, Vec2::new((i % 20) as f32 / 20.0 * LETTER, (i / 20) as f32 / 20.0)) > 0.5);
            inked.count() as f32 / 400.0
        };
        assert!(share("M") > 0.15 && share("M") < 0.6);
        assert_eq!(share(" "), 0.0);
        assert_eq!(ink("M", Vec2::new(-0.1, 0.5)) + ink("M", Vec2::new(9.0, 0.5)) + ink("M", Vec2::new(0.1, 1.5)), 0.0);
    }
}
