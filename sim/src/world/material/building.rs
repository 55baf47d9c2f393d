//! What a building is made of.

use super::canvas::{Canvas, Coat};
use super::glyph::{Running, write};
use super::noise::{fractal, hash, smooth};
use super::substance::*;

/// Rolled paint over plaster: almost bare. A faint orange peel, faint clouds, a few scuffs and a filled hole.
pub fn wall_paint(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, WALL_PAINT);
    canvas.mottle(0.5, 3, 0.025, seed);
    canvas.mottle(0.012, 2, 0.03, seed + 10);
    for mark in 0..9 {
        let [x, y, angle, length] = [0, 1, 2, 3].map(|i| hash(mark, i, seed + 20));
        let (from, reach) = ([x * size[0], y * size[1]], 0.02 + 0.1 * length);
        let (sin, cos) = (6.3 * angle).sin_cos();
        canvas.line(
            from,
            [from[0] + reach * cos, from[1] + 0.3 * reach * sin],
            0.003,
            Coat::Opaque([0.6, 0.58, 0.53, 0.66]),
        );
    }
    canvas.disc([0.31 * size[0], 0.64 * size[1]], 0.012, Coat::Opaque([0.83, 0.83, 0.81, 0.84]));
    canvas
}

/// Terrazzo tiles of 30 cm, each of its own tone, grouted.
pub fn floor_tile(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CERAMIC);
    let edge = 0.3;
    let count = (size[0] / edge).round() as u32;
    let cell = |metres: f32| ((metres / edge) as u32).min(count - 1);
    canvas.shade(|x, y| 0.86 + 0.28 * hash(cell(x), cell(y), seed));
    canvas.each(|x, y, [r, g, b, infrared]| {
        // A few tiles were replaced from another batch.
        let warm = if hash(cell(x), cell(y), seed + 1) > 0.86 { [1.06, 1.0, 0.88] } else { [1.0; 3] };
        [r * warm[0], g * warm[1], b * warm[2], infrared]
    });
    canvas.mottle(0.08, 4, 0.16, seed + 2);
    // Terrazzo: chips of marble, dark, light and reddish, of 5 to 40 mm, most of them small.
    for chip in 0..2200 {
        let [x, y, tone, radius] = [0, 1, 2, 3].map(|i| hash(chip, i, seed + 3));
        let tone = match tone {
            0.6.. => [0.62, 0.61, 0.57, 0.64],
            0.2.. => [0.17, 0.16, 0.15, 0.2],
            _ => [0.33, 0.22, 0.17, 0.38],
        };
        canvas.disc([x * size[0], y * size[1]], 0.0025 + 0.0175 * radius.powi(3), Coat::Opaque(tone));
    }
    for line in 0..count {
        let at = (line as f32 + 0.5) * edge;
        canvas.rectangle([at - 0.003, 0.0, at + 0.003, size[1]], Coat::Opaque(GROUT));
        canvas.rectangle([0.0, at - 0.003, size[0], at + 0.003], Coat::Opaque(GROUT));
    }
    canvas.mottle(0.6, 3, 0.08, seed + 4);
    canvas
}

/// Loop pile in squares of 50 cm, each turned a quarter against its neighbour; flecked, dashed with other yarn, worn.
pub fn carpet(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CARPET);
    let [width, height] = size;
    canvas.each(|x, y, [r, g, b, infrared]| {
        let turned = ((x / 0.5) as u32 + (y / 0.5) as u32) % 2 == 1;
        let (along, across) = if turned { (y, x) } else { (x, y) };
        let rib = 0.75 + 0.5 * smooth(along / width, across / height, [24, 125], seed);
        let fleck = hash((x * 400.0) as u32, (y * 400.0) as u32, seed + 1);
        let fleck = if fleck > 0.93 { 2.6 } else { 0.7 + 0.6 * fleck };
        let square = if turned { 0.82 } else { 1.1 };
        let visible = rib * fleck * square;
        // At 830 nm only the pile's own shadows are left.
        [r * visible, g * visible, b * visible, infrared * (0.6 + 0.4 * rib)]
    });
    // Dashes of other yarn along the ribs.
    for dash in 0..420 {
        let [x, y, tone, length] = [0, 1, 2, 3].map(|i| hash(dash, i, seed + 3));
        let (x, y) = (x * width, y * height);
        let turned = ((x / 0.5) as u32 + (y / 0.5) as u32) % 2 == 1;
        let (wide, long) = (0.008, 0.02 + 0.06 * length);
        let [right, bottom] = if turned { [x + wide, y + long] } else { [x + long, y + wide] };
        let yarn = [0x8A97A8, 0x1B222C, 0x5C7390][(tone * 3.0) as usize];
        canvas.rectangle([x, y, right, bottom], Coat::Ink(colour(yarn)));
    }
    canvas.mottle(0.25, 3, 0.2, seed + 2);
    for at in [0.0, 0.5] {
        for area in [[at, 0.0, at + 0.004, height], [0.0, at, width, at + 0.004]] {
            canvas.rectangle(area, Coat::Opaque([0.03, 0.035, 0.05, 0.2]));
        }
    }
    canvas
}

