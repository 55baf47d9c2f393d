//! Pictures that lie on the solids' faces: the light that leaves every spot, worked out once, at several resolutions.

use glam::{Vec2, Vec3, Vec3A, Vec4};
use rayon::prelude::*;

/// The brightest value a texel holds; 1 is white paper.
const BRIGHTEST: f32 = 4.0;
const STEPS: f32 = u16::MAX as f32 / BRIGHTEST;

/// A picture in linear RGB, halved again and again down to one texel.
pub struct Texture {
    /// Finest first.
    levels: Vec<Level>,
}

struct Level {
    width: usize,
    height: usize,
    /// Red, green, blue, and a nought that makes four of them load as one.
    texels: Vec<[u16; 4]>,
    /// Texels in a metre.
    density: Vec2,
    /// Centre of the last texel.
    last: Vec2,
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
                // A float beyond the range of u16 becomes the nearest of its ends.
                (colour(centre / density) * STEPS).extend(0.0).to_array().map(|value| value as u16)
            })
            .collect();
        let mut levels = vec![Level::new(width, height, texels, density)];
        while let Some(last) = levels.last().filter(|last| last.width > 1 || last.height > 1) {
            levels.push(last.halved());
        }
        Self { levels }
    }

    /// The mean colour of a spot `footprint` metres wide around `at` (metres from the lower left corner).
    pub fn sample(&self, at: Vec2, footprint: f32) -> Vec3A {
        let texels = footprint * self.levels[0].density.min_element();
        // The exponent of a float is the floor of its logarithm.
        let level = (texels.to_bits() >> 23).saturating_sub(127) as usize;
        self.levels[level.min(self.levels.len() - 1)].between(at)
    }
}

impl Level {
    fn new(width: usize, height: usize, texels: Vec<[u16; 4]>, density: Vec2) -> Self {
        Self { width, height, texels, density, last: Vec2::new((width - 1) as f32, (height - 1) as f32) }
    }

    fn halved(&self) -> Self {
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let texels = (0..width * height).map(|index| {
            let (x, y) = (2 * (index % width), 2 * (index / width));
            let (right, down) = ((x + 1).min(self.width - 1), (y + 1).min(self.height - 1));
            let four = [(x, y), (right, y), (x, down), (right, down)].map(|(x, y)| self.texels[y * self.width + x]);
            std::array::from_fn(|channel| (four.iter().map(|texel| u32::from(texel[channel])).sum::<u32>() / 4) as u16)
        });
        Self::new(width, height, texels.collect(), self.density / 2.0)
    }

    /// Bilinear; beyond the border, the border.
    fn between(&self, at: Vec2) -> Vec3A {
        let at = (at * self.density - 0.5).clamp(Vec2::ZERO, self.last);
        let (x, y) = (at.x as u32, at.y as u32);
        let t = at - Vec2::new(x as f32, y as f32);
        let corner = y as usize * self.width + x as usize;
        let right = usize::from(x as usize + 1 < self.width);
        let up = if y as usize + 1 < self.height { self.width } else { 0 };
        let texel = |index: usize| Vec3A::from_vec4(Vec4::from_array(self.texels[index].map(f32::from)));
        let low = texel(corner).lerp(texel(corner + right), t.x);
        low.lerp(texel(corner + up).lerp(texel(corner + up + right), t.x), t.y) / STEPS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_read_back_from_near_and_from_afar() {
        let texture = Texture::paint(Vec2::new(2.0, 1.0), 0.01, |at| Vec3::new(at.x, at.y, 0.5));
        let near = texture.sample(Vec2::new(1.234, 0.567), 0.005);
        assert!((near - Vec3A::new(1.234, 0.567, 0.5)).length() < 1e-3, "{near}");
        let far = texture.sample(Vec2::new(1.234, 0.567), 0.09);
        assert!((far - Vec3A::new(1.234, 0.567, 0.5)).length() < 1e-3, "{far}");
        assert!(texture.sample(Vec2::ZERO, 1e9).is_finite());
    }
}
