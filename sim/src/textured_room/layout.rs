//! The room: 6 × 5 × 2.7 m, x east, y north, z up, the origin in its south-west corner on the floor. What stands
//! where; the west wall is left bare on purpose.

use glam::{Mat3, Vec3};

use super::furniture::{chair, shelf, sofa, table};
use super::material::Material;
use super::scene::Scene;
use super::solid::{Face, Shape, Solid};
use super::things::{floor_lamp, plant, tableware};

/// Extents of the room, metres.
pub const ROOM: Vec3 = Vec3::new(6.0, 5.0, 2.7);

/// The window's opening in the north wall: lower left and upper right corner as x and z, metres.
pub const WINDOW: [(f32, f32); 2] = [(2.35, 0.92), (3.75, 2.22)];

/// Centres of the two ceiling lamps.
pub const CEILING_LAMPS: [Vec3; 2] = [Vec3::new(1.7, 2.4, 2.66), Vec3::new(4.3, 2.4, 2.66)];
/// Extents of a ceiling lamp.
pub const CEILING_LAMP: Vec3 = Vec3::new(0.3, 1.2, 0.06);

const WALL: Material = Material::Plaster(0xe6_e0_d4);
const WHITE: Material = Material::Plain(0xe9_e7_e1);
const STEEL: Material = Material::Plain(0x9a_9c_a0);

/// The room with all that is in it.
pub fn furnished_room() -> Scene {
    let room = Solid::new(Shape::Hollow, ROOM / 2.0, ROOM, WALL)
        .with(Face::Up, Material::Boards)
        .with(Face::Down, Material::Plaster(0xf2_f0_ec));
    let mut things = Vec::new();
    things.extend(fittings());
    things.extend(window());
    things.extend(pictures());
    things.push(Solid::between(Vec3::new(2.0, 2.35, 0.0), Vec3::new(4.6, 4.2, 0.008), Material::Rug));
    things.extend(place(table(), 0.10, Vec3::new(3.3, 3.35, 0.0)));
    things.extend(place(tableware(), 0.10, Vec3::new(3.3, 3.35, 0.74)));
    things.extend(place(chair(), 3.0, Vec3::new(3.15, 2.72, 0.0)));
    things.extend(place(chair(), 1.35, Vec3::new(2.28, 3.42, 0.0)));
    things.extend(place(sofa(), 0.0, Vec3::new(5.0, 4.52, 0.0)));
    things.extend(place(shelf(), 0.0, Vec3::new(0.85, 4.84, 0.0)));
    things.extend(place(plant(), 0.0, Vec3::new(1.86, 4.62, 0.0)));
    things.extend(place(floor_lamp(), 0.0, Vec3::new(3.98, 4.7, 0.0)));
    Scene::new(room, things)
}

fn place(things: Vec<Solid>, yaw: f32, shift: Vec3) -> impl Iterator<Item = Solid> {
    things.into_iter().map(move |solid| solid.placed(yaw, shift))
}

/// Skirting, door, lamps, sockets.
fn fittings() -> Vec<Solid> {
    let Vec3 { x, y, z: _ } = ROOM;
    let skirting = Material::Wood(0xcf_c8_ba);
    let bar = |low: (f32, f32), high: (f32, f32)| {
        Solid::between(Vec3::new(low.0, low.1, 0.0), Vec3::new(high.0, high.1, 0.09), skirting)
    };
    let mut all = vec![
        bar((0.0, y - 0.015), (x, y)),
        bar((0.0, 0.0), (x, 0.015)),
        bar((0.0, 0.0), (0.015, y)),
        bar((x - 0.015, 1.4), (x, y)),
    ];
    let frame = |low, high| Solid::between(low, high, WHITE);
    all.extend([
        Solid::between(Vec3::new(x - 0.03, 0.45, 0.0), Vec3::new(x, 1.35, 2.05), Material::Door),
        frame(Vec3::new(x - 0.05, 0.36, 0.0), Vec3::new(x, 0.45, 2.14)),
        frame(Vec3::new(x - 0.05, 1.35, 0.0), Vec3::new(x, 1.44, 2.14)),
        frame(Vec3::new(x - 0.05, 0.45, 2.05), Vec3::new(x, 1.35, 2.14)),
        Solid::between(Vec3::new(x - 0.09, 0.52, 1.02), Vec3::new(x - 0.07, 0.64, 1.04), STEEL),
        Solid::between(Vec3::new(x - 0.09, 0.52, 1.02), Vec3::new(x - 0.03, 0.54, 1.04), STEEL),
    ]);
    all.extend(CEILING_LAMPS.map(|centre| {
        Solid::new(Shape::Box, centre, CEILING_LAMP, WHITE).with(Face::Down, Material::Lamp(0xff_f4_e4))
    }));
    // By the bare wall somebody has left two boxes.
    for (x, y, size, seed) in [(0.20, 2.42, 0.30, 4), (0.19, 2.05, 0.24, 5)] {
        let centre = Vec3::new(x, y, size / 2.0);
        let carton = Solid::new(Shape::Box, centre, Vec3::splat(size), Material::Cardboard(seed));
        all.push(carton.turned(Mat3::from_rotation_z(0.2)));
    }
    // On it: two double sockets and a thermostat, each a plate with darker insets.
    for (along, up, inset) in [(2.86, 0.31, 0.028), (2.95, 0.31, 0.028), (1.62, 0.31, 0.028), (1.72, 1.28, 0.02)] {
        let centre = Vec3::new(0.0, along, up);
        all.push(Solid::new(Shape::Box, centre, Vec3::new(0.006, 0.082, 0.082), WHITE));
        let inset = Vec3::new(0.007, inset, inset);
        all.push(Solid::new(Shape::Box, centre, inset, Material::Plain(0x5a_5c_60)));
    }
    all
}

