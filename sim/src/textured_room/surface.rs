//! Wood, cloth, paint: albedo (linear RGB) at a spot, metres from the picture's lower left corner.

use glam::{Vec2, Vec3};

use super::material::linear;
use super::noise::{cell, fractal, smoothstep, value};

/// Wall paint: roller marks and a few faint scuffs.
pub fn plaster(colour: Vec3, at: Vec2) -> Vec3 {
    let clouds = fractal(at * 1.3, 4, 11) - 0.5;
    let grain = fractal(at * 45.0, 2, 12) - 0.5;
    let scuff = smoothstep(0.80, 0.93, fractal(at * Vec2::new(5.0, 9.0), 4, 13));
    colour * (1.0 + 0.05 * clouds + 0.06 * grain - 0.10 * scuff)
}

/// Oak boards of 12 cm, laid along x, their joints staggered.
pub fn boards(at: Vec2) -> Vec3 {
    const WIDTH: f32 = 0.12;
    const LENGTH: f32 = 1.15;
    let row = (at.y / WIDTH).floor();
    let shifted = at.x / LENGTH + cell(row as i32, 0, 21);
    let column = shifted.floor();
    let seed = (row as i32 * 31 + column as i32) as u32;
    let tone = cell(row as i32, column as i32, 22);
    let grain = grain(at, seed);
    let (to_side, to_end) = (edge(at.y / WIDTH) * WIDTH, edge(shifted) * LENGTH);
    let joint = smoothstep(0.0008, 0.0025, to_side.min(to_end));
    let base = linear(0xb8_86_56).lerp(linear(0x8c_5c_36), tone);
    base * (0.62 + 0.62 * grain) * (0.25 + 0.75 * joint)
}

/// Planed wood; `seed` tells one piece from another.
pub fn wood(colour: Vec3, at: Vec2, size: Vec2, seed: u32) -> Vec3 {
    let along = if size.x >= size.y { at } else { Vec2::new(at.y, at.x) };
    // A wide top is glued of staves.
    let stave = if size.min_element() > 0.3 { (along.y / 0.11).floor() } else { 0.0 };
    let tone = 0.9 + 0.25 * cell(stave as i32, 3, seed);
    colour * tone * (0.66 + 0.6 * grain(along, seed ^ stave as u32))
}

/// Year rings cut lengthwise, pores, and now and then a knot; x runs along the grain. About 0–1.
fn grain(at: Vec2, seed: u32) -> f32 {
    let bend = fractal(at * Vec2::new(1.6, 7.0), 3, seed);
    let rings = (at.y * 190.0 + 16.0 * bend).sin() * 0.5 + 0.5;
    let fibre = fractal(at * Vec2::new(22.0, 420.0), 2, seed ^ 0x55);
    let pores = smoothstep(0.72, 0.85, value(at * Vec2::new(45.0, 700.0), seed ^ 0x77));
    let spot = (at * Vec2::new(1.1, 5.0)).floor();
    let there = cell(spot.x as i32, spot.y as i32, seed ^ 0x99) > 0.9;
    let from_knot = ((at * Vec2::new(1.1, 5.0) - spot - 0.5) * Vec2::new(14.0, 3.5)).length();
    let knot = if there { 1.0 - smoothstep(0.25, 0.5, from_knot) } else { 0.0 };
    0.42 * rings + 0.45 * fibre + 0.25 * bend - 0.25 * pores - 0.5 * knot
}

/// Distance from the nearer end of a cell of length 1.
fn edge(x: f32) -> f32 {
    let t = x - x.floor();
    t.min(1.0 - t)
}

/// Coarse weave with flecks of lighter yarn.
pub fn cloth(colour: Vec3, at: Vec2, seed: u32) -> Vec3 {
    let thread = (at / 0.006).floor();
    let over = (thread.x as i32 + thread.y as i32) & 1;
    let yarn = cell(thread.x as i32, thread.y as i32, seed);
    let wear = fractal(at * 4.0, 4, seed);
    let fleck = smoothstep(0.6, 0.8, fractal(at * 70.0, 2, seed ^ 3));
    colour * (0.5 + 0.2 * over as f32 + 0.35 * yarn + 0.45 * wear) + Vec3::splat(0.05 * fleck)
}

/// Folds every 9 cm or so: what the light does between them is painted on.
pub fn curtain(colour: Vec3, at: Vec2) -> Vec3 {
    let wander = fractal(Vec2::new(at.x * 5.0, at.y * 0.7), 3, 41);
    let fold = ((at.x / 0.09 + 1.6 * wander) * std::f32::consts::TAU).sin() * 0.5 + 0.5;
    let stripe = smoothstep(0.42, 0.5, edge(at.x / 0.045 + 0.2 * wander));
    colour * (0.35 + 0.6 * fold) * (1.0 - 0.25 * stripe) * (0.9 + 0.2 * value(at * 300.0, 42))
}

