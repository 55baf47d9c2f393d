//! What houses, walls and fences are made of.

use super::canvas::{Canvas, Coat};
use super::glyph::{Running, write};
use super::noise::{fractal, hash, smooth};
use super::substance::*;

const MORTAR: Substance = [0.30, 0.275, 0.235, 0.35];
const GAP: Coat = Coat::Opaque([0.02, 0.018, 0.016, 0.03]);

/// Red brick in running bond, 24 × 6.5 cm with joints of 1 cm; each brick of its own firing.
pub fn brick(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, MORTAR);
    let [width, height] = size;
    canvas.mottle(0.02, 3, 0.2, seed);
    let (columns, rows) = ((width / 0.25).round() as u32, (height / 0.075).round() as u32);
    let [pitch, course] = [width / columns as f32, height / rows as f32];
    for row in 0..rows {
        for column in 0..=columns {
            let [tone, hue] = [0, 1].map(|i| hash(column % columns + 64 * i, row, seed + 1));
            let [r, g, b, infrared] = BRICK.map(|albedo| albedo * (0.62 + 0.72 * tone));
            let fired = match hue {
                0.88.. => [0.55, 0.5, 0.6, 0.6],
                0.65.. => [1.12, 1.3, 1.3, 1.12],
                _ => [1.0; 4],
            };
            let coat = Coat::Opaque([r * fired[0], g * fired[1], b * fired[2], (infrared * fired[3]).min(0.6)]);
            let left = pitch * (column as f32 - 0.5 * (row % 2) as f32);
            let top = course * row as f32;
            canvas.rectangle([left + 0.005, top + 0.005, left + pitch - 0.005, top + course - 0.005], coat);
        }
    }
    canvas.mottle(0.012, 2, 0.22, seed + 2);
    canvas.mottle(0.5, 3, 0.16, seed + 3);
    canvas
}

/// Trowelled plaster, painted ochre: grain, clouds, hairline cracks, streaks below where water runs.
pub fn plaster(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, OCHRE_PLASTER);
    let [width, height] = size;
    canvas.shade(|x, y| {
        let grain = hash((x * 170.0) as u32, (y * 170.0) as u32, seed);
        let cloud = fractal(x / width, y / height, [5, 5], 5, seed + 1);
        let streak = fractal(x / width, y / height, [18, 1], 3, seed + 2);
        (0.86 + 0.2 * grain) * (0.78 + 0.4 * cloud) * (0.84 + 0.3 * streak)
    });
    for crack in 0..5 {
        let [mut x, mut y] = [0, 1].map(|i| hash(crack, i, seed + 3));
        for step in 0..14 {
            let [dx, dy] = [0, 1].map(|i| 0.14 * (hash(crack * 20 + step, i, seed + 4) - 0.35));
            let (from, to) = ([x * width, y * height], [x * width + dx, y * height + dy]);
            canvas.line(from, to, 0.004, Coat::Opaque([0.25, 0.19, 0.12, 0.28]));
            x += dx / width;
            y += dy / height;
        }
    }
    canvas
}

/// Pantiles: rounded across, a shadow under each row.
pub fn roof_tile(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, ROOF_TILE);
    let [column, row] = [0.25, 0.35];
    canvas.shade(|x, y| {
        let round = (x / column * std::f32::consts::TAU).sin();
        let under = ((y / row).fract() * 9.0).min(1.0);
        let own = 0.75 + 0.5 * hash((x / column) as u32, (y / row) as u32, seed);
        (1.05 + 0.45 * round) * (0.25 + 0.75 * under) * own
    });
    canvas.mottle(0.05, 3, 0.2, seed + 1);
    canvas
}

/// Rubble in rough courses, lime mortar between.
pub fn stone(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, MORTAR.map(|albedo| 0.7 * albedo));
    let [width, height] = size;
    let courses = [0.17, 0.12, 0.21, 0.14, 0.19, 0.17];
    let scale = height / courses.iter().sum::<f32>();
    let mut top = 0.0;
    for (row, course) in courses.into_iter().enumerate() {
        let (bottom, row) = (top + course * scale, row as u32);
        let count = 4 + (hash(row, 0, seed) * 3.0) as u32;
        let edge = |i: u32| width * (i as f32 + 0.5 * (hash(row, 10 + i % count, seed) - 0.5)) / count as f32;
        for block in 0..count {
            let [tone, hue] = [0, 1].map(|i| hash(row * 10 + block, i, seed + 1));
            let (left, right) = (edge(block) + 0.008, edge(block + 1) - 0.008);
            let [r, g, b, infrared] = STONE.map(|albedo| albedo * (0.6 + 0.75 * tone));
            let tint = if hue > 0.7 { [1.1, 0.95, 0.8] } else { [0.97, 1.0, 1.04] };
            let coat = Coat::Opaque([r * tint[0], g * tint[1], b * tint[2], infrared]);
            for shift in [0.0, width, -width] {
                let [left, right] = [left + shift, right + shift];
                let area = [left, top + 0.006, right, bottom - 0.006];
                canvas.cover(area, coat, |x, y| {
                    let ragged = 0.02 * smooth(x / width, y / height, [30, 24], seed + 2);
                    let [dx, dy] = [
                        (x - 0.5 * (left + right)).abs() - 0.5 * (right - left) + 0.03,
                        (y - 0.5 * (top + bottom)).abs() - 0.5 * (bottom - top) + 0.036,
                    ];
                    // Rounded corners.
                    dx.max(0.0).hypot(dy.max(0.0)) + dx.max(dy).min(0.0) - 0.03 + ragged
                });
            }
        }
        top = bottom;
    }
    canvas.mottle(0.06, 4, 0.3, seed + 3);
    canvas
}

