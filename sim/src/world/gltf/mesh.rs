//! Triangles, in the world's axes, cut as small as light at vertices needs.

use glam::{Mat3, Mat4, Vec3};
use gltf::mesh::Mode;

use super::source::Source;
use crate::world::Mesh;
use crate::world::refine::refine;

/// x right, y up, z to the viewer → x east, y north, z up.
pub(super) const WORLD_FROM_GLTF: Mat4 = Mat4::from_cols_array_2d(&[
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
]);

/// Longest edge of a triangle, metres: light's shadows indoors are about as soft as that.
const LONGEST_EDGE: f32 = 0.6;

/// One primitive, placed.
pub(super) fn triangles(source: &Source, primitive: &gltf::Primitive<'_>, place: &Mat4) -> Result<Mesh, String> {
    if primitive.mode() != Mode::Triangles {
        return Err(format!("it is made of {:?}; export triangles", primitive.mode()));
    }
    let reader = primitive.reader(|buffer| source.buffer(&buffer));
    let positions: Vec<Vec3> = reader.read_positions().ok_or("it has no positions")?.map(Vec3::from).collect();
    if let Some(vertex) = positions.iter().position(|position| !position.is_finite()) {
        return Err(format!("vertex {vertex} is not finite"));
    }
    let corners: Vec<u32> = match reader.read_indices() {
        Some(indices) => indices.into_u32().collect(),
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(index) = corners.iter().find(|&&index| index as usize >= positions.len()) {
        return Err(format!("a triangle names vertex {index} of {}", positions.len()));
    }
    let (corners, _) = corners.as_chunks::<3>();
    let uvs: Vec<[f32; 2]> = match reader.read_tex_coords(0) {
        Some(uvs) => uvs.into_f32().collect(),
        None => vec![[0.0; 2]; positions.len()],
    };
    let normals: Option<Vec<Vec3>> = reader.read_normals().map(|normals| normals.map(Vec3::from).collect());
    if uvs.len() != positions.len() || normals.as_ref().is_some_and(|normals| normals.len() != positions.len()) {
        return Err("its attributes are of unequal length".into());
    }

    let turn = Mat3::from_mat4(*place);
    let mirrored = turn.determinant() < 0.0;
    // Normals follow the inverse transpose, which a flattened thing does not have.
    let turn_normals = if turn.determinant() == 0.0 { turn } else { turn.inverse().transpose() };
    let mut mesh = Mesh::default();
    let mut add_vertex = |index: usize, normal: Vec3| {
        mesh.positions.push(place.transform_point3(positions[index]).to_array());
        mesh.normals.push(normal.try_normalize().unwrap_or(Vec3::Z).to_array());
        mesh.uvs.push(uvs[index]);
    };
    let facing = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|index| place.transform_point3(positions[index as usize]));
        let cross = (b - a).cross(c - a);
        if mirrored { -cross } else { cross }
    };
    let mut whole: Vec<[u32; 3]> = corners.iter().filter(|corners| facing(corners).length() > 0.0).copied().collect();
    match &normals {
        Some(normals) => (0..positions.len()).for_each(|index| add_vertex(index, turn_normals * normals[index])),
        // Without normals every triangle is flat, and has its own corners.
        None => {
            for (number, corners) in whole.iter_mut().enumerate() {
                let normal = facing(corners);
                corners.iter().for_each(|&index| add_vertex(index as usize, normal));
                *corners = [0, 1, 2].map(|corner| 3 * number as u32 + corner);
            }
        }
    }
    if mirrored {
        whole.iter_mut().for_each(|[_, b, c]| std::mem::swap(b, c));
    }
    mesh.triangles = whole;
    refine(&mut mesh, |_| LONGEST_EDGE);
    if primitive.material().double_sided() {
        add_other_side(&mut mesh);
    }
    Ok(mesh)
}

/// Everything again, facing the other way.
fn add_other_side(mesh: &mut Mesh) {
    let count = mesh.positions.len() as u32;
    mesh.positions.extend_from_within(..);
    mesh.uvs.extend_from_within(..);
    let backs: Vec<[f32; 3]> = mesh.normals.iter().map(|normal| normal.map(|part| -part)).collect();
    mesh.normals.extend(backs);
    let turned: Vec<[u32; 3]> = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b].map(|index| index + count)).collect();
    mesh.triangles.extend(turned);
}
