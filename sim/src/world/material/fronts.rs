//! The faces of cabinets, instruments and screens.

use super::canvas::{Canvas, Coat};
use super::glyph::{Running, small_print, write};
use super::noise::{hash, smooth};
use super::substance::*;

const SHADOW: Coat = Coat::Opaque([0.05, 0.05, 0.05, 0.06]);
const HANDLE: Coat = Coat::Opaque([0.12, 0.12, 0.13, 0.13]);

fn sheet_metal(size: [f32; 2], base: Substance, seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, base);
    canvas.mottle(0.15, 4, 0.08, seed);
    canvas
}

/// Two steel doors, vents above and below, handles, a label each.
pub fn cabinet(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = sheet_metal(size, GREY_COAT, seed);
    let [width, height] = size;
    canvas.frame([0.0, 0.0, width, height], 0.012, HANDLE);
    canvas.rectangle([0.5 * width - 0.003, 0.0, 0.5 * width + 0.003, height], SHADOW);
    canvas.rectangle([0.0, height - 0.08, width, height - 0.074], SHADOW);
    for (door, left) in [0.0, 0.5 * width].into_iter().enumerate() {
        for slot in 0..6 {
            for top in [0.12, height - 0.25] {
                let y = top + 0.018 * slot as f32;
                canvas.rectangle([left + 0.12, y, left + 0.5 * width - 0.12, y + 0.006], SHADOW);
            }
        }
        let x = if door == 0 { 0.5 * width - 0.05 } else { 0.5 * width + 0.03 };
        canvas.rectangle([x, 0.9, x + 0.02, 1.06], HANDLE);
        canvas.rectangle([left + 0.14, 0.42, left + 0.3, 0.52], Coat::Opaque(PAPER));
        small_print(
            &mut canvas,
            [left + 0.15, 0.435, left + 0.29, 0.51],
            0.02,
            Coat::Opaque(CARBON_BLACK),
            seed + door as u32,
        );
    }
    canvas
}

/// A narrow locker door with vents, a lock and a number plate: the same on each, as it is in life.
pub fn locker(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = sheet_metal(size, coat(0x8FA9BD, 0.55), seed);
    let [width, height] = size;
    canvas.frame([0.0, 0.0, width, height], 0.01, SHADOW);
    for slot in 0..5 {
        for top in [0.14, height - 0.3] {
            let y = top + 0.03 * slot as f32;
            canvas.rectangle([0.09, y, width - 0.09, y + 0.01], SHADOW);
        }
    }
    canvas.rectangle([width - 0.09, 0.85, width - 0.05, 0.98], HANDLE);
    canvas.disc([width - 0.07, 1.03], 0.014, Coat::Opaque(STEEL));
    canvas.rectangle([0.14, 0.34, 0.26, 0.4], Coat::Opaque(PAPER));
    write(&mut canvas, [0.16, 0.352], 0.035, "A12", Running::Across, Coat::Opaque(CARBON_BLACK));
    canvas
}

/// A pedestal's three drawers.
pub fn drawers(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = sheet_metal(size, GREY_COAT, seed);
    let [width, height] = size;
    for top in [0.0, 0.14, 0.37] {
        canvas.rectangle([0.0, top, width, top + 0.006], SHADOW);
        canvas.rectangle([0.13, top + 0.045, width - 0.13, top + 0.06], HANDLE);
    }
    canvas.frame([0.0, 0.0, width, height], 0.004, SHADOW);
    canvas
}

