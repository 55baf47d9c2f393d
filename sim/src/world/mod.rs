//! What there is to see and to bump into: meshes, materials, lamps. Knows no robot, no camera and no estimator.
//!
//! World frame: x east, y north, z up; metres. Light has two bands everywhere: visible (linear RGB, lux) and 830 nm
//! (W m⁻² nm⁻¹).

pub mod bake;
pub mod gltf;
pub mod ground;
pub mod laboratory;
pub mod material;
pub mod plan;
pub mod rays;
pub mod refine;
mod scene;
pub mod shape;
pub mod yard;

use ground::Ground;

/// Edge of every texture, texels.
pub const TEXTURE_SIZE: usize = 512;

/// A place, ready to be rendered and collided with. Nothing in it moves.
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
    /// Irradiance from all lamps, direct and indirect, on the vertex: R, G, B in lux, then 830 nm in W m⁻² nm⁻¹.
    /// Empty until baked.
    pub irradiance: Vec<[f32; 4]>,
    /// Indices of corners.
    pub triangles: Vec<[u32; 3]>,
}

/// What a surface reflects; Lambertian. [`TEXTURE_SIZE`]² texels, row after row.
#[derive(Clone, Debug)]
pub struct Material {
    /// For readers.
    pub name: String,
    /// R, G, B: visible albedo, sRGB-encoded; fourth: 830 nm albedo, linear, 255 = 1.
    pub albedo: Vec<[u8; 4]>,
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
    pub exitance: [f32; 4],
    /// What it shines with.
    pub source: LightSource,
}

/// What lamps are switched and dimmed by, all of one source together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightSource {
    /// The mains.
    Electric,
    /// The sky.
    Daylight,
}

impl LightSource {
    /// All there are.
    pub const ALL: [Self; 2] = [Self::Electric, Self::Daylight];
}

/// How bright the lamps of each source are, in multiples of their exitance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brightness {
    /// Of those on the mains.
    pub electric: f32,
    /// Of windows.
    pub daylight: f32,
}

impl Brightness {
    /// As the world has them.
    pub const FULL: Self = Self { electric: 1.0, daylight: 1.0 };

    /// Of one source.
    pub fn of(&self, source: LightSource) -> f32 {
        match source {
            LightSource::Electric => self.electric,
            LightSource::Daylight => self.daylight,
        }
    }
}
