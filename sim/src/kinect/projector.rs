//! Where the pattern's light goes: from the grid of dots through the projector's lens into directions.
//!
//! Directions are points (x/z, y/z) in the projector's frame, whose axes are the infrared camera's. The shader that
//! renders the infrared image computes the same (`shaders/lib/projector.wgsl`).

use super::calibration::Calibration;
use super::pattern::{TILE_HEIGHT, TILE_WIDTH, TILES, Tile};

/// Infrared pixel in which the dots' size and pitch are published: a tangent, at 580 px.
const PIXEL: f64 = 1.0 / 580.0;
/// Tangent from one grid position to the next in the pattern's middle, of units that are sold: 1.05 px. A guess:
/// published as about 1.0 px, and with the pincushion below the whole pattern spans the published 63°×49°.
pub const PITCH: f64 = 1.05 * PIXEL;
/// Pincushion of the projector's lens, on r². A guess within 0.1 to 0.2.
pub const PINCUSHION: f64 = 0.15;
/// Radius at which a dot has 1/√e of its peak: 0.65 px, a full width of 1.5 px. Estimate; it holds the camera's own
/// blur and the pixel's area.
const DOT_RADIUS: f64 = 0.65 * PIXEL;
/// Light in the grid positions without a bright dot ("severely darkened"), relative to a bright dot. A guess.
const DIM_SPOT: f32 = 0.01;
/// The dot in a tile's middle, what is left of the undiffracted beam, relative to the others. A guess.
const MIDDLE_DOT: f32 = 4.0;
/// Brightness of the tiles: the middle one is brightest (Reichinger); amounts are guesses with a mean of 1.
pub const TILE_BRIGHTNESS: [[f32; TILES]; TILES] = [[0.8, 1.05, 0.8], [1.05, 1.6, 1.05], [0.8, 1.05, 0.8]];
/// Peak irradiance of a bright dot on a facing plane at 1 m: W m⁻². From 60 mW over the pattern's 34,749 dots
/// (OpenKinect, *Hardware info*) and the dot's size; uncertain by a factor of 2.
pub const PEAK_IRRADIANCE_AT_1_M: f64 = 0.19;

/// Samples of [`TileImage`] from one grid position to the next.
const SAMPLES: usize = 4;
/// Rounds of the inversion of the pincushion; each gains a factor of about 8.
const INVERSION_ROUNDS: usize = 5;

/// A tile's light, finely sampled; 1 is a bright dot's peak. It adjoins itself on all sides.
#[derive(Clone, Debug)]
pub struct TileImage {
    /// Samples across.
    pub width: usize,
    /// Samples down.
    pub height: usize,
    /// Row after row.
    pub samples: Vec<f32>,
}

impl TileImage {
    /// Spreads every dot over its blur.
    pub fn of(tile: &Tile) -> Self {
        let (width, height) = (TILE_WIDTH * SAMPLES, TILE_HEIGHT * SAMPLES);
        let mut samples = vec![0.0; width * height];
        let radius = DOT_RADIUS / PITCH * SAMPLES as f64;
        let reach = (4.0 * radius).ceil() as isize;
        // A dot sits in its position's middle, between two samples.
        let profile = |offset: isize| (-0.5 * ((offset as f64 + 0.5) / radius).powi(2)).exp() as f32;
        let weights: Vec<f32> = (-reach..reach).map(profile).collect();
        for position in 0..TILE_WIDTH * TILE_HEIGHT {
            let (column, row) = (position % TILE_WIDTH, position / TILE_WIDTH);
            let light = match tile.is_bright(column, row) {
                true if position == TILE_WIDTH * TILE_HEIGHT / 2 => MIDDLE_DOT,
                true => 1.0,
                false => DIM_SPOT,
            };
            let (middle_x, middle_y) = (column * SAMPLES + SAMPLES / 2, row * SAMPLES + SAMPLES / 2);
            for (weight_y, dy) in weights.iter().zip(-reach..) {
                let y = (middle_y + height).wrapping_add_signed(dy) % height;
                for (weight_x, dx) in weights.iter().zip(-reach..) {
                    let x = (middle_x + width).wrapping_add_signed(dx) % width;
                    samples[y * width + x] += light * weight_x * weight_y;
                }
            }
        }
        Self { width, height, samples }
    }

