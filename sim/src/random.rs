//! Random numbers: one independent stream for each (seed, name, frame), so that what one effect draws never moves
//! what another draws, and frames can be made in any order by any number of threads.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The stream of `name` (an effect, such as `depth noise`) in frame number `frame` of a run with `seed`.
pub fn stream(seed: u64, name: &str, frame: u64) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key[8..16].copy_from_slice(&fnv1a(name).to_le_bytes());
    let mut stream = ChaCha8Rng::from_seed(key);
    stream.set_stream(frame);
    stream
}

/// FNV-1a, 64 bits (Fowler, Noll, Vo): spreads names over keys; nothing here needs to be secret.
fn fnv1a(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::rand_core::Rng;

    #[test]
    fn streams_repeat_and_differ() {
        let first = |seed, name, frame| stream(seed, name, frame).next_u64();
        assert_eq!(first(1, "depth noise", 2), first(1, "depth noise", 2));
        let all = [
            first(1, "depth noise", 2),
            first(2, "depth noise", 2),
            first(1, "colour noise", 2),
            first(1, "depth noise", 3),
        ];
        for (index, value) in all.iter().enumerate() {
            assert!(!all[..index].contains(value));
        }
    }
}
