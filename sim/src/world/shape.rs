//! Shapes to build a world from: quads, boxes, cylinders, with normals and texture coordinates.

use glam::{Mat3, Vec2, Vec3, vec3};

use super::Mesh;

/// Faces are cut at least this often along each edge, metres, so that light kept at vertices shows shadows. Cutting
/// long strips crosswise here also spares bisection the slivers it is bad at.
const STEP: f32 = 0.3;
/// Bars of less girth, metres, are cut a quarter as often: no shadow shows on a pipe or a table's leg.
const THIN: f32 = 0.25;

/// How a texture lies on a face.
#[derive(Clone, Copy, Debug)]
pub enum Mapping {
    /// Repeats every `span` metres, shifted by `offset` metres, so that two tables do not show the same grain.
    Tiled {
        /// Metres that one repeat covers, along u and v.
        span: [f32; 2],
        /// Metres.
        offset: [f32; 2],
    },
    /// Shown once, edge to edge.
    Fitted,
}

impl Mapping {
    /// The texture coordinates of the point `along` metres from a face's top left corner, of a face `size` metres wide.
    fn uv(self, along: [f32; 2], size: [f32; 2]) -> [f32; 2] {
        match self {
            Self::Tiled { span, offset } => [0, 1].map(|i| (along[i] + offset[i]) / span[i]),
            Self::Fitted => [0, 1].map(|i| along[i] / size[i]),
        }
    }
}

impl Mapping {
    /// The texture coordinates of the point `along` metres from where the texture begins; of a surface without edges.
    pub fn uv_at(self, along: [f32; 2]) -> [f32; 2] {
        self.uv(along, [1.0; 2])
    }
}

/// Where a thing stands: its own frame's origin and heading in the world's.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place {
    /// Metres.
    pub at: Vec3,
    /// Anticlockwise about z, radians.
    pub yaw: f32,
}

impl Place {
    /// At x, y, z metres, turned by `yaw_deg` degrees anticlockwise.
    pub fn new(x: f32, y: f32, z: f32, yaw_deg: f32) -> Self {
        Self { at: vec3(x, y, z), yaw: yaw_deg.to_radians() }
    }

    /// On the floor at `from`, its x axis towards `to`.
    pub fn along(from: Vec2, to: Vec2) -> Self {
        let way = to - from;
        Self { at: from.extend(0.0), yaw: way.y.atan2(way.x) }
    }

    /// A point given in this place's frame, in the world's.
    pub fn point(&self, local: Vec3) -> Vec3 {
        self.at + Mat3::from_rotation_z(self.yaw) * local
    }

    /// A place given in this place's frame, in the world's.
    pub fn then(&self, local: Place) -> Place {
        Place { at: self.point(local.at), yaw: self.yaw + local.yaw }
    }
}

/// How long a bar of some girth (metres) may stay uncut.
fn longest_cut(girth: f32) -> f32 {
    if girth < THIN { 4.0 * STEP } else { STEP }
}

/// The cuts given, ascending, and evenly between them as many as leave no more than `longest` metres.
pub fn cuts_no_longer_than(longest: f32, cuts: &[f32]) -> Vec<f32> {
    let mut all = vec![cuts[0]];
    for pair in cuts.windows(2) {
        let steps = ((pair[1] - pair[0]) / longest - 1e-3).ceil().max(1.0);
        all.extend((1..steps as u32).map(|step| pair[0] + (pair[1] - pair[0]) * step as f32 / steps));
        all.push(pair[1]);
    }
    all
}

impl Mesh {
    /// A rectangle with its top left `corner`, its upper edge `right` and its left edge `down`, as seen from the side it
    /// faces.
    pub fn quad(corner: Vec3, right: Vec3, down: Vec3, mapping: Mapping) -> Self {
        Self::quad_cut(STEP, corner, right, down, mapping)
    }

    fn quad_cut(longest: f32, corner: Vec3, right: Vec3, down: Vec3, mapping: Mapping) -> Self {
        let [columns, rows] = [right, down].map(|edge| cuts_no_longer_than(longest, &[0.0, edge.length()]));
        Self::grid(corner, right, down, [&columns, &rows], |_, _| false, mapping)
    }

