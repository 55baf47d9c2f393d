//! The ground's grain, found again: turf and asphalt have some everywhere, of which a detector of features that can be told
//! apart at first sight keeps little. Where a patch of a plane lies in the next view is known but for the way's length.

use nalgebra::{Isometry3, Matrix2, Point2, Point3, Vector2, Vector3};

use crate::camera::CameraModel;
use crate::image::GrayImage;
use crate::motion::{GroundPlane, RayPair};

/// Distance of two patches, pixels.
const SPACING: usize = 16;
/// A patch reaches so far to each side of its middle, pixels.
const REACH: usize = 5;
const SIDE: usize = 2 * REACH + 1;
const AREA: usize = SIDE * SIDE;
/// Sine of the least angle below the horizon: five times as far off as the camera is high.
const LEAST_SINE: f64 = 0.2;
/// The ground is sought where it would be were the way longer or shorter by up to this share.
const SEARCH: f64 = 0.35;
/// Step of the search, pixels.
const STEP: f64 = 0.5;
/// What moves by less, pixels, over the whole search says nothing; what moves by more passes below the camera.
const MOVE: std::ops::Range<f64> = 4.0..300.0;
/// Standard deviation of a patch's grey levels at least: twice a camera's noise.
const LEAST_CONTRAST: f32 = 3.0;
/// Correlation of two views of one patch at least.
const LEAST_CORRELATION: f32 = 0.8;
/// … and by how much more than anywhere else on its line, but for …
const DISTINCT: f32 = 0.1;
/// … so many steps to each side: pavers are like pavers.
const OWN_STEPS: usize = 4;
/// σ of where a patch is found, pixels. A guess: correlation finds a tenth, perspective bends the patch.
const SIGMA: f64 = 0.25;

/// Patches of the reference image that may be ground, where the later one shows them, on their epipolar lines.
/// `camera_from_reference`: its turn and direction are right.
pub(super) fn ground_patches(
    reference: &GrayImage,
    image: &GrayImage,
    camera: &CameraModel,
    camera_from_reference: &Isometry3<f64>,
    ground: &GroundPlane,
) -> Vec<RayPair> {
    let (width, height) = reference.size();
    let middles = |size: usize| (REACH..size.saturating_sub(REACH)).step_by(SPACING);
    let places = middles(height).flat_map(|y| middles(width).map(move |x| (x, y)));
    let sigma = SIGMA / camera.fx;
    places
        .filter_map(|(x, y)| {
            let seen = Sighting::of(&Point2::new(x as f64, y as f64), camera, camera_from_reference, ground)?;
            let patch = Patch::cut(reference, x, y)?;
            Some(RayPair { reference: seen.ray, camera: seen.find(&patch, image)?, sigma })
        })
        .collect()
}

/// A place of the reference image, and where the ground there would be in the later one.
struct Sighting<'a> {
    camera: &'a CameraModel,
    ray: Vector3<f64>,
    /// The ray, turned, and what a way of the assumed length adds to it.
    turned: Vector3<f64>,
    shift: Vector3<f64>,
    /// d(place in the later image)/d(place in the reference), on the ground.
    warp: Matrix2<f32>,
}

impl<'a> Sighting<'a> {
    /// `None` where no ground can be.
    fn of(
        place: &Point2<f64>,
        camera: &'a CameraModel,
        camera_from_reference: &Isometry3<f64>,
        ground: &GroundPlane,
    ) -> Option<Self> {
        let ray = camera.ray(place);
        if ground.down.dot(&ray) < LEAST_SINE * ray.norm() {
            return None;
        }
        let parts = |ray: &Vector3<f64>| {
            let inverse_depth = ground.down.dot(ray) / ground.height;
            (camera_from_reference.rotation * ray, camera_from_reference.translation.vector * inverse_depth)
        };
        let (turned, shift) = parts(&ray);
        let mut sighting = Self { camera, ray, turned, shift, warp: Matrix2::identity() };
        let middle = sighting.place(1.0)?;
        let beside = |step: Vector2<f64>| {
            let (turned, shift) = parts(&camera.ray(&(place + step)));
            Some(camera.project(&Point3::from(turned + shift))? - middle)
        };
        sighting.warp = Matrix2::from_columns(&[beside(Vector2::x())?, beside(Vector2::y())?]).cast();
        Some(sighting)
    }

    /// Where it is on a way so many times as long.
    fn place(&self, share: f64) -> Option<Point2<f64>> {
        self.camera.project(&Point3::from(self.turned + self.shift * share))
    }

