//! Where a camera is and what it sees: poses over a frame, matrices, the G-buffer's margin.

use glam::{DAffine3, DMat4, DQuat, DVec3, Mat4, UVec2, Vec2};
use nalgebra::{Isometry3, Vector3};
use sunblind_estimator::camera::CameraModel;

use super::uniforms;

/// Nearest depth rendered, metres. A guess; the robot's own body keeps everything further away.
pub(super) const NEAR: f32 = 0.05;
/// What the G-buffer has beyond what a camera at rest sees, share of its width: how far things may move in during half a
/// frame.
const MOTION_MARGIN: f64 = 0.025;
/// How many instants of an exposure may be averaged: at rest, driving, spinning. Odd, so that one is in its middle.
pub(super) const TAPS: [u32; 3] = [1, 3, 7];
/// Motion in the image that may pass from one of them to the next, pixels.
const BLUR_STEP: f64 = 1.5;
/// Depth at which a camera's translation is judged when choosing the number of instants, metres. A guess.
const TYPICAL_DEPTH: f64 = 1.0;

/// A camera's pose (`world_from_camera`) at the start and at the end of a frame interval; it moves evenly between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// At the start.
    pub start: DAffine3,
    /// At the end.
    pub end: DAffine3,
}

impl Sweep {
    /// From one pose to another, in the estimator's mathematics.
    pub fn between(start: &Isometry3<f64>, end: &Isometry3<f64>) -> Self {
        Self { start: affine(start), end: affine(end) }
    }

    /// On a robot that drives an arc, over the `seconds` in whose middle it stands at `world_from_robot`. Speed in m/s,
    /// curvature in 1/m.
    pub fn driving(
        world_from_robot: &Isometry3<f64>,
        robot_from_camera: &Isometry3<f64>,
        [speed, curvature]: [f64; 2],
        seconds: f64,
    ) -> Self {
        let moved = |seconds: f64| {
            let turned = speed * curvature * seconds;
            // Along the chord: an arc's, of so small an angle.
            let (sin, cos) = (0.5 * turned).sin_cos();
            let chord = speed * seconds * Vector3::new(cos, sin, 0.0);
            world_from_robot * Isometry3::new(chord, Vector3::z() * turned) * robot_from_camera
        };
        Self::between(&moved(-0.5 * seconds), &moved(0.5 * seconds))
    }

    /// At rest.
    pub fn still(world_from_camera: DAffine3) -> Self {
        Self { start: world_from_camera, end: world_from_camera }
    }

    /// The pose in the middle of the interval.
    pub fn middle(&self) -> DAffine3 {
        let (start, end) = (rotation_and_place(&self.start), rotation_and_place(&self.end));
        DAffine3::from_rotation_translation(start.0.slerp(end.0, 0.5), start.1.lerp(end.1, 0.5))
    }

    /// The motion of another camera on the same device.
    pub fn of_other(&self, camera_from_other: &DAffine3) -> Self {
        Self { start: self.start * *camera_from_other, end: self.end * *camera_from_other }
    }
}

/// nalgebra, the estimator's mathematics, to glam, the renderer's.
pub fn affine(a_from_b: &Isometry3<f64>) -> DAffine3 {
    let rotation = a_from_b.rotation.coords;
    let translation = a_from_b.translation.vector;
    DAffine3::from_rotation_translation(
        DQuat::from_xyzw(rotation.x, rotation.y, rotation.z, rotation.w),
        DVec3::new(translation.x, translation.y, translation.z),
    )
}

fn rotation_and_place(pose: &DAffine3) -> (DQuat, DVec3) {
    (DQuat::from_mat3(&pose.matrix3), pose.translation)
}

/// One camera in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraFrame {
    /// Its motion.
    pub sweep: Sweep,
    /// How long a row is exposed, as a share of the frame interval; 0 for no motion blur.
    pub exposure: f32,
    /// From the first row's exposure to the last row's, likewise; 0 for a global shutter.
    pub readout: f32,
    /// Brightness lost in the corners, share.
    pub vignetting: f32,
}

/// A camera's optics and the size of its G-buffer.
pub(super) struct View {
    model: CameraModel,
    margin: u32,
}

impl View {
    pub fn new(model: CameraModel) -> Self {
        Self { model, margin: (overshoot(&model) + MOTION_MARGIN * model.width as f64).ceil() as u32 }
    }

    /// The camera.
    pub fn model(&self) -> &CameraModel {
        &self.model
    }

    /// Width and height of the G-buffer.
    pub fn gbuffer_size(&self) -> [u32; 2] {
        [self.model.width, self.model.height].map(|size| size as u32 + 2 * self.margin)
    }

    /// The G-buffer's pixel nearest to where a sensor's pixel looks.
    pub fn gbuffer_pixel(&self, x: usize, y: usize) -> [u32; 2] {
        let [seen_x, seen_y] = pinhole_pixel(&self.model, x as f64, y as f64);
        let [width, height] = self.gbuffer_size();
        let index = |seen: f64, size: u32| (seen + f64::from(self.margin)).round().clamp(0.0, f64::from(size - 1));
        [index(seen_x, width) as u32, index(seen_y, height) as u32]
    }

