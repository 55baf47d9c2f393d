//! A world from above, as a floor plan shows it.

use std::collections::BTreeMap;

use super::ground::Ground;
use super::{Mesh, Object, World};

/// Heights above the ground between which things are cut and seen from above, metres: above skirting boards and thresholds, below
/// windows' sills, and including desks.
const BAND: [f32; 2] = [0.1, 0.85];
/// What is narrower is a line, millimetres.
const LINE: f64 = 20.0;
/// A line of something that rises higher is a wall, metres: no furniture's side does.
const WALL: f32 = 2.15;
/// What is smaller is left out (a chair's leg), millimetres.
const SMALLEST: f64 = 100.0;

/// What stands in a robot's way, seen from above: x, y in the world, metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Walls' faces: lines with two ends. They are as wide as a reader draws them.
    pub walls: Vec<[[f64; 2]; 2]>,
    /// Convex outlines of everything else, the largest first, the last corner joined to the first.
    pub furniture: Vec<Vec<[f64; 2]>>,
}

/// A point from above, millimetres: whole numbers, so that corners that meet are equal.
type Point = [i64; 2];

impl Plan {
    /// The plan of what a robot can bump into.
    pub fn of(world: &World) -> Self {
        let mut plan = Self::default();
        let mut furniture = Vec::new();
        for object in world.objects.iter().filter(|object| object.collides) {
            for outline in pieces(&object.mesh, &world.ground).into_iter().map(convex_hull) {
                let (length, ends) = longest(&outline);
                if length < SMALLEST {
                    continue;
                }
                let area = area(&outline);
                if area < LINE * length && rises_to_a_ceiling(object) {
                    plan.walls.push(ends.map(metres));
                } else {
                    furniture.push((area, outline));
                }
            }
        }
        furniture.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        plan.furniture = furniture.into_iter().map(|(_, outline)| outline.into_iter().map(metres).collect()).collect();
        plan
    }
}

fn rises_to_a_ceiling(object: &Object) -> bool {
    object.mesh.bounds()[1].z > WALL
}

/// The corners of each piece of a mesh that hangs together within the band, cut at its edges. A wall with a door falls
/// into two, because what joins them is above.
fn pieces(mesh: &Mesh, ground: &Ground) -> Vec<Vec<Point>> {
    let mut groups = Groups::default();
    let mut cut = Vec::new();
    for &triangle in &mesh.triangles {
        let corners = mesh.corners(triangle).map(|corner| {
            let [x, y, z] = corner.to_array();
            [x, y, z - ground.height(x.into(), y.into()) as f32]
        });
        let corners_in_band = within_band(&corners);
        if corners_in_band.is_empty() {
            continue;
        }
        let [a, b, c] = corners.map(|corner| groups.corner(corner));
        groups.join(a, b);
        groups.join(a, c);
        cut.push((a, corners_in_band));
    }
    let mut pieces: BTreeMap<usize, Vec<Point>> = BTreeMap::new();
    for (corner, points) in cut {
        pieces.entry(groups.root(corner)).or_default().extend(points);
    }
    pieces.into_values().collect()
}

/// What of a triangle lies in the band, from above; nothing if it only touches it.
fn within_band(corners: &[[f32; 3]; 3]) -> Vec<Point> {
    let [low, high] = BAND;
    let above = corners.iter().any(|corner| corner[2] > low);
    let below = corners.iter().any(|corner| corner[2] < high);
    if !(above && below) {
        return Vec::new();
    }
    let mut points: Vec<Point> =
        corners.iter().filter(|corner| (low..=high).contains(&corner[2])).map(|&[x, y, _]| millimetres(x, y)).collect();
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        let ([x, y, z], [to_x, to_y, to_z]) = (corners[from], corners[to]);
        for edge in BAND {
            if (z < edge) != (to_z < edge) {
                let share = (edge - z) / (to_z - z);
                points.push(millimetres(x + share * (to_x - x), y + share * (to_y - y)));
            }
        }
    }
    points
}

fn millimetres(x: f32, y: f32) -> Point {
    [x, y].map(|value| (1e3 * value).round() as i64)
}

fn metres(point: Point) -> [f64; 2] {
    point.map(|value| value as f64 * 1e-3)
}

/// Corners by place, and which of them hang together.
#[derive(Default)]
struct Groups {
    index: BTreeMap<[i64; 3], usize>,
    parent: Vec<usize>,
}

