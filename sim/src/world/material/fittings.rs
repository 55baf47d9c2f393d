//! What hangs, is stuck and stands about in a laboratory: boards, notices, labels, blinds, packaging.

use super::canvas::{Area, Canvas, Coat};
use super::glyph::{Running, small_print, write};
use super::noise::{fractal, hash, smooth};
use super::substance::*;

/// Laser toner and black paint: carbon, so they stay at 830 nm.
const BLACK: Coat = Coat::Opaque(CARBON_BLACK);
const WHITE: Coat = Coat::Opaque(PAPER);
const METAL: Coat = Coat::Opaque(STEEL);

fn ink(hex: u32) -> Coat {
    Coat::Ink(colour(hex))
}

/// A pick among some, by chance.
fn one_of<T: Copy>(of: &[T], chance: f32) -> T {
    of[((chance * of.len() as f32) as usize).min(of.len() - 1)]
}

/// Glare-control fabric of a roller blind: coarse weave, a little uneven where it was wound.
pub fn blind(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, BLIND);
    canvas.shade(|x, y| 0.93 + 0.07 * ((x * 900.0).sin() * (y * 900.0).sin()));
    canvas.shade(|x, y| 0.94 + 0.12 * smooth(x / size[0], y / size[1], [3, 9], seed));
    canvas.mottle(0.02, 2, 0.06, seed + 1);
    canvas
}

/// A perforated steel board with tools on hooks.
pub fn tool_board(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, coat(0x5E7A94, 0.4));
    canvas.mottle(0.2, 3, 0.08, seed);
    for row in 0..(height / 0.04) as u32 {
        for column in 0..(width / 0.04) as u32 {
            let corner = [0.02 + 0.04 * column as f32, 0.02 + 0.04 * row as f32];
            canvas.rectangle([corner[0], corner[1], corner[0] + 0.01, corner[1] + 0.01], BLACK);
        }
    }
    let handles = [coat(0xC23B22, 0.6), coat(0xE0B020, 0.6), CARBON_BLACK, coat(0x2A6DB0, 0.5)];
    for tool in 0..18u32 {
        let pick = |i| hash(tool, i, seed + 1);
        let (x, y) = (0.1 + 0.125 * (tool % 9) as f32, 0.1 + 0.38 * (tool / 9) as f32 + 0.04 * pick(0));
        let (reach, handle) = (0.1 + 0.08 * pick(1), Coat::Opaque(one_of(&handles, pick(2))));
        match (4.0 * pick(3)) as u32 {
            // A screwdriver.
            0 => {
                canvas.line([x, y], [x, y + 0.5 * reach], 0.026, handle);
                canvas.line([x, y + 0.5 * reach], [x, y + 1.3 * reach], 0.008, METAL);
            }
            // Pliers.
            1 => {
                canvas.line([x, y], [x, y + 0.4 * reach], 0.03, METAL);
                for side in [-0.022, 0.022] {
                    canvas.line([x, y + 0.4 * reach], [x + side, y + 1.4 * reach], 0.014, handle);
                }
            }
            // A spanner.
            2 => {
                canvas.line([x, y], [x, y + 1.4 * reach], 0.016, METAL);
                for end in [y, y + 1.4 * reach] {
                    canvas.ring([x, end], 0.018, 0.012, METAL);
                }
            }
            // A hammer.
            _ => {
                canvas.rectangle([x - 0.05, y - 0.015, x + 0.05, y + 0.02], Coat::Opaque(DARK_COAT));
                canvas.line([x, y + 0.02], [x, y + 1.5 * reach], 0.018, Coat::Opaque(OAK));
            }
        }
    }
    canvas.frame([0.0, 0.0, width, height], 0.012, METAL);
    canvas
}

