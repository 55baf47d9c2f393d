//! Matching of descriptors: nearest neighbour, ratio test, mutual choice.

use pulp::{Arch, NullaryFnOnce};
use serde::{Deserialize, Serialize};

use super::surf::Feature;

/// Parameters of the matching.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MatchParams {
    /// Most that the nearest descriptor's distance may be of the second nearest's (Lowe 2004), 0–1.
    pub max_ratio: f32,
}

impl Default for MatchParams {
    fn default() -> Self {
        Self { max_ratio: 0.8 }
    }
}

/// A pair of features that show the same thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Match {
    /// Index into the first list.
    pub from: usize,
    /// Index into the second list.
    pub to: usize,
    /// Euclidean distance of the descriptors, 0–2.
    pub distance: f32,
}

/// The nearest and the second nearest seen so far: (similarity, index), similarity.
#[derive(Clone, Copy)]
struct Nearest {
    best: f32,
    index: usize,
    second: f32,
}

impl Nearest {
    const NONE: Self = Self { best: f32::NEG_INFINITY, index: usize::MAX, second: f32::NEG_INFINITY };

    fn offer(&mut self, similarity: f32, index: usize) {
        if similarity > self.best {
            *self = Self { best: similarity, index, second: self.best };
        } else if similarity > self.second {
            self.second = similarity;
        }
    }
}

/// Pairs of `from` and `to` that are each other's nearest, pass the ratio test and share the sign of the
/// Laplacian (Bay et al. §4.3); ordered by `from`.
pub fn match_features(from: &[Feature], to: &[Feature], params: &MatchParams) -> Vec<Match> {
    let (forward, backward) = Arch::new().dispatch(Comparison { from, to });
    let distance = |similarity: f32| (2.0 - 2.0 * similarity).max(0.0).sqrt();
    forward
        .iter()
        .enumerate()
        .filter(|(i, nearest)| nearest.index != usize::MAX && backward[nearest.index].index == *i)
        .map(|(i, nearest)| (Match { from: i, to: nearest.index, distance: distance(nearest.best) }, nearest.second))
        .filter(|(found, second)| {
            // Without a second neighbour there is nothing to confuse it with.
            *second == f32::NEG_INFINITY || found.distance < params.max_ratio * distance(*second)
        })
        .map(|(found, _)| found)
        .collect()
}

/// Every feature of `from` held against every one of `to`, and the nearest of each.
/// A type of its own: [`Arch::dispatch`] inlines no closure.
struct Comparison<'a> {
    from: &'a [Feature],
    to: &'a [Feature],
}

impl NullaryFnOnce for Comparison<'_> {
    type Output = (Vec<Nearest>, Vec<Nearest>);

    #[inline(always)]
    fn call(self) -> Self::Output {
        let Self { from, to } = self;
        let mut forward = vec![Nearest::NONE; from.len()];
        let mut backward = vec![Nearest::NONE; to.len()];
        for sign in [false, true] {
            let of_sign = |features: &[Feature]| -> Vec<usize> {
                (0..features.len()).filter(|&i| features[i].laplacian_positive == sign).collect()
            };
            let (from_indices, to_indices) = (of_sign(from), of_sign(to));
            let mut blocks: Vec<Block> = to_indices.chunks(LANES).map(|indices| Block::of(to, indices)).collect();
            for &i in &from_indices {
                for (indices, block) in to_indices.chunks(LANES).zip(&mut blocks) {
                    // Unit vectors: the nearest has the largest dot product.
                    let similarities = block.dot(&from[i].descriptor);
                    // Of most pairs neither is near to the other, and then it's enough to know that of all at once.
                    if exceeds(&similarities, &[forward[i].second; LANES]) || exceeds(&similarities, &block.second) {
                        for (lane, &j) in indices.iter().enumerate() {
                            forward[i].offer(similarities[lane], j);
                            backward[j].offer(similarities[lane], i);
                            block.second[lane] = backward[j].second;
                        }
                    }
                }
            }
        }
        (forward, backward)
    }
}

/// Descriptors compared at once.
const LANES: usize = 8;

/// As many descriptors beside each other.
struct Block {
    /// Their numbers, those of one place together.
    numbers: [[f32; LANES]; 64],
    /// Similarity of each one's second nearest so far.
    second: [f32; LANES],
}

impl Block {
    fn of(features: &[Feature], indices: &[usize]) -> Self {
        // Nothing is nearer than nobody's neighbours.
        let mut block = Self { numbers: [[0.0; LANES]; 64], second: [f32::INFINITY; LANES] };
        for (lane, &index) in indices.iter().enumerate() {
            block.second[lane] = f32::NEG_INFINITY;
            block.numbers.iter_mut().zip(&features[index].descriptor).for_each(|(to, &from)| to[lane] = from);
        }
        block
    }

