//! The passes of a frame, in order, and what comes out of them.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use glam::{DAffine3, DMat4, DVec3, Mat4, Vec2, Vec4};
use half::f16;
use sunblind_estimator::camera::CameraModel;
use wgpu::util::{DeviceExt, TextureDataOrder};

use super::device::{Adapter, Device, RenderError};
use super::raster::{GBuffer, ProjectorMap, Target, uniform_buffer};
use super::readback::Readback;
use super::scene::Scene;
use super::stage::{Binding, Stage};
use super::uniforms;
use super::view::{NEAR, TAPS, View, clip_from_camera};
use super::{CameraFrame, ColourSensor, InfraredSensor};
use crate::world::World;

/// The projector's map of depth: pixels, and its focal length. Covers the whole pattern and has about the infrared
/// camera's resolution.
const MAP_SIZE: [u32; 2] = [752, 576];
const MAP_FOCAL: f32 = 580.0;

/// The optics of a device, which do not change.
pub struct Optics<'a> {
    /// The colour camera.
    pub colour: CameraModel,
    /// The infrared camera.
    pub infrared: CameraModel,
    /// The projector beside it.
    pub projector: ProjectorLight<'a>,
}

/// A dot projector: a pattern of 3×3 equal tiles behind a lens. Tangents are x/z in its frame, which is the infrared
/// camera's moved along x.
pub struct ProjectorLight<'a> {
    /// Along x, metres.
    pub baseline: f32,
    /// Tangent by which the pattern's middle points towards the camera.
    pub toe_in: f32,
    /// Tangent from one grid position to the next.
    pub pitch: f32,
    /// Of the lens, on r².
    pub pincushion: f32,
    /// Of a dot's peak on a facing plane at 1 m, W/m².
    pub peak_irradiance: f32,
    /// Grid positions of a tile, across and down.
    pub tile_grid: [usize; 2],
    /// The tiles' brightness, row by row.
    pub tile_brightness: [[f32; 3]; 3],
    /// A tile's light, 1 at a dot's peak: samples across, down, and each one's value.
    pub tile_image: ([usize; 2], &'a [f32]),
}

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
}

/// What the sensors saw, row after row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Images {
    /// R, G, B, in sRGB.
    pub colour: Vec<[u8; 3]>,
    /// 10 bits.
    pub infrared: Vec<u16>,
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

/// One camera's passes.
struct CameraPasses {
    view: View,
    uniform: wgpu::Buffer,
    sensor_uniform: wgpu::Buffer,
    gbuffer: GBuffer,
    light: Stage,
    sensor: Stage,
    image: wgpu::Buffer,
}

/// A world, a device in it, and the graphics adapter that shows one the other.
pub struct Renderer {
    gpu: Device,
    scene: Scene,
    projector_map: ProjectorMap,
    projector_clip: wgpu::Buffer,
    infrared_from_projector: DAffine3,
    toe_in: f32,
    colour: CameraPasses,
    infrared: CameraPasses,
    readback: Readback,
}

/// What the stages of one frame need to know here: clip-space matrices (from the world) and numbers of instants.
struct Plan {
    projector_clip: Mat4,
    colour_clip: Mat4,
    infrared_clip: Mat4,
    colour_taps: usize,
    infrared_taps: usize,
}

