//! Puts a world together, piece by piece.

use std::collections::{BTreeMap, BTreeSet};

use glam::{Vec3, vec3};

use super::material::{self, Surface};
use super::shape::{Mapping, Place, cuts_no_longer_than};
use super::{Lamp, Mesh, Object, World};

/// How long an edge of a coarse box may be, metres.
const COARSE: f32 = 1.0;

/// A world under construction.
#[derive(Default)]
pub(super) struct Scene {
    objects: Vec<Object>,
    lamps: Vec<Lamp>,
    /// Where all that is added is put.
    origin: Place,
}

/// What a piece is to a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// It stands in the way.
    Solid,
    /// It hangs on a wall or lies on a table, out of the way.
    Decor,
}

impl Scene {
    /// Builds something in the frame of `place`, all of it: a building on its site.
    pub fn within(&mut self, place: Place, build: impl FnOnce(&mut Self)) {
        let outer = self.origin;
        self.origin = outer.then(place);
        build(self);
        self.origin = outer;
    }

    /// Adds a thing that `build` makes in the frame of `place`; one object for each of its surfaces.
    pub fn piece(&mut self, name: &str, kind: Kind, place: Place, build: impl FnOnce(&mut Piece)) {
        let number = self.objects.len() as f32;
        // Golden-section steps: pieces that follow each other show far-apart parts of a texture.
        let shift = [(0.618 * number).fract(), (0.414 * number).fract()];
        let mut piece = Piece { shift, meshes: BTreeMap::new() };
        build(&mut piece);
        for (surface, mesh) in piece.meshes {
            self.objects.push(Object {
                name: format!("{name}, {surface:?}"),
                mesh: mesh.placed(&self.origin.then(place)),
                material: surface.index(),
                collides: kind == Kind::Solid,
            });
        }
    }

    /// Adds a light.
    pub fn lamp(&mut self, mut lamp: Lamp) {
        let turned = |edge: [f32; 3]| (self.origin.point(edge.into()) - self.origin.at).to_array();
        lamp.half_edges = lamp.half_edges.map(turned);
        lamp.centre = self.origin.point(lamp.centre.into()).to_array();
        self.lamps.push(lamp);
    }

    /// What has been built, with materials painted from `seed`: those that are used, for each takes its time and its
    /// memory.
    pub fn finish(mut self, name: &str, seed: u64) -> World {
        let used: BTreeSet<usize> = self.objects.iter().map(|object| object.material).collect();
        let used: Vec<usize> = used.into_iter().collect();
        for object in &mut self.objects {
            object.material = used.binary_search(&object.material).expect("it was found in this very list");
        }
        let surfaces: Vec<Surface> = used.into_iter().map(|index| Surface::ALL[index]).collect();
        World {
            name: name.to_owned(),
            objects: self.objects,
            materials: material::materials(&surfaces, seed),
            lamps: self.lamps,
            ..World::default()
        }
    }
}

/// A thing while it is made, in its own frame: x to its right, y to its back, z up, its front faces −y. Metres.
pub(super) struct Piece {
    shift: [f32; 2],
    meshes: BTreeMap<Surface, Mesh>,
}

impl Piece {
    /// Adds any mesh.
    pub fn mesh(&mut self, surface: Surface, mesh: &Mesh) {
        self.meshes.entry(surface).or_default().append(mesh);
    }

    /// How a surface's texture lies on this piece.
    pub fn mapping(&self, surface: Surface) -> Mapping {
        surface.mapping(self.shift)
    }

    /// An upright box between two corners.
    pub fn cuboid(&mut self, surface: Surface, min: [f32; 3], max: [f32; 3]) {
        self.mesh(surface, &Mesh::cuboid(min.into(), max.into(), self.mapping(surface)));
    }

    /// An upright box without its bottom, cut no finer than it must be: for what is large, or small and many. What
    /// shades it is seen at its corners only.
    pub fn block(&mut self, surface: Surface, min: [f32; 3], max: [f32; 3]) {
        let ([min, max], mapping) = ([min, max].map(Vec3::from), self.mapping(surface));
        let size = max - min;
        let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
        for (corner, right, down) in [
            (min + z, x, -z),      // south
            (max, -x, -z),         // north
            (min + x + z, y, -z),  // east
            (min + y + z, -y, -z), // west
            (min + y + z, x, -y),  // up
        ] {
            let [columns, rows] = [right, down].map(|edge| cuts_no_longer_than(COARSE, &[0.0, edge.length()]));
            self.mesh(surface, &Mesh::grid(corner, right, down, [&columns, &rows], |_, _| false, mapping));
        }
    }

    /// A round bar of many metres, without flat ends, cut no finer than it must be.
    pub fn tube(&mut self, surface: Surface, from: [f32; 3], to: [f32; 3], radii: [f32; 2]) {
        let sides = if radii[0].max(radii[1]) < 0.08 { 6 } else { 9 };
        let mapping = self.mapping(surface);
        self.mesh(surface, &Mesh::tube(from.into(), to.into(), radii, sides, mapping));
    }

    /// A round bar.
    pub fn bar(&mut self, surface: Surface, from: [f32; 3], to: [f32; 3], radius: f32) {
        self.cone(surface, from, to, [radius; 2]);
    }

    /// A round bar with a radius at each end.
    pub fn cone(&mut self, surface: Surface, from: [f32; 3], to: [f32; 3], radii: [f32; 2]) {
        let sides = match radii[0].max(radii[1]) {
            ..0.03 => 6,
            ..0.1 => 10,
            _ => 18,
        };
        self.mesh(surface, &Mesh::cylinder(from.into(), to.into(), radii, sides, self.mapping(surface)));
    }

    /// A flat face, given its top left corner, upper and left edge as seen from where it shows.
    pub fn face(&mut self, surface: Surface, corner: Vec3, right: Vec3, down: Vec3) {
        self.mesh(surface, &Mesh::quad(corner, right, down, self.mapping(surface)));
    }

    /// A picture on a front: `left` to `right` and `bottom` to `top`, a hair before `y`.
    pub fn front(&mut self, surface: Surface, [left, right]: [f32; 2], [bottom, top]: [f32; 2], y: f32) {
        let corner = vec3(left, y - 0.002, top);
        self.face(surface, corner, vec3(right - left, 0.0, 0.0), vec3(0.0, 0.0, bottom - top));
    }

    /// A picture on a top that reads right from the front: `left` to `right`, `near` to `far`, a hair above `z`.
    pub fn top(&mut self, surface: Surface, [left, right]: [f32; 2], [near, far]: [f32; 2], z: f32) {
        let corner = vec3(left, far, z + 0.002);
        self.face(surface, corner, vec3(right - left, 0.0, 0.0), vec3(0.0, near - far, 0.0));
    }
}
