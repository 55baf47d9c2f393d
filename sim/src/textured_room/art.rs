//! Posters, and the view from the window: linear RGB at a spot, metres from the lower left corner.

use glam::{Vec2, Vec3};

use super::material::linear;
use super::noise::{cell, fractal, smoothstep, value};
use super::print::{LETTER, set};

/// One of five posters, with a white margin.
pub fn poster(which: u32, at: Vec2, size: Vec2) -> Vec3 {
    let margin = 0.025;
    if at.min(size - at).min_element() < margin {
        return linear(0xf2_ef_e6);
    }
    let uv = (at - margin) / (size - 2.0 * margin);
    let scaled = Vec2::new(uv.x * size.x / size.y, uv.y);
    match which % 5 {
        0 => mountains(scaled, uv),
        1 => discs(scaled),
        2 => contours(at),
        3 => announcement(at, size, uv),
        _ => brushwork(at),
    }
}

/// Ridges that fade into haze under a large sun.
fn mountains(at: Vec2, uv: Vec2) -> Vec3 {
    let mut colour = linear(0xf2_c4_7e).lerp(linear(0x4f_7c_a8), uv.y);
    let sun = (at - Vec2::new(0.44, 0.66)).length();
    colour = colour.lerp(linear(0xfd_f0_c8), 1.0 - smoothstep(0.135, 0.14, sun));
    colour += linear(0x60_40_10) * (1.0 - smoothstep(0.14, 0.4, sun)) * 0.6;
    for ridge in 0..6 {
        let nearness = ridge as f32 / 5.0;
        let line = 0.58 - 0.09 * ridge as f32
            + (0.20 - 0.1 * nearness)
                * (fractal(Vec2::new(at.x * (2.5 + nearness * 3.0), ridge as f32 * 7.0), 6, 91) - 0.5)
                * 2.0;
        if at.y < line {
            let rock = fractal(at * Vec2::new(24.0, 50.0), 4, 92 + ridge);
            let snow = smoothstep(0.05, 0.0, line - at.y) * (1.0 - nearness) * smoothstep(0.4, 0.6, rock);
            colour = linear(0xa4_9c_b0).lerp(linear(0x1c_2e_34), nearness) * (0.7 + 0.6 * rock);
            colour = colour.lerp(Vec3::splat(0.85), snow);
        }
    }
    colour
}

/// Discs and bars, as a school of design of a hundred years ago liked them.
fn discs(at: Vec2) -> Vec3 {
    let mut colour = linear(0xec_e2_cc) * (0.95 + 0.08 * fractal(at * 60.0, 3, 101));
    let shapes: [(f32, f32, f32, u32); 6] = [
        (0.24, 0.70, 0.21, 0xd2_3b_2a),
        (0.48, 0.52, 0.15, 0x1d_4e_89),
        (0.30, 0.34, 0.11, 0xf0_b4_29),
        (0.56, 0.80, 0.07, 0x22_22_22),
        (0.14, 0.18, 0.08, 0x22_22_22),
        (0.52, 0.18, 0.12, 0xd2_3b_2a),
    ];
    for (x, y, radius, ink) in shapes {
        let distance = (at - Vec2::new(x, y)).length();
        let cover = 1.0 - smoothstep(radius - 0.002, radius + 0.002, distance);
        // Rings cut out of some, overprinting in all.
        let ring = if ink == 0x22_22_22 && (distance * 60.0).fract() > 0.5 { 0.0 } else { 1.0 };
        colour = colour.lerp(linear(ink) * (0.4 + 0.6 * colour), cover * ring);
    }
    let slanted = at.y - 0.9 * at.x + 0.05;
    for (offset, width) in [(0.0, 0.012), (0.06, 0.004), (0.09, 0.002), (0.36, 0.02), (-0.2, 0.006)] {
        if (slanted - offset).abs() < width {
            colour = linear(0x22_22_22);
        }
    }
    colour
}

/// A hiking map.
fn contours(at: Vec2) -> Vec3 {
    let height = fractal(at * 3.2, 5, 111);
    let step = height * 34.0;
    let to_line = (step - step.round()).abs();
    let bold = (step.round() as i32).rem_euclid(5) == 0;
    let line = 1.0 - smoothstep(if bold { 0.16 } else { 0.07 }, if bold { 0.24 } else { 0.15 }, to_line);
    let mut colour = linear(0xcf_df_b4).lerp(linear(0xf0_e4_c4), smoothstep(0.35, 0.65, height));
    if height < 0.36 {
        colour = linear(0x9c_c8_de);
    }
    colour *= 0.96 + 0.08 * value(at * 260.0, 112);
    colour = colour.lerp(linear(0x9a_62_34), 0.85 * line);
    let trail = (at.y - 0.28 - 0.22 * fractal(Vec2::new(at.x * 3.0, 4.0), 4, 113)).abs();
    if trail < 0.0035 && (at.x * 40.0).fract() < 0.65 {
        colour = linear(0xc0_20_28);
    }
    let grid = (at / 0.1).fract().min_element();
    if grid < 0.015 { colour.lerp(linear(0x40_60_80), 0.45) } else { colour }
}

