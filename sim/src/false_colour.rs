//! Colours for numbers that nobody sees: depth.

/// Near is bright: viridis, legible to the colour-blind and in greyscale, backwards.
const DEPTH: colorous::Gradient = colorous::VIRIDIS;

/// Of a depth between the nearest shown (0) and the farthest (1); beyond, the ends.
pub(crate) fn of_depth(share: f32) -> [u8; 3] {
    DEPTH.eval_continuous(1.0 - f64::from(share.clamp(0.0, 1.0))).into_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_is_darker_than_near() {
        let brightness = |share| of_depth(share).iter().map(|&value| u32::from(value)).sum::<u32>();
        let steps: Vec<u32> = (-1..=11).map(|tenth| brightness(tenth as f32 / 10.0)).collect();
        assert!(steps[1..12].windows(2).all(|pair| pair[0] > pair[1]), "{steps:?}");
        assert_eq!((steps[0], steps[12]), (steps[1], steps[11]));
    }
}
