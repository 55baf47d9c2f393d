//! Smaller things: what is on the table, the plant, the lamp. Each built at the origin.

use glam::{Mat3, Vec3};

use super::material::Material;
use super::noise::cell;
use super::solid::{Face, Shape, Solid};

/// On a table top at z = 0, 1.6 × 0.85 m: a laptop, papers, books, mugs, a bowl of oranges.
pub fn tableware() -> Vec<Solid> {
    let grey = Material::Plain(0x8c_90_96);
    let mut all = vec![
        Solid::new(Shape::Box, Vec3::new(0.12, 0.10, 0.008), Vec3::new(0.34, 0.23, 0.016), grey)
            .with(Face::Up, Material::Keyboard)
            .turned(Mat3::from_rotation_z(0.3)),
        Solid::new(Shape::Box, Vec3::new(0.08, 0.23, 0.115), Vec3::new(0.34, 0.010, 0.22), grey)
            .with(Face::South, Material::Screen)
            .turned(Mat3::from_rotation_z(0.3) * Mat3::from_rotation_x(-0.25)),
    ];
    for (index, (x, y, yaw)) in
        [(-0.42, -0.12, 0.35), (-0.36, 0.02, -0.2), (-0.62, -0.18, 0.9), (0.46, -0.22, -0.5), (0.16, -0.26, 0.1)]
            .into_iter()
            .enumerate()
    {
        let centre = Vec3::new(x, y, 0.0015 + 0.001 * index as f32);
        let sheet = Solid::new(Shape::Box, centre, Vec3::new(0.21, 0.297, 0.001), Material::Sheet(index as u32));
        all.push(sheet.turned(Mat3::from_rotation_z(yaw)));
    }
    let mut stack = 0.0;
    for (index, (width, thick, yaw)) in
        [(0.27, 0.035, 0.15), (0.24, 0.025, -0.2), (0.21, 0.03, 0.3), (0.19, 0.012, -0.1)].into_iter().enumerate()
    {
        let centre = Vec3::new(0.60, 0.20, stack + thick / 2.0);
        let seed = 300 + index as u32;
        all.push(
            Solid::new(Shape::Box, centre, Vec3::new(0.72 * width, width, thick), Material::Pages)
                .with(Face::Up, Material::Cover(seed))
                .with(Face::West, Material::Spine(seed))
                .turned(Mat3::from_rotation_z(yaw)),
        );
        stack += thick;
    }
    let magazine =
        Solid::new(Shape::Box, Vec3::new(-0.58, 0.24, 0.003), Vec3::new(0.21, 0.28, 0.006), Material::Cover(41));
    all.push(magazine.turned(Mat3::from_rotation_z(-0.4)));
    all.extend(mug(Vec3::new(0.42, 0.02, 0.0), 0xc0_4a_36));
    all.extend(mug(Vec3::new(-0.18, 0.28, 0.0), 0x2c_5a_78));
    all.push(Solid::new(
        Shape::Cylinder,
        Vec3::new(-0.22, 0.02, 0.03),
        Vec3::new(0.24, 0.24, 0.06),
        Material::Wood(0x8a_60_3c),
    ));
    for (x, y, z) in [(-0.26, 0.0, 0.07), (-0.18, 0.0, 0.072), (-0.22, 0.07, 0.07), (-0.22, 0.02, 0.12)] {
        let orange = Material::Plain(0xe0_84_20);
        all.push(Solid::new(Shape::Ellipsoid, Vec3::new(x, y, z), Vec3::new(0.078, 0.078, 0.072), orange));
    }
    all
}

fn mug(at: Vec3, colour: u32) -> [Solid; 2] {
    let china = Material::Plain(colour);
    [
        Solid::new(Shape::Cylinder, at + Vec3::Z * 0.045, Vec3::new(0.08, 0.08, 0.09), china)
            .with(Face::Up, Material::Plain(0x2c_1c_12)),
        Solid::new(Shape::Box, at + Vec3::new(0.05, 0.0, 0.045), Vec3::new(0.03, 0.012, 0.055), china),
    ]
}

/// A rubber plant, 1.2 m high, in a terracotta pot.
pub fn plant() -> Vec<Solid> {
    let pot = Material::Plain(0xa8_5a_3c);
    let mut all = vec![
        Solid::new(Shape::Cylinder, Vec3::new(0.0, 0.0, 0.14), Vec3::new(0.28, 0.28, 0.28), pot),
        Solid::new(Shape::Cylinder, Vec3::new(0.0, 0.0, 0.29), Vec3::new(0.32, 0.32, 0.05), pot)
            .with(Face::Up, Material::Soil),
    ];
    let stem = Material::Wood(0x5c_4a_2c);
    for (lean, yaw, height) in [(0.08, 0.4, 0.85), (0.22, 2.6, 0.70), (0.20, 4.6, 0.62)] {
        let rotation = Mat3::from_rotation_z(yaw) * Mat3::from_rotation_y(lean);
        let foot = Vec3::new(0.0, 0.0, 0.30);
        let middle = foot + rotation * (Vec3::Z * height / 2.0);
        all.push(Solid::new(Shape::Cylinder, middle, Vec3::new(0.018, 0.018, height), stem).turned(rotation));
        for leaf in 0..9 {
            let share = 0.35 + 0.65 * leaf as f32 / 8.0;
            let seed = (yaw * 100.0) as u32 + leaf;
            // The golden angle: no leaf shades the one below.
            let turn = Mat3::from_rotation_z(2.4 * leaf as f32 + yaw);
            let droop = 0.55 - 1.1 * cell(leaf as i32, 3, seed) * (1.0 - share) - 0.7 * share;
            let length = 0.24 + 0.08 * cell(leaf as i32, 4, seed);
            let tilt = turn * Mat3::from_rotation_y(droop);
            let base = foot + rotation * (Vec3::Z * share * height);
            let centre = base + tilt * (Vec3::X * (0.03 + length / 2.0));
            let blade = Solid::new(Shape::Ellipsoid, centre, Vec3::new(length, 0.105, 0.010), Material::Leaf(seed));
            all.push(blade.turned(tilt * Mat3::from_rotation_x(0.5 * (cell(leaf as i32, 5, seed) - 0.5))));
        }
    }
    all
}

/// A standing lamp with a paper shade.
pub fn floor_lamp() -> Vec<Solid> {
    let black = Material::Plain(0x2a_2a_2c);
    vec![
        Solid::new(Shape::Cylinder, Vec3::new(0.0, 0.0, 0.012), Vec3::new(0.28, 0.28, 0.024), black),
        Solid::new(Shape::Cylinder, Vec3::new(0.0, 0.0, 0.75), Vec3::new(0.022, 0.022, 1.5), black),
        Solid::new(
            Shape::Cylinder,
            Vec3::new(0.0, 0.0, 1.55),
            Vec3::new(0.34, 0.34, 0.26),
            Material::Cloth(0xf0_dc_b0),
        ),
    ]
}
