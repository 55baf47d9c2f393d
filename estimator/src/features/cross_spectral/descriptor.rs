//! What the edges about a point look like, mostly whatever their contrast's sign.

use super::edges::{Edges, ORIENTATIONS, Seen};

/// Samples along the window's side.
const SIDE: usize = 4;
/// Between samples, pixels.
const STEP: f32 = 7.0;
const HALF: usize = SIDE * SIDE * ORIENTATIONS;
/// What the signed half weighs, of 1: most things keep their contrast's sign from colour to infrared, leaves and dyes
/// reverse it. From half of the recorded pairs.
const SIGNED: f32 = 0.3;

/// 4×4 samples × 4 orientations, without and with sign; unit length each.
#[derive(Clone, Debug)]
pub struct Descriptor {
    unsigned: [f32; HALF],
    signed: [f32; HALF],
}

impl Descriptor {
    /// About (x, y), pixels.
    pub fn at(edges: &Edges, x: f32, y: f32) -> Self {
        let (mut unsigned, mut signed) = ([0.0; HALF], [0.0; HALF]);
        let along = |middle: f32| std::array::from_fn(|k| middle + STEP * (k as f32 - (SIDE - 1) as f32 / 2.0));
        let seen: [[Seen; SIDE]; SIDE] = edges.at(along(x), along(y));
        for (sample, seen) in seen.iter().flatten().enumerate() {
            unsigned[sample * ORIENTATIONS..][..ORIENTATIONS].copy_from_slice(&seen.unsigned);
            signed[sample * ORIENTATIONS..][..ORIENTATIONS].copy_from_slice(&seen.signed);
        }
        // No value is negative: what is left of the mean would make all windows alike.
        let mean = unsigned.iter().sum::<f32>() / HALF as f32;
        unsigned.iter_mut().for_each(|value| *value -= mean);
        normalise(&mut unsigned);
        normalise(&mut signed);
        Self { unsigned, signed }
    }

    /// 1 is equal, but for the contrast's sign.
    pub fn similarity(&self, other: &Self) -> f32 {
        let signed = dot(&self.signed, &other.signed);
        (1.0 - SIGNED) * dot(&self.unsigned, &other.unsigned) + SIGNED * signed.abs()
    }
}

/// Dot product in eight running sums: a fixed order of additions that the compiler can still vectorise.
fn dot(a: &[f32; HALF], b: &[f32; HALF]) -> f32 {
    let mut sums = [0.0_f32; 8];
    for (a, b) in a.chunks_exact(8).zip(b.chunks_exact(8)) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum()
}

fn normalise(values: &mut [f32; HALF]) {
    let norm = dot(values, values).sqrt();
    if norm > 0.0 {
        values.iter_mut().for_each(|value| *value /= norm);
    }
}
