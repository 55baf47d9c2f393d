//! Baked light kept in a folder, under the hash of all it depends on.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use half::f16;
use sha2::{Digest, Sha256};

use super::{Effort, transfer};
use crate::world::World;
use crate::world::material::mean_albedo;
use crate::world::transfer::{Share, Transfer};

/// First bytes of a file. Raise the digit when the computation changes: it is part of the hash.
const MAGIC: &[u8; 8] = b"SUNBAKE3";
/// Bytes of a SHA-256.
const HASH: usize = 32;
/// Bytes of what scales the channels of one source's light, and of that light on a vertex.
const SCALE: usize = 4 * size_of::<f32>();
const VERTEX: usize = 4 * size_of::<f16>();

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

/// As [`bake`](super::bake), unless `folder` has the light already. A damaged or foreign file is computed anew and
/// replaced.
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
    let known = fs::read(&path).ok().and_then(|bytes| decode(&bytes, &key, world));
    let origin = if known.is_some() { Origin::Cache } else { Origin::Computed };
    let light = known.unwrap_or_else(|| transfer(world, effort, progress));
    let stored = if origin == Origin::Computed { store(&path, &encode(&key, &light)) } else { Ok(()) };
    world.transfer = Arc::new(light);
    progress(1.0);
    stored.map(|()| origin)
}

fn path(folder: &Path, key: &[u8; HASH]) -> PathBuf {
    let name: String = key[..12].iter().map(|byte| format!("{byte:02x}")).collect();
    folder.join(format!("light-{name}.bin"))
}

/// SHA-256 over geometry, mean albedos, lamps and effort. Names and pictures do not matter, but
/// for which lamps are of one group.
fn key(world: &World, effort: &Effort) -> [u8; HASH] {
    let mut hash = Sha256::new_with_prefix(MAGIC);
    let mut floats = |values: &[f32]| values.iter().for_each(|value| hash.update(value.to_le_bytes()));
    let groups = world.lamp_groups();
    floats(&[
        f32::from(u8::from(world.open_sky)),
        effort.rays as f32,
        effort.bounces as f32,
        effort.lamp_step,
        world.objects.len() as f32,
    ]);
    for material in &world.materials {
        floats(&mean_albedo(material));
    }
    for lamp in &world.lamps {
        floats(lamp.half_edges.concat().as_slice());
        floats(&lamp.centre);
        floats(&lamp.exitance);
        let group = groups.iter().position(|group| *group == lamp.group).unwrap_or_default();
        floats(&[group as f32]);
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

/// Magic, key, source after source (scale, then half floats, all little-endian), their SHA-256.
fn encode(key: &[u8; HASH], light: &Transfer) -> Vec<u8> {
    let mut bytes = [MAGIC.as_slice(), key].concat();
    for share in &light.shares {
        bytes.extend(share.scale.iter().flat_map(|scale| scale.to_le_bytes()));
        bytes.extend(share.light.as_flattened().iter().flat_map(|light| light.to_le_bytes()));
    }
    let sum = Sha256::digest(&bytes);
    bytes.extend_from_slice(&sum);
    bytes
}

/// `None` unless all of it is as [`encode`] left it.
fn decode(bytes: &[u8], key: &[u8; HASH], world: &World) -> Option<Transfer> {
    let vertices: usize = world.objects.iter().map(|object| object.mesh.positions.len()).sum();
    let sources = Transfer::sources_of(world);
    let (content, sum) = bytes.split_at_checked(bytes.len().checked_sub(HASH)?)?;
    let light = content.strip_prefix(MAGIC.as_slice())?.strip_prefix(key.as_slice())?;
    let size = SCALE + vertices * VERTEX;
    if Sha256::digest(content).as_slice() != sum || light.len() != sources.len() * size {
        return None;
    }
    let share = |bytes: &[u8]| {
        let (scale, light) = bytes.split_at(SCALE);
        let number = |at: usize| f32::from_le_bytes(std::array::from_fn(|byte| scale[4 * at + byte]));
        let (halves, _) = light.as_chunks::<2>();
        let (light, _) = halves.as_chunks::<4>();
        Share {
            scale: [0, 1, 2, 3].map(number),
            light: light.iter().map(|bands| bands.map(f16::from_le_bytes)).collect(),
        }
    };
    Some(Transfer { shares: light.chunks(size).map(share).collect(), sources })
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
