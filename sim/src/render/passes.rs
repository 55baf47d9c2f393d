//! What a camera's image takes: its passes, their textures and buffers, and what connects them.

use glam::{Vec2, Vec4};
use half::f16;
use sunblind_estimator::camera::CameraModel;
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};

use super::daylight::Daylight;
use super::device::Device;
use super::raster::{DepthMap, GBuffer, Target, uniform_buffer};
use super::scene::Scene;
use super::stage::{Binding, Stage};
use super::uniforms::{self, ColourSensor, InfraredSensor};
use super::view::{TAPS, View};

/// The projector's map of depth.
#[derive(Clone, Copy)]
pub(super) struct MapShape {
    /// Pixels.
    pub size: [u32; 2],
    pub focal: f32,
}

impl MapShape {
    /// For the camera that sees the pattern: covers the whole pattern and has about the camera's resolution.
    pub fn of(infrared: &CameraModel) -> Self {
        let scaled = |at_640: u32| at_640 * infrared.width as u32 / 640;
        Self { size: [752, 576].map(scaled), focal: scaled(580) as f32 }
    }

    /// Its size.
    pub fn edges(&self) -> Vec2 {
        Vec2::from(self.size.map(|size| size as f32))
    }
}

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

/// One camera's passes.
pub(super) struct CameraPasses {
    pub view: View,
    pub uniform: wgpu::Buffer,
    pub sensor_uniform: wgpu::Buffer,
    pub daylight_uniform: wgpu::Buffer,
    pub gbuffer: GBuffer,
    pub light: Stage,
    pub sensor: Stage,
    pub image: wgpu::Buffer,
}

/// How textures are read.
pub(super) struct Samplers {
    repeating: wgpu::Sampler,
    bilinear: wgpu::Sampler,
    nearest: wgpu::Sampler,
}