/// A cabinet of small clear drawers, labelled, with parts shining through.
pub fn parts_drawers(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, coat(0x2B4C7E, 0.35));
    let (columns, rows) = (6u32, 8u32);
    let (wide, tall) = (width / columns as f32, height / rows as f32);
    let parts = [0xB08D57, 0x8A8D91, 0x37474F, 0xC0392B, 0xD4C27A, 0x4B6F44];
    for drawer in 0..columns * rows {
        let pick = |i| hash(drawer, i, seed);
        let (left, top) = (wide * (drawer % columns) as f32, height - tall * (1 + drawer / columns) as f32);
        let area = [left + 0.004, top + 0.004, left + wide - 0.004, top + tall - 0.004];
        canvas.rectangle(area, Coat::Opaque([0.5, 0.52, 0.54, 0.55]));
        let filled = top + tall * (0.35 + 0.45 * pick(0));
        let tone = one_of(&parts, pick(1));
        canvas.rectangle([area[0] + 0.003, filled, area[2] - 0.003, area[3]], ink(tone));
        for part in 0..9 {
            let [x, y] = [0, 1].map(|i| hash(part, 2 + i, seed + drawer));
            let centre = [area[0] + x * (area[2] - area[0]), filled + y * (area[3] - filled)];
            canvas.disc(centre, 0.004, Coat::Opaque([0.2, 0.19, 0.18, 0.2]));
        }
        canvas.rectangle([left + 0.15 * wide, top + 0.012, left + 0.85 * wide, top + 0.03], WHITE);
        let label = [left + 0.2 * wide, top + 0.016, left + 0.8 * wide, top + 0.027];
        small_print(&mut canvas, label, 0.006, BLACK, seed + drawer);
        canvas.frame(area, 0.0015, BLACK);
    }
    canvas
}

/// The periodic table: eighteen columns, coloured by kind.
pub fn periodic_table(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, PAPER);
    write(&mut canvas, [0.3 * width, 0.035], 0.05, "PERIODIC TABLE", Running::Across, BLACK);
    let hues = [0xE57373, 0xFFB74D, 0xFFF176, 0xAED581, 0x4FC3F7, 0xBA68C8, 0x90A4AE];
    let cell = (width - 0.08) / 18.0;
    let symbols = "HLNKRCFBMSTVPZAGIEUXYD".as_bytes();
    for row in 0..9u32 {
        for column in 0..18u32 {
            let empty = match row {
                0 => column != 0 && column != 17,
                1 | 2 => (2..12).contains(&column),
                7 | 8 => !(2..17).contains(&column),
                _ => false,
            };
            if empty {
                continue;
            }
            let (x, y) =
                (0.04 + cell * column as f32, 0.14 + cell * row as f32 * 1.08 + if row > 6 { 0.03 } else { 0.0 });
            let hue = hues[((column * 7 / 18) as usize + usize::from(row > 6)) % hues.len()];
            canvas.rectangle([x, y, x + 0.94 * cell, y + cell], ink(hue));
            canvas.frame([x, y, x + 0.94 * cell, y + cell], 0.0025, BLACK);
            let letter = |i| char::from(symbols[(hash(18 * row + column, i, seed) * 22.0) as usize]);
            let text: String = (0..1 + (column + row) % 2).map(letter).collect();
            write(&mut canvas, [x + 0.2 * cell, y + 0.3 * cell], 0.32 * cell, &text, Running::Across, BLACK);
            small_print(
                &mut canvas,
                [x + 0.1 * cell, y + 0.75 * cell, x + 0.8 * cell, y + 0.95 * cell],
                0.01,
                BLACK,
                seed,
            );
        }
    }
    canvas.frame([0.0, 0.0, width, height], 0.008, BLACK);
    canvas
}

/// Two sockets in a frame.
pub fn sockets(size: [f32; 2], _seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, ENAMEL);
    canvas.frame([0.0, 0.0, width, height], 0.003, Coat::Opaque([0.35, 0.35, 0.34, 0.36]));
    for x in [0.25 * width, 0.75 * width] {
        canvas.disc([x, 0.5 * height], 0.024, Coat::Opaque([0.5, 0.5, 0.49, 0.5]));
        canvas.ring([x, 0.5 * height], 0.024, 0.003, Coat::Opaque(DARK_COAT));
        for side in [-0.009, 0.009] {
            canvas.disc([x + side, 0.5 * height], 0.004, BLACK);
        }
    }
    canvas
}

