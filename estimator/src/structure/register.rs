//! Depth carried into the colour camera's pixels by the believed calibration.

use nalgebra::{Matrix3, Point2, Vector3};
use pulp::{Arch, NullaryFnOnce};

use crate::camera::{DepthCamera, Rig};
use crate::image::{DepthImage, Image};

/// Z in the colour camera's frame for each colour pixel, metres; 0 = no value.
pub type RegisteredDepth = Image<f32>;

/// What of the calibration can be worked out once: a ray for each depth pixel, a depth for each value.
pub struct Registration {
    /// colour R_depth · ray through each depth pixel (z = 1 in the depth frame): all x, all y, all z.
    rays: [Vec<f32>; 3],
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
        let mut rays: [Vec<f32>; 3] = Default::default();
        let pixels = if registered_to_colour { 0 } else { model.width * model.height };
        for index in 0..pixels {
            let pixel = Point2::new((index % model.width) as f64, (index / model.width) as f64);
            let ray = rotation * model.ray(&pixel);
            rays.iter_mut().zip(ray.iter()).for_each(|(rays, &along)| rays.push(along as f32));
        }
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
        Arch::new().dispatch(Splat { registration: self, depth, registered: &mut registered });
        registered
    }
}

/// Every depth pixel into the colour pixels that it covers. A type of its own: [`Arch::dispatch`] inlines no closure.
struct Splat<'a> {
    registration: &'a Registration,
    depth: &'a DepthImage,
    registered: &'a mut RegisteredDepth,
}

impl NullaryFnOnce for Splat<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Registration { rays, offset, metres, rig } = self.registration;
        let lens = Lens::new(rig);
        // A depth pixel covers this many colour pixels; one more closes the gaps between neighbours.
        let reach_x = splat_reach(rig.colour.fx / rig.depth.model.fx);
        let reach_y = splat_reach(rig.colour.fy / rig.depth.model.fy);
        let (width, height) = (self.registered.width(), self.registered.height() as i32);
        let pixels = self.registered.pixels_mut();
        // A row's footprints first, many at a time, and then who hides whom, one by one.
        let row = self.depth.width();
        let mut depths = vec![0.0_f32; row];
        let [mut lefts, mut rights, mut tops, mut bottoms] = [(); 4].map(|()| vec![0_i32; row]);
        for (y, values) in self.depth.pixels().chunks_exact(row).enumerate() {
            depths.iter_mut().zip(values).for_each(|(z, &value)| *z = metres[usize::from(value)]);
            let [rays_x, rays_y, rays_z] = rays.each_ref().map(|along| &along[y * row..][..row]);
            let z = &mut depths[..row];
            let (lefts, rights) = (&mut lefts[..row], &mut rights[..row]);
            let (tops, bottoms) = (&mut tops[..row], &mut bottoms[..row]);
            for x in 0..row {
                let z_depth = z[x];
                let point = Vector3::new(rays_x[x] * z_depth, rays_y[x] * z_depth, rays_z[x] * z_depth) + offset;
                let (u, v) = lens.project(point);
                z[x] = if z_depth == 0.0 { 0.0 } else { point.z };
                (lefts[x], rights[x]) = (floor(u - reach_x) + 1, floor(u + reach_x));
                (tops[x], bottoms[x]) = (floor(v - reach_y) + 1, floor(v + reach_y));
            }
            for x in 0..row {
                let (left, right) = (lefts[x].max(0), rights[x].min(width as i32 - 1));
                if z[x] <= 0.0 || left > right {
                    continue;
                }
                for y in tops[x].max(0)..=bottoms[x].min(height - 1) {
                    let start = y as usize * width;
                    for nearest in &mut pixels[start + left as usize..=start + right as usize] {
                        if *nearest == 0.0 || z[x] < *nearest {
                            *nearest = z[x];
                        }
                    }
                }
            }
        }
    }
}

