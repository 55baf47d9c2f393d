//! Depth from the infrared image alone: every window of it is sought in the stored image of the pattern on the
//! reference plane. Nothing here knows of light, sun or truth; a window that resembles nothing has no depth, unless the hole
//! is a narrow one.
//!
//! A surface nearer than the reference plane shows the pattern further right, by b·f·(1/z − 1/z₀) pixels.

mod holes;
mod lanes;
mod refine;
mod residual;
mod search;

use std::ops::Range;

use pulp::{Arch, NullaryFnOnce};
use rayon::prelude::*;
use sunblind_estimator::image::{DepthImage, InfraredImage};

use super::calibration::{Calibration, REFERENCE_RAW, STEPS_PER_PIXEL};
use super::projector::Projector;
use refine::{Live, NO_SHIFT, Reference, Row};
use residual::Residual;
use search::{BAND, BitImage, NO_MATCH, ReferenceBits};

/// Raw value of a pixel without depth.
pub const NO_DEPTH: u16 = 2047;

/// Half the matched window, pixels: 9×9 (ROS `kinect_calibration/technical` says 9×9 or 9×7).
const RADIUS: usize = 4;
/// Shifts tried, in pixels of an image [`WIDTH`] wide. With 580 px and 75 mm from 0.46 m to infinity; the 64 that are
/// often quoted would end at 0.64 m. A surface at infinity shows the pattern 36.25 px left of the reference.
const SHIFTS: Range<isize> = -36..60;
/// A full image's columns; of fewer, shifts are the shorter.
const WIDTH: isize = 640;
/// Columns of the reference beyond the image on each side: the furthest shift and a window.
const MARGIN: usize = 72;
/// Brightness of a dot in the stored reference, of 1023; the tiles' middle dots saturate. No matter for matching.
const REFERENCE_DOT: f32 = 400.0;
/// Columns at the right that the device leaves without depth (commonly seen in raw frames).
const INVALID_BAND: usize = 8;

/// The depth engine of one unit.
pub struct Matcher {
    bits: ReferenceBits,
    reference: Reference,
    width: usize,
    height: usize,
}

impl Matcher {
    /// Stores the reference: what this unit's camera sees of this unit's pattern on the reference plane.
    pub fn new(calibration: &Calibration, projector: &Projector) -> Self {
        let camera = &calibration.infrared;
        let (width, height) = camera.size();
        let wide = width + 2 * MARGIN;
        let pixels: Vec<u16> = (0..wide * height)
            .into_par_iter()
            .map(|index| {
                let column = (index % wide) as f64 - MARGIN as f64;
                let (x, y) = (column - camera.cx, (index / wide) as f64 - camera.cy);
                let (x, y) = camera.distortion.undistort(x / camera.fx, y / camera.fy);
                let light = projector.light_seen_at(x, y, calibration.reference_distance);
                (light * REFERENCE_DOT).min(1023.0) as u16
            })
            .collect();
        let residual = Residual::of(&pixels, wide, height);
        let [first, end] = [SHIFTS.start, SHIFTS.end].map(|shift| shift * width as isize / WIDTH);
        let bits = ReferenceBits::of(&residual, MARGIN, width, first..end);
        Self { bits, reference: Reference::of(&residual, MARGIN, first), width, height }
    }

    /// Raw disparity of every pixel, [`NO_DEPTH`] where there is none.
    ///
    /// # Panics
    /// When the image is not of the size this unit's camera has.
    pub fn depth(&self, infrared: &InfraredImage) -> DepthImage {
        self.depth_on(Arch::new(), infrared)
    }

    /// On a kind of processor that this one is, or is a better one than. All find the same.
    fn depth_on(&self, processor: Arch, infrared: &InfraredImage) -> DepthImage {
        assert_eq!(infrared.size(), (self.width, self.height), "an infrared image of another camera");
        let (live_bits, live) = processor.dispatch(Beginning(infrared));
        let mut depth = DepthImage::filled(self.width, self.height, NO_DEPTH);
        let (first, last) = (RADIUS * self.width, (self.height - RADIUS) * self.width);
        let bands = depth.pixels_mut()[first..last].par_chunks_mut(BAND * self.width);
        bands.enumerate().for_each(|(band, raw)| {
            let top = RADIUS + band * BAND;
            processor.dispatch(Band { matcher: self, live_bits: &live_bits, live: &live, top, raw });
        });
        holes::close(&mut depth);
        depth
    }
}

/// An image to find depth in: what is done before its bands.
struct Beginning<'a>(&'a InfraredImage);

impl NullaryFnOnce for Beginning<'_> {
    type Output = (BitImage, Live);

    #[inline(always)]
    fn call(self) -> Self::Output {
        let (width, height) = self.0.size();
        let residual = Residual::of(self.0.pixels(), width, height);
        (BitImage::of(&residual, 0, width), Live::of(&residual))
    }
}

/// Some rows of an image, from `top` on, and where their raw disparity goes. A type, and not a closure: what the
/// processor is to run must be inlined whole, and a closure's call is not.
struct Band<'a> {
    matcher: &'a Matcher,
    live_bits: &'a BitImage,
    live: &'a Live,
    top: usize,
    raw: &'a mut [u16],
}

impl NullaryFnOnce for Band<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Matcher { bits, reference, width, .. } = self.matcher;
        let mut found = vec![NO_MATCH; self.raw.len()];
        bits.search(self.live_bits, self.top, self.top + self.raw.len() / width, *width, &mut found);
        let (mut scratch, mut shifts) = (Row::new(*width), vec![NO_SHIFT; *width]);
        let rows = self.raw.chunks_exact_mut(*width).zip(found.chunks_exact_mut(*width));
        for (row, (raw, found)) in rows.enumerate() {
            found[..RADIUS].fill(NO_MATCH);
            found[width - INVALID_BAND..].fill(NO_MATCH);
            reference.refine_row(self.live, self.top + row, found, &mut scratch, &mut shifts);
            for (raw, &shift) in raw.iter_mut().zip(&shifts) {
                *raw = raw_of_shift(shift);
            }
        }
    }
}

/// Rounds to the device's eighths of a pixel; [`NO_SHIFT`] to [`NO_DEPTH`].
#[inline(always)]
fn raw_of_shift(shift: f32) -> u16 {
    // Converting cuts fractions off.
    let raw = (REFERENCE_RAW + 0.5) as f32 - STEPS_PER_PIXEL as f32 * shift;
    raw.clamp(0.0, f32::from(NO_DEPTH)) as u16
}

#[cfg(test)]
mod tests;
