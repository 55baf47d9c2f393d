//! What lies on the ground outdoors.

use super::canvas::{Canvas, Coat};
use super::noise::{fractal, hash, smooth};
use super::outdoor_plants::shaded;
use super::substance::*;

/// A colour of one substance, brighter or darker by `factor`.
fn toned(substance: Substance, factor: f32) -> Coat {
    Coat::Opaque(substance.map(|albedo| albedo * factor))
}

/// Draws something at `at` and, where it reaches over an edge, on the other side too, so that the texture repeats.
pub fn repeated(size: [f32; 2], at: [f32; 2], reach: f32, mut draw: impl FnMut([f32; 2])) {
    let shifts = |axis: usize| {
        let (at, size) = (at[axis], size[axis]);
        [0.0, size, -size].into_iter().filter(move |shift| at + shift > -reach && at + shift < size + reach)
    };
    for dx in shifts(0) {
        for dy in shifts(1) {
            draw([at[0] + dx, at[1] + dy]);
        }
    }
}

/// Asphalt some years old: stones of all tones in grey bitumen, stains, cracks sealed with fresh bitumen.
pub fn asphalt(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, ASPHALT);
    let [width, height] = size;
    canvas.shade(|x, y| 0.72 + 0.56 * hash((x * 210.0) as u32, (y * 210.0) as u32, seed));
    for stone in 0..5200 {
        let [x, y, tone, radius] = [0, 1, 2, 3].map(|i| hash(stone, i, seed + 1));
        let coat = match tone {
            0.55.. => toned(ASPHALT, 1.25 + tone),
            _ => toned(ASPHALT, 0.35 + 0.6 * tone),
        };
        let radius = 0.004 + 0.008 * radius * radius;
        repeated(size, [x * width, y * height], radius, |at| canvas.disc(at, radius, coat));
    }
    canvas.shade(|x, y| 0.78 + 0.44 * fractal(x / width, y / height, [4, 4], 4, seed + 2));
    for crack in 0..4 {
        let [mut x, mut y] = [0, 1].map(|i| hash(crack, i, seed + 3));
        let mut heading = 6.3 * hash(crack, 2, seed + 3);
        for step in 0..26 {
            heading += 1.3 * (hash(crack, 10 + step, seed + 4) - 0.5);
            let (sin, cos) = heading.sin_cos();
            let [dx, dy] = [0.045 * cos, 0.045 * sin];
            repeated(size, [x * width, y * height], 0.1, |[x, y]| {
                canvas.line([x, y], [x + dx, y + dy], 0.014, Coat::Opaque([0.045, 0.045, 0.046, 0.05]));
            });
            x += dx / width;
            y += dy / height;
        }
    }
    canvas
}

/// Slabs of 50 cm, each of its own tone, with sand and moss in their joints.
pub fn pavers(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CONCRETE);
    let [width, height] = size;
    let edge = 0.5;
    let count = (width / edge).round() as u32;
    let cell = |metres: f32| ((metres / edge) as u32).min(count - 1);
    canvas.each(|x, y, [r, g, b, infrared]| {
        let tone = 0.72 + 0.5 * hash(cell(x), cell(y), seed);
        // Some are tinted with iron oxide.
        let [red, blue] = if hash(cell(x), cell(y), seed + 1) > 0.7 { [1.08, 0.8] } else { [1.0, 1.0] };
        [r * tone * red, g * tone, b * tone * blue, infrared * tone]
    });
    canvas.shade(|x, y| 0.9 + 0.2 * hash((x * 250.0) as u32, (y * 250.0) as u32, seed + 2));
    canvas.mottle(0.12, 4, 0.22, seed + 3);
    for pore in 0..1500 {
        let [x, y, radius] = [0, 1, 2].map(|i| hash(pore, i, seed + 4));
        canvas.disc([x * width, y * height], 0.002 + 0.005 * radius * radius, toned(CONCRETE, 0.55));
    }
    for line in 0..count {
        let at = line as f32 * edge;
        let joint = |along: f32, across: f32| {
            let wave = 0.004 * (smooth(along / width, 0.0, [40, 1], seed + 5 + line) - 0.5);
            across.min(width - across).abs() - 0.006 - wave
        };
        let sand = Coat::Opaque([0.13, 0.115, 0.09, 0.17]);
        canvas.cover([0.0, 0.0, width, height], sand, |x, y| joint(y, (x - at).abs()));
        canvas.cover([0.0, 0.0, width, height], sand, |x, y| joint(x, (y - at).abs()));
        for moss in 0..60 {
            let [along, off, radius] = [0, 1, 2].map(|i| hash(moss, i, seed + 20 + line));
            let green = toned([0.06, 0.09, 0.03, 0.4], 0.7 + off);
            let (along, off) = (along * width, at + 0.02 * (off - 0.5));
            for place in [[off, along], [along, off]] {
                repeated(size, place, 0.02, |at| canvas.disc(at, 0.003 + 0.009 * radius * radius, green));
            }
        }
    }
    canvas
}

