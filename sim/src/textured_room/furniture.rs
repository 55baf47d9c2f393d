//! Table, chair, sofa and shelf, each built at the origin on the floor, its front towards −y.

use glam::{Mat3, Vec3};

use super::material::Material;
use super::noise::cell;
use super::solid::{Face, Shape, Solid};

const OAK: Material = Material::Wood(0xb5_84_52);
const WALNUT: Material = Material::Wood(0x7a_50_33);
const BIRCH: Material = Material::Wood(0xd6_ba_8e);

/// A dining table, 1.6 × 0.85 m, 0.74 m high.
pub fn table() -> Vec<Solid> {
    let mut parts = vec![
        Solid::new(Shape::Box, Vec3::new(0.0, 0.0, 0.72), Vec3::new(1.6, 0.85, 0.04), OAK),
        Solid::new(Shape::Box, Vec3::new(0.0, -0.34, 0.655), Vec3::new(1.4, 0.025, 0.09), OAK),
        Solid::new(Shape::Box, Vec3::new(0.0, 0.34, 0.655), Vec3::new(1.4, 0.025, 0.09), OAK),
    ];
    for (x, y) in [(-0.73, -0.36), (0.73, -0.36), (-0.73, 0.36), (0.73, 0.36)] {
        parts.push(Solid::new(Shape::Box, Vec3::new(x, y, 0.35), Vec3::new(0.075, 0.075, 0.70), OAK));
    }
    parts
}

/// A wooden chair with a slatted back at +y.
pub fn chair() -> Vec<Solid> {
    let mut parts = vec![
        Solid::new(Shape::Box, Vec3::new(0.0, 0.0, 0.445), Vec3::new(0.43, 0.42, 0.035), WALNUT)
            .with(Face::Up, Material::Cloth(0x5c_6e_78)),
    ];
    for (x, y) in [(-0.19, -0.18), (0.19, -0.18)] {
        parts.push(Solid::new(Shape::Box, Vec3::new(x, y, 0.215), Vec3::new(0.04, 0.04, 0.43), WALNUT));
    }
    let lean = Mat3::from_rotation_x(-0.10);
    for x in [-0.19, 0.19] {
        parts.push(Solid::new(Shape::Box, Vec3::new(x, 0.19, 0.215), Vec3::new(0.04, 0.04, 0.43), WALNUT));
        let post = Solid::new(Shape::Box, Vec3::new(x, 0.215, 0.67), Vec3::new(0.04, 0.035, 0.50), WALNUT);
        parts.push(post.turned(lean));
    }
    for z in [0.60, 0.72, 0.86] {
        let back = 0.215 + 0.10 * (z - 0.67);
        let slat = Solid::new(Shape::Box, Vec3::new(0.0, back, z), Vec3::new(0.36, 0.02, 0.065), WALNUT);
        parts.push(slat.turned(lean));
    }
    parts
}

/// A two-seater of 1.7 m with cushions and a throw.
pub fn sofa() -> Vec<Solid> {
    let cloth = Material::Cloth(0x4a_64_72);
    let mut parts = vec![
        Solid::new(Shape::Box, Vec3::new(0.0, 0.0, 0.20), Vec3::new(1.70, 0.84, 0.24), cloth),
        Solid::new(Shape::Box, Vec3::new(0.0, 0.33, 0.55), Vec3::new(1.40, 0.18, 0.50), cloth)
            .turned(Mat3::from_rotation_x(-0.12)),
        Solid::new(Shape::Box, Vec3::new(-0.77, 0.0, 0.38), Vec3::new(0.16, 0.84, 0.44), cloth),
        Solid::new(Shape::Box, Vec3::new(0.77, 0.0, 0.38), Vec3::new(0.16, 0.84, 0.44), cloth),
    ];
    for x in [-0.345, 0.345] {
        let seat = Solid::new(Shape::Box, Vec3::new(x, -0.08, 0.385), Vec3::new(0.67, 0.66, 0.14), cloth);
        parts.push(seat.turned(Mat3::from_rotation_x(0.02)));
    }
    let cushion = |x: f32, yaw: f32, roll: f32, colour: u32| {
        let rotation = Mat3::from_rotation_z(yaw) * Mat3::from_rotation_x(-0.4) * Mat3::from_rotation_y(roll);
        Solid::new(Shape::Box, Vec3::new(x, 0.12, 0.65), Vec3::new(0.40, 0.11, 0.40), Material::Cloth(colour))
            .turned(rotation)
    };
    parts.push(cushion(-0.45, 0.25, 0.10, 0xc8_8a_3a));
    parts.push(cushion(0.40, -0.3, -0.2, 0xb4_4e_42));
    let throw = Solid::new(Shape::Box, Vec3::new(0.77, -0.05, 0.42), Vec3::new(0.19, 0.45, 0.39), Material::Rug);
    parts.push(throw);
    for (x, y) in [(-0.78, -0.36), (0.78, -0.36), (-0.78, 0.36), (0.78, 0.36)] {
        parts.push(Solid::new(Shape::Box, Vec3::new(x, y, 0.04), Vec3::new(0.05, 0.05, 0.08), WALNUT));
    }
    parts
}

