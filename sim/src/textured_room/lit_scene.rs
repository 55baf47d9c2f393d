//! The room as the cameras find it: its solids, and on each face a picture of the light that leaves it.

use glam::{Mat3A, Quat, Vec2, Vec3, Vec3A};
use nalgebra::Isometry3;
use rayon::prelude::*;

use super::layout::ROOM;
use super::light::Light;
use super::scene::{Hit, Scene};
use super::solid::{Face, Ray, Solid};
use super::texture::Texture;

/// Distance between the points at which light is worked out, metres; between them it is interpolated.
const LIGHT_GRID: f32 = 0.06;

/// Solids and their pictures.
pub struct LitScene {
    scene: Scene,
    /// Six a solid.
    pictures: Vec<Texture>,
}

impl LitScene {
    /// Lights a scene: a few seconds.
    pub fn new(scene: Scene) -> Self {
        let light = Light::new(&scene);
        let faces: Vec<_> = scene.solids().iter().flat_map(|solid| Face::ALL.map(|face| (solid, face))).collect();
        let pictures = faces.into_par_iter().map(|(solid, face)| picture(&light, solid, face)).collect();
        Self { scene, pictures }
    }

    /// The solids, without their looks.
    pub fn geometry(&self) -> &Scene {
        &self.scene
    }

    /// The colour that comes back along a ray, where one pixel (or sample) is `pixel` radians wide.
    pub fn colour(&self, ray: &Ray, hit: &Hit, pixel: f32) -> Vec3A {
        let solid = &self.scene.solids()[hit.solid];
        let point = ray.at(hit.t);
        let length = ray.direction.length();
        let facing = (solid.normal(hit.face, point).dot(ray.direction) / length).abs();
        // A pixel's trace is long and narrow on a slanted face; the mean of both is taken.
        let footprint = pixel * hit.t * length / facing.max(0.05).sqrt();
        self.pictures[6 * hit.solid + hit.face as usize].sample(solid.picture_from_room(hit.face, point), footprint)
    }
}

fn picture(light: &Light, solid: &Solid, face: Face) -> Texture {
    let size = solid.picture_size(face);
    let (centre, normal) = solid.room_from_picture(face, size / 2.0);
    let in_front = centre + normal * 0.01;
    let is_seen =
        solid.faces().contains(&face) && in_front.cmpge(Vec3A::ZERO).all() && in_front.cmple(ROOM.into()).all();
    if !is_seen {
        return Texture::paint(Vec2::ONE, 1.0, |_| Vec3::ZERO);
    }
    let material = solid.material(face);
    let lit = LightGrid::new(light, solid, face, size);
    Texture::paint(size, material.texel(), |at| {
        let look = material.look(at, size);
        look.albedo * lit.at(at) + look.glow
    })
}

/// Irradiance on one face at the points of a grid.
struct LightGrid {
    width: usize,
    height: usize,
    points: Vec<Vec3>,
    density: Vec2,
}

impl LightGrid {
    fn new(light: &Light, solid: &Solid, face: Face, size: Vec2) -> Self {
        let cells = (size / LIGHT_GRID).ceil().max(Vec2::ONE);
        let (width, height) = (cells.x as usize + 1, cells.y as usize + 1);
        let points = (0..width * height).into_par_iter().map(|index| {
            let share = Vec2::new((index % width) as f32, (index / width) as f32) / cells;
            // Not on the very edge, which may lie inside a neighbour.
            let (point, normal) = solid.room_from_picture(face, size * (0.04 + 0.92 * share));
            light.at(point, normal)
        });
        Self { width, height, points: points.collect(), density: cells / size }
    }

    fn at(&self, at: Vec2) -> Vec3 {
        let at = at * self.density;
        let (x, y) = ((at.x as usize).min(self.width - 2), (at.y as usize).min(self.height - 2));
        let t = at - Vec2::new(x as f32, y as f32);
        let point = |x: usize, y: usize| self.points[y * self.width + x];
        point(x, y).lerp(point(x + 1, y), t.x).lerp(point(x, y + 1).lerp(point(x + 1, y + 1), t.x), t.y)
    }
}

/// Where a camera is, in the renderer's own numbers.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// Turns directions of the camera into the room's.
    pub rotation: Mat3A,
    /// The camera's place in the room, metres.
    pub position: Vec3A,
}

impl From<&Isometry3<f64>> for Pose {
    fn from(world_from_camera: &Isometry3<f64>) -> Self {
        let world_from_camera = world_from_camera.cast::<f32>();
        let [x, y, z, w] = world_from_camera.rotation.coords.into();
        Self {
            rotation: Mat3A::from_quat(Quat::from_xyzw(x, y, z, w)),
            position: Vec3A::from_array(world_from_camera.translation.vector.into()),
        }
    }
}
