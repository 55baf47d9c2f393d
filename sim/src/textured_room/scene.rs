//! All solids together, and which of them a bundle of rays can meet.

use glam::Vec3A;

use super::solid::{Face, Ray, Solid};

/// The room and what stands in it. The room's box is solid number 0 and encloses every camera and lamp.
pub struct Scene {
    solids: Vec<Solid>,
}

/// Where a ray ends.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The ray's parameter.
    pub t: f32,
    /// Index of the solid.
    pub solid: usize,
    /// Its face.
    pub face: Face,
}

/// Rays that start close to one point and lie between four planes through it.
pub struct Bundle {
    apex: Vec3A,
    /// Unit normals of the planes, inwards.
    sides: [Vec3A; 4],
    /// How far a ray can be outside of the planes, metres.
    slack: f32,
}

impl Bundle {
    /// The rays between four directions (of any length), in order around their middle.
    pub fn between(apex: Vec3A, corners: [Vec3A; 4], slack: f32) -> Self {
        let middle: Vec3A = corners.iter().sum();
        let sides = std::array::from_fn(|index| {
            let normal = corners[index].cross(corners[(index + 1) % 4]).normalize();
            normal * normal.dot(middle).signum()
        });
        Self { apex, sides, slack }
    }
}

/// Solids that some rays can meet, nearest first; the room itself is left out.
pub struct Candidates<'a> {
    scene: &'a Scene,
    nearest_first: Vec<(f32, usize)>,
}

impl Scene {
    /// `room` encloses all `things`.
    pub fn new(room: Solid, things: Vec<Solid>) -> Self {
        Self { solids: std::iter::once(room).chain(things).collect() }
    }

    /// All solids; number 0 is the room.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// What the rays of a bundle can meet.
    pub fn candidates(&self, bundle: &Bundle) -> Candidates<'_> {
        self.gather(|solid| {
            let offset = solid.centre() - bundle.apex;
            let is_met = |side: &Vec3A| offset.dot(*side) + solid.extent(*side) > -bundle.slack;
            bundle.sides.iter().all(is_met).then(|| solid.distance(bundle.apex) - bundle.slack)
        })
    }

    /// What can be met within `reach` metres of a point.
    pub fn within(&self, point: Vec3A, reach: f32) -> Candidates<'_> {
        self.gather(|solid| Some(solid.distance(point)).filter(|&distance| distance < reach))
    }

    /// The things for which `distance` has an answer.
    fn gather(&self, distance: impl Fn(&Solid) -> Option<f32>) -> Candidates<'_> {
        let mut nearest_first: Vec<_> =
            (1..self.solids.len()).filter_map(|index| Some((distance(&self.solids[index])?, index))).collect();
        nearest_first.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Candidates { scene: self, nearest_first }
    }
}

impl Candidates<'_> {
    /// The first surface along one of the rays. There always is one: the room's.
    pub fn first_hit(&self, ray: &Ray) -> Hit {
        self.first_hit_near(ray, 0)
    }

    /// As [`first_hit`](Self::first_hit), sooner if `guess` is the solid that a neighbouring ray hit.
    pub fn first_hit_near(&self, ray: &Ray, guess: usize) -> Hit {
        let solids = &self.scene.solids;
        let (t, face, solid) = match solids[guess].hit(ray) {
            Some((t, face)) => (t, face, guess),
            None => solids[0].hit(ray).map_or((f32::INFINITY, Face::Up, 0), |(t, face)| (t, face, 0)),
        };
        let mut first = Hit { t, solid, face };
        let length = ray.direction.length();
        for &(distance, solid) in &self.nearest_first {
            if distance > first.t * length {
                break;
            }
            if let Some((t, face)) = solids[solid].hit(ray)
                && t < first.t
            {
                first = Hit { t, solid, face };
            }
        }
        first
    }

    /// Whether a solid other than `except` lies between a point and `t = 1` of the ray that starts there.
    pub fn is_blocked(&self, ray: &Ray, except: usize) -> bool {
        let length = ray.direction.length();
        let mut on_the_way = self.nearest_first.iter().take_while(|&&(distance, _)| distance < length);
        on_the_way.any(|&(_, solid)| solid != except && self.scene.solids[solid].hit(ray).is_some_and(|(t, _)| t < 1.0))
    }
}
