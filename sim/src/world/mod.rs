//! What there is to see and to bump into: meshes, materials, lamps. Knows no robot, no camera and no estimator.
//!
//! World frame: x east, y north, z up; metres. Light has two bands everywhere: visible (linear RGB, lux) and 830 nm
//! (W m⁻² nm⁻¹).

pub mod bake;
pub mod campus;
pub mod gltf;
pub mod ground;
pub mod laboratory;
pub mod material;
pub mod plan;
pub mod rays;
pub mod refine;
mod scene;
pub mod shape;
mod sun_directions;
pub mod transfer;
pub mod way;
pub mod yard;

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::light::Bands;
use ground::Ground;
pub use material::gloss::{Gloss, SHINIEST, SMOOTHEST};
use transfer::Transfer;

/// Edge of every texture, texels.
pub const TEXTURE_SIZE: usize = 512;

/// A place, ready to be rendered and collided with. Nothing in it moves. Empty by default.
#[derive(Clone, Debug, Default)]
pub struct World {
    /// For readers.
    pub name: String,
    /// Everything there is.
    pub objects: Vec<Object>,
    /// What it is made of.
    pub materials: Vec<Material>,
    /// What shines. Nobody sees a lamp itself: where one is in view, an object is its cover.
    pub lamps: Vec<Lamp>,
    /// What one drives on.
    pub ground: Ground,
    /// Whether it lies under the open sky: what looks past all objects sees the sky, and the sun shines in.
    pub open_sky: bool,
    /// How light gets from each source to each vertex. Empty until [baked](bake::bake).
    pub transfer: Arc<Transfer>,
}

/// A thing of one material. Large ones are cut up (a room's wall, not the building's), so that a view can leave out
/// what it does not show.
#[derive(Clone, Debug)]
pub struct Object {
    /// For readers and for errors: "desk 3, top".
    pub name: String,
    /// Its shape.
    pub mesh: Mesh,
    /// Index into [`World::materials`].
    pub material: usize,
    /// Whether a robot bumps into it. A poster does not count.
    pub collides: bool,
}

/// Triangles in world coordinates, counter-clockwise seen from outside. One entry a vertex in each list.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit length, outwards.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; they wrap, (0, 0) is the texture's first row's left corner.
    pub uvs: Vec<[f32; 2]>,
    /// Irradiance on the vertex that is there whatever shines, set by hand for small worlds; empty for none. What lamps
    /// and sky bring comes on top: see [`World::transfer`].
    pub irradiance: Vec<Bands>,
    /// Indices of corners.
    pub triangles: Vec<[u32; 3]>,
}

/// What a surface reflects: evenly, beneath a boundary that may mirror. [`TEXTURE_SIZE`]² texels, row after row.
#[derive(Clone, Debug)]
pub struct Material {
    /// For readers.
    pub name: String,
    /// R, G, B: visible albedo, sRGB-encoded; fourth: 830 nm albedo, linear, 255 = 1.
    pub albedo: Vec<[u8; 4]>,
    /// Its boundary.
    pub gloss: Gloss,
}

/// A rectangular panel that shines to one side, as a ceiling lamp does, or a window that lets daylight in.
#[derive(Clone, Debug)]
pub struct Lamp {
    /// For readers.
    pub name: String,
    /// Its middle, metres.
    pub centre: [f32; 3],
    /// From the middle to the middle of one edge, and of the edge beside it; it shines along their cross product.
    pub half_edges: [[f32; 3]; 2],
    /// Luminous exitance by channel, lux: R, G, B; then radiant exitance at 830 nm, W m⁻² nm⁻¹. At full brightness.
    /// [`LampKind`](crate::light::LampKind) knows it for common lamps.
    pub exitance: Bands,
    /// The lamps of a group are switched and dimmed together: "ceiling", "street", or [`WINDOWS`].
    pub group: String,
}

/// The group of all panels that stand for windows: they let in what the sky has.
pub const WINDOWS: &str = "windows";

impl World {
    /// The groups that its lamps belong to, in alphabetical order.
    pub fn lamp_groups(&self) -> Vec<&str> {
        let groups: BTreeSet<&str> = self.lamps.iter().map(|lamp| lamp.group.as_str()).collect();
        groups.into_iter().collect()
    }
}