/// Floor by truncation, far quicker than `f32::floor` where the processor lacks an instruction for it. Values below
/// −4096, which no pixel has, come out too large, and those beyond the range of i32 as any number that is no pixel's.
#[inline(always)]
fn floor(value: f32) -> i32 {
    ((value + 4096.0) as i32).wrapping_sub(4096)
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

    #[inline(always)]
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{CameraModel, DepthEncoding, Distortion};
    use nalgebra::{Isometry3, Point3};

    /// Two cameras of a Kinect, small: depth sees more finely than colour, from 25 mm beside it, slightly turned.
    fn rig() -> Rig {
        let colour = CameraModel {
            width: 160,
            height: 120,
            fx: 131.0,
            fy: 131.0,
            cx: 79.0,
            cy: 61.0,
            distortion: Distortion { k1: 0.26, k2: -0.95, p1: -0.005, p2: 0.003, k3: 1.16 },
        };
        let depth =
            CameraModel { fx: 146.0, fy: 146.0, cx: 80.0, cy: 59.5, distortion: Distortion::default(), ..colour };
        Rig {
            colour,
            depth: DepthCamera {
                model: depth,
                encoding: DepthEncoding::Linear { units_per_metre: 1000.0 },
                registered_to_colour: false,
            },
            colour_from_depth: Isometry3::new(Vector3::new(-0.025, 0.001, 0.0), Vector3::new(0.0, 0.01, 0.005)),
            alignment_sigma: 0.0,
            robot_from_colour: Isometry3::identity(),
            drive: None,
        }
    }

    #[test]
    fn a_wall_keeps_its_distance_and_has_no_holes() {
        let rig = rig();
        let registered = Registration::new(&rig).register(&DepthImage::filled(160, 120, 2000));
        // Away from the rim, where the depth camera does not look.
        for y in 25..95 {
            for x in 25..135 {
                let z = registered.at(x, y);
                assert!((z - 2.0).abs() < 0.02, "({x}, {y}): {z}");
            }
        }
    }

    #[test]
    fn it_equals_the_plain_projection() {
        // One depth pixel at a time, through the f64 camera model.
        let rig = rig();
        let registration = Registration::new(&rig);
        for (x, y, value) in [(40, 30, 900_u16), (80, 60, 2500), (120, 90, 4000), (100, 25, 1500)] {
            let mut depth = DepthImage::filled(160, 120, 0);
            depth.pixels_mut()[y * 160 + x] = value;
            let registered = registration.register(&depth);
            let ray = rig.depth.model.ray(&Point2::new(x as f64, y as f64));
            let point = rig.colour_from_depth * Point3::from(ray * (f64::from(value) / 1000.0));
            let pixel = rig.colour.project(&point).unwrap();
            let found = registered.at(pixel.x.round() as usize, pixel.y.round() as usize);
            assert!((f64::from(found) - point.z).abs() < 1e-4, "{found} at {pixel}");
            assert_eq!(registered.pixels().iter().filter(|&&z| z > 0.0).count(), 1);
        }
    }

    #[test]
    fn the_nearer_surface_hides_the_farther() {
        // A near half in front of a far wall: the baseline moves it across pixels that the wall reaches too.
        let rig = rig();
        let mut depth = DepthImage::filled(160, 120, 4000);
        for row in depth.pixels_mut().chunks_mut(160) {
            row[80..].fill(800);
        }
        let registered = Registration::new(&rig).register(&depth);
        let edge = rig
            .colour
            .project(&(rig.colour_from_depth * Point3::from(rig.depth.model.ray(&Point2::new(80.0, 60.0)) * 0.8)));
        let edge = edge.unwrap().x.round() as usize;
        for x in edge + 1..edge + 20 {
            assert!((registered.at(x, 60) - 0.8).abs() < 0.02, "{x}: {}", registered.at(x, 60));
        }
    }

    #[test]
    fn registered_depth_passes_as_it_is() {
        let mut rig = rig();
        rig.depth.registered_to_colour = true;
        let mut depth = DepthImage::filled(160, 120, 1234);
        depth.pixels_mut()[7] = 0;
        let registered = Registration::new(&rig).register(&depth);
        assert_eq!(registered.at(7, 0), 0.0);
        assert!((registered.at(8, 0) - 1.234).abs() < 1e-6);
    }

    #[test]
    fn floor_is_floor() {
        for value in [-3.2_f32, -1.0, -0.1, 0.0, 0.9, 1.0, 639.99] {
            assert_eq!(floor(value), value.floor() as i32, "{value}");
        }
    }
}
