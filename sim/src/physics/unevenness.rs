//! A smooth random field over the ground: what makes two places of one floor differ.

use rand_distr::{Distribution, StandardNormal};

use crate::random::stream;

/// Two independent fields over the plane, each with mean 0 and standard deviation 1 everywhere, twice differentiable.
///
/// Normal deviates on a square lattice, blended between its nodes; the lattice's pitch is the distance over which
/// the field forgets. Every node has its own random stream, so a place is the same whichever way it is reached.
#[derive(Clone, Debug)]
pub(super) struct Unevenness {
    seed: u64,
    pitch: f64,
}

impl Unevenness {
    /// `pitch` in metres.
    pub(super) fn new(seed: u64, pitch: f64) -> Self {
        Self { seed, pitch }
    }

    /// Both fields at (x, y), metres.
    pub(super) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let (x, y) = (x / self.pitch, y / self.pitch);
        let (column, row) = (x.floor(), y.floor());
        let (u, v) = (fade(x - column), fade(y - row));
        let mut sums = [0.0; 2];
        let mut weights_squared = 0.0;
        for (i, j, weight) in
            [(0, 0, (1.0 - u) * (1.0 - v)), (1, 0, u * (1.0 - v)), (0, 1, (1.0 - u) * v), (1, 1, u * v)]
        {
            let node = self.node(column as i32 + i, row as i32 + j);
            for (sum, value) in sums.iter_mut().zip(node) {
                *sum += weight * value;
            }
            weights_squared += weight * weight;
        }
        // A mean of several deviates is calmer than one: undone, or every floor would be even between the nodes.
        sums.map(|sum| sum / weights_squared.sqrt())
    }

    fn node(&self, column: i32, row: i32) -> [f64; 2] {
        let index = u64::from(column as u32) << 32 | u64::from(row as u32);
        let mut random = stream(self.seed, "floor", index);
        std::array::from_fn(|_| StandardNormal.sample(&mut random))
    }
}

/// From 0 to 1 with first and second derivative zero at both ends (Perlin 2002).
fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places far enough apart to know nothing of one another.
    fn sample(offset: (f64, f64)) -> Vec<[f64; 2]> {
        let field = Unevenness::new(3, 0.5);
        (0..40_i32)
            .flat_map(|i| (0..40_i32).map(move |j| (f64::from(i - 20), f64::from(j - 20))))
            .map(|(i, j)| field.at(i * 1.5 + offset.0, j * 1.5 + offset.1))
            .collect()
    }

    fn mean(values: impl Iterator<Item = f64>) -> f64 {
        let values: Vec<f64> = values.collect();
        values.iter().sum::<f64>() / values.len() as f64
    }

    #[test]
    fn every_place_varies_alike() {
        for offset in [(0.0, 0.0), (0.25, 0.25), (0.1, 0.3)] {
            let values = sample(offset);
            for field in 0..2 {
                let average = mean(values.iter().map(|value| value[field]));
                let variance = mean(values.iter().map(|value| value[field].powi(2)));
                assert!(average.abs() < 0.1 && (variance - 1.0).abs() < 0.15, "{offset:?}: {average}, {variance}");
            }
        }
    }

    #[test]
    fn neighbours_are_alike_and_strangers_are_not() {
        let here = sample((0.0, 0.0));
        let correlation = |offset| mean(here.iter().zip(sample(offset)).map(|(a, b)| a[0] * b[0]));
        assert!(correlation((0.05, 0.0)) > 0.9);
        assert!(correlation((0.5, 0.0)).abs() < 0.1);
        assert!(mean(here.iter().map(|value| value[0] * value[1])).abs() < 0.1, "the two fields are related");
    }
}
