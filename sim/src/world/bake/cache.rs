//! Baked light kept in a folder, under the hash of all it depends on.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::{Bands, Effort, bake, write};
use crate::world::World;
use crate::world::material::mean_albedo;

/// First bytes of a file. Raise the digit when the computation changes: it is part of the hash.
const MAGIC: &[u8; 8] = b"SUNBAKE1";
/// Bytes of a SHA-256.
const HASH: usize = 32;

/// Where the light came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Read from the folder.
    Cache,
    /// Computed, then put there.
    Computed,
}

/// As [`bake`], unless `folder` has the result already. A damaged or foreign file is computed anew and replaced.
///
/// # Errors
/// If the folder or file cannot be written; the world has its light all the same.
pub fn bake_cached(
    world: &mut World,
    effort: &Effort,
    folder: &Path,
    progress: &(dyn Fn(f32) + Sync),
) -> io::Result<Origin> {
    let key = key(world, effort);
    let path = path(folder, &key);
    let vertices = world.objects.iter().map(|object| object.mesh.positions.len()).sum();
    if let Some(light) = fs::read(&path).ok().and_then(|bytes| decode(&bytes, &key, vertices)) {
        write(world, &light);
        progress(1.0);
        return Ok(Origin::Cache);
    }
    bake(world, effort, progress);
    let light = world.objects.iter().flat_map(|object| &object.mesh.irradiance);
    store(&path, &encode(&key, light))?;
    Ok(Origin::Computed)
}

fn path(folder: &Path, key: &[u8; HASH]) -> PathBuf {
    let name: String = key[..12].iter().map(|byte| format!("{byte:02x}")).collect();
    folder.join(format!("light-{name}.bin"))
}

/// SHA-256 over geometry, mean albedos, lamps and effort. Names and pictures do not matter.
fn key(world: &World, effort: &Effort) -> [u8; HASH] {
    let mut hash = Sha256::new_with_prefix(MAGIC);
    let mut floats = |values: &[f32]| values.iter().for_each(|value| hash.update(value.to_le_bytes()));
    floats(&[effort.rays as f32, effort.bounces as f32, effort.lamp_step, world.objects.len() as f32]);
    for material in &world.materials {
        floats(&mean_albedo(material));
    }
    for lamp in &world.lamps {
        floats(lamp.half_edges.concat().as_slice());
        floats(&lamp.centre);
        floats(&lamp.exitance);
    }
    for object in &world.objects {
        let mesh = &object.mesh;
        floats(&[object.material as f32, mesh.positions.len() as f32, mesh.triangles.len() as f32]);
        floats(mesh.positions.as_flattened());
        floats(mesh.normals.as_flattened());
    }
    for index in world.objects.iter().flat_map(|object| object.mesh.triangles.as_flattened()) {
        hash.update(index.to_le_bytes());
    }
    hash.finalize().into()
}

/// Magic, key, little-endian floats, their SHA-256.
fn encode<'a>(key: &[u8; HASH], light: impl Iterator<Item = &'a Bands>) -> Vec<u8> {
    let mut bytes = [MAGIC.as_slice(), key].concat();
    bytes.extend(light.flatten().flat_map(|value| value.to_le_bytes()));
    let sum = Sha256::digest(&bytes);
    bytes.extend_from_slice(&sum);
    bytes
}

/// `None` unless all of it is as [`encode`] left it.
fn decode(bytes: &[u8], key: &[u8; HASH], vertices: usize) -> Option<Vec<Bands>> {
    let (content, sum) = bytes.split_at_checked(bytes.len().checked_sub(HASH)?)?;
    let floats = content.strip_prefix(MAGIC.as_slice())?.strip_prefix(key.as_slice())?;
    if Sha256::digest(content).as_slice() != sum || floats.len() != vertices * size_of::<Bands>() {
        return None;
    }
    let (floats, _) = floats.as_chunks::<4>();
    let (light, _) = floats.as_chunks::<4>();
    Some(light.iter().map(|bands| bands.map(f32::from_le_bytes)).collect())
}

/// Beside, then renamed, so that no reader finds half a file.
fn store(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let beside = path.with_extension(format!("{}.part", std::process::id()));
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let mut file = fs::File::create(&beside)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    fs::rename(&beside, path)
}
