//! The world as the engine feels it: terrain or a level plane, the ground that rises from it, and things to bump into.

use std::f64::consts::FRAC_PI_2;

use rapier3d::prelude::*;
use thiserror::Error;

use crate::world::ground::Terrain;
use crate::world::{Mesh, World};

/// Who touches whom. Tyres stand on the ground as balls (a ball rolls without a tremble where a cylinder's edge
/// rattles) and bump into things as cylinders (a ball would stick out past the tyre).
pub(super) mod groups {
    use rapier3d::prelude::{Group, InteractionGroups, InteractionTestMode};

    const GROUND: Group = Group::GROUP_1;
    const OBSTACLE: Group = Group::GROUP_2;
    const TYRE: Group = Group::GROUP_3;
    const WHEEL: Group = Group::GROUP_4;
    const CHASSIS: Group = Group::GROUP_5;

    const fn of(member: Group, touches: Group) -> InteractionGroups {
        InteractionGroups::new(member, touches, InteractionTestMode::And)
    }

    pub(in crate::physics) const GROUND_TOUCHES: InteractionGroups = of(GROUND, TYRE.union(CHASSIS));
    pub(in crate::physics) const OBSTACLE_TOUCHES: InteractionGroups = of(OBSTACLE, WHEEL.union(CHASSIS));
    pub(in crate::physics) const TYRE_TOUCHES: InteractionGroups = of(TYRE, GROUND);
    pub(in crate::physics) const WHEEL_TOUCHES: InteractionGroups = of(WHEEL, OBSTACLE);
    pub(in crate::physics) const CHASSIS_TOUCHES: InteractionGroups = of(CHASSIS, GROUND.union(OBSTACLE));
}

/// Faces less steep than this are ground: cos 45°. The robot climbs 19° (data sheet), so nothing steeper than this is
/// driven on; a guess.
const GROUND_NORMAL_Z: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Ground no higher than this above the plane or the terrain is it, metres: mesh vertices are f32.
const LEVEL: f64 = 1e-3;
/// How far the plane lies below the lowest ground of a world with terrain, metres.
const BELOW_TERRAIN: f64 = 10.0;
/// The plane's half edge, metres. Larger than any world.
const FAR: f64 = 1e5;
/// Obstacles against the robot's body; a guess. Tyres on the ground get theirs from the floor.
const OBSTACLE_FRICTION: f64 = 0.3;

/// A mesh that nothing can bump into.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum WorldError {
    /// NaN or infinite.
    #[error("`{object}`: vertex {vertex} is not finite")]
    NotFinite {
        /// Its name.
        object: String,
        /// Its index.
        vertex: usize,
    },
    /// A triangle of vertices that are not there.
    #[error("`{object}`: triangle {triangle} names a vertex that does not exist")]
    NoSuchVertex {
        /// Its name.
        object: String,
        /// Its index.
        triangle: usize,
    },
    /// The engine cannot use it.
    #[error("`{object}`: no collision mesh: {reason}")]
    Mesh {
        /// Its name.
        object: String,
        /// The engine's words.
        reason: String,
    },
}

type Triangle = [Vector; 3];

