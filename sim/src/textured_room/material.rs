//! What surfaces look like in daylight, and whether they give the Kinect's infrared dots back.

use glam::{Vec2, Vec3};

use super::noise::{fractal, value};
use super::{art, drawing, print, surface};

/// What a surface is made of. A picture is addressed in metres from its lower left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// One colour (sRGB) with a faint unevenness: plastic, lacquer, metal, porcelain.
    Plain(u32),
    /// Painted plaster: all but featureless.
    Plaster(u32),
    /// The floor: oak boards.
    Boards,
    /// Wood of a colour (sRGB), grain along the longer side.
    Wood(u32),
    /// Woven cloth of a colour (sRGB).
    Cloth(u32),
    /// Cloth hanging in folds.
    Curtain(u32),
    /// The rug.
    Rug,
    /// A poster; the number says which.
    Poster(u32),
    /// The plain side of a book whose back is `Spine` of the same number.
    Binding(u32),
    /// The back of a book; the number says which.
    Spine(u32),
    /// The front of a book or magazine; the number says which.
    Cover(u32),
    /// Page edges of a book.
    Pages,
    /// A printed sheet; the number says which.
    Sheet(u32),
    /// The whiteboard and what is drawn on it.
    Whiteboard,
    /// A laptop's keyboard.
    Keyboard,
    /// A lit screen.
    Screen,
    /// A window pane and what is seen through it.
    Window,
    /// A panelled door.
    Door,
    /// A ribbed radiator.
    Radiator,
    /// A cardboard box; the number says which.
    Cardboard(u32),
    /// A leaf.
    Leaf(u32),
    /// Earth in a flower pot.
    Soil,
    /// A lit lamp of a colour (sRGB).
    Lamp(u32),
}

impl Default for Material {
    fn default() -> Self {
        Self::Plain(0x80_80_80)
    }
}

/// How a spot looks: linear RGB.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Share of the light that comes back, 0–1.
    pub albedo: Vec3,
    /// Light of its own; 1 is as bright as white paper in this room.
    pub glow: Vec3,
}

impl Material {
    /// The look of the spot `at` in a picture of `size`, both in metres.
    pub fn look(self, at: Vec2, size: Vec2) -> Look {
        let glow = match self {
            Self::Window => art::view(at, size),
            Self::Screen => drawing::screen(at, size),
            Self::Lamp(colour) => 1.6 * linear(colour),
            _ => Vec3::ZERO,
        };
        Look { albedo: self.albedo(at, size), glow }
    }

    fn albedo(self, at: Vec2, size: Vec2) -> Vec3 {
        match self {
            Self::Plain(colour) => linear(colour) * (0.96 + 0.08 * fractal(at * 9.0, 3, colour)),
            Self::Plaster(colour) => surface::plaster(linear(colour), at),
            Self::Boards => surface::boards(at),
            Self::Wood(colour) => surface::wood(linear(colour), at, size, colour),
            Self::Cloth(colour) => surface::cloth(linear(colour), at, colour),
            Self::Curtain(colour) => surface::curtain(linear(colour), at),
            Self::Rug => surface::rug(at, size),
            Self::Poster(which) => art::poster(which, at, size),
            Self::Binding(seed) => print::binding(seed, at),
            Self::Spine(seed) => print::spine(seed, at, size),
            Self::Cover(seed) => print::cover(seed, at, size),
            Self::Pages => linear(0xe6_de_c8) * (0.75 + 0.25 * value(Vec2::new(at.x * 60.0, at.y * 900.0), 5)),
            Self::Sheet(seed) => print::sheet(seed, at, size),
            Self::Whiteboard => drawing::whiteboard(at, size),
            Self::Keyboard => drawing::keyboard(at, size),
            Self::Screen | Self::Window => Vec3::splat(0.03),
            Self::Door => surface::door(at, size),
            Self::Radiator => surface::radiator(at, size),
            Self::Cardboard(seed) => surface::cardboard(seed, at, size),
            Self::Leaf(seed) => surface::leaf(seed, at, size),
            Self::Soil => linear(0x3a_2a_1e) * (0.4 + 1.2 * fractal(at * 120.0, 4, 8)),
            Self::Lamp(colour) => linear(colour),
        }
    }

    /// Edge of a texel, metres: fine where something is printed, coarse where there is nothing to see.
    pub fn texel(self) -> f32 {
        match self {
            Self::Poster(_) | Self::Whiteboard | Self::Screen | Self::Keyboard => 0.002,
            Self::Spine(_) | Self::Cover(_) | Self::Sheet(_) => 0.0012,
            Self::Wood(_) | Self::Window | Self::Cardboard(_) => 0.003,
            Self::Plaster(_) | Self::Plain(_) | Self::Binding(_) | Self::Lamp(_) => 0.006,
            _ => 0.004,
        }
    }

    /// Whether the infrared dots come back diffusely. Glass, screens and lit lamps give none (facts of the device:
    /// "glass, mirror: no dot").
    pub fn returns_dots(self) -> bool {
        !matches!(self, Self::Window | Self::Screen | Self::Lamp(_))
    }
}

/// Linear RGB of an sRGB colour `0xRR_GG_BB`, by a cubic that stays within 0.002 of IEC 61966-2-1.
pub fn linear(srgb: u32) -> Vec3 {
    let channel = |shift: u32| {
        let c = (srgb >> shift & 0xff) as f32 / 255.0;
        c * (c * (c * 0.305_306 + 0.682_171) + 0.012_523)
    };
    Vec3::new(channel(16), channel(8), channel(0))
}
