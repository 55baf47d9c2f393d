//! Light in the room: daylight from the window, two ceiling lamps, a standing lamp, and what all surfaces throw back
//! to each other. Worked out once, since neither lamps nor furniture move.
//!
//! Brightness is relative: irradiance 1 on white paper shows as white paper. The numbers are chosen by eye.

use glam::{Vec2, Vec3, Vec3A};

use super::layout::{CEILING_LAMP, CEILING_LAMPS, ROOM, WINDOW};
use super::noise::smoothstep;
use super::scene::{Bundle, Scene};
use super::solid::Ray;

/// How far the surroundings take ambient light away, metres.
const REACH: f32 = 0.8;
/// Directions in which ambient light is gathered.
const DIRECTIONS: usize = 40;
/// Rays start this far off the surface, metres, so as not to meet it.
const LIFT: f32 = 0.004;

/// A shining rectangle, as a grid of points.
struct Lamp {
    /// Four rows of four.
    points: [Vec3A; 16],
    /// Where it shines; `None`: everywhere.
    normal: Option<Vec3A>,
    /// Brightness times area, shared by the points.
    power: Vec3,
}

/// All lamps and the ambient light of a scene.
pub struct Light<'a> {
    scene: &'a Scene,
    lamps: Vec<Lamp>,
    /// Cosine-distributed about +z.
    directions: Vec<Vec3A>,
}

impl<'a> Light<'a> {
    /// The light of the furnished room.
    pub fn new(scene: &'a Scene) -> Self {
        let [(left, low), (right, high)] = WINDOW;
        let window = Vec3::new((left + right) / 2.0, ROOM.y - 0.24, (low + high) / 2.0);
        let mut lamps = vec![
            lamp(
                window,
                Vec3::X * (right - left),
                Vec3::Z * (high - low),
                Some(Vec3A::NEG_Y),
                Vec3::new(0.98, 1.12, 1.28),
            ),
            lamp(Vec3::new(3.98, 4.7, 1.74), Vec3::X * 0.1, Vec3::Y * 0.1, None, Vec3::new(0.13, 0.095, 0.055)),
        ];
        lamps.extend(CEILING_LAMPS.map(|centre| {
            let below = centre - Vec3::Z * (CEILING_LAMP.z / 2.0 + LIFT);
            lamp(
                below,
                Vec3::X * CEILING_LAMP.x,
                Vec3::Y * CEILING_LAMP.y,
                Some(Vec3A::NEG_Z),
                Vec3::new(0.62, 0.58, 0.50),
            )
        }));
        Self { scene, lamps, directions: hemisphere() }
    }

    /// Irradiance, linear RGB, on a spot with a unit normal.
    pub fn at(&self, point: Vec3A, normal: Vec3A) -> Vec3 {
        let point = point + normal * LIFT;
        self.lamps.iter().map(|lamp| self.direct(lamp, point, normal)).sum::<Vec3>() + self.ambient(point, normal)
    }

    fn direct(&self, lamp: &Lamp, point: Vec3A, normal: Vec3A) -> Vec3 {
        let corners = [0, 3, 15, 12].map(|corner| lamp.points[corner] - point);
        let candidates = self.scene.candidates(&Bundle::between(point, corners, LIFT));
        let seen: f32 = lamp
            .points
            .iter()
            .map(|&from| {
                let offset = from - point;
                let squared = offset.length_squared();
                let towards = offset / squared.sqrt();
                let arriving = normal.dot(towards).max(0.0) * lamp.normal.map_or(1.0, |way| -way.dot(towards)).max(0.0);
                if arriving == 0.0 || candidates.is_blocked(&Ray { origin: point, direction: offset }, 0) {
                    return 0.0;
                }
                arriving / squared.max(0.02)
            })
            .sum();
        lamp.power * (seen / lamp.points.len() as f32)
    }

    /// Light that has been thrown to and fro: brighter from above than from the wooden floor, and less of it where
    /// something is close.
    fn ambient(&self, point: Vec3A, normal: Vec3A) -> Vec3 {
        let candidates = self.scene.within(point, REACH);
        let (side, other) = normal.any_orthonormal_pair();
        let gathered: Vec3 = self
            .directions
            .iter()
            .map(|way| {
                let direction = side * way.x + other * way.y + normal * way.z;
                let distance = candidates.first_hit(&Ray { origin: point, direction }).t;
                let from_above = Vec3::new(0.43, 0.44, 0.45);
                let from_below = Vec3::new(0.26, 0.21, 0.17);
                from_below.lerp(from_above, 0.5 + 0.5 * direction.z) * (0.12 + 0.88 * smoothstep(0.0, REACH, distance))
            })
            .sum();
        gathered / self.directions.len() as f32
    }
}

fn lamp(centre: Vec3, width: Vec3, height: Vec3, normal: Option<Vec3A>, power: Vec3) -> Lamp {
    let points = std::array::from_fn(|index| {
        let share = Vec2::new((index % 4) as f32, (index / 4) as f32) / 4.0 - 0.375;
        Vec3A::from(centre + width * share.x + height * share.y)
    });
    Lamp { points, normal, power }
}

/// A spiral over the disc, lifted onto the hemisphere: even in solid angle times cosine.
fn hemisphere() -> Vec<Vec3A> {
    const GOLDEN_ANGLE: f32 = 2.399_963;
    (0..DIRECTIONS)
        .map(|index| {
            let squared = (index as f32 + 0.5) / DIRECTIONS as f32;
            let (sin, cos) = (GOLDEN_ANGLE * index as f32).sin_cos();
            Vec3A::new(squared.sqrt() * cos, squared.sqrt() * sin, (1.0 - squared).sqrt())
        })
        .collect()
}
