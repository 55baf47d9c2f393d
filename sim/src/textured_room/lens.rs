//! The rays of a camera's pixels, and its image cut into tiles whose rays meet the same few solids.

use glam::Vec3;
use nalgebra::Point2;
use sunblind_estimator::camera::CameraModel;

use super::scene::{Candidates, Cone, Scene};
use super::world::Pose;

/// Edge of a tile, pixels.
const TILE: usize = 16;
/// What samples off a pixel's centre can miss the tile's cone by, metres: one pixel at the room's far end.
const SAMPLE: f32 = 0.015;

/// The rays of all pixels, worked out once.
pub struct Lens {
    width: usize,
    height: usize,
    /// Row by row, in the camera's frame, z = 1.
    rays: Vec<Vec3>,
}

impl Lens {
    /// The lens of a camera.
    pub fn new(camera: &CameraModel) -> Self {
        let (width, height) = camera.size();
        let rays = (0..width * height).map(|index| {
            let ray = camera.ray(&Point2::new((index % width) as f64, (index / width) as f64)).cast::<f32>();
            Vec3::new(ray.x, ray.y, ray.z)
        });
        Self { width, height, rays: rays.collect() }
    }

    /// The ray of a pixel by its index in row-major order.
    pub fn ray(&self, pixel: usize) -> Vec3 {
        self.rays[pixel]
    }

    /// Calls `shoot` with every tile's pixels (row-major indices) and the solids that can be met from all of `poses`
    /// (the camera during one exposure) by rays that start up to `slack` metres from it.
    pub fn by_tiles<'a>(
        &self,
        scene: &'a Scene,
        poses: &[Pose],
        slack: f32,
        mut shoot: impl FnMut(&[usize], &Candidates<'a>),
    ) {
        let apex = poses[0].position;
        let moved = poses.iter().map(|pose| pose.position.distance(apex)).fold(0.0, f32::max);
        let mut pixels = Vec::with_capacity(TILE * TILE);
        for top in (0..self.height).step_by(TILE) {
            for left in (0..self.width).step_by(TILE) {
                let (bottom, right) = ((top + TILE).min(self.height), (left + TILE).min(self.width));
                let corners = [(left, top), (right - 1, top), (left, bottom - 1), (right - 1, bottom - 1)]
                    .map(|(x, y)| self.rays[y * self.width + x]);
                let directions: Vec<Vec3> =
                    poses.iter().flat_map(|pose| corners.map(|corner| pose.rotation * corner)).collect();
                let candidates = scene.candidates(&Cone::around(apex, &directions, moved + slack + SAMPLE));
                pixels.clear();
                pixels.extend((top..bottom).flat_map(|y| (left..right).map(move |x| y * self.width + x)));
                shoot(&pixels, &candidates);
            }
        }
    }
}