impl Groups {
    fn corner(&mut self, place: [f32; 3]) -> usize {
        let next = self.parent.len();
        let index = *self.index.entry(place.map(|value| (1e3 * value).round() as i64)).or_insert(next);
        if index == next {
            self.parent.push(next);
        }
        index
    }

    fn root(&mut self, mut index: usize) -> usize {
        while self.parent[index] != index {
            self.parent[index] = self.parent[self.parent[index]];
            index = self.parent[index];
        }
        index
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.parent[one] = other;
    }
}

/// The convex hull, anticlockwise (Andrew, Information Processing Letters 1979). No three of its corners are in line.
fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_unstable();
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let chain = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0 {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    [chain(&mut points.iter().copied()), chain(&mut points.iter().rev().copied())].concat()
}

/// Twice the area of a triangle; above zero for a turn to the left.
fn turn(a: Point, b: Point, c: Point) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Of a convex outline, mm².
fn area(outline: &[Point]) -> f64 {
    outline.windows(2).map(|pair| 0.5 * turn(outline[0], pair[0], pair[1]) as f64).sum()
}

/// The two corners furthest apart, and how far that is, mm.
fn longest(outline: &[Point]) -> (f64, [Point; 2]) {
    let pairs = outline.iter().enumerate().flat_map(|(index, &a)| outline[index..].iter().map(move |&b| [a, b]));
    let length = |[a, b]: [Point; 2]| ((b[0] - a[0]) as f64).hypot((b[1] - a[1]) as f64);
    pairs.map(|ends| (length(ends), ends)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, [[0; 2]; 2]))
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};

    use super::*;
    use crate::world::laboratory::{laboratory, loop_waypoints};
    use crate::world::shape::Mapping;

    fn world(mesh: Mesh) -> World {
        let object = Object { name: "thing".into(), mesh, material: 0, collides: true };
        World { name: "test".into(), objects: vec![object], ..World::default() }
    }

    fn cuboid(min: [f32; 3], max: [f32; 3]) -> World {
        world(Mesh::cuboid(min.into(), max.into(), Mapping::Fitted))
    }

    #[test]
    fn a_box_is_its_footprint_if_a_robot_meets_it() {
        let plan = Plan::of(&cuboid([1.0, 2.0, 0.0], [1.5, 3.0, 2.5]));
        assert_eq!(plan.furniture, [[[1.0, 2.0], [1.5, 2.0], [1.5, 3.0], [1.0, 3.0]]]);
        assert!(plan.walls.is_empty());
        for heights in [[0.0, 0.05], [1.2, 2.0]] {
            let plan = Plan::of(&cuboid([1.0, 2.0, heights[0]], [1.5, 3.0, heights[1]]));
            assert_eq!(plan, Plan::default(), "{heights:?}");
        }
        let mut picture = cuboid([1.0, 2.0, 0.0], [1.5, 3.0, 2.0]);
        picture.objects[0].collides = false;
        assert_eq!(Plan::of(&picture), Plan::default());
    }

    #[test]
    fn a_wall_is_open_where_its_door_is() {
        let (columns, rows) = (vec![0.0, 2.0, 3.0, 5.0], vec![0.0, 0.6, 2.7]);
        let is_door = |column: usize, row: usize| column == 1 && row == 1;
        let face = Mesh::grid(vec3(0.0, 4.0, 2.7), Vec3::X, -Vec3::Z, [&columns, &rows], is_door, Mapping::Fitted);
        let plan = Plan::of(&world(face));
        assert_eq!(plan.walls, [[[0.0, 4.0], [2.0, 4.0]], [[3.0, 4.0], [5.0, 4.0]]]);
        assert!(plan.furniture.is_empty());
    }

    #[test]
    fn the_way_through_the_laboratory_is_free() {
        let plan = Plan::of(&laboratory(1));
        assert!(plan.walls.len() > 8 && plan.furniture.len() > 20);
        let inside = |outline: &[[f64; 2]], [x, y]: [f64; 2]| {
            let ends = outline.iter().zip(outline.iter().cycle().skip(1));
            outline.len() > 2 && ends.clone().all(|(a, b)| (b[0] - a[0]) * (y - a[1]) > (b[1] - a[1]) * (x - a[0]))
        };
        for point in loop_waypoints() {
            assert!(!plan.furniture.iter().any(|outline| inside(outline, point)), "{point:?}");
        }
        let corners = plan.walls.iter().flatten().chain(plan.furniture.iter().flatten());
        assert!(corners.clone().all(|&[x, y]| (-0.4..12.4).contains(&x) && (-0.4..9.4).contains(&y)));
    }
}