/// Upright boards of 12 cm, weathered, with gaps, grain and nails.
pub fn planks(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, WEATHERED_WOOD);
    let [width, height] = size;
    let board = 0.12;
    canvas.shade(|x, y| {
        let index = (x / board) as u32;
        let bend = 0.02 * smooth(x / width, y / height, [8, 5], seed);
        let grain = fractal(x / width + bend, y / height, [90, 3], 4, seed + 1 + index);
        (0.7 + 0.55 * hash(index, 0, seed + 2)) * (0.55 + 0.9 * grain)
    });
    for index in 0..(width / board).round() as u32 {
        let x = board * index as f32;
        canvas.rectangle([x, 0.0, x + 0.009, height], GAP);
        let [kx, ky, radius] = [0, 1, 2].map(|i| hash(index, i, seed + 3));
        canvas.disc([x + 0.03 + 0.06 * kx, ky * height], 0.008 + 0.01 * radius, Coat::Opaque([0.1, 0.075, 0.05, 0.2]));
        for y in [0.2, 0.75] {
            canvas.disc([x + 0.065, y * height], 0.005, Coat::Opaque(IRON));
        }
    }
    canvas
}

/// Weathered wood with its grain along x: benches, beams.
pub fn timber(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, WEATHERED_WOOD);
    let [width, height] = size;
    canvas.shade(|x, y| 0.5 + 0.95 * fractal(x / width, y / height, [2, 40], 4, seed));
    canvas.mottle(0.2, 3, 0.2, seed + 1);
    canvas
}

/// A casement window: white frame with a cross, dark panes that mirror some sky, curtains, a flower pot inside.
pub fn window(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PANE);
    let [width, height] = size;
    canvas.each(|x, y, texel| {
        let sky = 1.9 - 1.4 * (y / height) + 0.5 * fractal(x / width, y / height, [2, 3], 3, seed);
        let mirrored = if x + 0.6 * y < 0.9 * width { 1.35 } else { 0.8 };
        texel.map(|albedo| albedo * sky.max(0.3) * mirrored)
    });
    let cloth = [0.34, 0.33, 0.31, 0.36];
    for (from, to) in [(0.07, 0.25), (0.75, 0.93)] {
        let area = [from * width, 0.06, to * width, height - 0.06];
        canvas.cover(area, Coat::Opaque(cloth), |x, y| {
            let reach = 0.25 * width * (0.72 + 0.28 * (y / height - 0.4).abs());
            x.min(width - x) - reach
        });
        canvas.cover(area, Coat::Opaque(cloth.map(|albedo| 0.6 * albedo)), |x, _| {
            0.006 - 0.012 * (x * 130.0).sin().max(0.0) - 0.002
        });
    }
    let sill = height - 0.1;
    canvas.rectangle([0.42 * width, sill - 0.1, 0.54 * width, sill], Coat::Opaque(CLAY.map(|albedo| 0.6 * albedo)));
    for leaf in 0..24 {
        let [dx, dy] = [0, 1].map(|i| hash(leaf, i, seed + 1) - 0.5);
        let at = [0.48 * width + 0.2 * dx, sill - 0.18 + 0.18 * dy];
        canvas.disc(at, 0.028, Coat::Opaque(LEAF.map(|albedo| 0.75 * albedo)));
    }
    let (frame, edge) = (Coat::Opaque(ENAMEL), Coat::Opaque([0.4, 0.4, 0.39, 0.42]));
    canvas.frame([0.0, 0.0, width, height], 0.07, frame);
    canvas.frame([0.064, 0.064, width - 0.064, height - 0.064], 0.008, edge);
    canvas.rectangle([0.5 * width - 0.05, 0.0, 0.5 * width + 0.05, height], frame);
    canvas.rectangle([0.5 * width - 0.003, 0.0, 0.5 * width + 0.003, height], edge);
    canvas.rectangle([0.0, 0.36 * height - 0.025, width, 0.36 * height + 0.025], frame);
    canvas.rectangle([0.5 * width + 0.015, 0.6 * height, 0.5 * width + 0.03, 0.7 * height], Coat::Opaque(STEEL));
    canvas.mottle(0.2, 3, 0.06, seed + 2);
    canvas
}

