//! All solids together, and which of them a bundle of rays can meet.

use glam::Vec3;

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

/// Rays within `half_angle` of `axis` (unit) that start within `slack` metres of `apex`.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Where the rays start.
    pub apex: Vec3,
    /// The middle direction.
    pub axis: Vec3,
    /// Cosine of the half angle.
    pub cos: f32,
    /// How far from the apex rays may start, metres.
    pub slack: f32,
}

impl Cone {
    /// The narrowest about the mean of some directions (of any length).
    pub fn around(apex: Vec3, directions: &[Vec3], slack: f32) -> Self {
        let axis = directions.iter().map(|direction| direction.normalize()).sum::<Vec3>().normalize();
        let cos = directions.iter().map(|direction| axis.dot(direction.normalize())).fold(1.0, f32::min);
        Self { apex, axis, cos, slack }
    }

    /// Distance from which on the cone's rays can meet a sphere; `None` when they can't.
    fn reaches(&self, centre: Vec3, radius: f32) -> Option<f32> {
        let radius = radius + self.slack;
        let offset = centre - self.apex;
        let along = offset.dot(self.axis);
        let across = (offset.length_squared() - along * along).max(0.0).sqrt();
        let sin = (1.0 - self.cos * self.cos).max(0.0).sqrt();
        let beside = across * self.cos - along * sin;
        (beside < radius && along > -radius).then(|| (offset.length() - radius).max(0.0))
    }
}

/// Solids that a cone of rays can meet, nearest first; the room itself is left out.
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

    /// What the rays of a cone can meet.
    pub fn candidates(&self, cone: &Cone) -> Candidates<'_> {
        self.gather(|solid| cone.reaches(solid.centre(), solid.radius()))
    }

    /// What can be met within `reach` metres of a point.
    pub fn within(&self, point: Vec3, reach: f32) -> Candidates<'_> {
        self.gather(|solid| {
            let distance = solid.centre().distance(point) - solid.radius();
            (distance < reach).then_some(distance)
        })
    }

    /// The things for which `distance` has an answer.
    fn gather(&self, distance: impl Fn(&Solid) -> Option<f32>) -> Candidates<'_> {
        let mut nearest_first: Vec<_> = (1..self.solids.len())
            .filter_map(|index| Some((distance(&self.solids[index])?, index)))
            .collect();
        nearest_first.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Candidates { scene: self, nearest_first }
    }
}

impl Candidates<'_> {
    /// The first surface along a ray of the cone. There always is one: the room's.
    pub fn first_hit(&self, ray: &Ray) -> Hit {
        let solids = &self.scene.solids;
        let (t, face) = solids[0].hit(ray).unwrap_or((f32::INFINITY, Face::Up));
        let mut first = Hit { t, solid: 0, face };
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
        self.nearest_first.iter().any(|&(_, solid)| {
            solid != except && self.scene.solids[solid].hit(ray).is_some_and(|(t, _)| t < 1.0)
        })
    }
}
