//! Small worlds with light set by hand, and a Kinect at their origin that looks north.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use crate::world::{Gloss, Material, Mesh, Object, TEXTURE_SIZE, World};

/// `world_from_infrared` of a Kinect at the origin, level, looking north.
pub fn looking_north() -> DAffine3 {
    // The camera's right, down and forward in the world.
    DAffine3::from_mat3_translation(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y), DVec3::ZERO)
}

/// `world_from_camera` of one who looks in a direction, its rows level.
pub fn looking(from: DVec3, towards: DVec3) -> DAffine3 {
    let ahead = towards.normalize();
    let right = ahead.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
    // The camera's right, down and forward in the world.
    DAffine3::from_mat3_translation(DMat3::from_cols(right, ahead.cross(right), ahead), from)
}

/// Irradiance of a surface: lux of white light, W m⁻² nm⁻¹ at 830 nm.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Lux, the same in each channel.
    pub lux: f32,
    /// W m⁻² nm⁻¹ at 830 nm.
    pub near_infrared: f32,
}

/// Direct sun on a surface that faces it, by elevation: degrees, kilolux, W m⁻² nm⁻¹ at 830 nm. Clear sky by SPECTRL2
/// (aerosol 0.084, 1.42 cm of water).
const SUN_BY_ELEVATION: [[f32; 3]; 4] = [[3.0, 7.8, 0.29], [5.0, 18.0, 0.42], [10.0, 44.0, 0.61], [20.0, 74.0, 0.77]];

impl Light {
    /// An office: light, but none at 830 nm.
    pub const LED: Self = Self { lux: 500.0, near_infrared: 0.0 };
    /// Darkness.
    pub const NONE: Self = Self { lux: 0.0, near_infrared: 0.0 };

    /// Lamps that are LEDs or fluorescent tubes: below 0.0003 W m⁻² nm⁻¹ for a kilolux.
    pub fn led(lux: f32) -> Self {
        Self { lux, near_infrared: 0.0 }
    }

    /// A halogen lamp: a black body of 2856 K has 0.035 W m⁻² nm⁻¹ for a kilolux.
    pub fn halogen(lux: f32) -> Self {
        Self { lux, near_infrared: 35e-6 * lux }
    }

    /// Sunlight as at noon: 0.0085 W m⁻² nm⁻¹ for a kilolux (a clear sky by SPECTRL2 has 0.008 to 0.009).
    pub fn sun(kilolux: f32) -> Self {
        Self { lux: 1000.0 * kilolux, near_infrared: 0.0085 * kilolux }
    }

    /// An overcast sky: clouds are nearly grey, 0.006 to 0.008 W m⁻² nm⁻¹ for a kilolux. Estimate.
    pub fn overcast(kilolux: f32) -> Self {
        Self { lux: 1000.0 * kilolux, near_infrared: 0.007 * kilolux }
    }

    /// Blue skylight in the shade: 0.0033 to 0.0037 W m⁻² nm⁻¹ for a kilolux (SPECTRL2).
    pub fn shade(kilolux: f32) -> Self {
        Self { lux: 1000.0 * kilolux, near_infrared: 0.0035 * kilolux }
    }

    /// The sun so many degrees above the horizon, on an upright wall that faces it; of a few elevations from 3 to 20.
    ///
    /// # Panics
    /// At other elevations.
    pub fn low_sun(elevation: f32) -> Self {
        let row = SUN_BY_ELEVATION.iter().find(|row| row[0] == elevation);
        let &[_, kilolux, near_infrared] = row.expect("an elevation of the table");
        let facing = elevation.to_radians().cos();
        Self { lux: 1000.0 * kilolux * facing, near_infrared: near_infrared * facing }
    }

    fn irradiance(self) -> [f32; 4] {
        [self.lux, self.lux, self.lux, self.near_infrared]
    }
}

/// An even material: visible albedo (sRGB) and at 830 nm (linear).
pub fn even(name: &str, rgb: [u8; 3], near_infrared: f32) -> Material {
    let [red, green, blue] = rgb;
    let albedo = vec![[red, green, blue, (near_infrared * 255.0).round() as u8]; TEXTURE_SIZE * TEXTURE_SIZE];
    Material { name: name.into(), albedo, gloss: Gloss::MATT }
}

/// Squares of two shades, `across` of them along the texture.
pub fn chequered(name: &str, dark: [u8; 4], bright: [u8; 4], across: usize) -> Material {
    let square = TEXTURE_SIZE / across;
    let texel = |index: usize| {
        let (x, y) = (index % TEXTURE_SIZE / square, index / TEXTURE_SIZE / square);
        if (x + y) % 2 == 0 { dark } else { bright }
    };
    Material { name: name.into(), albedo: (0..TEXTURE_SIZE * TEXTURE_SIZE).map(texel).collect(), gloss: Gloss::MATT }
}