    /// Dot products with `descriptor`, each in eight running sums: one order of additions whatever the processor.
    #[inline(always)]
    fn dot(&self, descriptor: &[f32; 64]) -> [f32; LANES] {
        let mut total = [0.0; LANES];
        for first in 0..8 {
            let mut sum = [0.0_f32; LANES];
            for number in 0..8 {
                let (a, b) = (descriptor[first + 8 * number], &self.numbers[first + 8 * number]);
                for lane in 0..LANES {
                    sum[lane] += a * b[lane];
                }
            }
            for lane in 0..LANES {
                total[lane] += sum[lane];
            }
        }
        total
    }
}

/// Whether any of `values` is more than the bound beside it.
#[inline(always)]
fn exceeds(values: &[f32; LANES], bounds: &[f32; LANES]) -> bool {
    let mut any = false;
    for lane in 0..LANES {
        any |= values[lane] > bounds[lane];
    }
    any
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn feature(direction: usize, lean: f32, laplacian_positive: bool) -> Feature {
        let mut descriptor = [0.0; 64];
        descriptor[direction] = 1.0;
        descriptor[63] = lean;
        let norm = (1.0 + lean * lean).sqrt();
        descriptor.iter_mut().for_each(|value| *value /= norm);
        Feature { x: 0.0, y: 0.0, scale: 2.0, orientation: 0.0, response: 1.0, laplacian_positive, descriptor }
    }

    #[test]
    fn partners_find_each_other_in_any_order() {
        let from = [feature(0, 0.0, true), feature(1, 0.0, true), feature(2, 0.0, true)];
        let to = [feature(2, 0.1, true), feature(0, 0.1, true), feature(5, 0.1, true)];
        let pairs: Vec<_> =
            match_features(&from, &to, &MatchParams::default()).iter().map(|m| (m.from, m.to)).collect();
        assert_eq!(pairs, [(0, 1), (2, 0)]);
    }

    /// Features at random, in both signs.
    fn crowd(count: usize, seed: u64) -> Vec<Feature> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut one = |index: usize| {
            let mut feature = feature(0, 0.0, index.is_multiple_of(3));
            let numbers: [f32; 64] = std::array::from_fn(|_| random.random_range(-1.0..1.0));
            let norm = numbers.iter().map(|number| number * number).sum::<f32>().sqrt();
            feature.descriptor = numbers.map(|number| number / norm);
            feature
        };
        (0..count).map(&mut one).collect()
    }

    #[test]
    fn a_crowd_is_matched_as_if_one_by_one() {
        let mut matches = 0;
        for (count, others) in [(1, 1), (5, 8), (9, 60), (60, 9), (47, 53)] {
            let (from, to) = (crowd(count, 1), crowd(others, 2));
            let near = |a: &Feature, b: &Feature| -> f64 {
                a.descriptor.iter().zip(&b.descriptor).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
            };
            // From the nearest on.
            let neighbours = |of: &Feature, among: &[Feature]| -> Vec<(f64, usize)> {
                let same = |&i: &usize| among[i].laplacian_positive == of.laplacian_positive;
                let mut found: Vec<_> = (0..among.len()).filter(same).map(|i| (near(of, &among[i]), i)).collect();
                found.sort_by(|a, b| b.0.total_cmp(&a.0));
                found
            };
            let distance = |similarity: f64| (2.0 - 2.0 * similarity).sqrt();
            let expected: Vec<_> = (0..count)
                .filter_map(|i| {
                    let there = neighbours(&from[i], &to);
                    let &(best, j) = there.first()?;
                    let back = neighbours(&to[j], &from)[0].1;
                    let sure = there.get(1).is_none_or(|second| distance(best) < 0.97 * distance(second.0));
                    (back == i && sure).then_some((i, j))
                })
                .collect();
            let found = match_features(&from, &to, &MatchParams { max_ratio: 0.97 });
            assert_eq!(found.iter().map(|found| (found.from, found.to)).collect::<Vec<_>>(), expected);
            matches += expected.len();
        }
        assert!(matches > 10, "{matches} do not tell much");
    }

    #[test]
    fn twins_are_ambiguous() {
        let from = [feature(0, 0.0, true)];
        let to = [feature(0, 0.1, true), feature(0, 0.11, true)];
        assert!(match_features(&from, &to, &MatchParams::default()).is_empty());
    }

    #[test]
    fn dark_never_meets_light() {
        let pairs = match_features(&[feature(0, 0.0, true)], &[feature(0, 0.0, false)], &MatchParams::default());
        assert!(pairs.is_empty());
    }
}
