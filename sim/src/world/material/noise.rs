//! Noise that repeats with the texture: hashed lattices that wrap at its edges.

/// A number in 0..1 for a lattice point. An integer hash (multiply and xor-shift), equal on every machine.
pub fn hash(x: u32, y: u32, seed: u32) -> f32 {
    let mut h = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    h ^= h >> 15;
    (h >> 8) as f32 / (1 << 24) as f32
}

/// Smooth noise in 0..1 at (u, v) in texture coordinates, `cells` lattice cells from edge to edge.
pub fn smooth(u: f32, v: f32, cells: [u32; 2], seed: u32) -> f32 {
    let (x, y) = (u * cells[0] as f32, v * cells[1] as f32);
    let (column, row) = (x.floor(), y.floor());
    let ease = |t: f32| t * t * (3.0 - 2.0 * t);
    let (s, t) = (ease(x - column), ease(y - row));
    let wrap = |i: f32, cells: u32| (i as i64).rem_euclid(i64::from(cells)) as u32;
    let [x0, x1] = [column, column + 1.0].map(|i| wrap(i, cells[0]));
    let [y0, y1] = [row, row + 1.0].map(|i| wrap(i, cells[1]));
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    mix(mix(hash(x0, y0, seed), hash(x1, y0, seed), s), mix(hash(x0, y1, seed), hash(x1, y1, seed), s), t)
}

/// Sum of `octaves` of [`smooth`], each twice as fine and half as strong; in 0..1, about 0.5 on average.
pub fn fractal(u: f32, v: f32, cells: [u32; 2], octaves: u32, seed: u32) -> f32 {
    let mut sum = 0.0;
    let mut weight = 0.0;
    for octave in 0..octaves {
        let strength = 0.5f32.powi(octave as i32);
        sum += strength * smooth(u, v, cells.map(|cells| cells << octave), seed.wrapping_add(octave));
        weight += strength;
    }
    sum / weight
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_wraps_and_stays_in_range() {
        for i in 0..100 {
            let v = i as f32 / 100.0;
            assert!((fractal(0.0, v, [5, 7], 4, 1) - fractal(1.0, v, [5, 7], 4, 1)).abs() < 1e-4);
            assert!((0.0..=1.0).contains(&fractal(v, 0.3, [5, 7], 4, 1)));
        }
    }

    #[test]
    fn the_hash_is_uniform_enough() {
        let mean = (0..4096).map(|i| hash(i % 64, i / 64, 9)).sum::<f32>() / 4096.0;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
    }
}