const STAGES: [&str; 8] = [
    "projector map",
    "colour G-buffer",
    "infrared G-buffer",
    "colour light",
    "infrared light",
    "colour sensor",
    "infrared sensor",
    "readback",
];

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
        let projector_map = ProjectorMap::new(&gpu, MAP_SIZE, &projector_clip);
        let colour = colour_passes(&gpu, optics, &scene, &samplers);
        let infrared = infrared_passes(&gpu, optics, &scene, &samplers, &projector_map);
        let readback = Readback::new(&gpu, colour.image.size() + infrared.image.size());
        let along_baseline = DVec3::X * f64::from(optics.projector.baseline);
        Ok(Self {
            gpu,
            scene,
            projector_map,
            projector_clip,
            infrared_from_projector: DAffine3::from_translation(along_baseline),
            toe_in: optics.projector.toe_in,
            colour,
            infrared,
            readback,
        })
    }

    /// The adapter that renders.
    pub fn adapter(&self) -> &Adapter {
        &self.gpu.adapter
    }

    /// Takes both images.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn render(&mut self, frame: &Frame) -> Result<Images, RenderError> {
        let plan = self.prepare(frame);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        for stage in 0..STAGES.len() {
            self.encode(stage, &mut encoder, &plan);
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.read_images()
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
            self.gpu.queue.submit([encoder.finish()]);
            if index + 1 == STAGES.len() {
                self.read_images()?;
            } else {
                self.gpu.wait()?;
            }
            costs.push(StageCost { stage, cpu: cpu.elapsed(), wall: wall.elapsed() });
        }
        Ok(costs)
    }

    /// True depth (z, metres; infinite where there is nothing) of each pixel of the last frame's infrared image. For
    /// judging depth, never for making it.
    ///
    /// # Errors
    /// The adapter stopped working.
    pub fn true_depth(&self) -> Result<Vec<f32>, RenderError> {
        let view = &self.infrared.view;
        let [width, height] = view.gbuffer_size();
        let row_bytes = (16 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = Readback::new(&self.gpu, u64::from(row_bytes * height));
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row_bytes), rows_per_image: Some(height) };
        encoder.copy_texture_to_buffer(
            self.infrared.gbuffer.places.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: readback.buffer(), layout },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        self.gpu.queue.submit([encoder.finish()]);
        let (columns, rows) = view.model().size();
        readback.read(&self.gpu, |bytes| {
            let places: &[[f32; 4]] = bytemuck::cast_slice(bytes);
            (0..columns * rows)
                .map(|index| {
                    let [x, y] = view.gbuffer_pixel(index % columns, index / columns);
                    places[(y * row_bytes / 16 + x) as usize][2].recip()
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
        let size = Vec2::from(MAP_SIZE.map(|size| size as f32));
        let centre = size / 2.0 + Vec2::new(self.toe_in * MAP_FOCAL, 0.0);
        let clip_from_projector = clip_from_camera(Vec2::splat(MAP_FOCAL), centre, size, NEAR);
        let projector = (clip_from_projector.as_dmat4() * DMat4::from(world_from_projector.inverse())).as_mat4();
        write(&self.projector_clip, bytemuck::bytes_of(&projector));
        write(&self.colour.uniform, bytemuck::bytes_of(&colour));
        write(&self.colour.sensor_uniform, bytemuck::bytes_of(&frame.colour_sensor));
        write(&self.infrared.uniform, bytemuck::bytes_of(&infrared));
        write(&self.infrared.sensor_uniform, bytemuck::bytes_of(&frame.infrared_sensor));
        Plan {
            projector_clip: projector,
            colour_clip: colour.clip_from_world,
            infrared_clip: infrared.clip_from_world,
            colour_taps: self.colour.view.taps(&frame.colour),
            infrared_taps: self.infrared.view.taps(&frame.infrared),
        }
    }

    fn encode(&self, stage: usize, encoder: &mut wgpu::CommandEncoder, plan: &Plan) {
        match stage {
            0 => self.projector_map.encode(encoder, &self.scene, &plan.projector_clip),
            1 => self.colour.gbuffer.encode(encoder, &self.scene, &plan.colour_clip),
            2 => self.infrared.gbuffer.encode(encoder, &self.scene, &plan.infrared_clip),
            3 => self.colour.light.encode(encoder, 0),
            4 => self.infrared.light.encode(encoder, 0),
            5 => self.colour.sensor.encode(encoder, plan.colour_taps),
            6 => self.infrared.sensor.encode(encoder, plan.infrared_taps),
            _ => {
                let (colour, infrared) = (&self.colour.image, &self.infrared.image);
                encoder.copy_buffer_to_buffer(colour, 0, self.readback.buffer(), 0, colour.size());
                encoder.copy_buffer_to_buffer(infrared, 0, self.readback.buffer(), colour.size(), infrared.size());
            }
        }
    }

    fn read_images(&self) -> Result<Images, RenderError> {
        self.readback.read(&self.gpu, |bytes| {
            let (colour, infrared) = bytes.split_at(self.colour.image.size() as usize);
            let infrared: &[u32] = bytemuck::cast_slice(infrared);
            Images {
                colour: colour.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(),
                infrared: infrared.iter().map(|&number| number as u16).collect(),
            }
        })
    }
}

struct Samplers {
    repeating: wgpu::Sampler,
    bilinear: wgpu::Sampler,
    nearest: wgpu::Sampler,
}

impl Samplers {
    fn new(gpu: &Device) -> Self {
        let sampler = |address, filter| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u: address,
                address_mode_v: address,
                mag_filter: filter,
                min_filter: filter,
                ..Default::default()
            })
        };
        Self {
            repeating: sampler(wgpu::AddressMode::Repeat, wgpu::FilterMode::Linear),
            bilinear: sampler(wgpu::AddressMode::ClampToEdge, wgpu::FilterMode::Linear),
            nearest: sampler(wgpu::AddressMode::ClampToEdge, wgpu::FilterMode::Nearest),
        }
    }
}

/// Light as the pinhole sees it, between the two compute stages.
fn light_target(gpu: &Device, size: [u32; 2]) -> Target {
    Target::new(gpu, size, wgpu::TextureFormat::Rgba16Float, wgpu::TextureUsages::STORAGE_BINDING)
}

/// Four bytes for every pixel of a sensor.
fn image_buffer(gpu: &Device, model: &CameraModel) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("image"),
        size: 4 * (model.width * model.height) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

