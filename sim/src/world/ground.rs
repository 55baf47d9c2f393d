//! The ground: what it is made of where, and how high it lies.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// What covers the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // the names say it
pub enum Cover {
    #[default]
    Tile,
    Carpet,
    Concrete,
    Asphalt,
    Grass,
    Gravel,
}

/// A rectangle of one cover in the world's x and y, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoveredArea {
    /// South-west corner.
    pub min: [f64; 2],
    /// North-east corner.
    pub max: [f64; 2],
    /// What lies there.
    pub cover: Cover,
}

/// What a robot drives on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// Wherever no area is.
    pub elsewhere: Cover,
    /// The last one that covers a place counts, as with carpets.
    pub areas: Vec<CoveredArea>,
    /// Where the ground is not level. Objects that show it don't collide: the terrain stands for them.
    pub terrain: Option<Terrain>,
}

/// Heights on a square lattice over a rectangle; around it the ground lies at 0. Between lattice points it is flat
/// triangles: each cell is cut from its south-west to its north-east corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    /// South-west corner, metres.
    pub min: [f64; 2],
    /// Distance of neighbours, metres.
    pub pitch: f64,
    /// How many points lie in a row; at least 2.
    pub columns: usize,
    /// Metres; row after row from south to north, at least two rows.
    pub heights: Vec<f64>,
}

impl Terrain {
    /// The heights that a function of x and y has between two corners of the plan.
    pub fn sampled(min: [f64; 2], max: [f64; 2], pitch: f64, height: impl Fn(f64, f64) -> f64) -> Self {
        let [columns, rows] = [0, 1].map(|axis| 1 + ((max[axis] - min[axis]) / pitch).round().max(1.0) as usize);
        let at = |index: usize| {
            let [column, row] = [index % columns, index / columns];
            height(min[0] + pitch * column as f64, min[1] + pitch * row as f64)
        };
        Self { min, pitch, columns, heights: (0..columns * rows).map(at).collect() }
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.heights.len() / self.columns
    }

    /// The height at a place and its slope towards x and y; level outside.
    fn at(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        let [u, v] = [(x - self.min[0]) / self.pitch, (y - self.min[1]) / self.pitch];
        let [last_column, last_row] = [self.columns - 1, self.rows() - 1];
        if !(0.0..=last_column as f64).contains(&u) || !(0.0..=last_row as f64).contains(&v) {
            return (0.0, [0.0; 2]);
        }
        let [column, row] = [(u as usize).min(last_column - 1), (v as usize).min(last_row - 1)];
        let [u, v] = [u - column as f64, v - row as f64];
        let height = |right: usize, up: usize| self.heights[(row + up) * self.columns + column + right];
        let [south_west, south_east, north_west, north_east] = [height(0, 0), height(1, 0), height(0, 1), height(1, 1)];
        let rise = if v > u {
            [north_east - north_west, north_west - south_west]
        } else {
            [south_east - south_west, north_east - south_east]
        };
        (south_west + u * rise[0] + v * rise[1], rise.map(|rise| rise / self.pitch))
    }
}

impl Ground {
    /// How high it lies at a place, metres.
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.terrain.as_ref().map_or(0.0, |terrain| terrain.at(x, y).0)
    }

    /// The pose (`world_from_robot`) of who stands at a place, as level as the ground there is. `heading`:
    /// anticlockwise from x, radians. `reach`: how far from the middle its feet are, metres.
    pub fn standing(&self, x: f64, y: f64, heading: f64, reach: f64) -> Isometry3<f64> {
        if self.terrain.is_none() {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
            return Isometry3::from_parts(Translation3::new(x, y, 0.0), turn);
        }
        let (sin, cos) = heading.sin_cos();
        let at = |ahead: f64, left: f64| {
            let (x, y) = (x + ahead * cos - left * sin, y + ahead * sin + left * cos);
            Vector3::new(x, y, self.height(x, y))
        };
        let forward = (at(reach, 0.0) - at(-reach, 0.0)).normalize();
        let up = forward.cross(&(at(0.0, reach) - at(0.0, -reach))).normalize();
        let axes = Matrix3::from_columns(&[forward, up.cross(&forward), up]);
        let middle = (at(reach, 0.0) + at(-reach, 0.0) + at(0.0, reach) + at(0.0, -reach)) / 4.0;
        Isometry3::from_parts(
            Translation3::new(x, y, middle.z),
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 10° towards the north-east.
    fn slope() -> Ground {
        let rise = 10f64.to_radians().tan() / 2f64.sqrt();
        let terrain = Terrain::sampled([-2.0, -1.0], [3.0, 4.0], 0.25, |x, y| 1.0 + rise * (x + y));
        Ground { terrain: Some(terrain), ..Ground::default() }
    }

    #[test]
    fn heights_are_those_of_the_function_between_the_points_too() {
        let terrain = Terrain::sampled([0.0; 2], [2.0, 1.0], 0.5, |x, y| x - 3.0 * y);
        assert_eq!((terrain.columns, terrain.rows()), (5, 3));
        let ground = Ground { terrain: Some(terrain), ..Ground::default() };
        for [x, y] in [[0.0, 0.0], [0.3, 0.1], [0.1, 0.3], [1.99, 0.99], [2.0, 1.0]] {
            assert!((ground.height(x, y) - (x - 3.0 * y)).abs() < 1e-12, "{x}, {y}");
        }
        assert_eq!([ground.height(-0.1, 0.5), ground.height(1.0, 1.1)], [0.0; 2]);
    }

    #[test]
    fn who_stands_on_a_slope_leans_with_it_whichever_way_it_faces() {
        let uphill = 45f64.to_radians();
        for turn in [0.0, 1.0, -2.0] {
            let pose = slope().standing(0.5, 1.0, uphill + turn, 0.2);
            let up = pose.rotation * Vector3::z();
            assert!((up.z.acos().to_degrees() - 10.0).abs() < 1e-6 && up.x < 0.0 && up.y < 0.0, "{up}");
            assert!((pose.translation.z - slope().height(0.5, 1.0)).abs() < 1e-9);
            let forward = pose.rotation * Vector3::x();
            let off = forward.y.atan2(forward.x) - (uphill + turn);
            assert!(off.sin().abs() < 1e-9, "{off}");
        }
        let level = Ground::default().standing(1.0, 2.0, 0.3, 0.2);
        assert!((level.rotation.euler_angles().2 - 0.3).abs() < 1e-12 && level.translation.z == 0.0);
    }
}
