//! What hides other things: rectangles of wall, floor and ceiling, found in the geometry once.
//!
//! Conservative: a thing counts as hidden only if one rectangle alone hides the whole box around it. A rectangle is
//! made of whole triangles, so that wherever it counts, something is drawn.

use std::collections::BTreeMap;

use glam::{Mat4, Vec2, Vec3, Vec4, Vec4Swizzles, vec2};

use super::bounds::Bounds;
use super::view::NEAR;
use crate::world::Mesh;

/// Smallest rectangle worth asking, m². A guess: smaller ones hide little, and every one is asked about every part.
const SMALLEST_AREA: f32 = 1.0;
/// Distance up to which points count as one, metres.
const SAME_PLACE: f32 = 1e-4;
/// How far inside its shadow a thing must lie, metres, so that no rounding shows it.
const CLEARANCE: f32 = 1e-3;

/// A rectangle that can be seen from one side, and hides what is on the other. World frame, metres.
#[derive(Clone, Debug)]
pub(super) struct Occluder {
    /// Counter-clockwise for who sees it.
    corners: [Vec3; 4],
    /// Towards who sees it, unit length.
    normal: Vec3,
}

/// What an occluder hides from one point: all that lies on the inner side of every plane.
pub(super) struct Shadow([Vec4; 5]);

impl Occluder {
    /// The rectangles that a mesh contains.
    pub fn all_of(mesh: &Mesh) -> Vec<Self> {
        planes(mesh).flat_map(|plane| Grid::of(mesh, &plane)).flat_map(|grid| grid.rectangles()).collect()
    }

    /// What it hides from an eye; `None` if the eye is behind it, or so near that the view may begin behind it.
    pub fn shadow(&self, eye: Vec3) -> Option<Shadow> {
        let height = self.normal.dot(eye - self.corners[0]);
        // In view, nothing is more than twice as far away as it is deep.
        if height < 2.0 * NEAR {
            return None;
        }
        let plane = |normal: Vec3, at: Vec3| {
            let normal = normal.normalize();
            normal.extend(-normal.dot(at) - CLEARANCE)
        };
        let [a, b, c, d] = self.corners;
        let side = |from: Vec3, to: Vec3| plane((eye - from).cross(to - from), from);
        Some(Shadow([plane(-self.normal, a), side(a, b), side(b, c), side(c, d), side(d, a)]))
    }

    /// Where it is.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.corners)
    }
}

impl Shadow {
    /// Whether all of a box lies in it.
    pub fn hides(&self, bounds: &Bounds) -> bool {
        self.0.iter().all(|plane| bounds.is_inside(plane))
    }
}

/// Where a view is seen from: the point that has no place in the image. `None` without perspective.
pub(super) fn eye(clip_from_world: &Mat4) -> Option<Vec3> {
    let [x, y, w] = [0, 1, 3].map(|row| clip_from_world.row(row));
    // x = y = w = 0, by Cramer's rule.
    let (across, down, ahead) = (y.xyz().cross(w.xyz()), w.xyz().cross(x.xyz()), x.xyz().cross(y.xyz()));
    let eye = -(across * x.w + down * y.w + ahead * w.w) / x.xyz().dot(across);
    eye.is_finite().then_some(eye)
}

/// Triangles of a mesh that lie in one plane, nearly, and face one way.
fn planes(mesh: &Mesh) -> impl Iterator<Item = Vec<[u32; 3]>> {
    let mut planes: BTreeMap<[i32; 4], Vec<[u32; 3]>> = BTreeMap::new();
    for &triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(triangle);
        if let Some(normal) = (b - a).cross(c - a).try_normalize() {
            // Thousandths, and millimetres. Where rounding parts a plane, it hides less.
            let key = normal.extend(normal.dot(a)).to_array().map(|value| (1000.0 * value).round() as i32);
            planes.entry(key).or_default().push(triangle);
        }
    }
    planes.into_values()
}

