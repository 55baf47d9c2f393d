//! The world on the graphics device: geometry, albedos, and which parts of it a view shows.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::bounds::{Bounds, frustum};
use super::device::{Device, RenderError};
use super::occluder::{Occluder, Shadow, eye};
use super::texture::{albedo_array, gloss_row};
use crate::light::{Bands, LightState, each};
use crate::world::transfer::{Transfer, Weights};
use crate::world::{Mesh, World};

/// The geometry and albedos of a world.
pub(super) struct Scene {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    irradiances: Irradiances,
    indices: wgpu::Buffer,
    pub albedos: wgpu::TextureView,
    pub glosses: wgpu::TextureView,
    parts: Vec<Part>,
    occluders: Vec<Occluder>,
}

/// An object's share of the buffers, or a piece of it.
struct Part {
    bounds: Bounds,
    indices: Range<u32>,
    first_vertex: i32,
}

/// Parts with more triangles, and longer (metres), are divided. Guesses: a draw costs about what some dozen triangles do.
const FEW_TRIANGLES: usize = 96;
const LONG: f32 = 1.5;

/// What the vertex shader reads besides the position.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Attributes {
    normal: [i16; 4],
    uv: [f32; 2],
    material: u32,
}

const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
const ATTRIBUTES: [wgpu::VertexAttribute; 3] = wgpu::vertex_attr_array![1 => Snorm16x4, 2 => Float32x2, 4 => Uint32];
const IRRADIANCE: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![3 => Float32x4];

/// The light on the vertices.
struct Irradiances {
    buffer: wgpu::Buffer,
    /// What is there whatever shines.
    constant: Vec<Bands>,
    transfer: Arc<Transfer>,
    /// What the buffer holds.
    weights: Weights,
}

impl Scene {
    /// Layouts of the vertex buffers; the first is all that a depth map needs.
    pub fn vertex_buffers() -> [Option<wgpu::VertexBufferLayout<'static>>; 3] {
        let layout = |array_stride, attributes| {
            Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
        };
        let attributes = layout(size_of::<Attributes>() as u64, &ATTRIBUTES);
        [layout(12, &POSITION), attributes, layout(size_of::<Bands>() as u64, &IRRADIANCE)]
    }

    pub fn upload(gpu: &Device, world: &World) -> Result<Self, RenderError> {
        let mut geometry = Geometry::default();
        for object in &world.objects {
            geometry.add(&object.mesh, object.material as u32);
        }
        let buffer = |label, contents: &[u8], usage| {
            // An empty world still needs buffers.
            let contents = if contents.is_empty() { &[0; 64] } else { contents };
            gpu.device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let weights = world.transfer.weights(&LightState::default());
        let light = with(&geometry.irradiances, &world.transfer.irradiance(&weights));
        let irradiances = Irradiances {
            buffer: buffer(
                "irradiances",
                bytemuck::cast_slice(&light),
                wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            ),
            constant: geometry.irradiances,
            transfer: Arc::clone(&world.transfer),
            weights,
        };
        Ok(Self {
            positions: buffer("positions", bytemuck::cast_slice(&geometry.positions), wgpu::BufferUsages::VERTEX),
            attributes: buffer("attributes", bytemuck::cast_slice(&geometry.attributes), wgpu::BufferUsages::VERTEX),
            irradiances,
            indices: buffer("indices", bytemuck::cast_slice(&geometry.indices), wgpu::BufferUsages::INDEX),
            albedos: albedo_array(gpu, &world.materials)?,
            glosses: gloss_row(gpu, &world.materials),
            parts: geometry.parts,
            occluders: world.objects.iter().flat_map(|object| Occluder::all_of(&object.mesh)).collect(),
        })
    }

    /// Adds up the light on the vertices anew, if it differs.
    pub fn illuminate(&mut self, gpu: &Device, light: &LightState) {
        let Irradiances { buffer, constant, transfer, weights } = &mut self.irradiances;
        let wanted = transfer.weights(light);
        if wanted != *weights {
            let light = with(constant, &transfer.irradiance(&wanted));
            gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(&light));
            *weights = wanted;
        }
    }

    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        let corners = self.parts.iter().flat_map(|part| [part.bounds.lowest, part.bounds.highest]);
        Bounds::of(corners.filter(|corner| corner.is_finite()))
    }

    /// What a view may show, near things first.
    fn seen(&self, clip_from_world: &Mat4) -> impl Iterator<Item = &Part> {
        let planes = frustum(clip_from_world);
        let in_view = |bounds: &Bounds| planes.iter().all(|plane| bounds.reaches(plane));
        let eye = eye(clip_from_world);
        let shadows: Vec<Shadow> = (self.occluders.iter())
            .filter(|occluder| in_view(&occluder.bounds()))
            .filter_map(|occluder| occluder.shadow(eye?))
            .collect();
        let hidden = |bounds: &Bounds| shadows.iter().any(|shadow| shadow.hides(bounds));
        let mut seen: Vec<(f32, &Part)> = (self.parts.iter())
            .filter(|part| in_view(&part.bounds) && !hidden(&part.bounds))
            .map(|part| (clip_from_world.mul_vec4(part.bounds.middle().extend(1.0)).w, part))
            .collect();
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        seen.into_iter().map(|(_, part)| part)
    }

    /// How many triangles a view has drawn.
    pub fn triangles_drawn(&self, clip_from_world: &Mat4) -> usize {
        self.seen(clip_from_world).map(|part| part.indices.len() / 3).sum()
    }

    /// Draws what a view may show, near things first, so that what they hide costs little.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, clip_from_world: &Mat4) {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        pass.set_vertex_buffer(2, self.irradiances.buffer.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for part in self.seen(clip_from_world) {
            pass.draw_indexed(part.indices.clone(), part.first_vertex, 0..1);
        }
    }
}