/// Yellow and black floor marking, worn by wheels.
pub fn hazard_tape(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, coat(0xE3B81A, 0.6));
    canvas.each(|x, y, texel| {
        let stripe = ((x + y) / 0.1).rem_euclid(1.0) < 0.5;
        if stripe { CARBON_BLACK } else { texel }
    });
    worn(&mut canvas, seed);
    canvas
}

/// Yellow lane tape, worn by wheels.
pub fn lane_tape(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, coat(0xE3B81A, 0.6));
    worn(&mut canvas, seed);
    canvas
}

fn worn(canvas: &mut Canvas, seed: u32) {
    let size = canvas.size;
    canvas.each(|x, y, texel| {
        let wear = fractal(x / size[0], y / size[1], [24, 2], 3, seed);
        if wear > 0.62 { GROUT.map(|albedo| 1.4 * albedo) } else { texel.map(|albedo| albedo * (0.8 + 0.4 * wear)) }
    });
}

/// Chequer plate over a duct in the floor.
pub fn floor_plate(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, STEEL);
    canvas.mottle(0.1, 3, 0.2, seed);
    for row in 0..16 {
        for column in 0..16 {
            let (x, y) = ((column as f32 + 0.5) / 16.0 * width, (row as f32 + 0.5) / 16.0 * height);
            let [dx, dy] = if (row + column) % 2 == 0 { [0.006, 0.006] } else { [0.006, -0.006] };
            canvas.line([x - dx, y - dy], [x + dx, y + dy], 0.004, Coat::Opaque([0.24, 0.24, 0.23, 0.26]));
        }
    }
    canvas.frame([0.0, 0.0, width, height], 0.012, Coat::Opaque([0.16, 0.16, 0.16, 0.18]));
    for (x, y) in [(0.03, 0.03), (width - 0.03, 0.03), (0.03, height - 0.03), (width - 0.03, height - 0.03)] {
        canvas.disc([x, y], 0.009, BLACK);
    }
    canvas
}

/// A photocopier's face: panel, doors, paper drawers.
pub fn copier(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, GREY_PLASTIC);
    canvas.mottle(0.2, 3, 0.04, seed);
    canvas.rectangle([0.0, 0.0, width, 0.1], Coat::Opaque(DARK_COAT));
    canvas.rectangle([0.05, 0.02, 0.25, 0.08], ink(0x3B7FB5));
    canvas.rectangle([0.06, 0.03, 0.17, 0.045], ink(0xE8F2FA));
    for button in 0..12u32 {
        let centre = [0.3 + 0.03 * (button % 4) as f32, 0.03 + 0.02 * (button / 4) as f32];
        canvas.disc(centre, 0.007, Coat::Opaque([0.6, 0.6, 0.6, 0.6]));
    }
    canvas.disc([0.47, 0.05], 0.018, ink(0x2E9E4F));
    canvas.rectangle([0.04, 0.14, width - 0.04, 0.2], Coat::Opaque([0.03, 0.03, 0.03, 0.04]));
    canvas.rectangle([0.0, 0.215, width, 0.222], BLACK);
    write(&mut canvas, [0.06, 0.25], 0.035, "COPY 2040", Running::Across, BLACK);
    for top in [0.36, 0.54, 0.72, 0.86] {
        canvas.rectangle([0.0, top, width, top + 0.006], BLACK);
        canvas.rectangle([0.2, top + 0.05, width - 0.2, top + 0.075], Coat::Opaque([0.15, 0.15, 0.16, 0.16]));
        write(&mut canvas, [width - 0.09, top + 0.04], 0.03, "A4", Running::Across, ink(0x2255AA));
    }
    canvas.frame([0.0, 0.0, width, height], 0.005, BLACK);
    canvas
}

