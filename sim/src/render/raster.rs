//! Passes that turn triangles into pixels: a camera's G-buffer, and a light's map of depth.

use glam::Mat4;

use super::device::Device;
use super::scene::Scene;
use super::shader;
use super::stage::{Binding, bind};

const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// What it holds: `shaders/lib/surface.wgsl`.
const SURFACE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// Something drawn into.
pub(super) struct Target {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Target {
    pub fn new(gpu: &Device, size: [u32; 2], format: wgpu::TextureFormat, usage: wgpu::TextureUsages) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: usage | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }
}

/// A uniform that a shader reads and every frame sets.
pub(super) fn uniform_buffer(gpu: &Device, size: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: size as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// What a camera sees, before light.
pub(super) struct GBuffer {
    /// Undefined where depth is 0.
    pub surfaces: Target,
    /// near/z; 0: nothing there.
    pub depth: Target,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl GBuffer {
    /// `band`: which of the shader's two variants, colour or infrared.
    pub fn new(gpu: &Device, size: [u32; 2], camera: &wgpu::Buffer, band: &str) -> Self {
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let (layout, group) = bind(gpu, wgpu::ShaderStages::VERTEX, &[Binding::Uniform(camera)]);
        let shader = shader::module(&gpu.device, "gbuffer");
        let fragment = wgpu::FragmentState {
            module: &shader,
            entry_point: Some(&format!("{band}_surface")),
            compilation_options: Default::default(),
            targets: &[Some(SURFACE.into())],
        };
        Self {
            surfaces: Target::new(gpu, size, SURFACE, attachment),
            depth: Target::new(gpu, size, DEPTH, attachment | wgpu::TextureUsages::COPY_SRC),
            pipeline: pipeline(
                gpu,
                &layout,
                &shader,
                &format!("{band}_vertex"),
                Some(fragment),
                Default::default(),
                Some(wgpu::Face::Back),
            ),
            group,
        }
    }

    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene, clip_from_world: &Mat4) {
        let surfaces = Some(wgpu::RenderPassColorAttachment {
            view: &self.surfaces.view,
            depth_slice: None,
            resolve_target: None,
            // Where there is nothing, the last frame's surfaces stay, and depth says so: clearing 16 bytes a pixel costs.
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
        });
        draw(encoder, &[surfaces], &self.depth, &self.pipeline, &self.group, scene, clip_from_world);
    }
}

/// How far a light reaches: depth alone, seen from it.
pub(super) struct DepthMap {
    pub depth: Target,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl DepthMap {
    /// `slope_bias`: how much further away a lit surface may lie than the map says, in slopes of the map's pixels.
    /// `both_sides`: whether surfaces cast shadows that turn their back to the light.
    pub fn new(
        gpu: &Device,
        size: [u32; 2],
        clip_from_world: &wgpu::Buffer,
        slope_bias: f32,
        both_sides: bool,
    ) -> Self {
        let (layout, group) = bind(gpu, wgpu::ShaderStages::VERTEX, &[Binding::Uniform(clip_from_world)]);
        let shader = shader::module(&gpu.device, "depth_map");
        let bias = wgpu::DepthBiasState { constant: 0, slope_scale: slope_bias, clamp: 0.0 };
        let cull = if both_sides { None } else { Some(wgpu::Face::Back) };
        Self {
            depth: Target::new(gpu, size, DEPTH, wgpu::TextureUsages::RENDER_ATTACHMENT),
            pipeline: pipeline(gpu, &layout, &shader, "depth_vertex", None, bias, cull),
            group,
        }
    }

    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene, clip_from_world: &Mat4) {
        draw(encoder, &[], &self.depth, &self.pipeline, &self.group, scene, clip_from_world);
    }
}

fn pipeline(
    gpu: &Device,
    layout: &wgpu::BindGroupLayout,
    shader: &wgpu::ShaderModule,
    vertex: &str,
    fragment: Option<wgpu::FragmentState<'_>>,
    bias: wgpu::DepthBiasState,
    cull_mode: Option<wgpu::Face>,
) -> wgpu::RenderPipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(vertex),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let buffers = Scene::vertex_buffers();
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(vertex),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            // A depth map needs positions alone.
            buffers: if fragment.is_some() { &buffers } else { &buffers[..1] },
        },
        primitive: wgpu::PrimitiveState { cull_mode, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias,
        }),
        multisample: Default::default(),
        fragment,
        multiview_mask: None,
        cache: None,
    })
}

fn draw(
    encoder: &mut wgpu::CommandEncoder,
    color_attachments: &[Option<wgpu::RenderPassColorAttachment<'_>>],
    depth: &Target,
    pipeline: &wgpu::RenderPipeline,
    group: &wgpu::BindGroup,
    scene: &Scene,
    clip_from_world: &Mat4,
) {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments,
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth.view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    scene.draw(&mut pass, clip_from_world);
}
