//! Paper and boards: posters, notices, books, drawings.

use super::canvas::{Area, Canvas, Coat};
use super::glyph::{Running, small_print, write};
use super::noise::{fractal, hash};
use super::substance::*;

/// Laser toner: carbon, so it stays at 830 nm.
const TONER: Coat = Coat::Opaque(CARBON_BLACK);

fn ink(hex: u32) -> Coat {
    Coat::Ink(colour(hex))
}

/// Spines side by side on a dark shelf: widths, heights, hues and titles differ.
fn spines(size: [f32; 2], hues: &[u32], widths: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, [0.02, 0.018, 0.016, 0.03]);
    let titles = ["OPTICS", "ESTIMATION", "ROBOTICS", "VISION", "ALGEBRA", "CONTROL", "SENSORS", "SIGNALS", "FILTERS"];
    let mut x = 0.0;
    for book in 0.. {
        let pick = |i| hash(book, i, seed);
        let wide = widths[0] + (widths[1] - widths[0]) * pick(0);
        if x + wide > width {
            break;
        }
        let top = height * (0.02 + 0.3 * pick(1) * pick(1));
        let hue = colour(hues[(pick(2) * hues.len() as f32) as usize]);
        // Cloth and paper under the print: bright at 830 nm, whatever the hue, but for black covers (carbon).
        let infrared = if hue.iter().sum::<f32>() < 0.1 { 0.06 } else { 0.5 + 0.25 * pick(3) };
        let body = Coat::Opaque([hue[0], hue[1], hue[2], infrared]);
        canvas.rectangle([x + 0.0008, top, x + wide - 0.0008, height], body);
        let light = hue.iter().sum::<f32>() > 0.9;
        let print = if light { TONER } else { Coat::Opaque([0.8, 0.75, 0.55, 0.7]) };
        let bands = (3.0 * pick(4)) as u32;
        for band in 0..=bands {
            let y = top + (height - top) * (0.06 + 0.86 * hash(book, 10 + band, seed));
            canvas.rectangle([x + 0.001, y, x + wide - 0.001, y + 0.004], print);
        }
        if wide > 0.018 {
            let title = titles[(pick(5) * titles.len() as f32) as usize];
            let letter = (0.5 * wide).min(0.02);
            write(&mut canvas, [x + 0.5 * (wide + letter), top + 0.03], letter, title, Running::Down, print);
        }
        x += wide + if pick(6) > 0.93 { 0.02 } else { 0.0 };
    }
    // Round backs: darker at both sides, a little everywhere.
    canvas.mottle(0.02, 3, 0.15, seed + 1);
    canvas
}

pub fn books(size: [f32; 2], seed: u32) -> Canvas {
    let hues = [0xB23A48, 0x1F4E79, 0xE8E4D8, 0x2E6F57, 0xD9A441, 0x1A1A1C, 0x6B3F7A, 0xF2F2F0, 0x3F88C5, 0xC8553D];
    spines(size, &hues, [0.015, 0.055], seed)
}

pub fn old_books(size: [f32; 2], seed: u32) -> Canvas {
    let hues = [0x5A2A27, 0x2F3E2F, 0x3B2F2F, 0x6E5A3C, 0x22304A, 0x151515, 0x7B6B52, 0x8C8577];
    spines(size, &hues, [0.02, 0.06], seed)
}