fn window() -> Vec<Solid> {
    let [(left, low), (right, high)] = WINDOW;
    let wall = ROOM.y;
    let bar = |x0: f32, z0: f32, x1: f32, z1: f32, out: f32| {
        Solid::between(Vec3::new(x0, wall - out, z0), Vec3::new(x1, wall, z1), WHITE)
    };
    let middle = (left + right) / 2.0;
    let curtain = |x0: f32, x1: f32| {
        let (low, high) = (Vec3::new(x0, wall - 0.13, 0.03), Vec3::new(x1, wall - 0.07, 2.42));
        Solid::between(low, high, Material::Curtain(0x8f_a6_a8))
    };
    vec![
        bar(left, low, right, high, 0.006).with(Face::South, Material::Window),
        bar(left - 0.07, low - 0.07, left, high + 0.07, 0.05),
        bar(right, low - 0.07, right + 0.07, high + 0.07, 0.05),
        bar(left, high, right, high + 0.07, 0.05),
        bar(left, low - 0.07, right, low, 0.05),
        bar(middle - 0.035, low, middle + 0.035, high, 0.045),
        bar(left, 1.78, right, 1.82, 0.04),
        bar(left - 0.12, low - 0.1, right + 0.12, low - 0.07, 0.22).with(Face::Up, Material::Wood(0xd8_d2_c6)),
        Solid::between(
            Vec3::new(left + 0.05, wall - 0.13, 0.14),
            Vec3::new(right - 0.05, wall - 0.04, 0.74),
            Material::Radiator,
        ),
        curtain(left - 0.30, left + 0.08),
        curtain(right - 0.08, right + 0.22),
        Solid::new(Shape::Box, Vec3::new(middle, wall - 0.10, 2.44), Vec3::new(2.1, 0.025, 0.025), STEEL),
    ]
}

/// Whiteboard and posters.
fn pictures() -> Vec<Solid> {
    let Vec3 { x, y, z: _ } = ROOM;
    let board = Solid::between(Vec3::new(4.25, y - 0.02, 1.08), Vec3::new(5.85, y, 2.02), STEEL);
    let face = Solid::between(Vec3::new(4.265, y - 0.024, 1.095), Vec3::new(5.835, y, 2.005), STEEL)
        .with(Face::South, Material::Whiteboard);
    let tray = Solid::between(Vec3::new(4.7, y - 0.08, 1.05), Vec3::new(5.4, y, 1.07), STEEL);
    let pen = |at: f32, colour| {
        Solid::new(
            Shape::Cylinder,
            Vec3::new(at, y - 0.05, 1.079),
            Vec3::new(0.018, 0.018, 0.13),
            Material::Plain(colour),
        )
        .turned(Mat3::from_rotation_y(std::f32::consts::FRAC_PI_2))
    };
    // A sheet of a millimetre on the wall whose inner side is `face`.
    let poster = |face: Face, which: u32, along: f32, up: f32, width: f32, height: f32| {
        let (centre, size) = match face {
            Face::South => (Vec3::new(along, y, up), Vec3::new(width, 0.004, height)),
            Face::North => (Vec3::new(along, 0.0, up), Vec3::new(width, 0.004, height)),
            Face::East => (Vec3::new(0.0, along, up), Vec3::new(0.004, width, height)),
            _ => (Vec3::new(x, along, up), Vec3::new(0.004, width, height)),
        };
        Solid::new(Shape::Box, centre, size, WHITE).with(face, Material::Poster(which))
    };
    vec![
        board,
        face,
        tray,
        pen(4.85, 0x1c_44_a0),
        pen(5.02, 0xb8_24_28),
        pen(5.2, 0x20_24_2a),
        poster(Face::South, 3, 1.85, 1.62, 0.44, 0.62),
        poster(Face::East, 0, 3.95, 1.50, 0.70, 0.50),
        poster(Face::West, 1, 2.4, 1.6, 0.6, 0.85),
        poster(Face::West, 4, 3.6, 1.6, 0.9, 0.7),
        poster(Face::North, 2, 2.0, 1.55, 0.8, 0.8),
        poster(Face::North, 4, 4.2, 1.55, 1.1, 0.75),
    ]
}
