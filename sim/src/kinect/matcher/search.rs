//! Whole-pixel disparity: for every pixel the candidate at which the window's bits differ least from the reference's.
//!
//! Bit-sliced: a word holds one bit of 64 neighbouring pixels, a number of n bits is n such words, and every operation
//! works on all of them. A word's outer bits only feed their neighbours' windows, 56 pixels of it are results.

use std::ops::Range;

use wide::i16x16;

use super::lanes::{LANES, Lanes, add, less, subtract};
use super::residual::Residual;
use super::{RADIUS, SHIFTS};

/// Pixels a word has results for.
const USEFUL: usize = 64 - 2 * RADIUS;
/// Rows searched together; what they need stays in the processor's first cache.
pub(super) const BAND: usize = 40;
const WINDOW: usize = 2 * RADIUS + 1;

/// Bits of a number of differences; a candidate with more than they can count is no match. Unrelated windows of this
/// pattern differ in 36 ± 5 of 81 bits.
const COST_PLANES: usize = 5;
/// By how much the next best candidate, unless it is the best one's neighbour, must be worse for a match to be unique.
/// Chosen in the tests of the matcher: wrong matches stay below one in a hundred in any noise.
const MARGIN: u32 = 2;
const DISPARITY_PLANES: usize = (SHIFTS.end - SHIFTS.start).ilog2() as usize + 1;

/// An image of single bits: brighter than its surroundings or not.
pub(super) struct BitImage {
    /// Groups of [`LANES`] words in a row.
    groups: usize,
    words: Vec<Lanes>,
}

/// [`LANES`] × [`USEFUL`] pixels of a row.
const GROUP: usize = LANES * USEFUL;

impl BitImage {
    /// `width` columns of an image, starting `left` columns into it; what lies outside is dark.
    #[inline(always)]
    pub fn of(residual: &Residual, left: isize, width: usize) -> Self {
        let groups = width.div_ceil(GROUP);
        let mut words = Vec::with_capacity(groups * residual.height);
        // Bits of the row, padded so that every word's outer pixels exist.
        let mut bits = vec![0_u64; (groups * GROUP).div_ceil(64) + 2];
        for y in 0..residual.height {
            let start = left - RADIUS as isize;
            for (index, bits) in bits.iter_mut().enumerate() {
                let first = start + 64 * index as isize;
                let room = residual.row_and_room(y);
                if let Some(pixels) = usize::try_from(first).ok().and_then(|first| room.get(first..first + 64)) {
                    *bits = brighter(pixels.first_chunk().expect("as many"));
                    continue;
                }
                let inside = |column: isize| column.clamp(0, residual.width as isize) as usize;
                let pixels = &residual.row(y)[inside(first)..inside(first + 64)];
                let skipped = inside(first).wrapping_add_signed(-first);
                *bits = 0;
                for (place, &value) in pixels.iter().enumerate() {
                    *bits |= u64::from(value > 0) << (place + skipped);
                }
            }
            words.extend((0..groups).map(|group| {
                Lanes(std::array::from_fn(|lane| {
                    let first = (group * LANES + lane) * USEFUL;
                    let pair = u128::from(bits[first / 64]) | u128::from(bits[first / 64 + 1]) << 64;
                    (pair >> (first % 64)) as u64
                }))
            }));
        }
        Self { groups, words }
    }

    #[inline(always)]
    fn at(&self, group: usize, y: usize) -> Lanes {
        self.words[y * self.groups + group]
    }
}

/// Which of 64 pixels are brighter than their surroundings.
#[inline(always)]
fn brighter(pixels: &[i16; 64]) -> u64 {
    let mut bits = 0;
    for (part, pixels) in pixels.as_chunks().0.iter().enumerate() {
        bits |= u64::from(i16x16::new(*pixels).simd_gt(i16x16::ZERO).to_bitmask()) << (16 * part);
    }
    bits
}

/// The reference as every candidate disparity sees it.
pub(super) struct ReferenceBits {
    candidates: Vec<BitImage>,
}

impl ReferenceBits {
    /// `margin`: columns of the reference left of the live image's first. `shifts`: one for each candidate.
    pub fn of(reference: &Residual, margin: usize, width: usize, shifts: Range<isize>) -> Self {
        let candidate = |shift| BitImage::of(reference, margin as isize - shift, width);
        Self { candidates: shifts.map(candidate).collect() }
    }

    /// The best candidate of each pixel in rows `top..bottom`, or [`NO_MATCH`], to `found` (row after row). At most
    /// [`BAND`] rows, no nearer to the image's upper and lower border than a window reaches.
    #[inline(always)]
    pub fn search(&self, live: &BitImage, top: usize, bottom: usize, width: usize, found: &mut [u8]) {
        for group in 0..live.groups {
            let mut band = [Best::default(); BAND];
            let band = &mut band[..bottom - top];
            for (index, candidate) in self.candidates.iter().enumerate() {
                search_candidate(live, candidate, group, top, index, band);
            }
            let first = group * GROUP;
            for (row, best) in found.chunks_exact_mut(width).zip(band) {
                best.write(&mut row[first..(first + GROUP).min(width)]);
            }
        }
    }
}

