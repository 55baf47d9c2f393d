//! Smooth noise from a hash of grid points: the grain of the textures.

use glam::Vec2;

/// Mixes bits well enough for textures (finaliser of MurmurHash3, 32 bits).
pub fn hash(mut value: u32) -> u32 {
    value ^= value >> 16;
    value = value.wrapping_mul(0x85eb_ca6b);
    value ^= value >> 13;
    value = value.wrapping_mul(0xc2b2_ae35);
    value ^ (value >> 16)
}

/// A number in [0, 1) that belongs to a grid cell.
pub fn cell(x: i32, y: i32, seed: u32) -> f32 {
    let mixed = hash((x as u32).wrapping_mul(0x9e37_79b9) ^ hash((y as u32).wrapping_add(hash(seed))));
    (mixed >> 8) as f32 / (1 << 24) as f32
}

/// Noise in [0, 1) that varies over a length of 1.
pub fn value(at: Vec2, seed: u32) -> f32 {
    // Vec2::floor is a call into the C library where the target has no instruction for it, and textures live here.
    let floor = |x: f32| x as i32 - i32::from(x < 0.0);
    let (x, y) = (floor(at.x), floor(at.y));
    let t = at - Vec2::new(x as f32, y as f32);
    let t = t * t * (3.0 - 2.0 * t);
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    mix(mix(cell(x, y, seed), cell(x + 1, y, seed), t.x), mix(cell(x, y + 1, seed), cell(x + 1, y + 1, seed), t.x), t.y)
}

/// Noise in [0, 1) at several scales: each octave has half the length and half the height of the one before.
pub fn fractal(at: Vec2, octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut height, mut total, mut at) = (0.0, 1.0, 0.0, at);
    for octave in 0..octaves {
        sum += height * value(at, seed.wrapping_add(octave));
        total += height;
        height *= 0.5;
        at = at * 2.0 + Vec2::new(17.3, 9.1);
    }
    sum / total
}

/// 0 below `from`, 1 above `to`, smooth in between.
pub fn smoothstep(from: f32, to: f32, value: f32) -> f32 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_stays_in_range_and_is_smooth() {
        for index in 0..2000 {
            let at = Vec2::new(index as f32 * 0.037 - 20.0, index as f32 * 0.011);
            let noise = fractal(at, 5, 3);
            assert!((0.0..1.0).contains(&noise));
            assert!((fractal(at + Vec2::splat(1e-4), 5, 3) - noise).abs() < 0.01);
        }
    }
}