    /// The ray to the patch in the later image; `None` where it is not found, or might be elsewhere.
    fn find(&self, patch: &Patch, image: &GrayImage) -> Option<Vector3<f64>> {
        let (first, last) = (1.0 - SEARCH, 1.0 + SEARCH);
        let length = (self.place(last)? - self.place(first)?).norm();
        if !MOVE.contains(&length) {
            return None;
        }
        let steps = (length / STEP).ceil() as usize;
        let step = (last - first) / steps as f64;
        let alike: Vec<f32> = (0..=steps)
            .map(|index| {
                let place = self.place(first + step * index as f64)?;
                patch.correlation(image, place.cast(), &self.warp)
            })
            .map(|found| found.unwrap_or(-1.0))
            .collect();
        let best = (0..=steps).max_by(|&a, &b| alike[a].total_cmp(&alike[b]))?;
        let elsewhere = (0..=steps).filter(|index| index.abs_diff(best) > OWN_STEPS).map(|index| alike[index]);
        let is_distinct = elsewhere.fold(-1.0, f32::max) < alike[best] - DISTINCT;
        if best == 0 || best == steps || alike[best] < LEAST_CORRELATION || !is_distinct {
            return None;
        }
        // The top of a parabola through three steps.
        let (before, top, after) = (alike[best - 1], alike[best], alike[best + 1]);
        let aside = 0.5 * (before - after) / (before - 2.0 * top + after);
        let share = first + step * (best as f64 + f64::from(if aside.is_finite() { aside } else { 0.0 }));
        let ray = self.turned + self.shift * share;
        Some(ray / ray.z)
    }
}

/// Grey levels about a place, less their mean, the sum of their squares 1.
struct Patch([f32; AREA]);

impl Patch {
    /// `None` where nothing is to be seen.
    fn cut(image: &GrayImage, x: usize, y: usize) -> Option<Self> {
        let levels =
            std::array::from_fn(|index| f32::from(image.at(x + index % SIDE - REACH, y + index / SIDE - REACH)));
        Self::normalised(levels, LEAST_CONTRAST)
    }

    fn normalised(mut levels: [f32; AREA], least_contrast: f32) -> Option<Self> {
        let mean = levels.iter().sum::<f32>() / AREA as f32;
        levels.iter_mut().for_each(|level| *level -= mean);
        let norm = levels.iter().map(|level| level * level).sum::<f32>().sqrt();
        let contrast = norm / (AREA as f32).sqrt();
        levels.iter_mut().for_each(|level| *level /= norm);
        (contrast > least_contrast).then_some(Self(levels))
    }

    /// With what another image shows at a place, its axes bent by `warp`; −1–1. `None` beyond the image's edge.
    fn correlation(&self, image: &GrayImage, place: Point2<f32>, warp: &Matrix2<f32>) -> Option<f32> {
        let reach = REACH as f32;
        let corner = warp.abs() * Vector2::new(reach, reach);
        let (low, high) = (place - corner, place + corner);
        let (width, height) = image.size();
        if low.x < 0.0 || low.y < 0.0 || high.x >= (width - 1) as f32 || high.y >= (height - 1) as f32 {
            return None;
        }
        let levels = std::array::from_fn(|index| {
            let aside = Vector2::new((index % SIDE) as f32 - reach, (index / SIDE) as f32 - reach);
            let place = place + warp * aside;
            image.between(place.x, place.y)
        });
        let other = Self::normalised(levels, 0.0)?;
        Some(self.0.iter().zip(&other.0).map(|(a, b)| a * b).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Rig;

    /// Squares of 8 px in 256 greys, none of them next to its like.
    fn chequered() -> GrayImage {
        let grey = |x: usize, y: usize| ((x / 8 * 7919 + y / 8 * 104_729) % 256) as u8;
        let pixels = (0..640 * 480).map(|index| grey(index % 640, index / 640)).collect();
        GrayImage::from_pixels(640, 480, pixels).unwrap()
    }

    fn patches(way: f64) -> Vec<RayPair> {
        let (image, camera) = (chequered(), Rig::kinect_default().colour);
        let ground = GroundPlane { down: Vector3::y(), height: 0.6 };
        ground_patches(&image, &image, &camera, &Isometry3::translation(0.0, 0.0, -way), &ground)
    }

    #[test]
    fn what_passes_below_the_camera_is_not_sought() {
        // Of each row: on the longest way that is looked at the ground comes as near to the camera as numbers allow.
        let camera = Rig::kinect_default().colour;
        let rows = (REACH..480).step_by(SPACING).map(|row| camera.ray(&Point2::new(0.0, row as f64)).y);
        let near = rows.filter(|&down| down > 0.0).map(|down| 0.6 / (down * (1.0 + SEARCH)) * (1.0 - 1e-13));
        for way in near.chain([1.0, 1.5, 5.0, 1e9]) {
            assert!(patches(way).iter().all(|pair| pair.camera.iter().all(|x| x.is_finite())), "{way}");
        }
    }

    #[test]
    fn where_nothing_moves_nothing_is_said() {
        assert!(patches(0.0).is_empty() && patches(f64::NAN).is_empty());
    }
}
