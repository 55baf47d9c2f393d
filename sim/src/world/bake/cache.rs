//! Baked light kept in a folder, under the hash of all it depends on.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::{Bands, BySource, Effort, by_source, write};
use crate::world::material::mean_albedo;
use crate::world::{Brightness, LightSource, World};

/// First bytes of a file. Raise the digit when the computation changes: it is part of the hash.
const MAGIC: &[u8; 8] = b"SUNBAKE2";
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

/// The user's folder for baked light: `sunblind` in `XDG_CACHE_HOME`, else in `.cache` of the home folder, else in the
/// system's folder for temporary files. It may not exist yet.
pub fn cache_folder() -> PathBuf {
    let set = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let in_home = || std::env::home_dir().filter(|home| home.is_absolute()).map(|home| home.join(".cache"));
    set("XDG_CACHE_HOME").or_else(in_home).unwrap_or_else(std::env::temp_dir).join("sunblind")
}

/// As [`bake`](super::bake), unless `folder` has the light already, of whatever brightness. A damaged or foreign file is
/// computed anew and replaced.
///
/// # Errors
/// If the folder or file cannot be written; the world has its light all the same.
pub fn bake_cached(
    world: &mut World,
    effort: &Effort,
    brightness: Brightness,
    folder: &Path,
    progress: &(dyn Fn(f32) + Sync),
) -> io::Result<Origin> {
    let key = key(world, effort);
    let path = path(folder, &key);
    let vertices = world.objects.iter().map(|object| object.mesh.positions.len()).sum();
    if let Some(light) = fs::read(&path).ok().and_then(|bytes| decode(&bytes, &key, vertices)) {
        write(world, &light, brightness);
        progress(1.0);
        return Ok(Origin::Cache);
    }
    let light = by_source(world, effort, progress);
    write(world, &light, brightness);
    progress(1.0);
    store(&path, &encode(&key, &light))?;
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
        floats(&[f32::from(lamp.source as u8)]);
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

/// Magic, key, little-endian floats source after source, their SHA-256.
fn encode(key: &[u8; HASH], light: &BySource) -> Vec<u8> {
    let mut bytes = [MAGIC.as_slice(), key].concat();
    bytes.extend(light.iter().flatten().flatten().flat_map(|value| value.to_le_bytes()));
    let sum = Sha256::digest(&bytes);
    bytes.extend_from_slice(&sum);
    bytes
}

/// `None` unless all of it is as [`encode`] left it.
fn decode(bytes: &[u8], key: &[u8; HASH], vertices: usize) -> Option<BySource> {
    let (content, sum) = bytes.split_at_checked(bytes.len().checked_sub(HASH)?)?;
    let floats = content.strip_prefix(MAGIC.as_slice())?.strip_prefix(key.as_slice())?;
    if Sha256::digest(content).as_slice() != sum
        || floats.len() != LightSource::ALL.len() * vertices * size_of::<Bands>()
    {
        return None;
    }
    let (floats, _) = floats.as_chunks::<4>();
    let (light, _) = floats.as_chunks::<4>();
    let mut sources =
        light.chunks(vertices).map(|light| light.iter().map(|bands| bands.map(f32::from_le_bytes)).collect());
    Some(std::array::from_fn(|_| sources.next().unwrap_or_default()))
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
