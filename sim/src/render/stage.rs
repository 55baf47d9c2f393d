//! A compute shader with all that it reads and writes.

use super::device::Device;
use super::shader;

/// One thing a shader is bound to, in the order of its `@binding`s.
pub(super) enum Binding<'a> {
    /// `var<uniform>`.
    Uniform(&'a wgpu::Buffer),
    /// `var<storage, read_write>`.
    Output(&'a wgpu::Buffer),
    /// `var<storage, read>`.
    Input(&'a wgpu::Buffer),
    /// `texture_2d<f32>` of a format that can be filtered.
    Texture(&'a wgpu::TextureView),
    /// `texture_2d<f32>` that is only loaded from.
    Numbers(&'a wgpu::TextureView),
    /// `texture_2d<u32>`.
    Integers(&'a wgpu::TextureView),
    /// `texture_2d_array<f32>`.
    TextureArray(&'a wgpu::TextureView),
    /// `texture_depth_2d`.
    Depth(&'a wgpu::TextureView),
    /// `texture_storage_2d<rgba16float, write>`.
    OutputTexture(&'a wgpu::TextureView),
    /// `sampler` that interpolates.
    Linear(&'a wgpu::Sampler),
    /// `sampler` that does not.
    Nearest(&'a wgpu::Sampler),
}

impl<'a> Binding<'a> {
    fn kind(&self) -> wgpu::BindingType {
        let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
        let texture = |sample_type, view_dimension| wgpu::BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        let float = wgpu::TextureSampleType::Float { filterable: true };
        let (flat, layered) = (wgpu::TextureViewDimension::D2, wgpu::TextureViewDimension::D2Array);
        match self {
            Self::Uniform(_) => buffer(wgpu::BufferBindingType::Uniform),
            Self::Input(_) => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
            Self::Output(_) => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
            Self::Texture(_) => texture(float, flat),
            Self::Numbers(_) => texture(wgpu::TextureSampleType::Float { filterable: false }, flat),
            Self::Integers(_) => texture(wgpu::TextureSampleType::Uint, flat),
            Self::TextureArray(_) => texture(float, layered),
            Self::Depth(_) => texture(wgpu::TextureSampleType::Depth, flat),
            Self::OutputTexture(_) => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: wgpu::TextureFormat::Rgba16Float,
                view_dimension: flat,
            },
            Self::Linear(_) => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            Self::Nearest(_) => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering),
        }
    }

    fn resource(&self) -> wgpu::BindingResource<'a> {
        match self {
            Self::Uniform(buffer) | Self::Input(buffer) | Self::Output(buffer) => buffer.as_entire_binding(),
            Self::Texture(view)
            | Self::Numbers(view)
            | Self::Integers(view)
            | Self::TextureArray(view)
            | Self::Depth(view)
            | Self::OutputTexture(view) => wgpu::BindingResource::TextureView(view),
            Self::Linear(sampler) | Self::Nearest(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

/// Makes the layout of some bindings, and binds them.
pub(super) fn bind(
    gpu: &Device,
    visibility: wgpu::ShaderStages,
    bindings: &[Binding<'_>],
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let entries: Vec<_> = (0..)
        .zip(bindings)
        .map(|(binding, bound)| wgpu::BindGroupLayoutEntry { binding, visibility, ty: bound.kind(), count: None })
        .collect();
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries };
    let layout = gpu.device.create_bind_group_layout(&descriptor);
    let entries: Vec<_> = (0..)
        .zip(bindings)
        .map(|(binding, bound)| wgpu::BindGroupEntry { binding, resource: bound.resource() })
        .collect();
    let descriptor = wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries };
    let group = gpu.device.create_bind_group(&descriptor);
    (layout, group)
}

/// A compute shader, bound, and how often it runs across and down.
pub(super) struct Stage {
    /// One for each value of the shader's constant.
    pipelines: Vec<wgpu::ComputePipeline>,
    group: wgpu::BindGroup,
    size: [u32; 2],
}

/// The workgroups' width in every compute shader here; they are one pixel high.
const WORKGROUP: u32 = 64;

impl Stage {
    /// Compiles the shader once for each set of values of its `override` constants. Its entry point is called as its file
    /// is.
    pub fn with_variants(
        gpu: &Device,
        name: &str,
        size: [u32; 2],
        bindings: &[Binding<'_>],
        variants: &[&[(&str, f64)]],
    ) -> Self {
        let (layout, group) = bind(gpu, wgpu::ShaderStages::COMPUTE, bindings);
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = shader::module(&gpu.device, name);
        let pipeline = |constants: &&[(&str, f64)]| {
            gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: Some(&layout),
                module: &module,
                entry_point: Some(name),
                compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
                cache: None,
            })
        };
        Self { pipelines: variants.iter().map(pipeline).collect(), group, size }
    }

    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, variant: usize) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipelines[variant]);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(self.size[0].div_ceil(WORKGROUP), self.size[1], 1);
    }
}