impl Samplers {
    pub fn new(gpu: &Device) -> Self {
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

/// Where each pixel of a sensor looks.
fn directions_buffer(gpu: &Device, view: &View) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&BufferInitDescriptor {
        label: Some("directions"),
        contents: bytemuck::cast_slice(&view.directions()),
        usage: wgpu::BufferUsages::STORAGE,
    })
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

/// From the world to the colour camera's image.
pub(super) fn colour_passes(
    gpu: &Device,
    optics: &Optics<'_>,
    scene: &Scene,
    samplers: &Samplers,
    daylight: &Daylight,
) -> CameraPasses {
    let view = View::new(optics.colour);
    let size = view.gbuffer_size();
    let uniform = uniform_buffer(gpu, size_of::<uniforms::Camera>());
    let sensor_uniform = uniform_buffer(gpu, size_of::<ColourSensor>());
    let gbuffer = GBuffer::new(gpu, size, &uniform, "colour");
    let daylight_uniform = uniform_buffer(gpu, size_of::<uniforms::Daylight>());
    let luminance = light_target(gpu, size);
    let directions = directions_buffer(gpu, &view);
    let image = image_buffer(gpu, &optics.colour);
    let light = [
        Binding::Uniform(&uniform),
        Binding::Integers(&gbuffer.surfaces.view),
        Binding::Depth(&gbuffer.depth.view),
        Binding::TextureArray(&scene.albedos),
        Binding::Linear(&samplers.repeating),
        Binding::Uniform(&daylight_uniform),
        Binding::Depth(&daylight.map.depth.view),
        Binding::Nearest(&samplers.nearest),
        Binding::Numbers(&scene.glosses),
        Binding::OutputTexture(&luminance.view),
    ];
    let sensor = [
        Binding::Uniform(&uniform),
        Binding::Uniform(&sensor_uniform),
        Binding::Input(&directions),
        Binding::Texture(&luminance.view),
        Binding::Linear(&samplers.bilinear),
        Binding::Output(&image),
    ];
    let quads = [optics.colour.width, optics.colour.height].map(|size| size.div_ceil(2) as u32);
    let light = light_stage(gpu, "colour_light", in_pairs(size), &light, daylight);
    let sensor = sensor_stage(gpu, "colour_sensor", quads, &sensor);
    CameraPasses { view, uniform, sensor_uniform, daylight_uniform, gbuffer, light, sensor, image }
}

/// From the world, and what the projector reaches of it, to the infrared camera's image.
pub(super) fn infrared_passes(
    gpu: &Device,
    optics: &Optics<'_>,
    scene: &Scene,
    samplers: &Samplers,
    projector_map: &DepthMap,
    projector: &wgpu::Buffer,
    daylight: &Daylight,
) -> CameraPasses {
    let view = View::new(optics.infrared);
    let size = view.gbuffer_size();
    let uniform = uniform_buffer(gpu, size_of::<uniforms::Camera>());
    let sensor_uniform = uniform_buffer(gpu, size_of::<InfraredSensor>());
    let gbuffer = GBuffer::new(gpu, size, &uniform, "infrared");
    let daylight_uniform = uniform_buffer(gpu, size_of::<uniforms::Daylight>());
    let radiance = light_target(gpu, size);
    let directions = directions_buffer(gpu, &view);
    let image = image_buffer(gpu, &optics.infrared);
    let tile = tile_texture(gpu, &optics.projector);
    let light = [
        Binding::Uniform(&uniform),
        Binding::Integers(&gbuffer.surfaces.view),
        Binding::Depth(&gbuffer.depth.view),
        Binding::TextureArray(&scene.albedos),
        Binding::Linear(&samplers.repeating),
        Binding::Uniform(projector),
        Binding::Depth(&projector_map.depth.view),
        Binding::Nearest(&samplers.nearest),
        Binding::Uniform(&daylight_uniform),
        Binding::Depth(&daylight.map.depth.view),
        Binding::Numbers(&scene.glosses),
        Binding::OutputTexture(&radiance.view),
    ];
    let sensor = [
        Binding::Uniform(&uniform),
        Binding::Uniform(&sensor_uniform),
        Binding::Uniform(projector),
        Binding::Input(&directions),
        Binding::Texture(&radiance.view),
        Binding::Depth(&gbuffer.depth.view),
        Binding::Linear(&samplers.bilinear),
        Binding::Nearest(&samplers.nearest),
        Binding::Texture(&tile),
        Binding::Linear(&samplers.repeating),
        Binding::Output(&image),
    ];
    let pixels = [optics.infrared.width as u32, optics.infrared.height as u32];
    let light = light_stage(gpu, "infrared_light", in_pairs(size), &light, daylight);
    let sensor = sensor_stage(gpu, "infrared_sensor", in_pairs(pixels), &sensor);
    CameraPasses { view, uniform, sensor_uniform, daylight_uniform, gbuffer, light, sensor, image }
}

/// How often a shader runs across and down that works on two rows at a time.
fn in_pairs([width, height]: [u32; 2]) -> [u32; 2] {
    [width, height.div_ceil(2)]
}

/// A light's shader, compiled for every [variant](Daylight::variant) of the daylight that the world can have.
fn light_stage(gpu: &Device, name: &str, size: [u32; 2], bindings: &[Binding<'_>], daylight: &Daylight) -> Stage {
    let variants: Vec<[(&str, f64); 2]> = daylight.variants().map(|[sky, sun]| [("SKY", sky), ("SUN", sun)]).collect();
    Stage::with_variants(
        gpu,
        name,
        size,
        bindings,
        &variants.iter().map(|variant| variant.as_slice()).collect::<Vec<_>>(),
    )
}

/// A sensor's shader, compiled for every number of instants that its exposure may be made of.
fn sensor_stage(gpu: &Device, name: &str, size: [u32; 2], bindings: &[Binding<'_>]) -> Stage {
    let variants = TAPS.map(|taps| [("TAPS", f64::from(taps))]);
    Stage::with_variants(gpu, name, size, bindings, &variants.each_ref().map(|variant| variant.as_slice()))
}

/// What shaders are told of the projector.
pub(super) fn projector_uniform(projector: &ProjectorLight<'_>, map: MapShape) -> uniforms::Projector {
    let [across, down] = projector.tile_grid.map(|positions| positions as f32);
    uniforms::Projector {
        baseline: projector.baseline,
        toe_in: projector.toe_in,
        pincushion: projector.pincushion,
        peak_irradiance: projector.peak_irradiance,
        tiles: (projector.pitch * Vec2::new(across, down)).recip(),
        map: map.focal / map.edges(),
        tile_brightness: projector.tile_brightness.map(|[left, middle, right]| Vec4::new(left, middle, right, 0.0)),
    }
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
