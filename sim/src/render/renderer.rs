//! The passes of a frame, in order, and what comes out of them.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use glam::{DAffine3, DMat4, DVec3, Mat4, Vec2};

use super::daylight::Daylight;
use super::device::{Adapter, Device, RenderError};
use super::passes::{CameraPasses, MapShape, Optics, Samplers, colour_passes, infrared_passes, projector_uniform};
use super::raster::{DepthMap, uniform_buffer};
use super::readback::Readback;
use super::scene::Scene;
use super::uniforms::Projector;
use super::view::{NEAR, clip_from_camera};
use super::{CameraFrame, ColourSensor, InfraredSensor};
use crate::light::LightState;
use crate::world::World;

/// What is to be seen in one frame, and how it is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The colour camera.
    pub colour: CameraFrame,
    /// Its chip.
    pub colour_sensor: ColourSensor,
    /// The infrared camera.
    pub infrared: CameraFrame,
    /// Its chip.
    pub infrared_sensor: InfraredSensor,
    /// Tangent by which the projector points further towards the camera than its optics say.
    pub projector_turn: f32,
}

/// What the sensors saw, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Images {
    /// R, G, B, in sRGB.
    pub colour: Vec<[u8; 3]>,
    /// 10 bits.
    pub infrared: Vec<u16>,
}

/// A frame on its way.
#[must_use]
#[derive(Clone, Debug)]
pub struct Begun {
    infrared: wgpu::SubmissionIndex,
    colour: wgpu::SubmissionIndex,
}

/// What one stage of a frame took.
#[derive(Clone, Debug)]
pub struct StageCost {
    /// Which one.
    pub stage: &'static str,
    /// Processor time of all threads.
    pub cpu: Duration,
    /// Time on the clock.
    pub wall: Duration,
}

/// A world, a device in it, and the graphics adapter that shows one the other.
pub struct Renderer {
    gpu: Device,
    scene: Scene,
    daylight: Daylight,
    projector_map: DepthMap,
    projector_clip: wgpu::Buffer,
    infrared_from_projector: DAffine3,
    map_shape: MapShape,
    projector: Projector,
    projector_uniform: wgpu::Buffer,
    colour: CameraPasses,
    infrared: CameraPasses,
    colour_readback: Readback,
    infrared_readback: Readback,
}

/// What the stages of one frame need to know here: which light there is, clip-space matrices (from the world) and numbers of instants.
struct Plan {
    light: usize,
    projector_clip: Mat4,
    colour_clip: Mat4,
    infrared_clip: Mat4,
    colour_taps: usize,
    infrared_taps: usize,
}

/// How much further away a lit surface may lie than the projector's map says, in slopes of the map's pixels.
const SLOPE_BIAS: f32 = -2.0;

/// In order. Infrared first: depth can be found in it while colour is on its way.
const STAGES: [&str; 9] = [
    "projector map",
    "infrared G-buffer",
    "infrared light",
    "infrared sensor",
    "infrared readback",
    "colour G-buffer",
    "colour light",
    "colour sensor",
    "colour readback",
];
/// Those that the infrared image takes; the others are colour's.
const INFRARED: usize = 5;

impl Renderer {
    /// Opens the adapter and sends it the world.
    ///
    /// # Errors
    /// No adapter, or a world it cannot hold.
    pub fn new(world: &World, optics: &Optics<'_>) -> Result<Self, RenderError> {
        let gpu = Device::open()?;
        let scene = Scene::upload(&gpu, world)?;
        let samplers = Samplers::new(&gpu);
        let projector_clip = uniform_buffer(&gpu, size_of::<Mat4>());
        let map_shape = MapShape::of(&optics.infrared);
        let projector_map = DepthMap::new(&gpu, map_shape.size, &projector_clip, SLOPE_BIAS, false);
        let daylight = Daylight::new(&gpu, world.open_sky);
        let colour = colour_passes(&gpu, optics, &scene, &samplers, &daylight);
        let projector = uniform_buffer(&gpu, size_of::<Projector>());
        let infrared = infrared_passes(&gpu, optics, &scene, &samplers, &projector_map, &projector, &daylight);
        let [colour_readback, infrared_readback] =
            [&colour, &infrared].map(|camera| Readback::new(&gpu, camera.image.size()));
        let along_baseline = DVec3::X * f64::from(optics.projector.baseline);
        Ok(Self {
            gpu,
            scene,
            daylight,
            projector_map,
            projector_clip,
            infrared_from_projector: DAffine3::from_translation(along_baseline),
            map_shape,
            projector: projector_uniform(&optics.projector, map_shape),
            projector_uniform: projector,
            colour,
            infrared,
            colour_readback,
            infrared_readback,
        })
    }

