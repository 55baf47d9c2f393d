//! Sun and sky for the shaders: the sun's map of depth, drawn anew when the sun has moved, and what they are told.

use glam::{DAffine3, DMat4, DVec3, Mat4, Vec3, Vec4};

use super::bounds::Bounds;
use super::device::Device;
use super::raster::{DepthMap, uniform_buffer};
use super::scene::Scene;
use super::uniforms;
use crate::light::{Bands, Beam, LightState};

/// Edge of the sun's map, pixels: 2 cm in a yard of 40 m, about what the sun's own size blurs 2 m behind an edge.
const MAP_SIZE: u32 = 2048;
/// The map is drawn for a sun that stands on a grid of so many steps a degree: how it got there does not matter.
const STEPS_A_DEGREE: f64 = 10.0;
/// Pixels that stay empty around the map.
const BORDER: f64 = 2.0;
/// lux (cd/m²) in a unit of the shaders' visible light: `LUX_PER_UNIT`.
const LUX_PER_UNIT: f32 = 256.0;
/// How fast the glow about the sun fades with the angle, 1/rad: `GLOW_FADES` in the shader.
const GLOW_FADES: f64 = 3.0;

/// What an open world has above it. Worlds without a sky have one, too, that is never drawn.
pub(super) struct Daylight {
    open: bool,
    pub map: DepthMap,
    clip: wgpu::Buffer,
    light: LightState,
    /// Radiance in the middle of the glow for a unit of what the sky gives the ground.
    glow: f32,
    /// On the grid; what the map shows.
    drawn: Option<Vec3>,
    projection: Projection,
}

/// The sun's view of the world, without perspective.
#[derive(Clone, Copy, Default)]
struct Projection {
    clip_from_world: DMat4,
    /// Metres: width of a pixel, depth of the whole.
    pixel: f64,
    depth: f64,
}

impl Daylight {
    pub fn new(gpu: &Device, open: bool) -> Self {
        let clip = uniform_buffer(gpu, size_of::<Mat4>());
        let size = if open { MAP_SIZE } else { 1 };
        // The shader knows how far a surface may lie behind its map.
        let map = DepthMap::new(gpu, [size; 2], &clip, 0.0, true);
        Self {
            open,
            map,
            clip,
            light: LightState::default(),
            glow: 0.0,
            drawn: None,
            projection: Projection::default(),
        }
    }

    /// What there may be of sky and sun in this world, each 0 or 1: nothing, or a sky with and without a sun.
    pub fn variants(&self) -> impl Iterator<Item = [f64; 2]> {
        let all: &[[f64; 2]] = if self.open { &[[1.0, 0.0], [1.0, 1.0]] } else { &[[0.0, 0.0]] };
        all.iter().copied()
    }

    /// Which of them there is.
    pub fn variant(&self) -> usize {
        usize::from(self.open && self.light.beam.shines())
    }

    /// Has other light from now on.
    pub fn change(&mut self, gpu: &Device, scene: &Scene, light: &LightState) {
        if !self.open {
            return;
        }
        self.light = light.clone();
        self.glow = light.sky.glow / glow_on_the_ground(&light.beam) as f32;
        if !light.beam.shines() {
            return;
        }
        let towards = on_grid(light.beam.towards);
        if self.drawn == Some(towards) {
            return;
        }
        self.projection = Projection::of(&scene.bounds(), towards.as_dvec3());
        let clip = self.projection.clip_from_world.as_mat4();
        gpu.queue.write_buffer(&self.clip, 0, bytemuck::bytes_of(&clip));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.map.encode(&mut encoder, scene, &clip);
        gpu.queue.submit([encoder.finish()]);
        self.drawn = Some(towards);
    }

    /// For a camera's shader, if it looks for daylight.
    pub fn uniform(&self, world_from_camera: &DAffine3) -> Option<uniforms::Daylight> {
        if !self.open {
            return None;
        }
        let LightState { sky, beam, .. } = &self.light;
        let camera_from_world = world_from_camera.matrix3.transpose();
        let in_camera = |direction: DVec3| (camera_from_world * direction).as_vec3();
        // Clip space has y upwards, textures downwards.
        let half = 0.5 * f64::from(MAP_SIZE);
        // Pixel centres at whole numbers.
        let map_from_clip = DMat4::from_translation(DVec3::new(half - 0.5, half - 0.5, 0.0))
            * DMat4::from_scale(DVec3::new(half, -half, 1.0));
        let map_from_camera = map_from_clip * self.projection.clip_from_world * DMat4::from(*world_from_camera);
        let share = 1.0 - sky.glow;
        Some(uniforms::Daylight {
            map_from_camera: map_from_camera.as_mat4(),
            beam: if beam.shines() { units(beam.normal) } else { Vec4::ZERO },
            level: share * units(sky.level),
            rise: share * units(sky.rise),
            glow: self.glow * units(sky.horizontal()),
            ground: units(self.light.far_ground()),
            towards: in_camera(beam.towards.as_dvec3()),
            map_texel: (MAP_SIZE as f32).recip(),
            up: in_camera(DVec3::Z),
            map_step: (self.projection.pixel / self.projection.depth) as f32,
        })
    }
}

