//! Boxes around things, and the planes a view ends at.

use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};

/// A box along the world's axes, metres.
pub(super) struct Bounds {
    pub lowest: Vec3,
    pub highest: Vec3,
}

impl Bounds {
    /// The smallest around some points.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Self {
        let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let wider = |(lowest, highest): (Vec3, Vec3), point: Vec3| (lowest.min(point), highest.max(point));
        let (lowest, highest) = points.into_iter().fold(none, wider);
        Self { lowest, highest }
    }

    /// Its edges.
    pub fn size(&self) -> Vec3 {
        self.highest - self.lowest
    }

    /// Its centre.
    pub fn middle(&self) -> Vec3 {
        (self.lowest + self.highest) / 2.0
    }

    /// Whether some of it lies on a plane's inner side.
    pub fn reaches(&self, plane: &Vec4) -> bool {
        let furthest = Vec3::select(plane.xyz().cmpge(Vec3::ZERO), self.highest, self.lowest);
        plane.xyz().dot(furthest) + plane.w >= 0.0
    }

    /// Whether all of it lies on a plane's inner side.
    pub fn is_inside(&self, plane: &Vec4) -> bool {
        let nearest = Vec3::select(plane.xyz().cmpge(Vec3::ZERO), self.lowest, self.highest);
        plane.xyz().dot(nearest) + plane.w >= 0.0
    }
}

/// The planes a view ends at: left, right, bottom, top, near. Points inside have positive products with all.
pub(super) fn frustum(clip_from_world: &Mat4) -> [Vec4; 5] {
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
    [w + x, w - x, w + y, w - y, w - z]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::view::clip_from_camera;
    use glam::Vec2;

    #[test]
    fn a_view_shows_what_reaches_into_it_and_nothing_else() {
        let clip = clip_from_camera(Vec2::splat(500.0), Vec2::new(320.0, 240.0), Vec2::new(640.0, 480.0), 0.1);
        let shown = |x: f32, y: f32, z: f32| {
            let middle = Vec3::new(x, y, z);
            let bounds = Bounds { lowest: middle - 0.5, highest: middle + 0.5 };
            frustum(&clip).iter().all(|plane| bounds.reaches(plane))
        };
        assert!(shown(0.0, 0.0, 5.0) && shown(3.5, 0.0, 5.0) && shown(0.0, -2.8, 5.0) && shown(0.0, 0.0, 0.0));
        assert!(!shown(5.0, 0.0, 5.0) && !shown(0.0, -4.0, 5.0) && !shown(0.0, 0.0, -2.0));
    }
}
