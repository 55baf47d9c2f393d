//! Depth carried into the colour camera's pixels by the believed calibration.

use nalgebra::{Matrix3, Point2, Vector3};

use crate::camera::{DepthCamera, Rig};
use crate::image::{DepthImage, Image};

/// Z in the colour camera's frame for each colour pixel, metres; 0 = no value.
pub type RegisteredDepth = Image<f32>;

/// What of the calibration can be worked out once: a ray for each depth pixel, a depth for each value.
pub struct Registration {
    /// colour R_depth · ray through each depth pixel (z = 1 in the depth frame).
    rays: Vec<Vector3<f32>>,
    /// Origin of the depth frame, seen from the colour camera; metres.
    offset: Vector3<f32>,
    /// Metres by depth value; 0 = no value.
    metres: Vec<f32>,
    rig: Rig,
}

impl Registration {
    /// Tables for one rig.
    pub fn new(rig: &Rig) -> Self {
        let rotation: Matrix3<f64> = *rig.colour_from_depth.rotation.to_rotation_matrix().matrix();
        let DepthCamera { model, registered_to_colour, .. } = rig.depth;
        let rays = if registered_to_colour {
            Vec::new()
        } else {
            (0..model.width * model.height)
                .map(|index| {
                    let pixel = Point2::new((index % model.width) as f64, (index / model.width) as f64);
                    (rotation * model.ray(&pixel)).cast()
                })
                .collect()
        };
        Self {
            rays,
            offset: rig.colour_from_depth.translation.vector.cast(),
            metres: (0..=u16::MAX).map(|value| rig.depth.depth_of(value).unwrap_or(0.0) as f32).collect(),
            rig: rig.clone(),
        }
    }

    /// Carries `depth` into the colour image. Where two surfaces fall on one pixel the nearer one hides the other.
    /// `depth` must have the rig's size.
    pub fn register(&self, depth: &DepthImage) -> RegisteredDepth {
        let colour = &self.rig.colour;
        if self.rig.depth.registered_to_colour {
            let pixels = depth.pixels().iter().map(|&value| self.metres[usize::from(value)]).collect();
            return Image::from_pixels(depth.width(), depth.height(), pixels).expect("same size in and out");
        }
        let mut registered = RegisteredDepth::filled(colour.width, colour.height, 0.0);
        // A depth pixel covers this many colour pixels; one more closes the gaps between neighbours.
        let reach_x = splat_reach(colour.fx / self.rig.depth.model.fx);
        let reach_y = splat_reach(colour.fy / self.rig.depth.model.fy);
        let lens = Lens::new(&self.rig);
        for (&value, ray) in depth.pixels().iter().zip(&self.rays) {
            let z_depth = self.metres[usize::from(value)];
            if z_depth == 0.0 {
                continue;
            }
            let point = ray * z_depth + self.offset;
            if point.z <= 0.0 {
                continue;
            }
            let (u, v) = lens.project(point);
            let (left, right) = (floor(u - reach_x) + 1, floor(u + reach_x));
            let (top, bottom) = (floor(v - reach_y) + 1, floor(v + reach_y));
            for y in top.max(0)..=bottom.min(colour.height as i32 - 1) {
                for x in left.max(0)..=right.min(colour.width as i32 - 1) {
                    let z = &mut registered.pixels_mut()[y as usize * colour.width + x as usize];
                    if *z == 0.0 || point.z < *z {
                        *z = point.z;
                    }
                }
            }
        }
        registered
    }
}

/// Floor by truncation, far quicker than `f32::floor` where the processor lacks an instruction for it. Values below
/// −4096, which no pixel has, come out too large, and those beyond the range of i32 saturate.
fn floor(value: f32) -> i32 {
    (value + 4096.0) as i32 - 4096
}

/// Half the edge of a depth pixel's footprint in the colour image: half the magnification, and never under half a
/// pixel, or pixels between two splats stay empty.
fn splat_reach(magnification: f64) -> f32 {
    (0.5 * magnification).max(0.5) as f32
}

/// The colour camera's projection in f32, which is exact to 1e-4 px and twice as quick.
struct Lens {
    fx: f32,
    fy: f32,
    cx: f32,
    cy: f32,
    k: [f32; 5],
}

impl Lens {
    fn new(rig: &Rig) -> Self {
        let camera = &rig.colour;
        let d = camera.distortion;
        Self {
            fx: camera.fx as f32,
            fy: camera.fy as f32,
            cx: camera.cx as f32,
            cy: camera.cy as f32,
            k: [d.k1, d.k2, d.p1, d.p2, d.k3].map(|value| value as f32),
        }
    }

    fn project(&self, point: Vector3<f32>) -> (f32, f32) {
        let [k1, k2, p1, p2, k3] = self.k;
        let inverse = 1.0 / point.z;
        let (x, y) = (point.x * inverse, point.y * inverse);
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        let xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
        let yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
        (self.fx * xd + self.cx, self.fy * yd + self.cy)
    }
}