/// A bookshelf, 1.3 × 0.3 m, 1.95 m high, full.
pub fn shelf() -> Vec<Solid> {
    const WIDTH: f32 = 1.3;
    const DEPTH: f32 = 0.30;
    const BOARDS: [f32; 6] = [0.07, 0.44, 0.80, 1.16, 1.52, 1.94];
    let mut parts = vec![
        Solid::new(Shape::Box, Vec3::new(0.0, 0.14, 0.97), Vec3::new(WIDTH, 0.01, 1.94), BIRCH),
        Solid::new(Shape::Box, Vec3::new(-0.64, 0.0, 0.97), Vec3::new(0.022, DEPTH, 1.94), BIRCH),
        Solid::new(Shape::Box, Vec3::new(0.64, 0.0, 0.97), Vec3::new(0.022, DEPTH, 1.94), BIRCH),
    ];
    for (row, &height) in BOARDS.iter().enumerate() {
        parts.push(Solid::new(Shape::Box, Vec3::new(0.0, 0.0, height), Vec3::new(1.258, DEPTH, 0.022), BIRCH));
        // The lowest compartment holds boxes, the top board carries nothing.
        match row {
            0 => parts.extend(boxes(height + 0.011)),
            5 => {}
            _ => parts.extend(books(row as i32, height + 0.011)),
        }
    }
    parts
}

/// A row of books of all sizes with a gap, the last ones before it leaning.
fn books(row: i32, base: f32) -> Vec<Solid> {
    let mut books = Vec::new();
    let mut left = -0.62;
    let gap = -0.45 + 0.75 * cell(row, 0, 201);
    for index in 1.. {
        let random = |what: u32| cell(row, index, 201 + what);
        let thick = 0.022 + 0.028 * random(1);
        let (deep, high) = (0.14 + 0.06 * random(2), 0.19 + 0.12 * random(3));
        if left + thick > 0.62 {
            break;
        }
        let seed = (row * 40 + index) as u32;
        let front = -0.13 + 0.035 * random(4);
        let centre = Vec3::new(left + thick / 2.0, front + deep / 2.0, base + high / 2.0);
        let lean = if left < gap && left + 3.0 * thick > gap { 0.16 } else { 0.0 };
        let book = Solid::new(Shape::Box, centre, Vec3::new(thick, deep, high), Material::Spine(seed))
            .with(Face::Up, Material::Pages)
            .with(Face::East, Material::Binding(seed))
            .with(Face::West, Material::Binding(seed));
        books.push(book.turned(Mat3::from_rotation_y(lean)));
        left += thick + 0.0015 + 0.5 * thick * lean;
        if left > gap && left - thick <= gap {
            left += 0.09 + 0.16 * random(5);
        }
    }
    books
}

fn boxes(base: f32) -> Vec<Solid> {
    [(-0.40, 0.40, 0.24, 1), (0.05, 0.34, 0.29, 2), (0.43, 0.36, 0.20, 3)]
        .map(|(x, width, height, seed)| {
            let centre = Vec3::new(x, -0.01, base + height / 2.0);
            Solid::new(Shape::Box, centre, Vec3::new(width, 0.26, height), Material::Cardboard(seed))
        })
        .into()
}