/// A panelled house door, painted dark green, with a pane, a letter slot, a number.
pub fn house_door(size: [f32; 2], seed: u32) -> Canvas {
    let green = coat(0x24523C, 0.32);
    let mut canvas = Canvas::new(size, green);
    let [width, height] = size;
    let (shadow, light) = (Coat::Opaque(green.map(|a| 0.4 * a)), Coat::Opaque(green.map(|a| 1.5 * a)));
    for [left, right] in [[0.12, 0.46], [0.54, 0.88]] {
        for [top, bottom] in [[0.52, 0.7], [0.74, 0.95]] {
            let area = [left * width, top * height, right * width, bottom * height];
            canvas.frame(area, 0.018, shadow);
            canvas.frame([area[0] + 0.05, area[1] + 0.05, area[2] - 0.05, area[3] - 0.05], 0.012, light);
        }
    }
    let pane = [0.2 * width, 0.09 * height, 0.8 * width, 0.46 * height];
    canvas.rectangle(pane, Coat::Opaque(PANE));
    canvas.frame(pane, 0.025, light);
    for bar in [0.4, 0.6] {
        canvas.rectangle([bar * width - 0.01, pane[1], bar * width + 0.01, pane[3]], Coat::Opaque(green));
    }
    canvas.rectangle([0.38 * width, 0.485 * height, 0.62 * width, 0.505 * height], Coat::Opaque(STEEL));
    canvas.rectangle([0.04, 0.47 * height, 0.075, 0.58 * height], Coat::Opaque(STEEL));
    canvas.disc([0.0575, 0.5 * height], 0.03, Coat::Opaque([0.6, 0.5, 0.25, 0.6]));
    canvas.frame([0.0, 0.0, width, height], 0.03, Coat::Opaque(ENAMEL));
    canvas.mottle(0.2, 4, 0.14, seed);
    canvas
}

/// A garage door that rolls up: slats of 9 cm, scratches, a handle, a warning.
pub fn roller_door(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, [0.42, 0.44, 0.45, 0.46]);
    let [width, height] = size;
    canvas.shade(|_, y| {
        let slat = (y / 0.09).fract();
        if slat < 0.12 { 0.35 } else { 0.85 + 0.4 * (slat - 0.5) }
    });
    canvas
        .rectangle([0.5 * width - 0.08, height - 0.22, 0.5 * width + 0.08, height - 0.18], Coat::Opaque(CARBON_BLACK));
    canvas.rectangle([0.08 * width, 0.42 * height, 0.34 * width, 0.62 * height], Coat::Opaque(PAPER));
    let (black, red) = (Coat::Opaque(CARBON_BLACK), Coat::Ink(colour(0xC02020)));
    write(&mut canvas, [0.1 * width, 0.445 * height], 0.075, "KEEP", Running::Across, red);
    write(&mut canvas, [0.1 * width, 0.535 * height], 0.075, "CLEAR", Running::Across, black);
    canvas.rectangle([0.0, height - 0.03, width, height], Coat::Opaque(CARBON_BLACK));
    canvas.mottle(0.3, 4, 0.16, seed);
    canvas.shade(|x, y| 0.85 + 0.3 * fractal(x / width, y / height, [20, 1], 3, seed + 1));
    canvas
}

/// White letters on enamel: a house's number.
pub fn house_number(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, coat(0x1D3F87, 0.45));
    let [width, height] = size;
    canvas.frame([0.01, 0.01, width - 0.01, height - 0.01], 0.012, Coat::Opaque(PAPER));
    write(&mut canvas, [0.22 * width, 0.22 * height], 0.56 * height, "27", Running::Across, Coat::Opaque(PAPER));
    canvas
}

/// A parking sign: white on blue, and whose place it is.
pub fn parking_sign(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, coat(0x1F4FA3, 0.5));
    let [width, height] = size;
    let white = Coat::Opaque(PAPER);
    canvas.frame([0.012, 0.012, width - 0.012, height - 0.012], 0.014, white);
    write(&mut canvas, [0.3 * width, 0.12 * height], 0.45 * height, "P", Running::Across, white);
    canvas.rectangle([0.06 * width, 0.68 * height, 0.94 * width, 0.93 * height], white);
    let black = Coat::Opaque(CARBON_BLACK);
    write(&mut canvas, [0.17 * width, 0.755 * height], 0.1 * height, "GUESTS", Running::Across, black);
    canvas
}