/// A concert, or a conference.
fn announcement(at: Vec2, size: Vec2, uv: Vec2) -> Vec3 {
    let rays = ((uv - Vec2::new(0.5, 0.36)) * size).to_angle();
    let from_sun = ((uv - Vec2::new(0.5, 0.36)) * size).length() / size.x;
    let ray = (rays * 12.0 / std::f32::consts::PI).sin() > 0.0;
    let mut colour = linear(if ray { 0xe8_9a_2c } else { 0xd9_62_28 }) * (0.85 + 0.3 * fractal(at * 30.0, 4, 121));
    if from_sun < 0.2 {
        colour = linear(0xf6_e2_b0);
        // A robot in front of the sun: box, mast, eyes, wheels.
        let p = (uv - Vec2::new(0.5, 0.36)) * size / size.x;
        let inside = |x: f32, y: f32, w: f32, h: f32| (p.x - x).abs() < w && (p.y - y).abs() < h;
        let eye = ((p.x.abs() - 0.035).powi(2) + (p.y - 0.07).powi(2)).sqrt() < 0.012;
        let wheel = ((p.x.abs() - 0.06).powi(2) + (p.y + 0.11).powi(2)).sqrt() < 0.035;
        if (inside(0.0, -0.05, 0.1, 0.05) || inside(0.0, 0.02, 0.012, 0.03) || inside(0.0, 0.07, 0.075, 0.022) || wheel)
            && !eye
        {
            colour = linear(0x1e_24_30);
        }
    }
    let line = |text: &str, top: f32, share: f32| {
        let height = share * size.x / (text.len() as f32 * LETTER);
        set(text, Vec2::new((1.0 - share) / 2.0 * size.x, top * size.y), height, at)
    };
    let lettering = line("SUNBLIND", 0.93, 0.86) + line("a night of dead reckoning", 0.78, 0.8);
    let small = line("doors open when the sun is down - bring your own wheels", 0.13, 0.86)
        + line("GYRO  ODOMETER  INFRARED  & FRIENDS", 0.09, 0.8);
    colour.lerp(linear(0x1e_24_30), (lettering + small).min(1.0))
}

/// Broad strokes of paint over each other.
fn brushwork(at: Vec2) -> Vec3 {
    let bend = Vec2::new(fractal(at * 2.2, 3, 131), fractal(at * 2.2, 3, 132));
    let flow = at + 0.35 * bend;
    let stroke = fractal(flow * Vec2::new(6.0, 22.0), 4, 133);
    let patch = (flow * Vec2::new(5.0, 8.0)).floor();
    let palette = [0x1b_3a_4b, 0xd8_57_2a, 0xe9_d8_a6, 0x0a_93_96, 0x9b_22_26, 0xee_9b_00];
    let pick = |seed| linear(palette[(cell(patch.x as i32, patch.y as i32, seed) * palette.len() as f32) as usize]);
    let paint = pick(134).lerp(pick(135), smoothstep(0.45, 0.55, stroke));
    paint * (0.6 + 0.8 * fractal(flow * Vec2::new(30.0, 240.0), 2, 136))
}

/// Sky, far woods, a house across the street.
pub fn view(at: Vec2, size: Vec2) -> Vec3 {
    let uv = at / size;
    let clouds = smoothstep(0.45, 0.75, fractal(at * Vec2::new(1.6, 4.0), 5, 141));
    let mut colour = linear(0xe6_ee_f4).lerp(linear(0x9c_bc_dc), uv.y).lerp(Vec3::splat(0.95), clouds) * 1.5;
    let woods = 0.34 + 0.16 * fractal(Vec2::new(at.x * 6.0, 1.0), 5, 142);
    if uv.y < woods {
        colour = linear(0x6a_80_5a) * (0.5 + 0.9 * fractal(at * 30.0, 4, 143));
    }
    let roof = 0.62 - 0.5 * (uv.x - 0.66).abs();
    if (0.48..0.84).contains(&uv.x) && uv.y < roof {
        colour = linear(0xb4_6c_54) * (0.8 + 0.3 * fractal(at * Vec2::new(20.0, 90.0), 2, 144));
        if uv.y < 0.46 {
            colour = linear(0xd8_cc_b8);
            let pane = (at * Vec2::new(8.0, 6.0)).fract();
            if pane.min_element() > 0.3 && pane.max_element() < 0.8 {
                colour = linear(0x4a_5a_68);
            }
        }
    }
    if uv.y < 0.14 {
        colour = linear(0x7c_98_58) * (0.7 + 0.6 * fractal(at * 40.0, 3, 145));
    }
    // Exposed for the room, the world outside washes out.
    (colour * 1.5).lerp(Vec3::splat(1.5), 0.25)
}