/// Mineral fibre panels of 60 cm in a white grid, with fissures.
pub fn ceiling_tile(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CEILING);
    for hole in 0..2600 {
        let [x, y, radius] = [0, 1, 2].map(|i| hash(hole, i, seed));
        let centre = [x * size[0], y * size[1]];
        canvas.disc(centre, 0.001 + 0.003 * radius * radius, Coat::Opaque([0.36, 0.35, 0.33, 0.38]));
    }
    for at in [0.0, 0.6] {
        for (width, coat) in [(0.013, [0.45, 0.45, 0.44, 0.47]), (0.010, [0.84, 0.84, 0.83, 0.84])] {
            canvas.rectangle([at, 0.0, at + width, size[1]], Coat::Opaque(coat));
            canvas.rectangle([0.0, at, size[0], at + width], Coat::Opaque(coat));
        }
    }
    canvas.mottle(0.4, 2, 0.03, seed + 1);
    canvas
}

/// A beech-veneered door: frame, handle, kick plate, room number.
pub fn door_leaf(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, [0.52, 0.34, 0.18, 0.66]);
    let [width, height] = size;
    canvas.shade(|x, y| {
        let bend = 0.05 * smooth(x / width, y / height, [2, 3], seed);
        0.6 + 0.8 * fractal((x + bend) / width, y / height, [26, 2], 5, seed + 1)
    });
    let steel = Coat::Opaque(STEEL);
    canvas.rectangle([0.02, height - 0.25, width - 0.02, height - 0.03], steel);
    canvas.line([0.07, 1.05], [0.19, 1.05], 0.022, Coat::Opaque([0.3, 0.3, 0.3, 0.33]));
    canvas.rectangle([0.055, 0.98, 0.09, 1.2], steel);
    canvas.disc([0.073, 1.16], 0.008, Coat::Opaque(CARBON_BLACK));
    canvas.rectangle([0.36, 0.42, 0.64, 0.52], Coat::Opaque(GREY_COAT));
    let number = ["1-04", "1-07", "LAB 3", "2-11"][(hash(0, 0, seed + 2) * 4.0) as usize];
    write(&mut canvas, [0.40, 0.445], 0.05, number, Running::Across, Coat::Opaque(CARBON_BLACK));
    canvas.frame([0.0, 0.0, width, height], 0.012, Coat::Opaque([0.2, 0.12, 0.06, 0.3]));
    canvas
}

/// Dark grey skirting board.
pub fn skirting(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, [0.14, 0.14, 0.15, 0.16]);
    canvas.mottle(0.1, 4, 0.2, seed);
    canvas
}

/// A panel radiator: vertical convector ribs.
pub fn radiator(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, ENAMEL);
    canvas.shade(|x, y| {
        let rib = (x / 0.04 * std::f32::consts::TAU).sin();
        let edge = y.min(size[1] - y).min(x).min(size[0] - x);
        if edge < 0.02 { 0.9 } else { 0.78 + 0.2 * rib }
    });
    canvas
}

/// A lamp's cover: a faint prism grid.
pub fn opal(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, OPAL);
    canvas.shade(|x, y| 0.97 + 0.03 * ((x * 630.0).sin() * (y * 630.0).sin()));
    canvas
}

/// White enamelled or plastic: window frames, sills.
pub fn enamel(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, ENAMEL);
    canvas.mottle(0.3, 4, 0.04, seed);
    canvas
}
