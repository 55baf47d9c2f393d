//! Solids: what the room is built of, how a ray meets them, and how a picture lies on them.

use glam::{Mat3, Mat3A, Vec2, Vec3, Vec3A};
use std::f32::consts::{PI, TAU};

use super::material::Material;

/// Form of a solid, in its own axes; `half` is half its extent along each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A box.
    Box,
    /// A box seen from inside: the room itself.
    Hollow,
    /// An upright cylinder.
    Cylinder,
    /// An ellipsoid.
    Ellipsoid,
}

/// A face of a box, named by the direction it looks in. A cylinder has `East` as its side, `Up` and `Down`;
/// an ellipsoid has `East` only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Face {
    /// +x.
    East,
    /// −x.
    West,
    /// +y.
    North,
    /// −y.
    South,
    /// +z.
    Up,
    /// −z.
    Down,
}

impl Face {
    /// All six, in the order of their numbers.
    pub const ALL: [Self; 6] = [Self::East, Self::West, Self::North, Self::South, Self::Up, Self::Down];

    /// Outward, and to the right and upwards for someone who looks at the face from outside.
    fn axes(self) -> (Vec3A, Vec3A, Vec3A) {
        match self {
            Self::East => (Vec3A::X, Vec3A::Y, Vec3A::Z),
            Self::West => (Vec3A::NEG_X, Vec3A::NEG_Y, Vec3A::Z),
            Self::North => (Vec3A::Y, Vec3A::NEG_X, Vec3A::Z),
            Self::South => (Vec3A::NEG_Y, Vec3A::X, Vec3A::Z),
            Self::Up => (Vec3A::Z, Vec3A::X, Vec3A::Y),
            Self::Down => (Vec3A::NEG_Z, Vec3A::X, Vec3A::NEG_Y),
        }
    }

    /// The face that looks along ±`axis` (0 = x), the positive way if `positive`.
    fn along(axis: usize, positive: bool) -> Self {
        Self::ALL[2 * axis + usize::from(!positive)]
    }
}

/// A ray: points `origin + t · direction`.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where t = 0.
    pub origin: Vec3A,
    /// Change of the point per unit of t; any length.
    pub direction: Vec3A,
}

impl Ray {
    /// The point at `t`.
    pub fn at(&self, t: f32) -> Vec3A {
        self.origin + self.direction * t
    }
}

/// One solid in the room, metres.
#[derive(Clone, Debug)]
pub struct Solid {
    shape: Shape,
    half: Vec3A,
    centre: Vec3A,
    solid_from_room: Mat3A,
    materials: [Material; 6],
}

impl Solid {
    /// A solid of full extents `size`, centred on `centre`.
    pub fn new(shape: Shape, centre: Vec3, size: Vec3, material: Material) -> Self {
        let (half, centre) = (Vec3A::from(size / 2.0), Vec3A::from(centre));
        Self { shape, half, centre, solid_from_room: Mat3A::IDENTITY, materials: [material; 6] }
    }

    /// A box between two corners.
    pub fn between(low: Vec3, high: Vec3, material: Material) -> Self {
        Self::new(Shape::Box, (low + high) / 2.0, high - low, material)
    }

    /// Turned about its own centre by a rotation.
    pub fn turned(mut self, rotation: Mat3) -> Self {
        self.solid_from_room *= Mat3A::from(rotation.transpose());
        self
    }

    /// Turned about z through `pivot` and then moved by `shift`: places furniture that was built at the origin.
    pub fn placed(mut self, yaw: f32, shift: Vec3) -> Self {
        let rotation = Mat3::from_rotation_z(yaw);
        self.centre = rotation * self.centre + Vec3A::from(shift);
        self.turned(rotation)
    }

    /// With another material on one face.
    pub fn with(mut self, face: Face, material: Material) -> Self {
        self.materials[face as usize] = material;
        self
    }

    /// Its centre in the room.
    pub fn centre(&self) -> Vec3A {
        self.centre
    }

    /// How far its box reaches from the centre along a unit direction.
    pub fn extent(&self, direction: Vec3A) -> f32 {
        (self.solid_from_room * direction).abs().dot(self.half)
    }

    /// Distance of a point from its box; 0 inside.
    pub fn distance(&self, point: Vec3A) -> f32 {
        let local = self.solid_from_room * (point - self.centre);
        (local.abs() - self.half).max(Vec3A::ZERO).length()
    }

