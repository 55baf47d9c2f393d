//! The world as the engine feels it: a level plane, the ground that rises from it, and things to bump into.

use rapier3d::prelude::*;
use thiserror::Error;

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
/// Ground no higher than this above the plane is the plane, metres: mesh vertices are f32.
const LEVEL: f64 = 1e-3;
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
/// stumbles. It lies at z = 0, or lower where the world's own ground goes lower.
pub(super) fn build(world: &World, physics: &mut PhysicsWorld) -> Result<(), WorldError> {
    let mut ground = Vec::new();
    let mut obstacles = Vec::new();
    for (index, object) in world.objects.iter().enumerate().filter(|(_, object)| object.collides) {
        let (level, steep): (Vec<_>, Vec<_>) = triangles(&object.name, &object.mesh)?.into_iter().partition(is_ground);
        ground.extend(level);
        obstacles.push((index, steep));
    }
    let plane_height = ground.iter().flatten().map(|vertex| vertex.z).fold(0.0, f64::min);
    ground.retain(|triangle| triangle.iter().any(|vertex| vertex.z > plane_height + LEVEL));

    let plane = ColliderBuilder::cuboid(FAR, FAR, 1.0).translation(Vector::new(0.0, 0.0, plane_height - 1.0));
    insert(physics, plane, groups::GROUND_TOUCHES, 0);
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