    /// (x/z, y/z) that each pixel of the sensor looks in, row after row: how the estimator inverts a lens.
    pub fn directions(&self) -> Vec<[f32; 2]> {
        let (width, height) = self.model.size();
        let ray = |index| self.model.ray(&[(index % width) as f64, (index / width) as f64].into());
        (0..width * height).map(ray).map(|ray| [ray.x as f32, ray.y as f32]).collect()
    }

    pub fn uniform(&self, frame: &CameraFrame) -> uniforms::Camera {
        let model = &self.model;
        let world_from_camera = frame.sweep.middle();
        let camera_from_world = DMat4::from(world_from_camera.inverse());
        let focal = Vec2::new(model.fx as f32, model.fy as f32);
        let centre = Vec2::new(model.cx as f32, model.cy as f32);
        let margin = Vec2::splat(self.margin as f32);
        let gbuffer_size = Vec2::from(self.gbuffer_size().map(|size| size as f32));
        // Pixel centres at whole numbers here, edges at whole numbers in clip space.
        let clip_from_camera = clip_from_camera(focal, centre + margin + 0.5, gbuffer_size, NEAR);
        let from_middle = |pose: &DAffine3| pose.inverse() * world_from_camera;
        let (start, end) = (from_middle(&frame.sweep.start), from_middle(&frame.sweep.end));
        // Two turns by opposite angles differ by what a cross product does.
        let turned = end.matrix3 - start.matrix3;
        let turn = DVec3::new(turned.y_axis.z, turned.z_axis.x, turned.x_axis.y);
        let shift = end.translation - start.translation;
        let size = UVec2::new(model.width as u32, model.height as u32);
        uniforms::Camera {
            clip_from_world: (clip_from_camera.as_dmat4() * camera_from_world).as_mat4(),
            camera_from_world: camera_from_world.as_mat4(),
            turn: turn.as_vec3(),
            exposure: frame.exposure,
            shift: shift.as_vec3(),
            readout: frame.readout,
            focal,
            pitch: focal.recip(),
            centre: centre + margin,
            texel: gbuffer_size.recip(),
            size,
            vignetting: 4.0 * frame.vignetting / size.as_vec2().length_squared(),
            nearest: NEAR.recip(),
        }
    }

    /// Which of [`TAPS`] makes a smooth blur.
    pub fn taps(&self, frame: &CameraFrame) -> usize {
        let (start, end) = (rotation_and_place(&frame.sweep.start), rotation_and_place(&frame.sweep.end));
        let angle = start.0.angle_between(end.0) + start.1.distance(end.1) / TYPICAL_DEPTH;
        let blur = self.model.fx * angle * f64::from(frame.exposure);
        let enough = |taps: &u32| blur < BLUR_STEP * f64::from(*taps);
        TAPS.iter().position(enough).unwrap_or(TAPS.len() - 1)
    }
}

/// Where a camera without a lens would have the pixel that the camera with it has at (x, y).
fn pinhole_pixel(model: &CameraModel, x: f64, y: f64) -> [f64; 2] {
    let ray = model.ray(&[x, y].into());
    [model.fx * ray.x + model.cx, model.fy * ray.y + model.cy]
}

/// How far the lens sees beyond the edges of the pinhole's image, pixels.
fn overshoot(model: &CameraModel) -> f64 {
    let (right, bottom) = (model.width as f64 - 1.0, model.height as f64 - 1.0);
    let across = (0..model.width).flat_map(|x| [(x as f64, 0.0), (x as f64, bottom)]);
    let down = (0..model.height).flat_map(|y| [(0.0, y as f64), (right, y as f64)]);
    across.chain(down).fold(0.0, |furthest: f64, (x, y)| {
        let [seen_x, seen_y] = pinhole_pixel(model, x, y);
        furthest.max(-seen_x).max(seen_x - right).max(-seen_y).max(seen_y - bottom)
    })
}

/// Camera frame (x right, y down, z forward) → clip space, with near/z as depth. `centre`: pixels, edges at whole
/// numbers.
pub(super) fn clip_from_camera(focal: Vec2, centre: Vec2, size: Vec2, near: f32) -> Mat4 {
    let scale = 2.0 * focal / size;
    let shift = 2.0 * centre / size - 1.0;
    Mat4::from_cols_array_2d(&[
        [scale.x, 0.0, 0.0, 0.0],
        [0.0, -scale.y, 0.0, 0.0],
        [shift.x, -shift.y, 0.0, 1.0],
        [0.0, 0.0, near, 0.0],
    ])
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn clip_space_puts_points_where_the_pinhole_does() {
        let clip = clip_from_camera(Vec2::new(500.0, 510.0), Vec2::new(320.0, 240.0), Vec2::new(640.0, 480.0), 0.1);
        let point = clip.project_point3(Vec3::new(0.4, -0.3, 2.0));
        let pixel = Vec2::new((point.x + 1.0) * 320.0, (1.0 - point.y) * 240.0);
        assert!((pixel - Vec2::new(420.0, 163.5)).length() < 1e-3, "{pixel}");
        assert!((point.z - 0.05).abs() < 1e-6, "near over z");
    }

    #[test]
    fn the_middle_of_a_turn_is_half_of_it() {
        let turned = |angle| DAffine3::from_rotation_translation(DQuat::from_rotation_y(angle), DVec3::X * angle);
        let sweep = Sweep { start: turned(0.2), end: turned(0.6) };
        assert!(sweep.middle().abs_diff_eq(turned(0.4), 1e-12));
    }
}