/// Ring binders with labels and finger holes.
pub fn binders(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, [0.02, 0.018, 0.016, 0.03]);
    let hues = [0x24272B, 0x24272B, 0x2D5DA1, 0xA13030, 0x6A6F73, 0x2D7D46];
    let wide = 0.075;
    for binder in 0..(width / wide) as u32 {
        let (x, pick) = (binder as f32 * wide, |i| hash(binder, i, seed));
        if pick(0) > 0.88 {
            continue;
        }
        let hue = colour(hues[(pick(1) * 6.0) as usize]);
        let infrared = if hue.iter().sum::<f32>() < 0.1 { 0.06 } else { 0.5 };
        canvas.rectangle([x + 0.002, 0.01, x + wide - 0.002, height], Coat::Opaque([hue[0], hue[1], hue[2], infrared]));
        canvas.rectangle([x + 0.012, 0.04, x + wide - 0.012, 0.19], Coat::Opaque(PAPER));
        let year = format!("{}", 2009 + (pick(2) * 14.0) as u32);
        write(&mut canvas, [x + 0.016, 0.05], 0.014, &year, Running::Across, TONER);
        small_print(&mut canvas, [x + 0.016, 0.08, x + wide - 0.016, 0.18], 0.016, TONER, seed + binder);
        canvas.disc([x + 0.5 * wide, 0.25], 0.014, Coat::Opaque(STEEL));
        canvas.disc([x + 0.5 * wide, 0.25], 0.011, Coat::Opaque(CARBON_BLACK));
    }
    canvas
}

/// A typed page with a figure.
pub fn page(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PAPER);
    let [width, height] = size;
    canvas.rectangle([0.04, 0.03, 0.2, 0.045], TONER);
    small_print(&mut canvas, [0.03, 0.06, width - 0.03, 0.2], 0.011, TONER, seed);
    plot(&mut canvas, [0.05, 0.21, width - 0.05, 0.31], ink(0xC03020), seed);
    small_print(&mut canvas, [0.03, 0.33, width - 0.03, height - 0.03], 0.011, TONER, seed + 1);
    canvas
}

/// Axes with a wandering curve and bars.
fn plot(canvas: &mut Canvas, [left, top, right, bottom]: Area, hue: Coat, seed: u32) {
    let stroke = 0.008 * (right - left);
    canvas.polyline(&[[left, top], [left, bottom], [right, bottom]], stroke, TONER);
    let at = |t: f32, value: f32| [left + t * (right - left), bottom - value * (bottom - top)];
    for bar in 0..6 {
        let t = 0.1 + 0.15 * bar as f32;
        let [x, y] = at(t, 0.1 + 0.4 * hash(bar, 0, seed));
        canvas.rectangle([x, y, x + 0.08 * (right - left), bottom], ink(0x9FB7CC));
    }
    let curve: Vec<[f32; 2]> =
        (0..40).map(|i| i as f32 / 39.0).map(|t| at(t, 0.15 + 0.75 * fractal(t, 0.3, [4, 2], 3, seed))).collect();
    canvas.polyline(&curve, 1.5 * stroke, hue);
}

/// A conference poster: title bar, three columns of print, figures.
pub fn science_poster(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PAPER);
    let [width, height] = size;
    canvas.rectangle([0.0, 0.0, width, 0.2], ink(0x1D3F72));
    let white = ink(0xF4F4F4);
    write(&mut canvas, [0.05, 0.035], 0.065, "SEEING IN", Running::Across, white);
    write(&mut canvas, [0.05, 0.12], 0.05, "TWO BANDS", Running::Across, white);
    canvas.disc([width - 0.1, 0.1], 0.06, ink(0xE8A33D));
    canvas.disc([width - 0.1, 0.1], 0.03, ink(0x1D3F72));
    for column in 0..3u32 {
        let left = 0.03 + column as f32 * 0.27;
        let right = left + 0.24;
        let mut top = 0.23;
        for block in 0..3 {
            let here = seed + 10 * column + block;
            canvas.rectangle([left, top, right, top + 0.025], ink([0x1D3F72, 0xA33B3B, 0x2F6E4F][column as usize]));
            small_print(&mut canvas, [left, top + 0.035, right, top + 0.14], 0.013, TONER, here);
            let figure = [left + 0.01, top + 0.155, right - 0.01, top + 0.275];
            if (column + block) % 2 == 0 {
                plot(&mut canvas, figure, ink(0xC03020), here);
            } else {
                picture_of_rooms(&mut canvas, figure, here);
            }
            top += 0.3;
        }
    }
    canvas.rectangle([0.0, height - 0.03, width, height], ink(0x1D3F72));
    canvas
}