/// Written where no candidate, or more than one, resembles the pixel's window.
pub(super) const NO_MATCH: u8 = u8::MAX;

/// What the search knows of 256 pixels.
#[derive(Clone, Copy)]
struct Best {
    cost: [Lanes; COST_PLANES],
    disparity: [Lanes; DISPARITY_PLANES],
    /// The next best cost, not counting the best candidate's neighbours.
    next_cost: [Lanes; COST_PLANES],
    /// The candidate before this one is the best so far.
    beside_best: Lanes,
}

impl Default for Best {
    fn default() -> Self {
        let (worst, none) = ([Lanes::all(true); COST_PLANES], Lanes::all(false));
        Self { cost: worst, disparity: [none; DISPARITY_PLANES], next_cost: worst, beside_best: none }
    }
}

impl Best {
    /// Judges one more candidate.
    #[inline(always)]
    fn update(&mut self, candidate: usize, cost: [Lanes; 7]) {
        let hopeless = cost[5] | cost[6];
        let (mut capped, mut loser) = (self.cost, self.cost);
        for plane in 0..COST_PLANES {
            capped[plane] = cost[plane] | hopeless;
        }
        let better = less(capped, self.cost);
        for plane in 0..COST_PLANES {
            loser[plane] = better.choose(self.cost[plane], capped[plane]);
        }
        let next = less(loser, self.next_cost) & !self.beside_best;
        for plane in 0..COST_PLANES {
            self.next_cost[plane] = next.choose(loser[plane], self.next_cost[plane]);
            self.cost[plane] = better.choose(capped[plane], self.cost[plane]);
        }
        for (place, plane) in self.disparity.iter_mut().enumerate() {
            *plane = better.choose(Lanes::all(candidate >> place & 1 == 1), *plane);
        }
        self.beside_best = better;
    }

    /// Where the best candidate leads the next by [`MARGIN`].
    #[inline(always)]
    fn unique(&self) -> Lanes {
        let mut carry = Lanes::all(false);
        let mut needed = [Lanes::all(false); COST_PLANES];
        for (plane, needed) in needed.iter_mut().enumerate() {
            (*needed, carry) = add(self.cost[plane], Lanes::all(MARGIN >> plane & 1 == 1), carry);
        }
        !carry & !less(self.next_cost, needed)
    }

    #[inline(always)]
    fn write(&self, out: &mut [u8]) {
        let unique = self.unique();
        for (lane, pixels) in out.chunks_mut(USEFUL).enumerate() {
            let unique = unique.0[lane];
            for (x, pixel) in pixels.iter_mut().enumerate() {
                let mut disparity = 0;
                for (place, plane) in self.disparity.iter().enumerate() {
                    disparity |= ((plane.0[lane] >> x) as u8 & 1) << place;
                }
                *pixel = if unique >> x & 1 == 1 { disparity } else { NO_MATCH };
            }
        }
    }
}

/// One candidate's costs down a band: the number of differing bits in a sliding window.
#[inline(always)]
fn search_candidate(
    live: &BitImage,
    reference: &BitImage,
    group: usize,
    top: usize,
    candidate: usize,
    band: &mut [Best],
) {
    let none = Lanes::all(false);
    let mut cost = [none; 7];
    let mut rows = [[none; 4]; WINDOW];
    for step in 0..band.len() + 2 * RADIUS {
        let y = top - RADIUS + step;
        let across = sum_of_nine(live.at(group, y) ^ reference.at(group, y));
        let leaving = std::mem::replace(&mut rows[step % WINDOW], across);
        let (mut carry, mut borrow) = (none, none);
        for plane in 0..7 {
            let out = if plane < 4 { leaving[plane] } else { none };
            let into = if plane < 4 { across[plane] } else { none };
            let (rest, next_borrow) = subtract(cost[plane], out, borrow);
            let (sum, next_carry) = add(rest, into, carry);
            (cost[plane], borrow, carry) = (sum, next_borrow, next_carry);
        }
        if step >= 2 * RADIUS {
            band[step - 2 * RADIUS].update(candidate, cost);
        }
    }
}

/// How many of nine neighbouring bits are set. The result for the middle one lands [`RADIUS`] places lower.
#[inline(always)]
fn sum_of_nine(bits: Lanes) -> [Lanes; 4] {
    let (ones, twos) = add(bits, bits >> 1, bits >> 2);
    let (one, two_a) = add(ones, ones >> 3, ones >> 6);
    let (two_b, four_a) = add(twos, twos >> 3, twos >> 6);
    let (two, four_b) = (two_a ^ two_b, two_a & two_b);
    [one, two, four_a ^ four_b, four_a & four_b]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nine_bits_are_counted() {
        let bits = 0b1011_0111_1111_1001_0110_u64;
        let sums = sum_of_nine(Lanes([bits; LANES]));
        for x in 0..USEFUL {
            let count = (0..4).map(|plane| (sums[plane].0[1] >> x & 1) << plane).sum::<u64>();
            assert_eq!(count, u64::from((bits >> x & 0x1FF).count_ones()), "at {x}");
        }
    }
}