/// A screen with two traces, knobs and sockets.
pub fn oscilloscope(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = sheet_metal(size, GREY_PLASTIC, seed);
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.006, HANDLE);
    let (left, top, right, bottom) = (0.02, 0.02, 0.22, 0.15);
    canvas.rectangle([left, top, right, bottom], Coat::Opaque(DARK_GLASS));
    let grid = Coat::Ink([0.1, 0.12, 0.12]);
    for i in 0..=10 {
        let x = left + (right - left) * i as f32 / 10.0;
        canvas.line([x, top], [x, bottom], 0.0008, grid);
    }
    for i in 0..=8 {
        let y = top + (bottom - top) * i as f32 / 8.0;
        canvas.line([left, y], [right, y], 0.0008, grid);
    }
    for (hex, offset, pitch) in [(0xF5E63C, 0.06, 90.0), (0x41D9F0, 0.11, 180.0)] {
        let trace: Vec<[f32; 2]> = (0..100)
            .map(|i| left + (right - left) * i as f32 / 99.0)
            .map(|x| [x, offset + 0.018 * (x * pitch).sin().clamp(-0.8, 0.8)])
            .collect();
        canvas.polyline(&trace, 0.002, Coat::Ink(colour(hex)));
    }
    for row in 0..3 {
        for column in 0..3 {
            let centre = [0.255 + 0.045 * column as f32, 0.04 + 0.045 * row as f32];
            canvas.disc(centre, 0.014, HANDLE);
            canvas.line(centre, [centre[0] + 0.008, centre[1] - 0.008], 0.002, Coat::Opaque(PAPER));
        }
    }
    for socket in 0..4 {
        let centre = [0.05 + 0.06 * socket as f32, 0.175];
        canvas.disc(centre, 0.012, Coat::Opaque(STEEL));
        canvas.disc(centre, 0.005, SHADOW);
    }
    canvas
}

/// Two displays of digits, knobs, red and black terminals.
pub fn power_supply(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = sheet_metal(size, coat(0xC9C4B4, 0.6), seed);
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.005, HANDLE);
    for (left, text) in [(0.015, "12-05"), (0.125, "01-50")] {
        canvas.rectangle([left, 0.015, left + 0.1, 0.06], Coat::Opaque(DARK_GLASS));
        write(&mut canvas, [left + 0.01, 0.022], 0.022, text, Running::Across, Coat::Ink(colour(0xFF5040)));
        canvas.disc([left + 0.025, 0.085], 0.014, HANDLE);
        canvas.disc([left + 0.07, 0.085], 0.014, HANDLE);
        canvas.disc([left + 0.025, 0.13], 0.01, Coat::Opaque(RED_COAT));
        canvas.disc([left + 0.07, 0.13], 0.01, Coat::Opaque(CARBON_BLACK));
    }
    canvas
}

/// Servers and switches in a black rack, with lights, vents and handles.
pub fn rack(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = sheet_metal(size, CARBON_BLACK, seed);
    let [width, height] = size;
    let mut top = 0.04;
    let mut unit = 0;
    while top < height - 0.16 {
        let pick = |i| hash(unit, i, seed);
        let tall = 0.044 * (1.0 + (3.0 * pick(0)).floor());
        let face = [DARK_COAT, GREY_COAT, coat(0x30343C, 0.06), STEEL][(4.0 * pick(1)) as usize];
        let (left, right, bottom) = (0.04, width - 0.04, top + tall - 0.005);
        canvas.rectangle([left, top, right, bottom], Coat::Opaque(face));
        if pick(2) > 0.5 {
            for port in 0..16 {
                let x = left + 0.06 + 0.026 * port as f32;
                canvas.rectangle([x, top + 0.012, x + 0.016, top + 0.027], SHADOW);
                let light = if hash(unit, 20 + port, seed) > 0.4 { 0x59F05A } else { 0xF5A623 };
                canvas.rectangle([x + 0.002, top + 0.005, x + 0.007, top + 0.009], Coat::Ink(colour(light)));
            }
        } else {
            for slot in 0..18 {
                let x = left + 0.12 + 0.018 * slot as f32;
                canvas.rectangle([x, top + 0.008, x + 0.008, bottom - 0.008], SHADOW);
            }
            canvas.disc([left + 0.05, top + 0.02], 0.006, Coat::Ink(colour(0x3C8CFF)));
        }
        top += tall;
        unit += 1;
    }
    canvas.frame([0.0, 0.0, width, height], 0.03, Coat::Opaque(DARK_COAT));
    canvas
}