impl Projection {
    /// All of the world, seen from the sun.
    fn of(bounds: &Bounds, towards: DVec3) -> Self {
        let (lowest, highest) = (bounds.lowest.as_dvec3(), bounds.highest.as_dvec3());
        if !(highest - lowest).is_finite() {
            return Self { clip_from_world: DMat4::IDENTITY, pixel: 1.0, depth: 1.0 };
        }
        // Along the horizon, up as seen, towards the sun.
        let across = DVec3::Z.cross(towards).try_normalize().unwrap_or(DVec3::X);
        let axes = [across, towards.cross(across), towards];
        let middle = (lowest + highest) / 2.0;
        let half = axes.map(|axis| (axis.abs().dot(highest - lowest) / 2.0).max(1e-3));
        let inside = 1.0 - 2.0 * BORDER / f64::from(MAP_SIZE);
        // Nearer is more, as everywhere: 1 at the end that is nearest to the sun.
        let scale = [inside / half[0], inside / half[1], 0.5 / half[2]];
        let rows = [0, 1, 2].map(|row| {
            let axis = scale[row] * axes[row];
            axis.extend(-axis.dot(middle) + if row == 2 { 0.5 } else { 0.0 })
        });
        let clip_from_world = DMat4::from_cols(rows[0], rows[1], rows[2], glam::DVec4::W).transpose();
        let pixel = 2.0 * half[0].max(half[1]) / inside / f64::from(MAP_SIZE);
        Self { clip_from_world, pixel, depth: 2.0 * half[2] }
    }
}

/// The direction of the grid nearest to one, which is at most half a step away in each angle.
fn on_grid(towards: Vec3) -> Vec3 {
    let towards = towards.as_dvec3();
    let nearest = |angle: f64| ((angle.to_degrees() * STEPS_A_DEGREE).round() / STEPS_A_DEGREE).to_radians();
    let (elevation, azimuth) = (towards.z.clamp(-1.0, 1.0).asin(), towards.x.atan2(towards.y));
    // A sun on the horizon still looks a little down: edge-on, ground would have no depth.
    crate::light::towards(nearest(elevation).max((1.0 / STEPS_A_DEGREE).to_radians()), nearest(azimuth))
}

/// Visible light in the shaders' units.
fn units([red, green, blue, near_infrared]: Bands) -> Vec4 {
    Vec4::new(red / LUX_PER_UNIT, green / LUX_PER_UNIT, blue / LUX_PER_UNIT, near_infrared)
}

/// What the ground gets of a glow that has a radiance of 1 at its middle: ∫ e^(−3γ) sin(elevation) dω.
fn glow_on_the_ground(beam: &Beam) -> f64 {
    const STEPS: [usize; 2] = [24, 72];
    let towards = beam.towards.as_dvec3();
    let step = [std::f64::consts::FRAC_PI_2 / STEPS[0] as f64, std::f64::consts::TAU / STEPS[1] as f64];
    let at = |index: usize| {
        let [row, column] = [index / STEPS[1], index % STEPS[1]];
        let (elevation, azimuth) = ((row as f64 + 0.5) * step[0], (column as f64 + 0.5) * step[1]);
        let way = crate::light::towards(elevation, azimuth).as_dvec3();
        let apart = (2.0 - 2.0 * way.dot(towards)).max(0.0).sqrt();
        (-GLOW_FADES * apart).exp() * elevation.sin() * elevation.cos() * step[0] * step[1]
    };
    (0..STEPS[0] * STEPS[1]).map(at).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{daylight, towards};

    fn bounds() -> Bounds {
        Bounds { lowest: Vec3::new(-20.0, -10.0, -1.0), highest: Vec3::new(25.0, 12.0, 9.0) }
    }

    #[test]
    fn the_suns_map_holds_the_whole_world_nearer_to_the_sun_being_more() {
        for (elevation, azimuth) in [(0.3, 1.0), (1.2, -2.0), (0.002, 0.0), (std::f64::consts::FRAC_PI_2, 0.0)] {
            let sun = towards(elevation, azimuth).as_dvec3();
            let projection = Projection::of(&bounds(), sun);
            for corner in 0..8 {
                let pick = |axis: usize| if corner >> axis & 1 == 0 { bounds().lowest } else { bounds().highest };
                let corner = Vec3::new(pick(0).x, pick(1).y, pick(2).z).as_dvec3();
                let clip = projection.clip_from_world.project_point3(corner);
                let border = 1.0 - BORDER / f64::from(MAP_SIZE);
                assert!(clip.x.abs() < border && clip.y.abs() < border && (-1e-9..=1.0 + 1e-9).contains(&clip.z));
                let nearer = projection.clip_from_world.project_point3(corner + 0.1 * sun);
                assert!((nearer - clip - DVec3::new(0.0, 0.0, 0.1 / projection.depth)).length() < 1e-9);
            }
        }
    }

    #[test]
    fn the_map_is_drawn_for_a_sun_within_a_tenth_of_a_degree() {
        for step in 0..500 {
            let sun = towards(0.001 + 0.003 * f64::from(step), 0.1 * f64::from(step));
            let grid = on_grid(sun);
            assert!(grid.angle_between(sun) < 0.0018, "{sun} {grid}");
            assert!(on_grid(grid).angle_between(grid) < 1e-6, "stays where it is");
        }
    }

    #[test]
    fn the_glow_is_part_of_what_the_sky_gives_and_not_beside_it() {
        for elevation in [3.0_f64, 20.0, 45.0, 80.0] {
            let light = daylight(elevation.to_radians(), 1.0, 0.3);
            let glow = glow_on_the_ground(&light.beam);
            // A sky half of which is glow: numerically the same sum, coarser.
            assert!((0.05..0.7).contains(&glow), "{elevation}°: {glow}");
        }
    }
}