    /// The adapter that renders.
    pub fn adapter(&self) -> &Adapter {
        &self.gpu.adapter
    }

    /// Has the world under this light from now on.
    pub fn illuminate(&mut self, light: &LightState) {
        self.scene.illuminate(&self.gpu, light);
        self.daylight.change(&self.gpu, &self.scene, light);
    }

    /// Takes both images.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn render(&mut self, frame: &Frame) -> Result<Images, RenderError> {
        let begun = self.begin(frame);
        let infrared = self.infrared(&begun)?;
        Ok(Images { colour: self.colour(&begun)?, infrared })
    }

    /// Begins to take both images, the infrared one first.
    pub fn begin(&mut self, frame: &Frame) -> Begun {
        let plan = self.prepare(frame);
        let submit = |stages| {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            for stage in stages {
                self.encode(stage, &mut encoder, &plan);
            }
            self.gpu.queue.submit([encoder.finish()])
        };
        Begun { infrared: submit(0..INFRARED), colour: submit(INFRARED..STAGES.len()) }
    }

    /// Waits for the infrared image: 10 bits.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn infrared(&self, begun: &Begun) -> Result<Vec<u16>, RenderError> {
        self.infrared_readback.read(&self.gpu, &begun.infrared, |bytes| {
            let numbers: &[u32] = bytemuck::cast_slice(bytes);
            numbers.iter().map(|&number| number as u16).collect()
        })
    }

    /// Waits for the colour image: R, G, B, in sRGB.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn colour(&self, begun: &Begun) -> Result<Vec<[u8; 3]>, RenderError> {
        self.colour_readback.read(&self.gpu, &begun.colour, |bytes| {
            bytes.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
        })
    }

    /// Takes both images as [`render`](Self::render) does, but waits after every stage and reports what it took.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn profile(&mut self, frame: &Frame) -> Result<Vec<StageCost>, RenderError> {
        let plan = self.prepare(frame);
        let mut costs = Vec::new();
        for (index, stage) in STAGES.into_iter().enumerate() {
            let (cpu, wall) = (ProcessTime::now(), Instant::now());
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            self.encode(index, &mut encoder, &plan);
            let submission = self.gpu.queue.submit([encoder.finish()]);
            let begun = Begun { infrared: submission.clone(), colour: submission };
            match stage {
                "infrared readback" => drop(self.infrared(&begun)?),
                "colour readback" => drop(self.colour(&begun)?),
                _ => self.gpu.wait(&begun.colour)?,
            }
            costs.push(StageCost { stage, cpu: cpu.elapsed(), wall: wall.elapsed() });
        }
        Ok(costs)
    }

    /// True depth (z, metres; infinite where there is nothing) of each `step`th pixel, across and down, of the last frame's
    /// infrared image. For judging depth, never for making it.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn true_depth(&self, step: usize) -> Result<Vec<f32>, RenderError> {
        let view = &self.infrared.view;
        let [width, height] = view.gbuffer_size();
        let row_bytes = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = Readback::new(&self.gpu, u64::from(row_bytes * height));
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_bytes), rows_per_image: Some(height) };
        encoder.copy_texture_to_buffer(
            self.infrared.gbuffer.depth.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: readback.buffer(), layout },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        let submission = self.gpu.queue.submit([encoder.finish()]);
        let (columns, rows) = view.model().size();
        readback.read(&self.gpu, &submission, |bytes| {
            let depths: &[f32] = bytemuck::cast_slice(bytes);
            let pixels =
                (0..rows).step_by(step).flat_map(|row| (0..columns).step_by(step).map(move |column| (column, row)));
            pixels
                .map(|(column, row)| {
                    let [x, y] = view.gbuffer_pixel(column, row);
                    NEAR / depths[(y * row_bytes / 4 + x) as usize]
                })
                .collect()
        })
    }

    /// Tells the device where everything is.
    fn prepare(&self, frame: &Frame) -> Plan {
        let write = |buffer: &wgpu::Buffer, bytes: &[u8]| self.gpu.queue.write_buffer(buffer, 0, bytes);
        let colour = self.colour.view.uniform(&frame.colour);
        let infrared = self.infrared.view.uniform(&frame.infrared);
        let world_from_projector = frame.infrared.sweep.middle() * self.infrared_from_projector;
        let turned = Projector { toe_in: self.projector.toe_in + frame.projector_turn, ..self.projector };
        let (focal, edges) = (self.map_shape.focal, self.map_shape.edges());
        let centre = edges / 2.0 + Vec2::new(turned.toe_in * focal, 0.0);
        let clip_from_projector = clip_from_camera(Vec2::splat(focal), centre, edges, NEAR);
        let projector = (clip_from_projector.as_dmat4() * DMat4::from(world_from_projector.inverse())).as_mat4();
        write(&self.projector_clip, bytemuck::bytes_of(&projector));
        write(&self.projector_uniform, bytemuck::bytes_of(&turned));
        write(&self.colour.uniform, bytemuck::bytes_of(&colour));
        write(&self.colour.sensor_uniform, bytemuck::bytes_of(&frame.colour_sensor));
        write(&self.infrared.uniform, bytemuck::bytes_of(&infrared));
        write(&self.infrared.sensor_uniform, bytemuck::bytes_of(&frame.infrared_sensor));
        for (camera, frame) in [(&self.colour, &frame.colour), (&self.infrared, &frame.infrared)] {
            if let Some(daylight) = self.daylight.uniform(&frame.sweep.middle()) {
                write(&camera.daylight_uniform, bytemuck::bytes_of(&daylight));
            }
        }
        Plan {
            light: self.daylight.variant(),
            projector_clip: projector,
            colour_clip: colour.clip_from_world,
            infrared_clip: infrared.clip_from_world,
            colour_taps: self.colour.view.taps(&frame.colour),
            infrared_taps: self.infrared.view.taps(&frame.infrared),
        }
    }

    #[cfg(test)]
    pub(crate) fn forget_occluders(&mut self) {
        self.scene.forget_occluders();
    }

    /// Triangles drawn for each view: projector, colour, infrared.
    pub fn triangles_drawn(&self, frame: &Frame) -> [usize; 3] {
        let plan = self.prepare(frame);
        [plan.projector_clip, plan.colour_clip, plan.infrared_clip].map(|clip| self.scene.triangles_drawn(&clip))
    }

    fn encode(&self, stage: usize, encoder: &mut wgpu::CommandEncoder, plan: &Plan) {
        match stage {
            0 => self.projector_map.encode(encoder, &self.scene, &plan.projector_clip),
            1 => self.infrared.gbuffer.encode(encoder, &self.scene, &plan.infrared_clip),
            2 => self.infrared.light.encode(encoder, plan.light),
            3 => self.infrared.sensor.encode(encoder, plan.infrared_taps),
            4 => self.infrared_readback.encode(encoder, &self.infrared.image),
            5 => self.colour.gbuffer.encode(encoder, &self.scene, &plan.colour_clip),
            6 => self.colour.light.encode(encoder, plan.light),
            7 => self.colour.sensor.encode(encoder, plan.colour_taps),
            _ => self.colour_readback.encode(encoder, &self.colour.image),
        }
    }
}