/// A woven rug: border, rows of diamonds, uneven dye.
pub fn rug(at: Vec2, size: Vec2) -> Vec3 {
    let (ground, dark, light) = (linear(0x9a_3b_2e), linear(0x22_2f_4a), linear(0xe2_d0_a6));
    let inward = at.min(size - at).min_element();
    let knot = (at / 0.008).floor();
    let uneven = 0.7 + 0.25 * cell(knot.x as i32, knot.y as i32, 51) + 0.35 * fractal(at * 3.0, 4, 52);
    let colour = if inward < 0.03 {
        dark
    } else if inward < 0.05 {
        light
    } else if inward < 0.17 {
        let zigzag = edge((at.x + at.y) / 0.12) + edge((at.x - at.y) / 0.12);
        if zigzag < 0.33 { light } else { dark }
    } else if inward < 0.19 {
        light
    } else {
        let tile = at / Vec2::new(0.26, 0.34);
        let diamond = 1.0 - (edge(tile.x) + edge(tile.y));
        let which = cell(tile.x.floor() as i32, tile.y.floor() as i32, 53);
        match (diamond * 12.0) as i32 {
            0 | 1 => light,
            2 | 3 => dark,
            4 if which > 0.5 => linear(0xc7_8a_3c),
            5 => light,
            8.. => dark.lerp(ground, which),
            _ => ground,
        }
    };
    colour * uneven
}

/// White lacquer with two panels.
pub fn door(at: Vec2, size: Vec2) -> Vec3 {
    let panel = |low: f32, high: f32| {
        let d = Vec2::new(at.x - 0.13, at.y - low).min(Vec2::new(size.x - 0.13 - at.x, high - at.y)).min_element();
        // A moulding: lit on its upper edge, dark in its groove.
        0.16 * smoothstep(0.0, 0.008, d) * (1.0 - smoothstep(0.012, 0.02, d)) - 0.05 * smoothstep(0.02, 0.03, d)
    };
    linear(0xe4_e0_d6) * (0.97 - panel(0.2, 0.95) - panel(1.1, 1.92) + 0.03 * fractal(at * 6.0, 3, 61))
}

/// Ribs every 4.5 cm.
pub fn radiator(at: Vec2, size: Vec2) -> Vec3 {
    let rib = smoothstep(0.05, 0.3, edge(at.x / 0.045));
    let rim = smoothstep(0.0, 0.02, at.y.min(size.y - at.y));
    linear(0xee_ec_e6) * (0.45 + 0.5 * rib * rim + 0.05 * fractal(at * 20.0, 2, 71))
}

/// Corrugated board with a strip of tape and a label.
pub fn cardboard(seed: u32, at: Vec2, size: Vec2) -> Vec3 {
    let flute = value(Vec2::new(at.x * 160.0, at.y * 2.0), seed);
    let stain = fractal(at * 6.0, 4, seed ^ 5);
    let board = linear(0xb0_8a_5e) * (0.75 + 0.18 * flute + 0.25 * stain);
    let middle = (at.x - size.x / 2.0).abs();
    let label = at - size * Vec2::new(0.58, 0.2);
    if label.min_element() > 0.0 && label.x < 0.09 && label.y < 0.06 {
        let bar = cell((label.x * 600.0) as i32, 1, seed) > 0.5 && (0.015..0.045).contains(&label.y);
        return linear(if bar { 0x20_20_20 } else { 0xf0_ee_e8 });
    }
    if middle < 0.025 { board.lerp(linear(0xd8_c0_8c), 0.6) } else { board }
}

/// Green with a lighter rib and veins; the picture goes once around the leaf.
pub fn leaf(seed: u32, at: Vec2, size: Vec2) -> Vec3 {
    let uv = at / size;
    let rib = 1.0 - smoothstep(0.0, 0.02, edge(uv.x * 2.0 + 0.5) * 0.5);
    let vein = 1.0 - smoothstep(0.0, 0.12, edge(uv.x * 14.0 + uv.y * 3.0));
    let base = linear(0x3f_74_35).lerp(linear(0x77_9a_45), cell(seed as i32, 1, 81));
    base * (0.7 + 0.5 * fractal(at * 30.0, 3, seed)) + linear(0x8f_b0_60) * (0.35 * rib + 0.15 * vein)
}