/// An instruction on the wall: a mandatory sign, a bold line, print.
pub fn notice(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, PAPER);
    canvas.rectangle([0.0, 0.0, width, 0.05], ink(0x1F5FA8));
    write(&mut canvas, [0.02, 0.014], 0.022, "LAB RULES", Running::Across, ink(0xFFFFFF));
    canvas.disc([0.5 * width, 0.105], 0.04, ink(0x1F5FA8));
    canvas.polyline(&[[0.085, 0.1], [0.105, 0.13], [0.125, 0.08]], 0.012, ink(0xFFFFFF));
    write(&mut canvas, [0.02, 0.16], 0.018, "WEAR GOGGLES", Running::Across, BLACK);
    small_print(&mut canvas, [0.02, 0.19, width - 0.02, height - 0.02], 0.011, BLACK, seed);
    canvas.frame([0.0, 0.0, width, height], 0.003, BLACK);
    canvas
}

/// A talk announced: coloured ground, a title, a picture, tear-off strips.
pub fn flyer(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, coat(0xF4D35E, 0.8));
    write(&mut canvas, [0.015, 0.015], 0.026, "TALK TODAY", Running::Across, BLACK);
    patches(&mut canvas, [0.02, 0.06, width - 0.02, 0.17], &[0x2A9D8F, 0xE76F51, 0x264653, 0xF4A261, 0xE9C46A], seed);
    small_print(&mut canvas, [0.02, 0.185, width - 0.02, height - 0.06], 0.012, BLACK, seed + 1);
    for strip in 0..7 {
        let x = width * strip as f32 / 7.0;
        canvas.line([x, height - 0.05], [x, height], 0.002, BLACK);
        let area = [x + 0.006, height - 0.045, x + width / 7.0 - 0.004, height - 0.01];
        small_print(&mut canvas, area, 0.009, BLACK, seed + strip);
    }
    canvas
}

/// Overlapping rectangles in some hues.
fn patches(canvas: &mut Canvas, [left, top, right, bottom]: Area, hues: &[u32], seed: u32) {
    canvas.rectangle([left, top, right, bottom], ink(hues[0]));
    for patch in 0..14 {
        let [x, y, wide, tall, hue] = [0, 1, 2, 3, 4].map(|i| hash(patch, i, seed));
        let (x, y) = (left + x * (right - left), top + y * (bottom - top));
        let (x1, y1) = (x + (0.1 + 0.3 * wide) * (right - left), y + (0.1 + 0.3 * tall) * (bottom - top));
        canvas.rectangle([x, y, x1.min(right), y1.min(bottom)], ink(one_of(hues, hue)));
    }
}

/// Amber glass with a label around it, as seen unrolled.
pub fn amber_bottle(size: [f32; 2], seed: u32) -> Canvas {
    bottle(size, coat(0x4A2508, 0.45), 0xC0392B, seed)
}

/// A white plastic bottle with a label around it, unrolled.
pub fn white_bottle(size: [f32; 2], seed: u32) -> Canvas {
    bottle(size, coat(0xE6E9EA, 0.8), 0x1B6CA8, seed)
}

fn bottle(size: [f32; 2], body: Substance, stripe: u32, seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, body);
    let (top, bottom) = (0.25 * height, 0.8 * height);
    // Twice around, so that one label shows from everywhere.
    for left in [0.02 * width, 0.52 * width] {
        let right = left + 0.44 * width;
        canvas.rectangle([left, top, right, bottom], WHITE);
        canvas.rectangle([left, top, right, top + 0.16 * height], ink(stripe));
        let text = one_of(&["NACL", "ETOH", "HCL", "H2O", "KOH"], hash(0, 0, seed));
        write(&mut canvas, [left + 0.02, top + 0.03 * height], 0.1 * height, text, Running::Across, ink(0xFFFFFF));
        let print = [left + 0.01, top + 0.2 * height, right - 0.04, bottom - 0.02];
        small_print(&mut canvas, print, 0.012, BLACK, seed);
        canvas.rectangle([right - 0.035, bottom - 0.05, right - 0.01, bottom - 0.02], ink(0xF28C28));
    }
    canvas
}