/// Cast concrete: formwork boards of 25 cm, bubbles, streaks from rain.
pub fn concrete(size: [f32; 2], seed: u32) -> Canvas {
    cast(size, CONCRETE, seed)
}

/// The same in a tunnel.
pub fn sooty_concrete(size: [f32; 2], seed: u32) -> Canvas {
    cast(size, SOOTY_CONCRETE, seed)
}

fn cast(size: [f32; 2], concrete: Substance, seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, concrete);
    let [width, height] = size;
    canvas.shade(|x, y| {
        let board = hash((y / 0.25) as u32, 0, seed);
        let grain = fractal(x / width, y / height, [3, 120], 3, seed + 1);
        let streak = fractal(x / width, y / height, [28, 1], 3, seed + 2);
        (0.84 + 0.2 * board) * (0.9 + 0.2 * grain) * (0.72 + 0.5 * streak)
    });
    canvas.mottle(0.3, 5, 0.2, seed + 3);
    for bubble in 0..420 {
        let [x, y, radius] = [0, 1, 2].map(|i| hash(bubble, i, seed + 4));
        let at = [x * width, y * height];
        repeated(size, at, 0.01, |at| canvas.disc(at, 0.002 + 0.006 * radius * radius, toned(concrete, 0.4)));
    }
    for board in 0..(height / 0.25) as u32 {
        let y = 0.25 * board as f32;
        canvas.rectangle([0.0, y, width, y + 0.005], toned(concrete, 0.55));
    }
    for tie in 0..4 {
        let at = [width * (0.25 + 0.5 * (tie % 2) as f32), height * (0.25 + 0.5 * (tie / 2) as f32)];
        canvas.disc(at, 0.014, toned(concrete, 0.35));
    }
    canvas
}

/// A mown lawn: blades of many greens, dry ones among them, clover, bare spots.
pub fn lawn(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, shaded(GRASS, 0.45));
    let [width, height] = size;
    canvas.shade(|x, y| 0.6 + 0.8 * fractal(x / width, y / height, [20, 20], 3, seed + 9));
    for blade in 0..15_000 {
        let [x, y, turn, tone] = [0, 1, 2, 3].map(|i| hash(blade, i, seed));
        let [u, v] = [x, y];
        let lush = fractal(u, v, [5, 5], 3, seed + 1);
        let (sin, cos) = (6.3 * turn).sin_cos();
        let reach = 0.025 + 0.035 * hash(blade, 4, seed);
        let coat = match hash(blade, 5, seed) {
            0.93.. => toned([0.30, 0.25, 0.13, 0.5], 0.6 + 0.6 * tone),
            _ => {
                let [r, g, b, infrared] = shaded(GRASS, 0.55 + 0.55 * tone + 0.6 * lush);
                // Where it is less lush it is yellower.
                Coat::Opaque([r * (1.5 - 0.9 * lush), g, b * (0.7 + 0.4 * lush), infrared.min(0.62)])
            }
        };
        let at = [x * width, y * height];
        repeated(size, at, 0.06, |[x, y]| canvas.line([x, y], [x + reach * cos, y + reach * sin], 0.0045, coat));
    }
    for clover in 0..260 {
        let [x, y, tone] = [0, 1, 2].map(|i| hash(clover, i, seed + 3));
        if fractal(x, y, [4, 4], 2, seed + 4) < 0.55 {
            continue;
        }
        for leaf in 0..3 {
            let (sin, cos) = (2.1 * leaf as f32 + 6.3 * tone).sin_cos();
            let at = [x * width + 0.01 * cos, y * height + 0.01 * sin];
            repeated(size, at, 0.01, |at| canvas.disc(at, 0.009, toned(GRASS, 0.8 + 0.7 * tone)));
        }
    }
    for spot in 0..7 {
        let [x, y, radius] = [0, 1, 2].map(|i| hash(spot, i, seed + 5));
        for crumb in 0..40 {
            let [dx, dy, tone] = [0, 1, 2].map(|i| hash(crumb, i, seed + 6 + spot) - 0.5);
            let at = [x * width + 0.1 * radius * dx * 2.0, y * height + 0.1 * radius * dy * 2.0];
            repeated(size, at, 0.02, |at| canvas.disc(at, 0.005, toned(SOIL, 1.2 + tone)));
        }
    }
    canvas
}

