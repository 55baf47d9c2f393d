//! A texture while it is painted: albedo in two bands, drawn on in metres.

use super::super::{Material, TEXTURE_SIZE};
use super::gloss::Gloss;
use super::noise;
use super::substance::{Substance, encoded};

/// What a stroke leaves behind.
#[derive(Clone, Copy, Debug)]
pub enum Coat {
    /// Opaque in both bands: paint, carbon toner, another thing.
    Opaque(Substance),
    /// Ink or dye: colours the visible, clear at 830 nm.
    Ink([f32; 3]),
}

/// A rectangle's left, top, right and bottom, metres from the top left corner.
pub type Area = [f32; 4];

/// A texture while it is painted. x to the right, y down, metres from the top left corner.
pub struct Canvas {
    /// Width and height of what the texture shows, metres.
    pub size: [f32; 2],
    texels: Vec<Substance>,
}

impl Canvas {
    /// All of one substance.
    pub fn new(size: [f32; 2], substance: Substance) -> Self {
        Self { size, texels: vec![substance; TEXTURE_SIZE * TEXTURE_SIZE] }
    }

    /// Rewrites each texel, given its middle in metres.
    pub fn each(&mut self, paint: impl Fn(f32, f32, Substance) -> Substance) {
        for (index, texel) in self.texels.iter_mut().enumerate() {
            let [u, v] = [index % TEXTURE_SIZE, index / TEXTURE_SIZE].map(|i| (i as f32 + 0.5) / TEXTURE_SIZE as f32);
            *texel = paint(u * self.size[0], v * self.size[1], *texel);
        }
    }

    /// Makes texels brighter or darker in both bands: relief, shadow, dirt, wear.
    pub fn shade(&mut self, factor: impl Fn(f32, f32) -> f32) {
        self.each(|x, y, texel| {
            let factor = factor(x, y);
            texel.map(|albedo| albedo * factor)
        });
    }

    /// Shades by fractal noise of ± `strength` about 1, with features of about `metres`.
    pub fn mottle(&mut self, metres: f32, octaves: u32, strength: f32, seed: u32) {
        let size = self.size;
        let cells = size.map(|size| ((size / metres).round() as u32).max(1));
        self.shade(|x, y| {
            1.0 + strength * 2.0 * (noise::fractal(x / size[0], y / size[1], cells, octaves, seed) - 0.5)
        });
    }

    /// Lays a coat where `distance` (metres, negative inside) says so, with soft edges of one texel. Only looks
    /// within `area`.
    pub fn cover(&mut self, area: Area, coat: Coat, distance: impl Fn(f32, f32) -> f32) {
        let texel = self.size.map(|size| size / TEXTURE_SIZE as f32);
        let blur = texel[0].max(texel[1]);
        let index = |metres: f32, axis: usize, slack: f32| {
            (metres / texel[axis] + slack).clamp(0.0, TEXTURE_SIZE as f32) as usize
        };
        for row in index(area[1], 1, -1.0)..index(area[3], 1, 2.0) {
            for column in index(area[0], 0, -1.0)..index(area[2], 0, 2.0) {
                let (x, y) = ((column as f32 + 0.5) * texel[0], (row as f32 + 0.5) * texel[1]);
                let share = (0.5 - distance(x, y) / blur).clamp(0.0, 1.0);
                let old = &mut self.texels[row * TEXTURE_SIZE + column];
                let new = match coat {
                    Coat::Opaque(substance) => substance,
                    Coat::Ink([r, g, b]) => [r, g, b, old[3]],
                };
                for (old, new) in old.iter_mut().zip(new) {
                    *old += share * (new - *old);
                }
            }
        }
    }

    /// A filled rectangle.
    pub fn rectangle(&mut self, area: Area, coat: Coat) {
        let [left, top, right, bottom] = area;
        self.cover(area, coat, |x, y| (left - x).max(x - right).max(top - y).max(y - bottom));
    }

    /// A rectangle's outline of some width.
    pub fn frame(&mut self, area: Area, width: f32, coat: Coat) {
        let [left, top, right, bottom] = area;
        self.cover(area, coat, |x, y| {
            let inside = (left - x).max(x - right).max(top - y).max(y - bottom);
            inside.max(-width - inside)
        });
    }

    /// A filled circle.
    pub fn disc(&mut self, centre: [f32; 2], radius: f32, coat: Coat) {
        let [cx, cy] = centre;
        let area = [cx - radius, cy - radius, cx + radius, cy + radius];
        self.cover(area, coat, |x, y| (x - cx).hypot(y - cy) - radius);
    }

    /// A circle's outline of some width.
    pub fn ring(&mut self, centre: [f32; 2], radius: f32, width: f32, coat: Coat) {
        let ([cx, cy], reach) = (centre, radius + width);
        let area = [cx - reach, cy - reach, cx + reach, cy + reach];
        self.cover(area, coat, |x, y| ((x - cx).hypot(y - cy) - radius).abs() - 0.5 * width);
    }

    /// A straight stroke with round ends.
    pub fn line(&mut self, [ax, ay]: [f32; 2], [bx, by]: [f32; 2], width: f32, coat: Coat) {
        let area = [ax.min(bx) - width, ay.min(by) - width, ax.max(bx) + width, ay.max(by) + width];
        let (dx, dy) = (bx - ax, by - ay);
        let squared = (dx * dx + dy * dy).max(1e-12);
        self.cover(area, coat, |x, y| {
            let t = (((x - ax) * dx + (y - ay) * dy) / squared).clamp(0.0, 1.0);
            (x - ax - t * dx).hypot(y - ay - t * dy) - 0.5 * width
        });
    }

    /// Strokes from point to point.
    pub fn polyline(&mut self, points: &[[f32; 2]], width: f32, coat: Coat) {
        for pair in points.windows(2) {
            self.line(pair[0], pair[1], width, coat);
        }
    }

    /// The finished texture.
    pub fn finish(self, name: &str) -> Material {
        let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
        let albedo = self.texels.iter().map(|&[r, g, b, nir]| [encoded(r), encoded(g), encoded(b), nir].map(byte));
        Material { name: name.to_owned(), albedo: albedo.collect(), gloss: Gloss::MATT }
    }
}