/// A parallelogram from a corner along two edges (metres), facing along their cross product, `cells`² quads; the
/// texture repeats every metre.
pub fn panel(corner: Vec3, edges: [Vec3; 2], cells: u32, light: Light) -> Mesh {
    let normal = edges[0].cross(edges[1]).normalize();
    let mut mesh = Mesh::default();
    for row in 0..=cells {
        for column in 0..=cells {
            let (across, up) = (column as f32 / cells as f32, row as f32 / cells as f32);
            mesh.positions.push((corner + edges[0] * across + edges[1] * up).to_array());
            mesh.normals.push(normal.to_array());
            mesh.uvs.push([across * edges[0].length(), up * edges[1].length()]);
            mesh.irradiance.push(light.irradiance());
        }
    }
    for cell in 0..cells * cells {
        let first = cell / cells * (cells + 1) + cell % cells;
        mesh.triangles.push([first, first + 1, first + cells + 2]);
        mesh.triangles.push([first, first + cells + 2, first + cells + 1]);
    }
    mesh
}

/// A thing that a robot bumps into.
pub fn object(name: &str, mesh: Mesh, material: usize) -> Object {
    Object { name: name.into(), mesh, material, collides: true }
}

/// A wall across the view at a distance, larger than any view.
pub fn facing_wall(distance: f32, light: Light) -> Mesh {
    turned_wall(distance, 0.0, light)
}

/// A wall turned about the vertical through the point straight ahead, by an angle in radians.
pub fn turned_wall(distance: f32, angle: f32, light: Light) -> Mesh {
    let half = 30.0;
    let along = Vec3::new(angle.cos(), angle.sin(), 0.0);
    let corner = Vec3::new(0.0, distance, 0.0) - half * along - half * Vec3::Z;
    panel(corner, [2.0 * half * along, 2.0 * half * Vec3::Z], 8, light)
}

/// The front, sides, top and bottom of an upright box; `centre` and `size` in world axes.
pub fn block(centre: Vec3, size: Vec3, light: Light) -> Mesh {
    let half = size / 2.0;
    let (x, y, z) = (Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z);
    let (low, high) = (centre - half, centre + half);
    let faces = [(low, [x, z]), (low, [z, y]), (low, [y, x]), (high, [-z, -x]), (high, [-y, -z]), (high, [-x, -y])];
    let mut whole = Mesh::default();
    for (corner, edges) in faces {
        let face = panel(corner, edges, 1, light);
        let first = whole.positions.len() as u32;
        whole.positions.extend(face.positions);
        whole.normals.extend(face.normals);
        whole.uvs.extend(face.uvs);
        whole.irradiance.extend(face.irradiance);
        whole.triangles.extend(face.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
    }
    whole
}

/// A world whose light is that of its vertices.
pub fn world(name: &str, objects: Vec<Object>, materials: Vec<Material>) -> World {
    World { name: name.into(), objects, materials, ..World::default() }
}

/// Nothing but a wall straight ahead.
pub fn wall_world(distance: f32, near_infrared_albedo: f32, light: Light) -> World {
    let material = even("paint", [230, 228, 220], near_infrared_albedo);
    world("wall", vec![object("wall", facing_wall(distance, light), 0)], vec![material])
}

/// A furnished room of about as many triangles as a view of a real one has.
pub fn room_world(cells: u32, light: Light) -> World {
    let shaded = |share: f32| Light { lux: light.lux * share, near_infrared: light.near_infrared * share };
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let mut objects = vec![
        object("floor", panel(Vec3::new(-3.0, -1.0, -0.6), [6.0 * x, 6.0 * y], cells, light), 0),
        object("ceiling", panel(Vec3::new(-3.0, -1.0, 2.0), [6.0 * y, 6.0 * x], cells, shaded(0.4)), 1),
        object("north wall", panel(Vec3::new(-3.0, 5.0, -0.6), [6.0 * x, 2.6 * z], cells, shaded(0.8)), 1),
        object("west wall", panel(Vec3::new(-3.0, -1.0, -0.6), [6.0 * y, 2.6 * z], cells, shaded(0.6)), 1),
        object("east wall", panel(Vec3::new(3.0, -1.0, -0.6), [2.6 * z, 6.0 * y], cells, shaded(0.7)), 1),
    ];
    for number in 0..12 {
        let place = Vec3::new(-2.2 + 0.4 * number as f32, 1.4 + 0.9 * (number % 4) as f32, -0.35);
        let size = Vec3::new(0.3, 0.3, 0.5 + 0.1 * (number % 3) as f32);
        objects.push(object("box", block(place, size, shaded(0.9)), 2 + number % 3));
    }
    let materials = vec![
        chequered("tiles", [120, 110, 100, 90], [150, 140, 128, 120], 4),
        even("paint", [225, 222, 212], 0.8),
        even("card", [170, 120, 70], 0.6),
        chequered("print", [40, 60, 140, 150], [220, 215, 200, 160], 8),
        even("rubber", [45, 45, 48], 0.05),
    ];
    world("room", objects, materials)
}
