//! 64 pixels a word, four words at a time: a width that any compiler turns into the vectors its processor has.

use std::ops::{BitAnd, BitOr, BitXor, Not, Shr};

/// Words side by side.
pub(super) const LANES: usize = 4;

/// One bit for each of 256 pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Lanes(pub [u64; LANES]);

impl Lanes {
    /// The same bit everywhere.
    #[inline(always)]
    pub fn all(bit: bool) -> Self {
        Self([if bit { u64::MAX } else { 0 }; LANES])
    }

    /// Where the bit is set `yes`, elsewhere `no`.
    #[inline(always)]
    pub fn choose(self, yes: Self, no: Self) -> Self {
        no ^ ((yes ^ no) & self)
    }
}

#[inline(always)]
fn each(mut a: Lanes, b: Lanes, operation: impl Fn(u64, u64) -> u64) -> Lanes {
    // A loop, here as elsewhere, as not all of an iterator's or an array's methods are sure to be inlined.
    for lane in 0..LANES {
        a.0[lane] = operation(a.0[lane], b.0[lane]);
    }
    a
}

impl BitXor for Lanes {
    type Output = Self;
    #[inline(always)]
    fn bitxor(self, other: Self) -> Self {
        each(self, other, |a, b| a ^ b)
    }
}

impl BitAnd for Lanes {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        each(self, other, |a, b| a & b)
    }
}

impl BitOr for Lanes {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        each(self, other, |a, b| a | b)
    }
}

impl Not for Lanes {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        each(self, self, |a, _| !a)
    }
}

impl Shr<u32> for Lanes {
    type Output = Self;
    /// Moves every word's bits down by itself; none pass from word to word.
    #[inline(always)]
    fn shr(self, places: u32) -> Self {
        each(self, self, |a, _| a >> places)
    }
}

/// Sum and carry of three bits.
#[inline(always)]
pub(super) fn add(a: Lanes, b: Lanes, c: Lanes) -> (Lanes, Lanes) {
    let difference = a ^ b;
    (difference ^ c, difference.choose(c, a))
}

/// Difference and borrow of a − b − borrow.
#[inline(always)]
pub(super) fn subtract(a: Lanes, b: Lanes, borrow: Lanes) -> (Lanes, Lanes) {
    let difference = a ^ b;
    (difference ^ borrow, difference.choose(b, borrow))
}

/// Whether a < b, both as planes of bits, lowest first.
#[inline(always)]
pub(super) fn less<const PLANES: usize>(a: [Lanes; PLANES], b: [Lanes; PLANES]) -> Lanes {
    let mut borrow = Lanes::all(false);
    for plane in 0..PLANES {
        borrow = (a[plane] ^ b[plane]).choose(b[plane], borrow);
    }
    borrow
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_bits_add_subtract_and_compare_as_numbers_do() {
        let bit = |on: u32| Lanes::all(on == 1);
        for (a, b, c) in (0..8).map(|n| (n & 1, n >> 1 & 1, n >> 2)) {
            assert_eq!(add(bit(a), bit(b), bit(c)), (bit((a + b + c) & 1), bit((a + b + c) >> 1)));
            let difference = a as i32 - b as i32 - c as i32;
            let borrow = u32::from(difference < 0);
            assert_eq!(subtract(bit(a), bit(b), bit(c)), (bit(difference.rem_euclid(2) as u32), bit(borrow)));
        }
        for (a, b) in (0..64).map(|n| (n & 7, n >> 3)) {
            let planes = |n: u32| [bit(n & 1), bit(n >> 1 & 1), bit(n >> 2)];
            assert_eq!(less(planes(a), planes(b)), bit(u32::from(a < b)));
        }
    }
}