/// Loose pebbles of 1 to 4 cm, each with the shadow beneath it.
pub fn gravel(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, PEBBLE.map(|albedo| 0.3 * albedo));
    let [width, height] = size;
    for pebble in 0..5200 {
        let [x, y, tone, hue] = [0, 1, 2, 3].map(|i| hash(pebble, i, seed));
        let radius = 0.005 + 0.013 * hash(pebble, 4, seed).powi(2);
        let [r, g, b, infrared] = PEBBLE.map(|albedo| albedo * (0.45 + 0.95 * tone));
        let tint = match hue {
            0.8.. => [1.15, 0.92, 0.75],
            0.6.. => [0.9, 1.0, 1.1],
            _ => [1.0; 3],
        };
        let stone = [r * tint[0], g * tint[1], b * tint[2], infrared];
        repeated(size, [x * width, y * height], 0.03, |[x, y]| {
            let under = Coat::Opaque(PEBBLE.map(|albedo| 0.16 * albedo));
            canvas.disc([x + 0.003, y + 0.003], radius + 0.002, under);
            canvas.disc([x, y], radius, Coat::Opaque(stone.map(|albedo| 0.8 * albedo)));
            canvas.disc([x - 0.2 * radius, y - 0.2 * radius], 0.65 * radius, Coat::Opaque(stone));
        });
    }
    canvas
}

/// A bed's soil: clods, small stones, bark chips, fallen leaves.
pub fn earth(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, SOIL);
    let [width, height] = size;
    canvas.shade(|x, y| 0.35 + 1.3 * fractal(x / width, y / height, [24, 24], 4, seed));
    for clod in 0..900 {
        let [x, y, tone, radius] = [0, 1, 2, 3].map(|i| hash(clod, i, seed + 1));
        let radius = 0.006 + 0.02 * radius.powi(3);
        repeated(size, [x * width, y * height], 0.03, |[x, y]| {
            canvas.disc([x + 0.003, y + 0.003], radius, toned(SOIL, 0.35));
            canvas.disc([x, y], radius, toned(SOIL, 0.7 + 0.8 * tone));
        });
    }
    for chip in 0..420 {
        let [x, y, turn, tone] = [0, 1, 2, 3].map(|i| hash(chip, i, seed + 2));
        let (sin, cos) = (6.3 * turn).sin_cos();
        let coat = if tone > 0.8 { toned(PEBBLE, 0.9) } else { toned(BARK, 0.8 + tone) };
        repeated(size, [x * width, y * height], 0.06, |[x, y]| {
            canvas.line([x, y], [x + 0.03 * cos, y + 0.03 * sin], 0.009, coat);
        });
    }
    canvas
}

/// A cast-iron cover, 60 cm, ribbed in squares, worn bright, with its concrete ring.
pub fn manhole(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, CONCRETE);
    let [width, _] = size;
    let centre = [0.5 * width; 2];
    canvas.mottle(0.05, 4, 0.25, seed);
    canvas.disc(centre, 0.45 * width, Coat::Opaque([0.02, 0.02, 0.02, 0.02]));
    let iron = Coat::Opaque(IRON);
    canvas.disc(centre, 0.435 * width, iron);
    for ring in [0.40, 0.31] {
        canvas.ring(centre, ring * width, 0.012, Coat::Opaque([0.03, 0.028, 0.026, 0.035]));
    }
    let pitch = width / 14.0;
    for column in -7..7_i32 {
        for row in -7..7_i32 {
            let at = [0.5 + column as f32 + 0.5, 0.5 + row as f32 + 0.5].map(|i| (i - 0.5) * pitch + 0.5 * width);
            let off = (at[0] - centre[0]).hypot(at[1] - centre[1]);
            if off < 0.28 * width || (off > 0.33 * width && off < 0.385 * width) {
                let half = 0.3 * pitch;
                let worn = Coat::Opaque(IRON.map(|albedo| albedo * 1.9));
                canvas.rectangle([at[0] - half, at[1] - half, at[0] + half, at[1] + half], worn);
            }
        }
    }
    canvas.mottle(0.1, 3, 0.3, seed + 1);
    canvas
}

/// A gully's grate: bars over a dark hole in an iron frame.
pub fn grate(size: [f32; 2], seed: u32) -> Canvas {
    let mut canvas = Canvas::new(size, IRON);
    let [width, height] = size;
    let slots = 9;
    for slot in 0..slots {
        let x = 0.06 + (width - 0.12) * (slot as f32 + 0.25) / slots as f32;
        let hole = Coat::Opaque([0.008, 0.008, 0.008, 0.01]);
        for [top, bottom] in [[0.06, 0.5 * height - 0.02], [0.5 * height + 0.02, height - 0.06]] {
            canvas.rectangle([x, top, x + 0.5 * (width - 0.12) / slots as f32, bottom], hole);
        }
    }
    canvas.frame([0.0, 0.0, width, height], 0.02, Coat::Opaque(IRON.map(|albedo| albedo * 1.8)));
    canvas.mottle(0.08, 3, 0.3, seed);
    canvas
}
