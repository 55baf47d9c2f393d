//! Houses round the yard, walls, fences, gates.

use glam::{Vec2, Vec3, vec3};

use crate::world::Mesh;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::{Place, cuts_no_longer_than};

/// How deep windows and doors lie in a wall, metres.
const REVEAL: f32 = 0.14;
/// Longest edge of a façade's triangles, metres.
const EDGE: f32 = 1.1;
/// How steep roofs are: rise over run.
const PITCH: f32 = 0.8;

/// What closes an opening.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fill {
    /// A picture of a window, with a sill below.
    Window,
    /// A picture of a door.
    Door,
    /// A picture of a garage door.
    Roller,
    /// Nothing: what is behind builds its own cheeks.
    Open,
}

/// A hole in a façade: along it from its left end and above the ground, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    pub along: [f32; 2],
    pub height: [f32; 2],
    pub fill: Fill,
}

/// A house's side, from left to right for who sees it.
pub(super) struct Facade<'a> {
    pub name: &'static str,
    pub from: [f32; 2],
    pub to: [f32; 2],
    /// Of the eaves, metres.
    pub height: f32,
    pub surface: Surface,
    /// Where it is cut into pieces, metres along.
    pub pieces: &'a [f32],
    pub openings: &'a [Opening],
}

impl Facade<'_> {
    fn place(&self) -> Place {
        Place::along(self.from.into(), self.to.into())
    }

    fn length(&self) -> f32 {
        Vec2::from(self.from).distance(self.to.into())
    }

    /// Builds the wall with its openings.
    pub fn build(&self, scene: &mut Scene) {
        let ends = [&[0.0], self.pieces, &[self.length()]].concat();
        for (index, pair) in ends.windows(2).enumerate() {
            let [left, right] = [pair[0], pair[1]];
            let within = |opening: &&Opening| left <= opening.along[0] && opening.along[1] <= right;
            let openings: Vec<Opening> = self.openings.iter().filter(within).copied().collect();
            scene.piece(&format!("{}, part {index}", self.name), Kind::Solid, self.place(), |piece| {
                self.face(piece, [left, right], &openings);
            });
            if openings.iter().any(|opening| opening.fill != Fill::Open) {
                let name = format!("{}, part {index}, openings", self.name);
                scene.piece(&name, Kind::Solid, self.place(), |piece| {
                    openings.iter().for_each(|opening| self.fill(piece, opening));
                });
            }
        }
    }

    fn face(&self, piece: &mut Piece, [left, right]: [f32; 2], openings: &[Opening]) {
        let cuts = |ends: [f32; 2], inner: Vec<f32>| {
            let mut cuts = [ends.to_vec(), inner].concat();
            cuts.sort_by(f32::total_cmp);
            cuts.dedup();
            cuts_no_longer_than(EDGE, &cuts)
        };
        let columns = cuts([0.0, right - left], openings.iter().flat_map(|o| o.along.map(|x| x - left)).collect());
        let rows = cuts([0.0, self.height], openings.iter().flat_map(|o| o.height.map(|z| self.height - z)).collect());
        let hole = |column: usize, row: usize| {
            let (x, z) = (left + columns[column] + 1e-3, self.height - rows[row] - 1e-3);
            let within = |[low, high]: [f32; 2], value: f32| low <= value && value <= high;
            openings.iter().any(|opening| within(opening.along, x) && within(opening.height, z))
        };
        let corner = vec3(left, 0.0, self.height);
        // Courses run on from piece to piece, and from the ground up.
        let mapping = self.surface.mapping_from([left, -self.height]);
        piece.mesh(self.surface, &Mesh::grid(corner, Vec3::X, -Vec3::Z, [&columns, &rows], hole, mapping));
    }

    fn fill(&self, piece: &mut Piece, &Opening { along: [left, right], height: [bottom, top], fill }: &Opening) {
        let picture = match fill {
            Fill::Window => Surface::HouseWindow,
            Fill::Door => Surface::HouseDoor,
            Fill::Roller => Surface::RollerDoor,
            Fill::Open => return,
        };
        let (into, width, down) = (vec3(0.0, REVEAL, 0.0), vec3(right - left, 0.0, 0.0), vec3(0.0, 0.0, bottom - top));
        for (corner, right, down) in [
            (vec3(left, 0.0, top), into, down),
            (vec3(right, REVEAL, top), -into, down),
            (vec3(left, 0.0, top), width, into),
        ] {
            let [columns, rows] = [right, down].map(|edge| cuts_no_longer_than(EDGE, &[0.0, edge.length()]));
            let mapping = piece.mapping(self.surface);
            piece.mesh(self.surface, &Mesh::grid(corner, right, down, [&columns, &rows], |_, _| false, mapping));
        }
        let [columns, rows] = [width, down].map(|edge| cuts_no_longer_than(0.8, &[0.0, edge.length()]));
        let mapping = piece.mapping(picture);
        let corner = vec3(left, REVEAL, top);
        piece.mesh(picture, &Mesh::grid(corner, width, down, [&columns, &rows], |_, _| false, mapping));
        match fill {
            Fill::Window => {
                piece.block(Surface::Concrete, [left - 0.06, -0.06, bottom - 0.07], [right + 0.06, REVEAL, bottom]);
            }
            _ => piece.block(Surface::Concrete, [left - 0.14, -0.02, top], [right + 0.14, 0.0, top + 0.2]),
        }
    }

    /// Eaves, gutter and the roof's slope above, `rise` metres high.
    pub fn roof(&self, scene: &mut Scene, rise: f32) {
        let out = 0.45;
        let ends = [-out, 0.5 * self.length(), self.length() + out];
        for (index, pair) in ends.windows(2).enumerate() {
            scene.piece(&format!("{}, roof {index}", self.name), Kind::Decor, self.place(), |piece| {
                self.roof_part(piece, [pair[0], pair[1]], out, rise);
            });
        }
    }

    fn roof_part(&self, piece: &mut Piece, [left, right]: [f32; 2], out: f32, rise: f32) {
        let (eaves, low) = (self.height, self.height - 0.12);
        piece.block(Surface::Timber, [left, 0.06 - out, low], [right, 0.0, eaves]);
        let columns = cuts_no_longer_than(2.0, &[0.0, right - left]);
        let mut face = |surface: Surface, corner: Vec3, down: Vec3| {
            let rows = cuts_no_longer_than(2.0, &[0.0, down.length()]);
            let mapping = piece.mapping(surface);
            piece.mesh(surface, &Mesh::grid(corner, Vec3::X, down, [&columns, &rows], |_, _| false, mapping));
        };
        // The eaves' underside, which is what one sees from below.
        face(Surface::Timber, vec3(left, 0.06 - out, low), vec3(0.0, out - 0.06, 0.0));
        let depth = rise / PITCH;
        let ridge = vec3(left, depth, eaves + 0.05 + PITCH * (depth + out));
        face(Surface::RoofTile, ridge, (depth + out) * vec3(0.0, -1.0, -PITCH));
        piece.tube(Surface::GreyCoat, [left, -out, eaves + 0.02], [right, -out, eaves + 0.02], [0.06; 2]);
    }

    /// A rainwater pipe with its brackets.
    pub fn downpipe(&self, scene: &mut Scene, along: f32) {
        scene.piece(&format!("{}, downpipe at {along}", self.name), Kind::Solid, self.place(), |piece| {
            piece.tube(Surface::GreyCoat, [along, -0.09, 0.12], [along, -0.09, self.height - 0.1], [0.045; 2]);
            piece.tube(Surface::GreyCoat, [along, -0.09, 0.14], [along, -0.2, 0.06], [0.045; 2]);
            for z in [0.8, 2.6, 4.4] {
                piece.block(Surface::DarkCoat, [along - 0.06, -0.14, z], [along + 0.06, 0.0, z + 0.03]);
            }
        });
    }
}