    /// The material of a face.
    pub fn material(&self, face: Face) -> Material {
        self.materials[face as usize]
    }

    /// The faces this shape has.
    pub fn faces(&self) -> &'static [Face] {
        match self.shape {
            Shape::Box | Shape::Hollow => &Face::ALL,
            Shape::Cylinder => &[Face::East, Face::Up, Face::Down],
            Shape::Ellipsoid => &[Face::East],
        }
    }

    /// Where a ray first meets the surface beyond `t = 0`: t and the face.
    pub fn hit(&self, ray: &Ray) -> Option<(f32, Face)> {
        let origin = self.solid_from_room * (ray.origin - self.centre);
        let direction = self.solid_from_room * ray.direction;
        match self.shape {
            Shape::Box => self.hit_box(origin, direction),
            Shape::Hollow => Some(self.leave_box(origin, direction)),
            Shape::Cylinder => self.hit_cylinder(origin, direction),
            Shape::Ellipsoid => hit_unit_sphere(origin / self.half, direction / self.half).map(|t| (t, Face::East)),
        }
    }

    fn hit_box(&self, origin: Vec3A, direction: Vec3A) -> Option<(f32, Face)> {
        let inverse = direction.recip();
        let (a, b) = ((-self.half - origin) * inverse, (self.half - origin) * inverse);
        let (near, far) = (a.min(b), a.max(b));
        let enter = near.max_element();
        if !(enter > 0.0 && enter <= far.min_element()) {
            return None;
        }
        let axis = if enter == near.x { 0 } else { 2 - usize::from(enter == near.y) };
        Some((enter, Face::along(axis, direction[axis] < 0.0)))
    }

    fn leave_box(&self, origin: Vec3A, direction: Vec3A) -> (f32, Face) {
        let far = (self.half * direction.signum() - origin) / direction;
        let leave = far.min_element();
        let axis = if leave == far.x { 0 } else { 2 - usize::from(leave == far.y) };
        // The wall a ray leaves through looks back at it.
        (leave, Face::along(axis, direction[axis] < 0.0))
    }

    fn hit_cylinder(&self, origin: Vec3A, direction: Vec3A) -> Option<(f32, Face)> {
        let flat = |v: Vec3A| Vec2::new(v.x, v.y) / self.half.x;
        let (o, d) = (flat(origin), flat(direction));
        let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 1.0);
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return None;
        }
        let side = (-b - discriminant.sqrt()) / a;
        if side > 0.0 && (origin.z + side * direction.z).abs() <= self.half.z {
            return Some((side, Face::East));
        }
        let cap = (-self.half.z * direction.z.signum() - origin.z) / direction.z;
        (cap > 0.0 && (o + d * cap).length_squared() <= 1.0).then(|| (cap, Face::along(2, direction.z < 0.0)))
    }

    /// Width and height of the picture on a face, metres. On a curved side the width is once around.
    pub fn picture_size(&self, face: Face) -> Vec2 {
        let half = self.half;
        match (self.shape, face) {
            (Shape::Cylinder, Face::East) => Vec2::new(TAU * half.x, 2.0 * half.z),
            (Shape::Ellipsoid, _) => Vec2::new(TAU, PI) * half.max_element(),
            _ => {
                let (_, right, up) = face.axes();
                2.0 * Vec2::new(half.dot(right.abs()), half.dot(up.abs()))
            }
        }
    }

    /// Where a point of the surface lies in its face's picture: metres from the lower left corner.
    pub fn picture_from_room(&self, face: Face, point: Vec3A) -> Vec2 {
        let local = self.solid_from_room * (point - self.centre);
        let size = self.picture_size(face);
        match (self.shape, face) {
            (Shape::Cylinder, Face::East) => Vec2::new(around(local) * size.x, local.z + self.half.z),
            (Shape::Ellipsoid, _) => {
                let unit = local / self.half;
                Vec2::new(around(unit), unit.z.clamp(-1.0, 1.0).asin() / PI + 0.5) * size
            }
            _ => {
                let (_, right, up) = face.axes();
                Vec2::new(local.dot(right), local.dot(up)) + size / 2.0
            }
        }
    }

    /// The inverse of [`picture_from_room`](Self::picture_from_room): the point, and the surface's normal there.
    pub fn room_from_picture(&self, face: Face, picture: Vec2) -> (Vec3A, Vec3A) {
        let size = self.picture_size(face);
        let (local, normal) = match (self.shape, face) {
            (Shape::Cylinder, Face::East) => {
                let (sin, cos) = (TAU * (picture.x / size.x - 0.5)).sin_cos();
                let normal = Vec3A::new(cos, sin, 0.0);
                (normal * self.half.x + Vec3A::Z * (picture.y - self.half.z), normal)
            }
            (Shape::Ellipsoid, _) => {
                let (sin, cos) = (TAU * (picture.x / size.x - 0.5)).sin_cos();
                let (up, out) = (PI * (picture.y / size.y - 0.5)).sin_cos();
                let unit = Vec3A::new(out * cos, out * sin, up);
                (unit * self.half, (unit / self.half).normalize())
            }
            _ => {
                let (normal, right, up) = face.axes();
                let depth = self.half.dot(normal.abs()) * if self.shape == Shape::Hollow { -1.0 } else { 1.0 };
                let flat = picture - size / 2.0;
                (normal * depth + right * flat.x + up * flat.y, normal)
            }
        };
        let room_from_solid = self.solid_from_room.transpose();
        (room_from_solid * local + self.centre, room_from_solid * normal)
    }

    /// The surface's unit normal at one of its points.
    pub fn normal(&self, face: Face, point: Vec3A) -> Vec3A {
        let local = self.solid_from_room * (point - self.centre);
        let normal = match (self.shape, face) {
            (Shape::Cylinder, Face::East) => Vec3A::new(local.x, local.y, 0.0).normalize(),
            (Shape::Ellipsoid, _) => (local / (self.half * self.half)).normalize(),
            _ => face.axes().0,
        };
        self.solid_from_room.transpose() * normal
    }
}