/// A false-colour picture of boxes, as a depth image shows.
fn picture_of_rooms(canvas: &mut Canvas, [left, top, right, bottom]: Area, seed: u32) {
    canvas.rectangle([left, top, right, bottom], ink(0x2B2F77));
    for patch in 0..9 {
        let [x, y, w, h, hue] = [0, 1, 2, 3, 4].map(|i| hash(patch, i, seed));
        let (x, y) = (left + 0.7 * x * (right - left), top + 0.7 * y * (bottom - top));
        let (w, h) = (0.3 * w * (right - left), 0.3 * h * (bottom - top));
        let hue = [0xF0E442, 0x35B779, 0x21918C, 0x31688E, 0xFDE725][(hue * 5.0) as usize];
        canvas.rectangle([x, y, x + w, y + h], ink(hue));
    }
}

/// A robot's drawing with dimensions and a block diagram.
pub fn robot_poster(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, [0.74, 0.77, 0.80, 0.82]);
    let [width, height] = size;
    canvas.rectangle([0.0, 0.0, width, 0.16], ink(0xD9532C));
    write(&mut canvas, [0.06, 0.045], 0.075, "ROVER LAB", Running::Across, ink(0xFFFFFF));
    let (dark, line) = (TONER, ink(0x2E4057));
    canvas.rectangle([0.18, 0.48, 0.66, 0.64], ink(0xB8342B));
    canvas.rectangle([0.22, 0.44, 0.62, 0.48], dark);
    canvas.rectangle([0.40, 0.28, 0.43, 0.44], dark);
    canvas.rectangle([0.32, 0.23, 0.52, 0.28], dark);
    for x in [0.36, 0.42, 0.475] {
        canvas.disc([x, 0.255], 0.014, ink(0x5F7F9F));
    }
    for x in [0.25, 0.59] {
        canvas.disc([x, 0.66], 0.085, dark);
        canvas.disc([x, 0.66], 0.045, ink(0xB9BEC4));
        canvas.disc([x, 0.66], 0.012, dark);
    }
    canvas.line([0.1, 0.78], [0.74, 0.78], 0.004, line);
    for x in [0.165, 0.675] {
        canvas.line([x, 0.74], [x, 0.8], 0.003, line);
    }
    write(&mut canvas, [0.36, 0.795], 0.03, "508 MM", Running::Across, line);
    for block in 0..3u32 {
        let left = 0.06 + 0.27 * block as f32;
        canvas.rectangle([left, 0.87, left + 0.19, 0.96], ink([0x77A6B6, 0xE3C16F, 0x8FB996][block as usize]));
        canvas.frame([left, 0.87, left + 0.19, 0.96], 0.005, dark);
        write(&mut canvas, [left + 0.025, 0.9], 0.03, ["CAM", "EKF", "MAP"][block as usize], Running::Across, dark);
        if block < 2 {
            canvas.line([left + 0.19, 0.915], [left + 0.265, 0.915], 0.006, dark);
        }
    }
    small_print(&mut canvas, [0.06, 1.0, width - 0.06, height - 0.04], 0.02, dark, seed);
    canvas
}

/// Height contours with tints, a river and a grid.
pub fn contour_map(size: [f32; 2], seed: u32) -> Canvas {
    let [width, height] = size;
    let mut canvas = Canvas::new(size, PAPER);
    let tints = [0x9CC5A1, 0xC9DDB0, 0xEFE8B4, 0xE6C98F, 0xCF9F6B, 0xB57F5A].map(colour);
    canvas.each(|x, y, [_, _, _, infrared]| {
        let level = 11.0 * fractal(0.9 * x / width, 0.9 * y / height, [3, 2], 5, seed) - 2.2;
        let tint = tints[(0.75 * level).clamp(0.0, 5.0) as usize];
        let line = (level - level.round()).abs() < 0.07;
        let river = (level - 0.6).abs() < 0.08;
        let [r, g, b] = if river { colour(0x3E7CB1) } else { tint.map(|c| if line { 0.3 * c } else { c }) };
        [r, g, b, infrared]
    });
    for step in 1..6 {
        let at = step as f32 * 0.2;
        canvas.line([at, 0.0], [at, height], 0.0015, ink(0x4A4A6A));
        canvas.line([0.0, at], [width, at], 0.0015, ink(0x4A4A6A));
    }
    canvas.frame([0.0, 0.0, width, height], 0.03, Coat::Opaque(PAPER));
    canvas.frame([0.028, 0.028, width - 0.028, height - 0.028], 0.004, TONER);
    canvas
}