/// The front of a computer under a desk.
pub fn computer(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, coat(0x3A3D42, 0.12));
    canvas.mottle(0.1, 2, 0.1, seed);
    for bay in 0..2 {
        let y = 0.03 + 0.05 * bay as f32;
        canvas.rectangle([0.02, y, width - 0.02, y + 0.04], Coat::Opaque(DARK_COAT));
        canvas.rectangle([0.03, y + 0.026, width - 0.05, y + 0.03], METAL);
    }
    canvas.disc([0.5 * width, 0.17], 0.014, ink(0x59F05A));
    for slot in 0..9 {
        let y = 0.24 + 0.02 * slot as f32;
        canvas.rectangle([0.03, y, width - 0.03, y + 0.008], BLACK);
    }
    canvas.rectangle([0.03, 0.205, 0.06, 0.215], METAL);
    canvas.rectangle([width - 0.07, height - 0.035, width - 0.02, height - 0.02], METAL);
    canvas.frame([0.0, 0.0, width, height], 0.004, BLACK);
    canvas
}

/// Galvanised spiral duct: zinc flowers and seams.
pub fn duct(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, STEEL);
    canvas.mottle(0.02, 2, 0.25, seed);
    canvas.shade(|x, y| {
        let seam = ((y + 0.2 * x) / 0.125).rem_euclid(1.0);
        if seam < 0.08 { 0.55 } else { 1.0 }
    });
    canvas
}

/// A row of magazine files and archive boxes with labels.
pub fn box_files(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, [0.03, 0.028, 0.025, 0.04]);
    let bodies = [coat(0xC8B48A, 0.62), coat(0x7FA3B5, 0.55), coat(0xDADAD2, 0.8), coat(0xA9542F, 0.55), CARDBOARD];
    let mut x = 0.0;
    for file in 0.. {
        let pick = |i| hash(file, i, seed);
        let wide = 0.08 + 0.06 * pick(0);
        if x + wide > width {
            break;
        }
        let top = 0.1 * height * pick(1);
        canvas.rectangle([x + 0.002, top, x + wide - 0.002, height], Coat::Opaque(one_of(&bodies, pick(2))));
        let label = [x + 0.015, top + 0.05, x + wide - 0.015, top + 0.12];
        canvas.rectangle(label, WHITE);
        small_print(&mut canvas, label.map(|edge| edge + 0.003), 0.011, BLACK, seed + file);
        canvas.disc([x + 0.5 * wide, height - 0.06], 0.015, BLACK);
        x += wide;
    }
    canvas.mottle(0.03, 2, 0.08, seed + 1);
    canvas
}

/// A maker's printed box: a picture, a name, small print.
pub fn printed_box(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, coat(0xE9ECEF, 0.75));
    canvas.rectangle([0.0, 0.72 * height, width, height], ink(0x0B5D8F));
    patches(
        &mut canvas,
        [0.05, 0.1, 0.5 * width, 0.65 * height],
        &[0x4F6D7A, 0xC0D6DF, 0x166088, 0xDD6E42, 0x222222],
        seed,
    );
    write(&mut canvas, [0.55 * width, 0.12 * height], 0.14 * height, "SERVO", Running::Across, BLACK);
    small_print(&mut canvas, [0.55 * width, 0.34 * height, 0.95 * width, 0.65 * height], 0.016, BLACK, seed);
    write(&mut canvas, [0.06, 0.8 * height], 0.1 * height, "24V 5A  10 PCS", Running::Across, ink(0xFFFFFF));
    canvas.frame([0.0, 0.0, width, height], 0.004, Coat::Opaque(GREY_COAT));
    canvas
}