/// A plane's triangles as cells of an uneven grid.
struct Grid {
    /// Of the grid's frame: where (0, 0) is, and its axes.
    origin: Vec3,
    right: Vec3,
    up: Vec3,
    columns: Vec<f32>,
    rows: Vec<f32>,
    /// Row after row: whether two triangles fill the cell.
    filled: Vec<bool>,
}

impl Grid {
    /// `None` if the triangles are not the halves of a grid's cells.
    fn of(mesh: &Mesh, triangles: &[[u32; 3]]) -> Option<Self> {
        // Along an edge of a triangle that has a right angle, any.
        let [a, b, c] = mesh.corners(triangles[0]);
        let square = [[a, b, c], [b, c, a], [c, a, b]].into_iter().find(|[at, left, right]| {
            (left - at).normalize_or_zero().dot((right - at).normalize_or_zero()).abs() < 1e-4
        })?;
        let right = (square[1] - square[0]).normalize();
        let normal = (b - a).cross(c - a).normalize();
        let up = normal.cross(right);
        let flat = |point: Vec3| vec2(right.dot(point - a), up.dot(point - a));
        let corners = |triangle: &[u32; 3]| mesh.corners(*triangle).map(flat);
        let off_plane = |point: Vec3| normal.dot(point - a).abs() > SAME_PLACE;
        if triangles.iter().any(|&triangle| mesh.corners(triangle).into_iter().any(off_plane)) {
            return None;
        }
        let all: Vec<Vec2> = triangles.iter().flat_map(corners).collect();
        let columns = distinct(all.iter().map(|point| point.x));
        let rows = distinct(all.iter().map(|point| point.y));
        let cells = columns.len() - 1;
        let mut halves = vec![0; cells * (rows.len() - 1)];
        for triangle in triangles {
            let [a, b, c] = corners(triangle);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let [column, row] = [index_of(&columns, low.x), index_of(&rows, low.y)];
            let (end_column, end_row) = (index_of(&columns, high.x), index_of(&rows, high.y));
            let area = 0.5 * (b - a).perp_dot(c - a);
            let half = 0.5 * (high - low).element_product();
            if [end_column, end_row] != [column + 1, row + 1] || (area - half).abs() > 1e-3 * half {
                return None;
            }
            halves[row * cells + column] += 1;
        }
        Some(Self { origin: a, right, up, columns, rows, filled: halves.iter().map(|&count| count == 2).collect() })
    }

    /// Takes the largest filled rectangle, then the largest of what is left, as long as they are large.
    fn rectangles(mut self) -> Vec<Occluder> {
        let mut found = Vec::new();
        while let Some([left, right, bottom, top]) = self.largest() {
            let width = self.columns.len() - 1;
            for row in bottom..top {
                self.filled[row * width + left..row * width + right].fill(false);
            }
            let corner =
                |column: usize, row: usize| self.origin + self.columns[column] * self.right + self.rows[row] * self.up;
            let corners = [corner(left, bottom), corner(right, bottom), corner(right, top), corner(left, top)];
            found.push(Occluder { corners, normal: self.right.cross(self.up) });
        }
        found
    }

    /// Columns and rows of the largest filled rectangle: from, to. `None` if it is too small.
    fn largest(&self) -> Option<[usize; 4]> {
        let width = self.columns.len() - 1;
        let mut best = (SMALLEST_AREA, None);
        for bottom in 0..self.rows.len() - 1 {
            let mut free = vec![true; width];
            for top in bottom..self.rows.len() - 1 {
                for (free, filled) in free.iter_mut().zip(&self.filled[top * width..][..width]) {
                    *free &= filled;
                }
                let height = self.rows[top + 1] - self.rows[bottom];
                let mut left = 0;
                for run in free.chunk_by(|a, b| a == b) {
                    let right = left + run.len();
                    let area = height * (self.columns[right] - self.columns[left]);
                    if run[0] && area > best.0 {
                        best = (area, Some([left, right, bottom, top + 1]));
                    }
                    left = right;
                }
            }
        }
        best.1
    }
}

