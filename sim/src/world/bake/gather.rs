//! What a point sees: rays over its hemisphere.

use glam::{DVec3, Vec3};

use crate::light::Bands;
use crate::world::Lamp;
use crate::world::rays::Rays;

/// No surface in this direction, or one that hands on no light.
const NOTHING: u32 = u32::MAX;
/// A point that sees this share of its hemisphere from behind lies in a body (a guess that held here).
const BURIED_SHARE: f32 = 0.3;
/// A lamp's own cover lies no further than this behind its panel, metres.
pub(super) const COVER_DEPTH: f64 = 0.02;
/// The plastic number's reciprocals, 1/ρ and 1/ρ² with ρ³ = ρ + 1: Roberts' R2 sequence fills the square evenly.
const R2: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// The triangles that a point's rays meet, and the sky.
pub(super) struct Gathered {
    triangles: Box<[u32]>,
    from_behind: u32,
    /// Sums over the rays that meet nothing above the horizon: of 1, of the sine of their elevation.
    sky: [f64; 2],
}

impl Gathered {
    /// Casts `count` rays, cosine-weighted and the same for each point with that normal: an error is then smooth over
    /// a surface, where noise would be seen.
    pub fn cast(rays: &Rays, lamps: &[Lamp], at: DVec3, normal: DVec3, count: u32) -> Self {
        let (across, beside) = normal.any_orthonormal_pair();
        let (mut from_behind, mut sky) = (0, [0.0; 2]);
        let triangles = (0..count)
            .map(|index| {
                let [u, v] = R2.map(|step| (0.5 + step * f64::from(index + 1)).fract());
                let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
                let direction = u.sqrt() * (cos * across + sin * beside) + (1.0 - u).sqrt() * normal;
                match rays.first(at, direction, f64::MAX) {
                    Some(hit) if !hit.front => {
                        from_behind += 1;
                        NOTHING
                    }
                    Some(hit) if !lamps.iter().any(|lamp| hides(lamp, at, direction, hit.distance)) => hit.triangle,
                    None if direction.z > 0.0 => {
                        sky = [sky[0] + 1.0, sky[1] + direction.z];
                        NOTHING
                    }
                    _ => NOTHING,
                }
            })
            .collect();
        Self { triangles, from_behind, sky }
    }

    /// Whether the point lies inside a body, or behind a surface that has one side only.
    pub fn buried(&self) -> bool {
        self.from_behind as f32 > BURIED_SHARE * self.triangles.len() as f32
    }

    /// Irradiance from a sky of luminance 1, and from one whose luminance is the sine of the elevation.
    pub fn sky(&self) -> [f32; 2] {
        self.sky.map(|sum| (std::f64::consts::PI * sum / self.triangles.len() as f64) as f32)
    }

    /// Irradiance from what is seen, given each triangle's radiosity.
    pub fn mean(&self, radiosity: &[Bands]) -> Bands {
        let mut sum = [0.0; 4];
        for &triangle in self.triangles.iter().filter(|&&triangle| triangle != NOTHING) {
            for (sum, value) in sum.iter_mut().zip(radiosity[triangle as usize]) {
                *sum += value;
            }
        }
        sum.map(|sum| sum / self.triangles.len() as f32)
    }
}

/// Whether a ray meets a lamp's bright side well before it meets a surface. A window's panel stands for all that is
/// outside, and its light is counted already.
fn hides(lamp: &Lamp, at: DVec3, direction: DVec3, surface: f64) -> bool {
    let [centre, a, b] = [lamp.centre, lamp.half_edges[0], lamp.half_edges[1]].map(|v| Vec3::from(v).as_dvec3());
    let facing = a.cross(b).normalize();
    let closing = -direction.dot(facing);
    if closing <= 0.0 {
        return false;
    }
    let distance = (at - centre).dot(facing) / closing;
    if distance < 0.0 || distance + COVER_DEPTH / closing > surface {
        return false;
    }
    let on_panel = at + distance * direction - centre;
    [a, b].iter().all(|half| on_panel.dot(*half).abs() <= half.length_squared())
}
