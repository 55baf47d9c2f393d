//! What a projector throws, learnt from what the camera beside it sees.

/// Light by where it leaves the projector, in infrared pixels of infinitely far surfaces; row by row. Its mean is 1.
///
/// A dot keeps its row and the place in the pattern that it comes from, wherever it falls: seen at column u on a surface at
/// depth z it left at u − f·b/z. What the surfaces reflect changes as the robot moves and averages out; the dots stay.
#[derive(Clone, Debug)]
pub(super) struct Pattern {
    width: usize,
    height: usize,
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
        Self { width: width + MARGIN, height, light: vec![0.0; size], weight: vec![0.0; size] }
    }

    /// Forgets a little, before an image is learnt.
    pub fn fade(&mut self) {
        let keep = 0.5_f32.powf(1.0 / MEMORY);
        self.light.iter_mut().chain(&mut self.weight).for_each(|value| *value *= keep);
    }

    /// Learns that where (column, row) is seen at `disparity` there was `light`, relative to the light around.
    pub fn learn(&mut self, column: usize, row: usize, disparity: f32, light: f32) {
        let Some((index, share)) = self.place(column, row, disparity) else { return };
        for (index, weight) in [(index, 1.0 - share), (index + 1, share)] {
            self.light[index] += weight * light;
            self.weight[index] += weight;
        }
    }

    /// The light expected where (column, row) is seen at `disparity`.
    pub fn light(&self, column: usize, row: usize, disparity: f32) -> f32 {
        let Some((index, share)) = self.place(column, row, disparity) else { return 1.0 };
        let at = |index: usize| (self.light[index] + DOUBT) / (self.weight[index] + DOUBT);
        at(index) * (1.0 - share) + at(index + 1) * share
    }

    /// Index of the place to the left, and how far beyond it.
    fn place(&self, column: usize, row: usize, disparity: f32) -> Option<(usize, f32)> {
        let x = (column + MARGIN) as f32 - disparity;
        let inside = x >= 0.0 && x < (self.width - 1) as f32 && row < self.height;
        inside.then(|| (row * self.width + x as usize, x.fract()))
    }
}
