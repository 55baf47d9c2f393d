//! What somebody drew on the whiteboard, and what is on the laptop: linear RGB at a spot, metres from the lower left
//! corner.

use glam::{Vec2, Vec3};

use super::material::linear;
use super::noise::{cell, fractal, smoothstep};
use super::print::{LETTER, set};

/// Width of a marker's stroke, metres.
const STROKE: f32 = 0.006;

const BLACK: u32 = 0x20_24_2a;
const BLUE: u32 = 0x1c_44_a0;
const RED: u32 = 0xb8_24_28;
const GREEN: u32 = 0x1c_7a_44;

/// The board: a block diagram, a plot of two trajectories, and notes.
pub fn whiteboard(at: Vec2, size: Vec2) -> Vec3 {
    let wiped = smoothstep(0.55, 0.8, fractal(at * Vec2::new(2.0, 7.0), 4, 151));
    let mut colour = linear(0xf4_f5_f4) * (1.0 - 0.07 * wiped);
    // Hands shake: everything is drawn through a slight warp.
    let shaken = at + 0.008 * Vec2::new(fractal(at * 9.0, 2, 152) - 0.5, fractal(at * 9.0, 2, 153) - 0.5);
    let mut ink = |cover: f32, pen: u32| colour = colour.lerp(linear(pen), cover.min(1.0));
    for (x, label, pen) in [(0.10, "EKF", BLUE), (0.42, "GATE", RED), (0.74, "SVSF", BLUE)] {
        let corner = Vec2::new(x, size.y - 0.30);
        ink(outline(shaken, corner, corner + Vec2::new(0.22, 0.14)), BLACK);
        ink(set(label, corner + Vec2::new(0.03, 0.11), 0.075, shaken), pen);
        ink(segment(shaken, corner + Vec2::new(0.22, 0.07), corner + Vec2::new(0.31, 0.07)), BLACK);
        ink(segment(shaken, corner + Vec2::new(0.31, 0.07), corner + Vec2::new(0.285, 0.09)), BLACK);
        ink(segment(shaken, corner + Vec2::new(0.31, 0.07), corner + Vec2::new(0.285, 0.05)), BLACK);
    }
    let plot = shaken - Vec2::new(0.12, 0.12);
    ink(segment(plot, Vec2::ZERO, Vec2::new(0.72, 0.0)), BLACK);
    ink(segment(plot, Vec2::ZERO, Vec2::new(0.0, 0.45)), BLACK);
    if (0.0..0.7).contains(&plot.x) {
        let truth = 0.08 + 0.22 * smoothstep(0.0, 0.6, plot.x) + 0.03 * (plot.x * 14.0).sin();
        let drift = truth + 0.22 * plot.x * plot.x;
        let noisy = drift + 0.03 * (fractal(Vec2::new(plot.x * 40.0, 0.0), 3, 154) - 0.5);
        ink(line(plot.y - truth), GREEN);
        ink(line(plot.y - noisy), RED);
    }
    let notes =
        ["x' = f(x, u) + w", "z  = h(x) + v", "P = FPF' + Q", "slip on wet grass?", "ask Ana: LAB KEY", "TODO: clouds"];
    for (row, note) in notes.iter().enumerate() {
        let corner = Vec2::new(0.95, size.y - 0.42 - 0.085 * row as f32);
        ink(set(note, corner, 0.055, shaken), [BLACK, BLACK, BLUE, RED, GREEN, BLACK][row]);
    }
    colour
}

fn line(distance: f32) -> f32 {
    1.0 - smoothstep(STROKE * 0.4, STROKE * 0.7, distance.abs())
}

fn segment(at: Vec2, from: Vec2, to: Vec2) -> f32 {
    let along = to - from;
    let t = ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    line((at - from - along * t).length())
}

fn outline(at: Vec2, low: Vec2, high: Vec2) -> f32 {
    let outside = (low - at).max(at - high);
    line(outside.max_element())
}

/// An editor on a dark ground: what the laptop shows.
pub fn screen(at: Vec2, size: Vec2) -> Vec3 {
    const CODE: [&str; 8] = [
        "fn update(&mut self, z: Z) {",
        "    let v = z - self.h();",
        "    if v > self.bound {",
        "        return Rejected;",
        "    }",
        "    self.x += self.k * v;",
        "    self.p.symmetrise();",
        "}",
    ];
    let height = 0.9 * size.x / (30.0 * LETTER);
    let row = ((size.y - 0.02 - at.y) / (1.2 * height)).floor();
    let mut colour = linear(0x1e_22_2c);
    if row >= 0.0 && at.y > 0.01 {
        let code = CODE[row as usize % CODE.len()];
        let corner = Vec2::new(0.012, size.y - 0.02 - row * 1.2 * height);
        let pen = [0x7f_d0_ff, 0xff_c0_70, 0xd8_e0_e8][(cell(row as i32, 2, 161) * 3.0) as usize];
        colour = colour.lerp(linear(pen), set(code, corner, height, at));
    }
    colour
}

/// Five rows of dark keys and a touch pad.
pub fn keyboard(at: Vec2, size: Vec2) -> Vec3 {
    let case = linear(0x8c_90_96);
    let keys = (at - Vec2::new(0.02, 0.09)) / 0.02;
    let pad = (at - Vec2::new(size.x / 2.0, 0.045)).abs();
    if keys.min_element() > 0.0 && keys.x < 15.0 && keys.y < 5.0 {
        let key = (keys + Vec2::new(0.25 * keys.y.floor(), 0.0)).fract();
        return if key.min_element() > 0.14 { linear(0x26_28_2c) } else { case };
    }
    if pad.x < 0.05 && pad.y < 0.032 { case * 0.8 } else { case }
}