    /// The light at a grid position, whole numbers being the dots' middles; between samples, linear.
    fn at(&self, column: f64, row: f64) -> f32 {
        let fine_x = (column + 0.5) * SAMPLES as f64 - 0.5;
        let fine_y = (row + 0.5) * SAMPLES as f64 - 0.5;
        let (left, top) = (fine_x.floor(), fine_y.floor());
        let (share_x, share_y) = ((fine_x - left) as f32, (fine_y - top) as f32);
        let wrap = |value: f64, size: usize| (value as isize).rem_euclid(size as isize) as usize;
        let (x0, x1) = (wrap(left, self.width), wrap(left + 1.0, self.width));
        let (y0, y1) = (wrap(top, self.height), wrap(top + 1.0, self.height));
        let along = |y: usize| {
            let row = &self.samples[y * self.width..(y + 1) * self.width];
            row[x0] + share_x * (row[x1] - row[x0])
        };
        along(y0) + share_y * (along(y1) - along(y0))
    }
}

/// The projector of one unit.
#[derive(Clone, Debug)]
pub struct Projector {
    /// The light of one tile.
    pub tile: TileImage,
    /// Tangent by which the pattern's middle points towards the camera, so that on the reference plane it lies in the
    /// image's middle. A guess: a pattern of the published width covers the image no other way.
    pub toe_in: f64,
    /// From the infrared camera to the projector, along x; metres.
    pub baseline: f64,
    /// Tangent from one grid position to the next in the pattern's middle.
    pub pitch: f64,
}

impl Projector {
    /// The projector that belongs to a unit.
    pub fn of(calibration: &Calibration) -> Self {
        let toe_in = calibration.baseline / calibration.reference_distance;
        let Calibration { baseline, pattern_pitch: pitch, .. } = *calibration;
        Self { tile: TileImage::of(Tile::kinect()), toe_in, baseline, pitch }
    }

    /// The pattern's light in a direction; 1 is the peak of a bright dot in a tile of brightness 1.
    pub fn light_towards(&self, x: f64, y: f64) -> f32 {
        let (x, y) = (x + self.toe_in, y);
        let (mut grid_x, mut grid_y) = (x, y);
        for _ in 0..INVERSION_ROUNDS {
            let stretch = 1.0 + PINCUSHION * (grid_x * grid_x + grid_y * grid_y);
            (grid_x, grid_y) = (x / stretch, y / stretch);
        }
        let column = grid_x / self.pitch + ((TILES * TILE_WIDTH) / 2) as f64;
        let row = grid_y / self.pitch + ((TILES * TILE_HEIGHT) / 2) as f64;
        let tile_x = ((column + 0.5) / TILE_WIDTH as f64).floor();
        let tile_y = ((row + 0.5) / TILE_HEIGHT as f64).floor();
        let inside = 0.0..TILES as f64;
        if !inside.contains(&tile_x) || !inside.contains(&tile_y) {
            return 0.0;
        }
        TILE_BRIGHTNESS[tile_y as usize][tile_x as usize] * self.tile.at(column, row)
    }

    /// The pattern's light on a surface that the infrared camera sees towards (`x`, `y`) at depth `z` metres.
    pub fn light_seen_at(&self, x: f64, y: f64, z: f64) -> f32 {
        self.light_towards(x - self.baseline / z, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tile_holds_the_light_of_its_dots() {
        let image = TileImage::of(Tile::kinect());
        let sum: f64 = image.samples.iter().map(|&sample| f64::from(sample)).sum();
        let radius = DOT_RADIUS / PITCH * SAMPLES as f64;
        let dots = 3860.0 + f64::from(MIDDLE_DOT) + f64::from(DIM_SPOT) * (211.0 * 165.0 - 3861.0);
        let expected = dots * std::f64::consts::TAU * radius * radius;
        assert!((sum / expected - 1.0).abs() < 1e-3, "{sum} against {expected}");
    }

    #[test]
    fn the_pattern_spans_the_published_angles() {
        let projector = Projector::of(&Calibration::nominal());
        let lit = |x: f64, y: f64| projector.light_towards(x - projector.toe_in, y) > 0.0;
        let edge =
            |lit: &dyn Fn(f64) -> bool| (0..1000).map(|step| f64::from(step) / 1000.0).find(|&t| !lit(t)).unwrap();
        let width = 2.0 * edge(&|x| lit(x, 0.0)).atan().to_degrees();
        let height = 2.0 * edge(&|y| lit(0.0, y)).atan().to_degrees();
        assert!((width - 63.0).abs() < 2.0 && (height - 49.0).abs() < 2.0, "{width}° × {height}°");
    }
}