/// Overlapping discs and bars in strong hues.
pub fn art_print(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, [0.72, 0.66, 0.54, 0.8]);
    let hues = [0xD1495B, 0xEDAE49, 0x00798C, 0x30638E, 0x003D5B, 0xF4F1DE, 0xE07A5F];
    for shape in 0..16 {
        let [x, y, r, hue, kind] = [0, 1, 2, 3, 4].map(|i| hash(shape, i, seed));
        let hue = ink(hues[(hue * 7.0) as usize]);
        let (x, y, r) = (x * size[0], y * size[1], 0.04 + 0.16 * r);
        match (kind * 3.0) as u32 {
            0 => canvas.disc([x, y], r, hue),
            1 => canvas.ring([x, y], r, 0.035, hue),
            _ => canvas.rectangle([x - r, y - 0.03, x + r, y + 0.03], hue),
        }
    }
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.05, Coat::Opaque(PAPER));
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.02, TONER);
    canvas
}

/// Coloured fields with signs and print.
pub fn safety_poster(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PAPER);
    let width = size[0];
    canvas.rectangle([0.0, 0.0, width, 0.13], ink(0xF2B705));
    write(&mut canvas, [0.04, 0.035], 0.06, "LASER LAB", Running::Across, TONER);
    for row in 0..4u32 {
        let y = 0.22 + 0.15 * row as f32;
        let hue = ink([0x1F5FA8, 0xC0262D, 0x1E8449, 0xF2B705][row as usize]);
        canvas.disc([0.1, y], 0.058, hue);
        canvas.line([0.07, y + 0.02], [0.13, y - 0.02], 0.018, ink(0xFFFFFF));
        small_print(&mut canvas, [0.19, y - 0.045, width - 0.04, y + 0.05], 0.03, TONER, seed + row);
    }
    canvas.frame([0.0, 0.0, width, size[1]], 0.006, TONER);
    canvas
}

pub fn exit_sign(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, coat(0x0B7A45, 0.5));
    let white = Coat::Opaque(PAPER);
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.01, white);
    write(&mut canvas, [0.16, 0.06], 0.08, "EXIT", Running::Across, white);
    canvas.polyline(&[[0.13, 0.1], [0.04, 0.1], [0.08, 0.06]], 0.016, white);
    canvas.line([0.04, 0.1], [0.08, 0.14], 0.016, white);
    canvas
}

pub fn clock(size: [f32; 2], _seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PAPER);
    let middle = [0.5 * size[0], 0.5 * size[1]];
    let hand = |hour: f32, reach: f32| {
        let (sin, cos) = (hour / 12.0 * std::f32::consts::TAU).sin_cos();
        [middle[0] + reach * sin, middle[1] - reach * cos]
    };
    canvas.ring(middle, 0.138, 0.02, TONER);
    for hour in 0..12 {
        canvas.line(hand(hour as f32, 0.105), hand(hour as f32, 0.12), 0.008, TONER);
    }
    canvas.line(middle, hand(10.15, 0.065), 0.009, TONER);
    canvas.line(middle, hand(1.8, 0.1), 0.006, TONER);
    canvas
}

