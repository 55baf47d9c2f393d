//! What a projector throws, learnt from what the camera beside it sees.

use crate::image::Image;

/// Light by where it leaves the projector, in infrared pixels of infinitely far surfaces; row by row. Its mean is 1.
///
/// A dot keeps its row and the place in the pattern that it comes from, wherever it falls: seen at column u on a surface at
/// depth z it left at u − f·b/z. What the surfaces reflect changes as the robot moves and averages out; the dots stay.
#[derive(Clone, Debug)]
pub(super) struct Pattern {
    width: usize,
    /// Sums of light over images, and of how many.
    light: Vec<f32>,
    weight: Vec<f32>,
}

/// Columns to the left of the image: f·b/z of 580 px, 75 mm and 0.4 m, the nearest a Kinect sees, is 109.
const MARGIN: usize = 112;
/// Images after which the older ones have half the weight: the projector turns a little as it warms up. A guess.
const MEMORY: f32 = 60.0;
/// An unlearnt share is taken for even light: one image holds as much of the surfaces as of the dots, of n of them 1/n.
/// In images; a guess.
const DOUBT: f32 = 2.0;

impl Pattern {
    /// Nothing known: even light.
    pub fn unknown(width: usize, height: usize) -> Self {
        let size = (width + MARGIN) * height;
        Self { width: width + MARGIN, light: vec![0.0; size], weight: vec![0.0; size] }
    }

    /// Forgets a little, before an image is learnt.
    pub fn fade(&mut self) {
        let keep = 0.5_f32.powf(1.0 / MEMORY);
        self.light.iter_mut().chain(&mut self.weight).for_each(|value| *value *= keep);
    }

    /// Learns that where (column, row) is seen at `disparity` there was `light`, relative to the light around.
    pub fn learn(&mut self, column: usize, row: usize, disparity: f32, light: f32) {
        let Some((place, share)) = self.place(column, disparity) else { return };
        let index = row * self.width + place;
        for (index, weight) in [(index, 1.0 - share), (index + 1, share)] {
            self.light[index] += weight * light;
            self.weight[index] += weight;
        }
    }

    /// The light expected in each pixel of an image whose surfaces lie at these disparities.
    pub fn light(&self, disparity: &Image<f32>) -> Image<f32> {
        let known = self.light.iter().zip(&self.weight);
        let known: Vec<f32> = known.map(|(light, weight)| (light + DOUBT) / (weight + DOUBT)).collect();
        let (width, height) = disparity.size();
        let mut expected = Image::filled(width, height, 1.0);
        let rows = expected.pixels_mut().chunks_exact_mut(width).zip(disparity.pixels().chunks_exact(width));
        for ((expected, disparity), known) in rows.zip(known.chunks_exact(self.width)) {
            for (column, (expected, &disparity)) in expected.iter_mut().zip(disparity).enumerate() {
                if let Some((place, share)) = self.place(column, disparity) {
                    *expected = known[place] * (1.0 - share) + known[place + 1] * share;
                }
            }
        }
        expected
    }

    /// The place in its row that is left of where light left the projector, and how far beyond it.
    fn place(&self, column: usize, disparity: f32) -> Option<(usize, f32)> {
        // 32 bits are a single instruction where 64 are many.
        let x = (column + MARGIN) as u32 as f32 - disparity;
        let left = x as i32;
        (x >= 0.0 && x < (self.width - 1) as u32 as f32).then_some((left as usize, x - left as f32))
    }
}