    /// A quad cut along `columns` and `rows` (metres from its top left corner, ascending, ends included), without the
    /// cells that `hole` names. Cells share their corners, so light is smooth across the cuts.
    pub fn grid(
        corner: Vec3,
        right: Vec3,
        down: Vec3,
        [columns, rows]: [&[f32]; 2],
        hole: impl Fn(usize, usize) -> bool,
        mapping: Mapping,
    ) -> Self {
        let (right, down) = (right.normalize(), down.normalize());
        let size = [columns, rows].map(|cuts| cuts.last().copied().unwrap_or(0.0));
        let mut mesh = Self::default();
        for &v in rows {
            for &u in columns {
                mesh.positions.push((corner + u * right + v * down).to_array());
                mesh.normals.push(down.cross(right).to_array());
                mesh.uvs.push(mapping.uv([u, v], size));
            }
        }
        let at = |column: usize, row: usize| (row * columns.len() + column) as u32;
        for row in 0..rows.len() - 1 {
            for column in (0..columns.len() - 1).filter(|&column| !hole(column, row)) {
                let [a, b] = [at(column, row), at(column + 1, row)];
                let [d, c] = [at(column, row + 1), at(column + 1, row + 1)];
                mesh.triangles.extend([[a, d, c], [a, c, b]]);
            }
        }
        mesh
    }

    /// An upright box between two corners.
    pub fn cuboid(min: Vec3, max: Vec3, mapping: Mapping) -> Self {
        let size = max - min;
        let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
        let longest = longest_cut(2.0 * (size.element_sum() - size.max_element()));
        let mut mesh = Self::default();
        for (corner, right, down) in [
            (min + z, x, -z),      // south
            (max, -x, -z),         // north
            (min + x + z, y, -z),  // east
            (min + y + z, -y, -z), // west
            (min + y + z, x, -y),  // up
            (min, x, y),           // down
        ] {
            mesh.append(&Self::quad_cut(longest, corner, right, down, mapping));
        }
        mesh
    }

    /// A round bar with flat ends; the radii may differ, as a bin's do.
    pub fn cylinder(from: Vec3, to: Vec3, radii: [f32; 2], sides: u32, mapping: Mapping) -> Self {
        let round = std::f32::consts::TAU * radii[0].max(radii[1]);
        let mut mesh = Self::sleeve(from, to, radii, sides, longest_cut(round), mapping);
        let along = (to - from).normalize();
        let (across, beside) = along.any_orthonormal_pair();
        for (end, radius, facing) in [(from, radii[0], -along), (to, radii[1], along)] {
            let first = mesh.positions.len() as u32;
            for side in 0..sides {
                let (sin, cos) = (side as f32 / sides as f32 * std::f32::consts::TAU).sin_cos();
                let flat = radius * (cos * across + sin * beside);
                mesh.positions.push((end + flat).to_array());
                mesh.normals.push(facing.to_array());
                let uv = [radius + flat.dot(across), radius + flat.dot(beside)];
                mesh.uvs.push(mapping.uv(uv, [2.0 * radius; 2]));
            }
            for side in 1..sides - 1 {
                let turn = if facing == along { [side, side + 1] } else { [side + 1, side] };
                mesh.triangles.push([first, first + turn[0], first + turn[1]]);
            }
        }
        mesh
    }

    /// A round bar without flat ends, cut only every two metres: of what is long and thin, or far off.
    pub fn tube(from: Vec3, to: Vec3, radii: [f32; 2], sides: u32, mapping: Mapping) -> Self {
        Self::sleeve(from, to, radii, sides, 2.0, mapping)
    }

    fn sleeve(from: Vec3, to: Vec3, radii: [f32; 2], sides: u32, step: f32, mapping: Mapping) -> Self {
        let axis = to - from;
        let (along, length) = (axis.normalize(), axis.length());
        let (across, beside) = along.any_orthonormal_pair();
        let round = std::f32::consts::TAU * radii[0].max(radii[1]);
        let heights = cuts_no_longer_than(step, &[0.0, length]);
        let mut mesh = Self::default();
        for side in 0..=sides {
            let (sin, cos) = (side as f32 / sides as f32 * std::f32::consts::TAU).sin_cos();
            let out = cos * across + sin * beside;
            let normal = (out + along * (radii[0] - radii[1]) / length).normalize().to_array();
            let u = side as f32 / sides as f32 * round;
            for &height in &heights {
                let radius = radii[0] + (radii[1] - radii[0]) * height / length;
                mesh.positions.push((from + height * along + radius * out).to_array());
                mesh.normals.push(normal);
                mesh.uvs.push(mapping.uv([u, length - height], [round, length]));
            }
        }
        let rings = heights.len() as u32;
        for (side, ring) in (0..sides).flat_map(|side| (0..rings - 1).map(move |ring| (side, ring))) {
            let (here, next) = (side * rings + ring, (side + 1) * rings + ring);
            mesh.triangles.extend([[here, next, next + 1], [here, next + 1, here + 1]]);
        }
        mesh
    }

    /// A thin sheet with a front and a back, such as a leaf.
    pub fn leaf(corner: Vec3, right: Vec3, down: Vec3, mapping: Mapping) -> Self {
        let mut mesh = Self::quad(corner, right, down, mapping);
        let back = corner + 1e-3 * right.cross(down).normalize();
        mesh.append(&Self::quad(back + right, -right, down, mapping));
        mesh
    }

