//! Pictures that lie on the solids' faces: the light that leaves every spot, worked out once, at several resolutions.

use glam::Vec2;
use glam::Vec3;
use rayon::prelude::*;

/// The brightest value a texel holds; 1 is white paper.
const BRIGHTEST: f32 = 4.0;
const STEPS: f32 = u16::MAX as f32 / BRIGHTEST;

/// A picture in linear RGB, halved again and again down to one texel.
pub struct Texture {
    /// Finest first.
    levels: Vec<Level>,
    /// Texels a metre in the finest.
    density: Vec2,
}

struct Level {
    width: usize,
    height: usize,
    texels: Vec<[u16; 3]>,
}

impl Texture {
    /// A picture of `size` metres with texels of about `texel` metres, coloured by `colour` at their centres (metres
    /// from the lower left corner).
    pub fn paint(size: Vec2, texel: f32, colour: impl Fn(Vec2) -> Vec3 + Sync) -> Self {
        let cells = (size / texel).ceil().clamp(Vec2::ONE, Vec2::splat(4096.0));
        let (width, height) = (cells.x as usize, cells.y as usize);
        let density = cells / size;
        let texels = (0..width * height)
            .into_par_iter()
            .with_min_len(256)
            .map(|index| {
                let centre = Vec2::new((index % width) as f32 + 0.5, (index / width) as f32 + 0.5);
                ((colour(centre / density) * STEPS).clamp(Vec3::ZERO, Vec3::splat(65535.0))).to_array().map(|c| c as u16)
            })
            .collect();
        let mut levels = vec![Level { width, height, texels }];
        while let Some(last) = levels.last().filter(|last| last.width > 1 || last.height > 1) {
            levels.push(last.halved());
        }
        Self { levels, density }
    }

    /// The mean colour of a spot `footprint` metres wide around `at` (metres from the lower left corner).
    pub fn sample(&self, at: Vec2, footprint: f32) -> Vec3 {
        let texels = footprint * self.density.min_element();
        // The exponent of a float is the floor of its logarithm.
        let level = (texels.to_bits() >> 23).saturating_sub(127) as usize;
        let level = &self.levels[level.min(self.levels.len() - 1)];
        let scale = self.density * Vec2::new(level.width as f32, level.height as f32)
            / Vec2::new(self.levels[0].width as f32, self.levels[0].height as f32);
        level.between(at * scale - 0.5)
    }
}

impl Level {
    fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let texels = (0..width * height).map(|index| {
            let (x, y) = (2 * (index % width), 2 * (index / width));
            let (right, down) = ((x + 1).min(self.width - 1), (y + 1).min(self.height - 1));
            let four = [(x, y), (right, y), (x, down), (right, down)].map(|(x, y)| self.texels[y * self.width + x]);
            std::array::from_fn(|channel| (four.iter().map(|texel| u32::from(texel[channel])).sum::<u32>() / 4) as u16)
        });
        Self { width, height, texels: texels.collect() }
    }

    /// Bilinear; beyond the border, the border.
    fn between(&self, at: Vec2) -> Vec3 {
        let at = at.clamp(Vec2::ZERO, Vec2::new((self.width - 1) as f32, (self.height - 1) as f32));
        let (x, y) = (at.x as usize, at.y as usize);
        let (right, up) = ((x + 1).min(self.width - 1), (y + 1).min(self.height - 1));
        let t = at.fract();
        let texel = |x: usize, y: usize| {
            let [r, g, b] = self.texels[y * self.width + x];
            Vec3::new(f32::from(r), f32::from(g), f32::from(b))
        };
        let low = texel(x, y).lerp(texel(right, y), t.x);
        low.lerp(texel(x, up).lerp(texel(right, up), t.x), t.y) / STEPS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_read_back_and_its_mean_from_afar() {
        let texture = Texture::paint(Vec2::new(2.0, 1.0), 0.01, |at| Vec3::new(at.x, at.y, 0.5));
        let near = texture.sample(Vec2::new(1.234, 0.567), 0.005);
        assert!((near - Vec3::new(1.234, 0.567, 0.5)).length() < 1e-3, "{near}");
        let far = texture.sample(Vec2::new(1.2, 0.4), 10.0);
        assert!((far - Vec3::new(1.0, 0.5, 0.5)).length() < 0.02, "{far}");
    }
}