/// In order, those that are one counted once.
fn distinct(values: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut values: Vec<f32> = values.collect();
    values.sort_by(f32::total_cmp);
    values.dedup_by(|a, b| *a - *b < SAME_PLACE);
    values
}

/// Of the value in an ordered list that is nearest.
fn index_of(values: &[f32], value: f32) -> usize {
    values.partition_point(|&other| other < value - SAME_PLACE).min(values.len() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::view::clip_from_camera;

    /// A wall of 6 × 3 cells of half a metre in the plane y = 0, seen from the south, with a hole in its lower middle.
    fn wall() -> Mesh {
        let mut mesh = Mesh::default();
        for z in 0..=3 {
            mesh.positions.extend((0..=6).map(|x| [0.5 * x as f32, 0.0, 0.5 * z as f32]));
        }
        for cell in 0..18 {
            let (column, row) = (cell % 6, cell / 6);
            if row == 2 || !(2..4).contains(&column) {
                let first = row * 7 + column;
                mesh.triangles.extend([[first, first + 1, first + 8], [first, first + 8, first + 7]]);
            }
        }
        mesh
    }

    #[test]
    fn a_wall_with_a_hole_is_what_is_beside_it() {
        let found = Occluder::all_of(&wall());
        let areas: Vec<f32> = found
            .iter()
            .map(|found| {
                let [a, b, _, d] = found.corners;
                a.distance(b) * a.distance(d)
            })
            .collect();
        assert_eq!(areas, [1.5, 1.5], "two sides, and a lintel that is too small");
        assert!(found.iter().all(|found| found.normal.abs_diff_eq(Vec3::NEG_Y, 1e-6)));
    }

    #[test]
    fn only_what_is_wholly_behind_is_hidden() {
        let found = Occluder::all_of(&wall());
        let left = found.iter().find(|found| found.corners.iter().all(|corner| corner.x < 1.1)).unwrap();
        let hides = |eye: Vec3, middle: Vec3, half: f32| {
            let bounds = Bounds::of([middle - half, middle + half]);
            left.shadow(eye).is_some_and(|shadow| shadow.hides(&bounds))
        };
        let (eye, behind) = (Vec3::new(0.5, -2.0, 0.75), Vec3::new(0.5, 1.0, 0.75));
        assert!(hides(eye, behind, 0.1) && hides(eye, behind, 0.59));
        assert!(!hides(eye, behind, 0.61), "it looks out at the sides");
        assert!(!hides(eye, Vec3::new(0.5, -1.0, 0.75), 0.1), "it is in front");
        assert!(!hides(eye, Vec3::new(0.5, 0.05, 0.75), 0.1), "it reaches through the wall");
        assert!(!hides(Vec3::new(0.5, 2.0, 0.75), Vec3::new(0.5, -1.0, 0.75), 0.1), "a wall's back is not drawn");
        assert!(!hides(Vec3::new(0.5, -0.09, 0.75), behind, 0.1), "the view may begin behind the wall");
    }

    #[test]
    fn triangles_that_are_no_grid_hide_nothing() {
        let mut mesh = wall();
        mesh.positions[8] = [0.6, 0.0, 0.6];
        assert!(Occluder::all_of(&mesh).is_empty());
    }

    #[test]
    fn the_eye_is_where_the_camera_is() {
        let clip = clip_from_camera(Vec2::splat(500.0), vec2(320.0, 240.0), vec2(640.0, 480.0), 0.1);
        let place = Vec3::new(3.0, -2.0, 0.6);
        let camera_from_world = Mat4::from_rotation_y(0.7) * Mat4::from_translation(-place);
        assert!(eye(&(clip * camera_from_world)).unwrap().abs_diff_eq(place, 1e-5));
        assert!(eye(&camera_from_world).is_none());
    }
}
