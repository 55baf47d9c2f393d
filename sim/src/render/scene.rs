//! The world on the graphics device: geometry, albedos, and which parts of it a view shows.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4, Vec4Swizzles};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::device::{Device, RenderError};
use super::texture::albedo_array;
use crate::world::{Mesh, World};

/// The geometry and albedos of a world.
pub(super) struct Scene {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    indices: wgpu::Buffer,
    pub albedos: wgpu::TextureView,
    parts: Vec<Part>,
}

/// One object's share of the buffers.
struct Part {
    bounds: Bounds,
    indices: Range<u32>,
    first_vertex: i32,
}

/// What the vertex shader reads besides the position.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Attributes {
    normal: [i8; 4],
    uv: [f32; 2],
    irradiance: [f32; 4],
    material: u32,
}

const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![1 => Snorm8x4, 2 => Float32x2, 3 => Float32x4, 4 => Uint32];

impl Scene {
    /// Layouts of the two vertex buffers; the first is all that a depth map needs.
    pub fn vertex_buffers() -> [Option<wgpu::VertexBufferLayout<'static>>; 2] {
        let layout = |array_stride, attributes| {
            Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
        };
        [layout(12, &POSITION), layout(size_of::<Attributes>() as u64, &ATTRIBUTES)]
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
        Ok(Self {
            positions: buffer("positions", bytemuck::cast_slice(&geometry.positions), wgpu::BufferUsages::VERTEX),
            attributes: buffer("attributes", bytemuck::cast_slice(&geometry.attributes), wgpu::BufferUsages::VERTEX),
            indices: buffer("indices", bytemuck::cast_slice(&geometry.indices), wgpu::BufferUsages::INDEX),
            albedos: albedo_array(gpu, &world.materials)?,
            parts: geometry.parts,
        })
    }

    /// Draws what a view may show, near things first, so that what they hide costs little.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, clip_from_world: &Mat4) {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        let planes = frustum(clip_from_world);
        let mut seen: Vec<(f32, &Part)> = (self.parts.iter())
            .filter(|part| planes.iter().all(|plane| part.bounds.reaches(plane)))
            .map(|part| (clip_from_world.mul_vec4(part.bounds.middle().extend(1.0)).w, part))
            .collect();
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, part) in seen {
            pass.draw_indexed(part.indices.clone(), part.first_vertex, 0..1);
        }
    }
}

/// A box along the world's axes, metres.
struct Bounds {
    lowest: Vec3,
    highest: Vec3,
}

impl Bounds {
    fn of(positions: &[[f32; 3]]) -> Self {
        let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (lowest, highest) = (positions.iter().map(|&position| Vec3::from(position)))
            .fold(none, |(lowest, highest), position| (lowest.min(position), highest.max(position)));
        Self { lowest, highest }
    }

    fn middle(&self) -> Vec3 {
        (self.lowest + self.highest) / 2.0
    }

    /// Whether some of it lies on a plane's inner side.
    fn reaches(&self, plane: &Vec4) -> bool {
        let furthest = Vec3::select(plane.xyz().cmpge(Vec3::ZERO), self.highest, self.lowest);
        plane.xyz().dot(furthest) + plane.w >= 0.0
    }
}

/// The planes a view ends at: left, right, bottom, top, near. Points inside have positive products with all.
fn frustum(clip_from_world: &Mat4) -> [Vec4; 5] {
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
    [w + x, w - x, w + y, w - y, w - z]
}

#[derive(Default)]
struct Geometry {
    positions: Vec<[f32; 3]>,
    attributes: Vec<Attributes>,
    indices: Vec<[u32; 3]>,
    parts: Vec<Part>,
}

impl Geometry {
    fn add(&mut self, mesh: &Mesh, material: u32) {
        let first_index = 3 * self.indices.len() as u32;
        let first_vertex = self.positions.len() as i32;
        self.positions.extend_from_slice(&mesh.positions);
        self.attributes.extend((0..mesh.positions.len()).map(|vertex| {
            let [x, y, z] = mesh.normals[vertex].map(|value| (value * 127.0).round() as i8);
            // Not baked yet: dark.
            let irradiance = mesh.irradiance.get(vertex).copied().unwrap_or_default();
            Attributes { normal: [x, y, z, 0], uv: mesh.uvs[vertex], irradiance, material }
        }));
        self.indices.extend_from_slice(&mesh.triangles);
        let indices = first_index..3 * self.indices.len() as u32;
        self.parts.push(Part { bounds: Bounds::of(&mesh.positions), indices, first_vertex });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::view::clip_from_camera;
    use glam::Vec2;

    #[test]
    fn a_view_shows_what_reaches_into_it_and_nothing_else() {
        let clip = clip_from_camera(Vec2::splat(500.0), Vec2::new(320.0, 240.0), Vec2::new(640.0, 480.0), 0.1);
        let shown = |x: f32, y: f32, z: f32| {
            let middle = Vec3::new(x, y, z);
            let bounds = Bounds { lowest: middle - 0.5, highest: middle + 0.5 };
            frustum(&clip).iter().all(|plane| bounds.reaches(plane))
        };
        assert!(shown(0.0, 0.0, 5.0) && shown(3.5, 0.0, 5.0) && shown(0.0, -2.8, 5.0) && shown(0.0, 0.0, 0.0));
        assert!(!shown(5.0, 0.0, 5.0) && !shown(0.0, -4.0, 5.0) && !shown(0.0, 0.0, -2.0));
    }
}