fn colour_passes(gpu: &Device, optics: &Optics<'_>, scene: &Scene, samplers: &Samplers) -> CameraPasses {
    let view = View::new(optics.colour);
    let size = view.gbuffer_size();
    let uniform = uniform_buffer(gpu, size_of::<uniforms::Camera>());
    let sensor_uniform = uniform_buffer(gpu, size_of::<ColourSensor>());
    let gbuffer = GBuffer::new(gpu, size, &uniform, "colour_vertex");
    let luminance = light_target(gpu, size);
    let image = image_buffer(gpu, &optics.colour);
    let light = [
        Binding::PreciseTexture(&gbuffer.places.view),
        Binding::Texture(&gbuffer.lights.view),
        Binding::TextureArray(&scene.albedos),
        Binding::Linear(&samplers.repeating),
        Binding::OutputTexture(&luminance.view),
    ];
    let sensor = [
        Binding::Uniform(&uniform),
        Binding::Uniform(&sensor_uniform),
        Binding::Texture(&luminance.view),
        Binding::Linear(&samplers.bilinear),
        Binding::Output(&image),
    ];
    let pixels = [optics.colour.width as u32, optics.colour.height as u32];
    let light = Stage::new(gpu, "colour_light", size, &light);
    let sensor = sensor_stage(gpu, "colour_sensor", pixels, &sensor);
    CameraPasses { view, uniform, sensor_uniform, gbuffer, light, sensor, image }
}

fn infrared_passes(
    gpu: &Device,
    optics: &Optics<'_>,
    scene: &Scene,
    samplers: &Samplers,
    projector_map: &ProjectorMap,
) -> CameraPasses {
    let view = View::new(optics.infrared);
    let size = view.gbuffer_size();
    let uniform = uniform_buffer(gpu, size_of::<uniforms::Camera>());
    let sensor_uniform = uniform_buffer(gpu, size_of::<InfraredSensor>());
    let gbuffer = GBuffer::new(gpu, size, &uniform, "infrared_vertex");
    let radiance = light_target(gpu, size);
    let image = image_buffer(gpu, &optics.infrared);
    let projector = projector_uniform(gpu, &optics.projector);
    let tile = tile_texture(gpu, &optics.projector);
    let light = [
        Binding::Uniform(&uniform),
        Binding::PreciseTexture(&gbuffer.places.view),
        Binding::Texture(&gbuffer.lights.view),
        Binding::TextureArray(&scene.albedos),
        Binding::Linear(&samplers.repeating),
        Binding::Uniform(&projector),
        Binding::Depth(&projector_map.depth.view),
        Binding::Nearest(&samplers.nearest),
        Binding::OutputTexture(&radiance.view),
    ];
    let sensor = [
        Binding::Uniform(&uniform),
        Binding::Uniform(&sensor_uniform),
        Binding::Uniform(&projector),
        Binding::Texture(&radiance.view),
        Binding::PreciseTexture(&gbuffer.places.view),
        Binding::Linear(&samplers.bilinear),
        Binding::Nearest(&samplers.nearest),
        Binding::Texture(&tile),
        Binding::Linear(&samplers.repeating),
        Binding::Output(&image),
    ];
    let pixels = [optics.infrared.width as u32, optics.infrared.height as u32];
    let light = Stage::new(gpu, "infrared_light", size, &light);
    let sensor = sensor_stage(gpu, "infrared_sensor", pixels, &sensor);
    CameraPasses { view, uniform, sensor_uniform, gbuffer, light, sensor, image }
}

/// A sensor's shader, compiled for every number of instants that its exposure may be made of.
fn sensor_stage(gpu: &Device, name: &str, size: [u32; 2], bindings: &[Binding<'_>]) -> Stage {
    let variants = TAPS.map(|taps| [("TAPS", f64::from(taps))]);
    Stage::with_variants(gpu, name, size, bindings, &variants.each_ref().map(|variant| variant.as_slice()))
}

fn projector_uniform(gpu: &Device, projector: &ProjectorLight<'_>) -> wgpu::Buffer {
    let uniform = uniforms::Projector {
        baseline: projector.baseline,
        toe_in: projector.toe_in,
        pitch: projector.pitch,
        pincushion: projector.pincushion,
        peak_irradiance: projector.peak_irradiance,
        map_focal: MAP_FOCAL,
        map_size: Vec2::from(MAP_SIZE.map(|size| size as f32)),
        map_near: NEAR,
        tile_width: projector.tile_grid[0] as f32,
        tile_height: projector.tile_grid[1] as f32,
        padding: 0.0,
        tile_brightness: projector.tile_brightness.map(|[left, middle, right]| Vec4::new(left, middle, right, 0.0)),
    };
    let buffer = uniform_buffer(gpu, size_of::<uniforms::Projector>());
    gpu.queue.write_buffer(&buffer, 0, bytemuck::bytes_of(&uniform));
    buffer
}

fn tile_texture(gpu: &Device, projector: &ProjectorLight<'_>) -> wgpu::TextureView {
    let ([width, height], samples) = projector.tile_image;
    // Half floats: every device can filter them.
    let halves: Vec<u16> = samples.iter().map(|&sample| f16::from_f32(sample).to_bits()).collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("tile"),
        size: wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let bytes = bytemuck::cast_slice(&halves);
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, bytes);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