/// The angle about z as a share of a full turn, 0–1, from −x anticlockwise.
fn around(point: Vec3A) -> f32 {
    point.y.atan2(point.x) / TAU + 0.5
}

fn hit_unit_sphere(origin: Vec3A, direction: Vec3A) -> Option<f32> {
    let (a, b, c) = (direction.length_squared(), origin.dot(direction), origin.length_squared() - 1.0);
    let discriminant = b * b - a * c;
    let t = (-b - discriminant.max(0.0).sqrt()) / a;
    (discriminant >= 0.0 && t > 0.0).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hit_lies_in_the_picture_where_it_came_from() {
        for shape in [Shape::Box, Shape::Hollow, Shape::Cylinder, Shape::Ellipsoid] {
            let solid = Solid::new(shape, Vec3::new(1.0, 2.0, 0.5), Vec3::new(0.6, 0.6, 0.3), Material::default())
                .turned(Mat3::from_rotation_y(0.4) * Mat3::from_rotation_z(0.7));
            for &face in solid.faces() {
                let picture = solid.picture_size(face) * Vec2::new(0.3, 0.6);
                let (point, normal) = solid.room_from_picture(face, picture);
                assert!((solid.picture_from_room(face, point) - picture).length() < 1e-5, "{shape:?} {face:?}");
                assert!((solid.normal(face, point) - normal).length() < 1e-5, "{shape:?} {face:?}");
                let ray = Ray { origin: point + normal * 0.2, direction: -normal * 2.0 };
                let (t, hit) = solid.hit(&ray).unwrap();
                assert!((t - 0.1).abs() < 1e-5 && hit == face, "{shape:?} {face:?}: {t} {hit:?}");
            }
        }
    }

    #[test]
    fn what_lies_behind_or_beside_is_missed() {
        for shape in [Shape::Box, Shape::Cylinder, Shape::Ellipsoid] {
            let solid = Solid::new(shape, Vec3::ZERO, Vec3::ONE, Material::default());
            let hit = |origin, direction| solid.hit(&Ray { origin, direction });
            assert!(hit(Vec3A::new(2.0, 0.1, 0.1), Vec3A::new(1.0, 0.01, 0.02)).is_none());
            assert!(hit(Vec3A::new(-2.0, 0.9, 0.1), Vec3A::new(1.0, 0.01, 0.02)).is_none());
            assert!(hit(Vec3A::new(-2.0, 0.1, 0.1), Vec3A::new(1.0, 0.01, 0.02)).is_some());
        }
    }
}