/// Puts everything that collides into the engine. A collider's `user_data` is the object's index plus one; the ground
/// has 0.
///
/// The level floor is an exact plane and not its triangles, because a wheel that crosses a seam between two meshes
/// stumbles. It lies at z = 0, or lower where the world's own ground goes lower. Terrain is one height field for the same
/// reason.
pub(super) fn build(world: &World, physics: &mut PhysicsWorld) -> Result<(), WorldError> {
    let mut ground = Vec::new();
    let mut obstacles = Vec::new();
    for (index, object) in world.objects.iter().enumerate().filter(|(_, object)| object.collides) {
        let (level, steep): (Vec<_>, Vec<_>) = triangles(&object.name, &object.mesh)?.into_iter().partition(is_ground);
        ground.extend(level);
        obstacles.push((index, steep));
    }
    let terrain = world.ground.terrain.as_ref();
    let lowest = ground.iter().flatten().map(|vertex| vertex.z).fold(0.0, f64::min);
    // Below terrain it only catches what falls off: ground in two places at once would hold a tyre twice.
    let plane_height = lowest - if terrain.is_some() { BELOW_TERRAIN } else { 0.0 };
    let base = |vertex: &Vector| match terrain {
        Some(_) => world.ground.height(vertex.x, vertex.y),
        None => plane_height,
    };
    ground.retain(|triangle| triangle.iter().any(|vertex| vertex.z > base(vertex) + LEVEL));

    let plane = ColliderBuilder::cuboid(FAR, FAR, 1.0).translation(Vector::new(0.0, 0.0, plane_height - 1.0));
    insert(physics, plane, groups::GROUND_TOUCHES, 0);
    if let Some(terrain) = terrain {
        insert(physics, height_field(terrain), groups::GROUND_TOUCHES, 0);
    }
    if let Some(mesh) = trimesh("ground", &ground, TriMeshFlags::FIX_INTERNAL_EDGES)? {
        insert(physics, mesh, groups::GROUND_TOUCHES, 0);
    }
    for (index, triangles) in obstacles {
        // Two-sided, because a wall may be a single sheet.
        let flags = TriMeshFlags::FIX_INTERNAL_EDGES_TWO_SIDED;
        if let Some(mesh) = trimesh(&world.objects[index].name, &triangles, flags)? {
            insert(physics, mesh.friction(OBSTACLE_FRICTION), groups::OBSTACLE_TOUCHES, index as u128 + 1);
        }
    }
    Ok(())
}

fn insert(physics: &mut PhysicsWorld, collider: ColliderBuilder, touches: InteractionGroups, user_data: u128) {
    let collider =
        collider.collision_groups(touches).friction_combine_rule(CoefficientCombineRule::Multiply).user_data(user_data);
    physics.colliders.insert(collider);
}

fn triangles(object: &str, mesh: &Mesh) -> Result<Vec<Triangle>, WorldError> {
    if let Some(vertex) = mesh.positions.iter().position(|position| position.iter().any(|value| !value.is_finite())) {
        return Err(WorldError::NotFinite { object: object.into(), vertex });
    }
    let corner = |index: u32| mesh.positions.get(index as usize).map(|p| Vector::from_array(p.map(f64::from)));
    mesh.triangles
        .iter()
        .enumerate()
        .map(|(triangle, &[a, b, c])| match (corner(a), corner(b), corner(c)) {
            (Some(a), Some(b), Some(c)) => Ok([a, b, c]),
            _ => Err(WorldError::NoSuchVertex { object: object.into(), triangle }),
        })
        .collect()
}

fn height_field(terrain: &Terrain) -> ColliderBuilder {
    let (columns, rows) = (terrain.columns, terrain.rows());
    // The engine's height fields have y up, rows along z and the middle at the origin. Turned z up, rows lead south.
    let by_column = (0..columns).flat_map(|column| (0..rows).rev().map(move |row| row * columns + column));
    let heights = Array2::new(rows, columns, by_column.map(|index| terrain.heights[index]).collect());
    let size = [columns, rows].map(|points| terrain.pitch * (points - 1) as f64);
    ColliderBuilder::heightfield_with_flags(
        heights,
        Vector::new(size[0], 1.0, size[1]),
        HeightFieldFlags::FIX_INTERNAL_EDGES,
    )
    .translation(Vector::new(terrain.min[0] + size[0] / 2.0, terrain.min[1] + size[1] / 2.0, 0.0))
    .rotation(Vector::X * FRAC_PI_2)
}

fn is_ground([a, b, c]: &Triangle) -> bool {
    (*b - *a).cross(*c - *a).normalize_or_zero().z > GROUND_NORMAL_Z
}

/// `None` when there is nothing: the engine refuses empty meshes.
fn trimesh(object: &str, triangles: &[Triangle], flags: TriMeshFlags) -> Result<Option<ColliderBuilder>, WorldError> {
    if triangles.is_empty() {
        return Ok(None);
    }
    let indices = (0..triangles.len() as u32).map(|triangle| [3 * triangle, 3 * triangle + 1, 3 * triangle + 2]);
    let flags = flags | TriMeshFlags::DELETE_DEGENERATE_TRIANGLES;
    ColliderBuilder::trimesh_with_flags(triangles.as_flattened().to_vec(), indices.collect(), flags)
        .map(Some)
        .map_err(|error| WorldError::Mesh { object: object.into(), reason: error.to_string() })
}
