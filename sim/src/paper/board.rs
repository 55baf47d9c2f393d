//! A chequered board on a stand, and the Kinect before it.

use glam::{DAffine3, DVec2, DVec3};
use nalgebra::{Isometry3, Point2, Point3};
use sunblind_estimator::camera::CameraModel;

use crate::kinect::calibration::Calibration;
use crate::kinect::{Imaging, Kinect, KinectFrame};
use crate::render::{RenderError, Sweep};
use crate::validation::scene::{Light, chequered, even, facing_wall, looking_north, object, panel, world};
use crate::world::World;

/// Squares along each edge, of which the corners within are measured: 10 × 10.
const SQUARES: u8 = 11;
/// The board's turn about the vertical, back, and in its own plane, degrees: it is no plane of equal depth, and no edge lies
/// along a row of pixels.
const TURN_DEG: [f64; 3] = [8.0, 5.0, 12.0];
/// The wall behind the board, metres.
const WALL: f32 = 1.5;

/// From the infrared camera to half way between the two, metres: that is before the board's middle.
pub const BESIDE: f64 = 0.0125;

/// Albedo at 830 nm of carbon black, as in toner; rubber and plastic with carbon have 4–6 %.
pub const CARBON: f32 = 0.05;
/// Of paper, visible and at 830 nm; as of white paint.
const PAPER: f32 = 0.8;

/// The board. Its middle is the world's origin.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Edge of a square, metres.
    pub square: f64,
    /// Albedo at 830 nm of the squares that are black to the eye.
    pub black: f32,
}

impl Board {
    /// Along the board to the right and up, and towards its front.
    fn axes() -> [DVec3; 3] {
        let [aside, back, roll] = TURN_DEG.map(f64::to_radians);
        let level = DVec3::new(aside.cos(), aside.sin(), 0.0);
        let towards = level.cross(DVec3::Z) * back.cos() + DVec3::Z * back.sin();
        let upright = towards.cross(level);
        let right = level * roll.cos() + upright * roll.sin();
        [right, towards.cross(right), towards]
    }

    /// Metres.
    fn edge(&self) -> f64 {
        f64::from(SQUARES) * self.square
    }

    /// The corners within, row by row from the lower left.
    pub fn corners(&self) -> Vec<DVec3> {
        let [right, up, _] = Self::axes();
        let place = |number: u8| f64::from(number) * self.square - self.edge() / 2.0;
        let inner = 1..SQUARES;
        inner.clone().flat_map(|row| inner.clone().map(move |column| right * place(column) + up * place(row))).collect()
    }

    /// Where a ray meets the board, if it does.
    pub fn hit(&self, from: DVec3, along: DVec3) -> Option<DVec3> {
        let [right, up, towards] = Self::axes();
        let at = from - along * (from.dot(towards) / along.dot(towards));
        let inside = DVec2::new(at.dot(right), at.dot(up)).abs().max_element() < self.edge() / 2.0;
        inside.then_some(at)
    }

    /// The board before a wall.
    pub fn world(&self, light: Light) -> World {
        let [right, up, _] = Self::axes().map(|axis| axis.as_vec3());
        let edge = self.edge() as f32;
        let mut mesh = panel(-0.5 * edge * (right + up), [edge * right, edge * up], 1, light);
        // The texture is two squares wide.
        mesh.uvs.as_flattened_mut().iter_mut().for_each(|metres| *metres /= 2.0 * self.square as f32);
        // In sRGB, 5 % and 80 %.
        let (black, paper) = (63, 231);
        let infrared = |albedo: f32| (255.0 * albedo).round() as u8;
        let dark = [black, black, black, infrared(self.black)];
        let board = chequered("board", dark, [paper, paper, paper, infrared(PAPER)], 2);
        let objects = vec![object("wall", facing_wall(WALL, light), 0), object("board", mesh, 1)];
        world("board", objects, vec![even("paint", [200, 200, 200], 0.6), board])
    }
}

/// One single frame, and the truth.
pub struct Shot {
    pub frame: KinectFrame,
    world_from_infrared: DAffine3,
    unit: Calibration,
}

/// What one unit sees of a board from distances, metres, each for the first time.
///
/// # Errors
/// No graphics adapter, or one that stopped working.
pub fn shots(board: &Board, light: Light, unit: &Calibration, seed: u64, z: &[f64]) -> Result<Vec<Shot>, RenderError> {
    let mut kinect = Kinect::new(&board.world(light), unit.clone(), Imaging::default(), seed)?;
    let mut shot = |(number, &z): (usize, &f64)| {
        let place = DAffine3::from_translation(DVec3::new(-BESIDE, -z, 0.0));
        let world_from_infrared = place * looking_north();
        kinect.restart();
        let frame = kinect.capture(&Sweep::still(world_from_infrared), number as u64)?;
        Ok(Shot { frame, world_from_infrared, unit: unit.clone() })
    };
    z.iter().enumerate().map(&mut shot).collect()
}

impl Shot {
    /// A point of the world in the infrared and in the colour camera's true frame.
    pub fn true_place(&self, point: DVec3) -> [Point3<f64>; 2] {
        let seen = self.world_from_infrared.inverse().transform_point3(point);
        let seen = Point3::new(seen.x, seen.y, seen.z);
        [seen, self.unit.colour_from_infrared * seen]
    }

    /// What of the board a pixel of the infrared (or colour) image shows, in the colour camera's true frame.
    pub fn truth_at(&self, board: &Board, is_infrared: bool, pixel: Point2<f64>) -> Option<Point3<f64>> {
        let from = match is_infrared {
            true => Isometry3::identity(),
            false => self.unit.colour_from_infrared.inverse(),
        };
        let (start, along) = (from.translation.vector, from.rotation * self.camera(is_infrared).ray(&pixel));
        let in_world = self.world_from_infrared;
        let hit = board.hit(
            in_world.transform_point3(DVec3::new(start.x, start.y, start.z)),
            in_world.transform_vector3(DVec3::new(along.x, along.y, along.z)),
        )?;
        Some(self.true_place(hit)[1])
    }

    /// The unit's infrared or colour camera as it truly is.
    pub fn camera(&self, is_infrared: bool) -> &CameraModel {
        if is_infrared { &self.unit.infrared } else { &self.unit.colour }
    }
}
