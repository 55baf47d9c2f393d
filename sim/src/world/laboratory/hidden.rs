//! Leaves out what nobody can see: faces that lie against another face, as a cabinet's bottom does.

use glam::{DVec3, Vec3};

use crate::world::rays::Rays;
use crate::world::{Mesh, World};

/// A face is hidden by what lies no further than this in front of it, metres: no camera fits between.
const CLOSE: f64 = 0.02;
/// Faces are set this far before where they are, metres: of two in one place, back to back, each then lies behind the
/// other.
const LIFT: f32 = 2e-4;

/// Takes out the hidden triangles, and objects of which nothing is left. Walls keep theirs: plans are drawn of them.
pub(in crate::world) fn remove(world: &mut World) {
    let mut lifted = world.objects.clone();
    lifted.iter_mut().for_each(|object| lift(&mut object.mesh));
    let Some(rays) = Rays::new(&lifted) else { return };
    for object in world.objects.iter_mut().filter(|object| !object.name.ends_with("WallPaint")) {
        let Mesh { triangles, .. } = &object.mesh;
        let seen: Vec<[u32; 3]> =
            triangles.iter().copied().filter(|&triangle| !is_hidden(&rays, object.mesh.corners(triangle))).collect();
        if seen.len() < triangles.len() {
            object.mesh = of_triangles(&object.mesh, &seen);
        }
    }
    world.objects.retain(|object| !object.mesh.triangles.is_empty());
}

fn lift(mesh: &mut Mesh) {
    for (position, normal) in mesh.positions.iter_mut().zip(&mesh.normals) {
        *position = (Vec3::from(*position) + LIFT * Vec3::from(*normal)).to_array();
    }
}

/// Whether its middle and all of its corners are covered.
fn is_hidden(rays: &Rays, corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let (middle, out) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize());
    let lift = f64::from(LIFT);
    let covered = |at: DVec3| {
        let faces_it = rays.first(at - 2.0 * lift * out, out, 2.5 * lift).is_some_and(|hit| hit.front);
        faces_it || rays.first(at + 2.0 * lift * out, out, CLOSE).is_some()
    };
    covered(middle) && [a, b, c].into_iter().all(|corner| covered(corner.lerp(middle, 0.06)))
}

/// Some of a mesh's triangles, with the vertices that they need.
fn of_triangles(mesh: &Mesh, triangles: &[[u32; 3]]) -> Mesh {
    let mut part = Mesh::default();
    let mut index_of = vec![None; mesh.positions.len()];
    for corners in triangles {
        part.triangles.push(corners.map(|index| {
            let old = index as usize;
            *index_of[old].get_or_insert_with(|| {
                part.positions.push(mesh.positions[old]);
                part.normals.push(mesh.normals[old]);
                part.uvs.push(mesh.uvs[old]);
                part.positions.len() as u32 - 1
            })
        }));
    }
    part
}

#[cfg(test)]
mod tests {
    use glam::vec3;

    use super::*;
    use crate::world::Object;
    use crate::world::shape::Mapping;

    #[test]
    fn what_lies_against_something_goes_and_the_rest_stays() {
        let thing = |name: &str, mesh: Mesh| Object { name: name.into(), mesh, material: 0, collides: true };
        let floor = Mesh::quad(vec3(-1.0, 1.0, 0.0), 2.0 * Vec3::X, -2.0 * Vec3::Y, Mapping::Fitted);
        let cube = Mesh::cuboid(vec3(-0.1, -0.1, 0.0), vec3(0.1, 0.1, 0.2), Mapping::Fitted);
        let objects = vec![thing("floor", floor.clone()), thing("cube", cube)];
        let mut world = World { name: "test".into(), objects, ..World::default() };
        remove(&mut world);
        assert_eq!(world.objects[0].mesh.triangles.len(), floor.triangles.len(), "no cell of it is covered wholly");
        let cube = &world.objects[1].mesh;
        assert_eq!((cube.triangles.len(), cube.positions.len()), (10, 20));
        assert!(cube.normals.iter().all(|normal| normal[2] > -0.5), "its bottom is gone");
    }
}