/// What is there whatever shines and what the sources bring; either may be missing.
fn with(constant: &[Bands], light: &[Bands]) -> Vec<Bands> {
    if light.len() != constant.len() {
        return constant.to_vec();
    }
    constant.iter().zip(light).map(|(constant, light)| each(|band| constant[band] + light[band])).collect()
}

#[derive(Default)]
struct Geometry {
    positions: Vec<[f32; 3]>,
    attributes: Vec<Attributes>,
    irradiances: Vec<Bands>,
    indices: Vec<[u32; 3]>,
    parts: Vec<Part>,
}

impl Geometry {
    fn add(&mut self, mesh: &Mesh, material: u32) {
        let first_vertex = self.positions.len() as i32;
        self.positions.extend_from_slice(&mesh.positions);
        self.attributes.extend((0..mesh.positions.len()).map(|vertex| {
            let [x, y, z] = mesh.normals[vertex].map(|value| (value * 32767.0).round() as i16);
            Attributes { normal: [x, y, z, 0], uv: mesh.uvs[vertex], material }
        }));
        let constant = |vertex| mesh.irradiance.get(vertex).copied().unwrap_or_default();
        self.irradiances.extend((0..mesh.positions.len()).map(constant));
        self.divide(mesh, &mut mesh.triangles.clone(), first_vertex);
    }

    /// Makes parts of triangles: long things in pieces, so that a view can leave out most of a floor.
    fn divide(&mut self, mesh: &Mesh, triangles: &mut [[u32; 3]], first_vertex: i32) {
        let corners = |triangle: &[u32; 3]| mesh.corners(*triangle);
        let bounds = Bounds::of(triangles.iter().flat_map(corners));
        let longest = bounds.size().max_position();
        if triangles.len() > FEW_TRIANGLES && bounds.size()[longest] > LONG {
            let middle = |triangle: &[u32; 3]| corners(triangle).into_iter().sum::<Vec3>()[longest];
            triangles.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
            let (low, high) = triangles.split_at_mut(triangles.len() / 2);
            self.divide(mesh, low, first_vertex);
            self.divide(mesh, high, first_vertex);
            return;
        }
        let first_index = 3 * self.indices.len() as u32;
        self.indices.extend_from_slice(triangles);
        let indices = first_index..3 * self.indices.len() as u32;
        self.parts.push(Part { bounds, indices, first_vertex });
    }
}

#[cfg(test)]
impl Scene {
    /// Has everything in view drawn, hidden or not.
    pub fn forget_occluders(&mut self) {
        self.occluders.clear();
    }
}