/// A wall that stands by itself, with a coping, between two points of its middle line.
pub(super) fn wall(
    scene: &mut Scene,
    name: &str,
    surface: Surface,
    [from, to]: [[f32; 2]; 2],
    thickness: f32,
    height: f32,
) {
    let [from, to] = [from, to].map(Vec2::from);
    let (place, length) = (Place::along(from, to), from.distance(to));
    let pieces = (length / 6.0).ceil().max(1.0);
    let part = length / pieces;
    for index in 0..pieces as u32 {
        let left = part * index as f32;
        scene.piece(&format!("{name}, part {index}"), Kind::Solid, place, |piece| {
            let half = 0.5 * thickness;
            piece.block(surface, [left, -half, -0.1], [left + part, half, height]);
            piece.block(Surface::Concrete, [left, -half - 0.03, height], [left + part, half + 0.03, height + 0.06]);
        });
    }
}

/// A fence of upright boards on posts, its boarded side to −y of the line from `from` to `to`.
pub(super) fn fence(scene: &mut Scene, name: &str, [from, to]: [[f32; 2]; 2], bottom: f32, top: f32) {
    let [from, to] = [from, to].map(Vec2::from);
    scene.piece(name, Kind::Solid, Place::along(from, to), |piece| {
        let length = from.distance(to);
        piece.block(Surface::Planks, [0.0, -0.02, bottom], [length, 0.02, top]);
        for post in 0..=(length / 1.8).ceil() as u32 {
            // Not at a corner: light is kept there.
            let x = (1.8 * post as f32).min(length - 0.15).max(0.15);
            piece.block(Surface::Timber, [x - 0.045, 0.02, bottom - 0.1], [x + 0.045, 0.11, top + 0.05]);
        }
        for z in [bottom + 0.25, top - 0.25] {
            piece.block(Surface::Timber, [0.0, 0.02, z], [length, 0.06, z + 0.09]);
        }
    });
}
