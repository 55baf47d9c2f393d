//! A user's own world from a glTF 2.0 file (`.gltf` with its buffers and images beside it, or `.glb`).
//!
//! glTF's axes (y up) become the world's: x stays, y = −z, z = y. What is taken: the default scene's triangles, normals,
//! first texture coordinates, base colours. What is not: animation, skins, cameras, lights. See [`material`] for how
//! surfaces look at 830 nm.
//!
//! Extras, all optional:
//! - of a material, `"albedo_830nm": 0.4` (0 to 1): its albedo at 830 nm;
//! - of a node, `"collides": false`: robots pass through it (grass, curtains).

mod material;
mod mesh;
mod source;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use glam::{Mat4, Vec3};
use gltf::{Node, Scene};
use serde::Deserialize;
use thiserror::Error;

use super::{Object, World};
use source::Source;

/// Most triangles of a world. A guess: light for so many takes some minutes.
const MOST_TRIANGLES: usize = 1_000_000;
/// Smaller worlds than this, metres, are nearly always in a wrong unit, and so are larger ones than [`LARGEST`].
const SMALLEST: f32 = 0.5;
/// Metres.
const LARGEST: f32 = 2000.0;

/// Why a file gives no world.
#[derive(Debug, Error)]
#[error("{}: {problem}", file.display())]
pub struct GltfError {
    /// The file that was asked for.
    pub file: PathBuf,
    /// What is wrong in it, where, and what to do.
    pub problem: String,
}

/// Reads a world, without its light.
///
/// # Errors
/// Files that can't be read, are not glTF, or hold nothing that a world can be made of.
pub fn load(file: &Path) -> Result<World, GltfError> {
    build(file).map_err(|problem| GltfError { file: file.to_owned(), problem })
}

fn build(file: &Path) -> Result<World, String> {
    let source = Source::read(file)?;
    let document = &source.document;
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene = scene.ok_or("there is no scene in it; export one")?;
    let mut materials: Vec<_> =
        document.materials().map(|one| material::material(&source, &one)).collect::<Result<_, _>>()?;
    // Of primitives that name none.
    materials.push(material::plain());
    let mut objects = Vec::new();
    for (node, world_from_node) in placed_nodes(&scene) {
        add_objects(&source, &node, &world_from_node, &mut objects)?;
    }
    check_size(&objects)?;
    let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    Ok(World { name, objects, materials, open_sky: true, ..World::default() })
}

/// What a node may say in its extras.
#[derive(Deserialize)]
struct NodeExtras {
    #[serde(default = "yes")]
    collides: bool,
}

fn yes() -> bool {
    true
}

/// All nodes of a scene with their place in the world.
fn placed_nodes<'a>(scene: &Scene<'a>) -> Vec<(Node<'a>, Mat4)> {
    let mut pending: Vec<(Node<'a>, Mat4)> = scene.nodes().map(|node| (node, mesh::WORLD_FROM_GLTF)).collect();
    let mut placed = Vec::new();
    while let Some((node, world_from_parent)) = pending.pop() {
        let world_from_node = world_from_parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        pending.extend(node.children().map(|child| (child, world_from_node)));
        placed.push((node, world_from_node));
    }
    placed
}

fn add_objects(source: &Source, node: &Node<'_>, place: &Mat4, objects: &mut Vec<Object>) -> Result<(), String> {
    let Some(mesh) = node.mesh() else { return Ok(()) };
    let name = node.name().or(mesh.name()).map_or_else(|| format!("node {}", node.index()), str::to_owned);
    let collides = match node.extras() {
        Some(extras) => {
            let extras: NodeExtras = serde_json::from_str(extras.get())
                .map_err(|error| format!("extras of node \"{name}\": {error}; write \"collides\": false or true"))?;
            extras.collides
        }
        None => true,
    };
    for primitive in mesh.primitives() {
        let material = primitive.material();
        // Light passes through what is transparent, and nothing here shows it half.
        if material.alpha_mode() == gltf::material::AlphaMode::Blend {
            continue;
        }
        let mesh = mesh::triangles(source, &primitive, place).map_err(|problem| format!("\"{name}\": {problem}"))?;
        let material = material.index().unwrap_or(source.document.materials().len());
        objects.push(Object { name: name.clone(), mesh, material, collides });
    }
    Ok(())
}

fn check_size(objects: &[Object]) -> Result<(), String> {
    let triangles: usize = objects.iter().map(|object| object.mesh.triangles.len()).sum();
    if triangles == 0 {
        return Err("it has no triangles that can be seen; export meshes, not curves or points".into());
    }
    if triangles > MOST_TRIANGLES {
        return Err(format!("it has {triangles} triangles; simplify it to at most {MOST_TRIANGLES}"));
    }
    let positions = || objects.iter().flat_map(|object| &object.mesh.positions).map(|&at| Vec3::from(at));
    let (low, high) =
        positions().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    let span = (high - low).max_element();
    if !(SMALLEST..=LARGEST).contains(&span) {
        return Err(format!("it spans {span} m, glTF's unit is the metre; scale it to {SMALLEST} to {LARGEST} m"));
    }
    Ok(())
}