/// Rows of keys.
pub fn keyboard(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CARBON_BLACK);
    let key = Coat::Opaque([0.1, 0.1, 0.105, 0.12]);
    for row in 0..6 {
        for column in 0..21 {
            let (x, y) = (0.012 + 0.02 * column as f32, 0.012 + 0.02 * row as f32);
            let wide = if row == 5 && (5..10).contains(&column) { 0.02 } else { 0.0165 };
            canvas.rectangle([x, y, x + wide, y + 0.0165], key);
            canvas.rectangle([x + 0.005, y + 0.004, x + 0.009, y + 0.009], Coat::Opaque([0.5, 0.5, 0.5, 0.5]));
        }
    }
    canvas
}

/// A dark desktop with windows of highlighted code. Lit from behind in life; here the picture is its albedo, and at
/// 830 nm the screen is dark.
pub fn code_screen(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, DARK_GLASS);
    let [width, height] = size;
    canvas.rectangle([0.0, 0.0, width, 0.012], Coat::Ink(colour(0x3A3F4B)));
    canvas.rectangle([0.0, 0.012, 0.09, height], Coat::Ink(colour(0x21252B)));
    small_print(&mut canvas, [0.008, 0.03, 0.085, 0.28], 0.0125, Coat::Ink(colour(0x7A8294)), seed);
    let hues = [0xE06C75, 0x98C379, 0x61AFEF, 0xC678DD, 0xE5C07B, 0xABB2BF];
    for line in 0..24u32 {
        let y = 0.022 + 0.0112 * line as f32;
        let mut x = 0.105 + 0.016 * (4.0 * hash(line, 0, seed + 1)).floor();
        for word in 0..(7.0 * hash(line, 1, seed + 1)) as u32 {
            let length = 0.012 + 0.04 * hash(line, 2 + word, seed + 1);
            let hue = hues[(6.0 * hash(line, 30 + word, seed + 1)) as usize];
            canvas.rectangle([x, y, x + length, y + 0.006], Coat::Ink(colour(hue)));
            x += length + 0.006;
        }
    }
    canvas
}

/// A bright desktop: a plot of a trajectory, a camera picture, a table.
pub fn plot_screen(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, DARK_GLASS);
    let [width, height] = size;
    canvas.rectangle([0.0, 0.0, width, height], Coat::Ink(colour(0x2B5C86)));
    canvas.rectangle([0.02, 0.02, 0.31, 0.27], Coat::Ink(colour(0xF4F4F4)));
    let axis = Coat::Ink(colour(0x303030));
    canvas.polyline(&[[0.045, 0.04], [0.045, 0.25], [0.3, 0.25]], 0.0015, axis);
    for (hex, wobble) in [(0xD62728, 0.0), (0x1F77B4, 0.006), (0x2CA02C, 0.014)] {
        let path: Vec<[f32; 2]> = (0..60)
            .map(|i| i as f32 / 59.0)
            .map(|t| {
                let noise = wobble * (smooth(t, 0.5, [7, 1], seed) - 0.3);
                let (sin, cos) = (6.0 * t).sin_cos();
                [0.17 + 0.1 * cos + 4.0 * noise * t, 0.145 + (0.08 + noise) * sin]
            })
            .collect();
        canvas.polyline(&path, 0.003, Coat::Ink(colour(hex)));
    }
    canvas.rectangle([0.33, 0.02, 0.51, 0.14], Coat::Ink(colour(0x6B5B4B)));
    canvas.rectangle([0.36, 0.06, 0.42, 0.14], Coat::Ink(colour(0xB09A7A)));
    canvas.rectangle([0.44, 0.03, 0.49, 0.09], Coat::Ink(colour(0xC8D8E8)));
    canvas.rectangle([0.33, 0.155, 0.51, 0.27], Coat::Ink(colour(0x1C1C1C)));
    small_print(&mut canvas, [0.338, 0.165, 0.5, 0.265], 0.0105, Coat::Ink(colour(0x60E070)), seed);
    canvas
}
