//! The rays of a camera's pixels, and its image cut into tiles whose rays meet the same few solids.

use glam::Vec3A;
use nalgebra::Point2;
use sunblind_estimator::camera::CameraModel;

use super::lit_scene::Pose;
use super::scene::{Bundle, Candidates, Scene};

/// Edge of a tile, pixels.
const TILE: usize = 16;
/// The longest ray in the room, metres.
const FARTHEST: f32 = 8.3;
/// What samples off a pixel's centre can leave the tile by, metres: one pixel at the farthest.
const SAMPLE: f32 = FARTHEST / 525.0;

/// The rays of all pixels, worked out once.
pub struct Lens {
    width: usize,
    height: usize,
    /// Row by row, in the camera's frame, z = 1.
    rays: Vec<Vec3A>,
}

impl Lens {
    /// The lens of a camera.
    pub fn new(camera: &CameraModel) -> Self {
        let (width, height) = camera.size();
        let rays = (0..width * height).map(|index| {
            let ray = camera.ray(&Point2::new((index % width) as f64, (index / width) as f64)).cast::<f32>();
            Vec3A::new(ray.x, ray.y, ray.z)
        });
        Self { width, height, rays: rays.collect() }
    }

    /// The ray of a pixel by its index in row-major order.
    pub fn ray(&self, pixel: usize) -> Vec3A {
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
        let [first, others @ ..] = poses else { return };
        let apex = first.position;
        let mut pixels = Vec::with_capacity(TILE * TILE);
        for top in (0..self.height).step_by(TILE) {
            for left in (0..self.width).step_by(TILE) {
                let (bottom, right) = ((top + TILE).min(self.height), (left + TILE).min(self.width));
                let corners = [(left, top), (right - 1, top), (right - 1, bottom - 1), (left, bottom - 1)]
                    .map(|(x, y)| self.rays[y * self.width + x]);
                let directions = corners.map(|corner| first.rotation * corner);
                let swept = others.iter().flat_map(|pose| {
                    let moved = pose.position.distance(apex);
                    corners.iter().zip(&directions).map(move |(&corner, direction)| {
                        moved + FARTHEST * (pose.rotation * corner).distance(*direction)
                    })
                });
                let slack = slack + SAMPLE + swept.fold(0.0, f32::max);
                let candidates = scene.candidates(&Bundle::between(apex, directions, slack));
                pixels.clear();
                pixels.extend((top..bottom).flat_map(|y| (left..right).map(move |x| y * self.width + x)));
                shoot(&pixels, &candidates);
            }
        }
    }
}