    /// Adds another mesh's triangles.
    pub fn append(&mut self, other: &Self) {
        let first = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.uvs.extend(&other.uvs);
        self.irradiance.extend(&other.irradiance);
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|index| first + index)));
    }

    /// The mesh, given in the frame of `place`, in the world's frame.
    pub fn placed(mut self, place: &Place) -> Self {
        let turn = Mat3::from_rotation_z(place.yaw);
        for position in &mut self.positions {
            *position = place.point(Vec3::from(*position)).to_array();
        }
        for normal in &mut self.normals {
            *normal = (turn * Vec3::from(*normal)).to_array();
        }
        self
    }

    /// The mesh leant by `angle` radians about an axis through the origin.
    pub fn tilted(mut self, axis: Vec3, angle: f32) -> Self {
        let turn = Mat3::from_axis_angle(axis, angle);
        for vector in self.positions.iter_mut().chain(&mut self.normals) {
            *vector = (turn * Vec3::from(*vector)).to_array();
        }
        self
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|index| Vec3::from(self.positions[index as usize]))
    }

    /// The smallest upright box around it: least and greatest corner. Of an empty mesh, ±∞.
    pub fn bounds(&self) -> [Vec3; 2] {
        self.positions.iter().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[min, max], &position| {
            [min.min(position.into()), max.max(position.into())]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const METRIC: Mapping = Mapping::Tiled { span: [1.0, 1.0], offset: [0.0, 0.0] };

    /// By the divergence theorem; positive only if the triangles face outwards.
    fn volume(mesh: &Mesh) -> f32 {
        mesh.triangles.iter().map(|&triangle| mesh.corners(triangle)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    fn assert_normals_agree_with_winding(mesh: &Mesh) {
        for &triangle in &mesh.triangles {
            let [a, b, c] = mesh.corners(triangle);
            let facing = (b - a).cross(c - a);
            for index in triangle {
                assert!(facing.dot(Vec3::from(mesh.normals[index as usize])) > 0.5 * facing.length());
            }
        }
    }

    #[test]
    fn a_box_faces_outwards_and_has_its_volume() {
        let mesh = Mesh::cuboid(vec3(1.0, 2.0, 3.0), vec3(2.0, 4.0, 6.0), METRIC);
        assert!((volume(&mesh) - 6.0).abs() < 1e-4);
        assert_normals_agree_with_winding(&mesh);
    }

    #[test]
    fn a_cylinder_faces_outwards_whichever_way_it_points() {
        for to in [vec3(1.0, 1.0, 3.0), vec3(1.0, 1.0, -1.0), vec3(3.0, 1.0, 1.0), vec3(2.0, 2.0, 2.0)] {
            for radii in [[0.5, 0.5], [0.3, 0.6], [0.6, 0.3]] {
                let from = vec3(1.0, 1.0, 1.0);
                let mesh = Mesh::cylinder(from, to, radii, 64, METRIC);
                let [a, b] = radii;
                let cone = std::f32::consts::PI * (a * a + a * b + b * b) / 3.0 * from.distance(to);
                assert!((volume(&mesh) / cone - 1.0).abs() < 0.01, "{radii:?} to {to}: {} ≠ {cone}", volume(&mesh));
                assert_normals_agree_with_winding(&mesh);
            }
        }
    }

    #[test]
    fn placing_turns_positions_and_normals_alike() {
        let mesh = Mesh::cuboid(Vec3::ZERO, Vec3::ONE, METRIC).placed(&Place::new(5.0, 1.0, 0.0, 37.0));
        assert!((volume(&mesh) - 1.0).abs() < 1e-4);
        assert_normals_agree_with_winding(&mesh);
    }

    #[test]
    fn a_quad_shows_its_texture_upright_to_who_looks_at_it() {
        let mesh = Mesh::quad(Vec3::Z, Vec3::X, -Vec3::Z, Mapping::Fitted);
        let last = mesh.positions.len() - 1;
        assert_eq!(mesh.normals[0], [0.0, -1.0, 0.0]);
        assert_eq!((mesh.positions[0], mesh.uvs[0]), ([0.0, 0.0, 1.0], [0.0, 0.0]));
        assert_eq!((mesh.positions[last], mesh.uvs[last]), ([1.0, 0.0, 0.0], [1.0, 1.0]));
    }

    #[test]
    fn a_grid_leaves_its_holes_out() {
        let cuts: &[f32] = &[0.0, 1.0, 2.0, 3.0];
        let mesh = Mesh::grid(Vec3::ZERO, Vec3::X, Vec3::Y, [cuts, cuts], |i, j| i == 1 && j == 1, METRIC);
        assert_eq!(mesh.triangles.len(), 16);
        assert_normals_agree_with_winding(&mesh);
    }
}