/// Marker sketches: a room with a path, equations, a graph, a list. Marker ink vanishes at 830 nm, the black one too.
pub fn whiteboard(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, ENAMEL);
    canvas.mottle(0.4, 4, 0.05, seed);
    let [blue, red, black, green] = [0x2446A8, 0xC32F2F, 0x25252B, 0x1F7A3D].map(ink);
    canvas.polyline(&[[0.15, 0.2], [0.8, 0.18], [0.82, 0.62], [0.14, 0.64], [0.15, 0.2]], 0.011, black);
    canvas.polyline(&[[0.48, 0.19], [0.48, 0.4]], 0.011, black);
    let path: Vec<[f32; 2]> = (0..40)
        .map(|i| i as f32 / 39.0)
        .map(|t| [0.2 + 0.55 * t, 0.42 + 0.13 * (7.0 * t).sin() + 0.02 * hash(1, (t * 9.0) as u32, seed)])
        .collect();
    canvas.polyline(&path, 0.009, red);
    for point in [0, 13, 27, 39] {
        canvas.ring(path[point], 0.022, 0.008, blue);
    }
    for line in 0..4u32 {
        let y = 0.2 + 0.115 * line as f32;
        let text = ["X - F X + W", "Z - H X + V", "K - P H S", "P - I KH P"][line as usize];
        write(&mut canvas, [0.98, y], 0.06, text, Running::Across, if line % 2 == 0 { blue } else { black });
    }
    canvas.polyline(&[[1.0, 0.72], [1.0, 1.08], [1.65, 1.08]], 0.011, black);
    for (marker, phase) in [(red, 0.0), (green, 1.3)] {
        let curve: Vec<[f32; 2]> = (0..30)
            .map(|i| i as f32 / 29.0)
            .map(|t| [1.02 + 0.6 * t, 0.95 - 0.14 * (5.0 * t + phase).sin() * (1.0 - 0.5 * t)])
            .collect();
        canvas.polyline(&curve, 0.010, marker);
    }
    for item in 0..4u32 {
        let y = 0.74 + 0.1 * item as f32;
        canvas.frame([0.16, y, 0.2, y + 0.04], 0.007, black);
        small_print(
            &mut canvas,
            [0.24, y, 0.24 + 0.5 * hash(item, 9, seed) + 0.15, y + 0.05],
            0.06,
            green,
            seed + item,
        );
    }
    // An old drawing, not quite wiped off.
    canvas.ring([1.75, 0.3], 0.13, 0.03, ink(0xC3C8D8));
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.03, Coat::Opaque(STEEL));
    canvas
}

/// Cork with pinned sheets, photographs and a plan.
pub fn noticeboard(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CORK);
    canvas.mottle(0.012, 3, 0.45, seed);
    let sheets = [PAPER, PAPER, coat(0xF6E58D, 0.8), PAPER, coat(0xF8B4B4, 0.8), coat(0xB8E0F0, 0.8)];
    for sheet in 0..12u32 {
        let pick = |i| hash(sheet, i, seed + 1);
        let (column, row) = (sheet % 4, sheet / 4);
        let (left, top) = (0.08 + 0.35 * column as f32 + 0.06 * pick(0), 0.07 + 0.3 * row as f32 + 0.04 * pick(1));
        let (wide, tall) = (0.16 + 0.1 * pick(2), 0.16 + 0.1 * pick(3));
        let area = [left, top, left + wide, top + tall];
        canvas.rectangle(area, Coat::Opaque(sheets[(pick(4) * 6.0) as usize]));
        let inner = [left + 0.02, top + 0.03, left + wide - 0.02, top + tall - 0.02];
        match (pick(5) * 4.0) as u32 {
            0 => plot(&mut canvas, inner, ink(0xC03020), seed + sheet),
            1 => picture_of_rooms(&mut canvas, inner, seed + sheet),
            _ => small_print(&mut canvas, inner, 0.018, TONER, seed + sheet),
        }
        canvas.disc([left + 0.5 * wide, top + 0.012], 0.008, Coat::Opaque(RED_COAT));
    }
    canvas.frame([0.0, 0.0, size[0], size[1]], 0.025, Coat::Opaque(STEEL));
    canvas
}
