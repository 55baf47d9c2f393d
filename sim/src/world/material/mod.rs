//! Procedural, seeded textures, each with a visible albedo and its own at 830 nm.

mod building;
mod canvas;
mod fittings;
mod fronts;
pub mod gloss;
mod glyph;
mod noise;
mod outdoor_ground;
mod outdoor_house;
mod outdoor_plants;
mod outdoor_things;
mod outdoors;
mod printed;
mod stuff;
pub mod substance;

use rayon::prelude::*;

use super::shape::Mapping;
use super::{Material, TEXTURE_SIZE};
use canvas::Canvas;
pub use outdoor_plants::BLOSSOM_COLOURS;

/// Everything a world here is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs)] // the names say it
pub enum Surface {
    WallPaint,
    FloorTile,
    Carpet,
    CeilingTile,
    DoorLeaf,
    Skirting,
    Radiator,
    Opal,
    Enamel,
    Oak,
    Walnut,
    Resin,
    Steel,
    GreyCoat,
    DarkCoat,
    GreyPlastic,
    BlackPlastic,
    BluePlastic,
    RedCoat,
    GreenCoat,
    BlueFabric,
    GreyFabric,
    Cardboard,
    BoxSide,
    Leaf,
    Soil,
    Clay,
    CabinetFront,
    LockerFront,
    DrawerFront,
    Oscilloscope,
    PowerSupply,
    RackFront,
    Keyboard,
    Blind,
    ToolBoard,
    PartsDrawers,
    PeriodicTable,
    Sockets,
    HazardTape,
    LaneTape,
    FloorPlate,
    Copier,
    Notice,
    Flyer,
    AmberBottle,
    WhiteBottle,
    Computer,
    Duct,
    BoxFiles,
    PrintedBox,
    Binders,
    Books,
    OldBooks,
    Whiteboard,
    Noticeboard,
    Paper,
    SciencePoster,
    RobotPoster,
    ContourMap,
    ArtPrint,
    SafetyPoster,
    ExitSign,
    Clock,
    CodeScreen,
    PlotScreen,
    Outdoors,
    Asphalt,
    Pavers,
    Concrete,
    SootyConcrete,
    Lawn,
    Gravel,
    Earth,
    Manhole,
    Grate,
    Foliage,
    Hedge,
    Needles,
    Bark,
    Blossom,
    Brick,
    Plaster,
    RoofTile,
    Stone,
    Planks,
    Timber,
    HouseWindow,
    HouseDoor,
    RollerDoor,
    HouseNumber,
    ParkingSign,
    CarPaint,
    CarSide,
    CarFront,
    CarRear,
    Pane,
    Wheel,
    BinFront,
}

/// How a surface is made.
struct Recipe {
    /// Metres that the texture shows, width and height.
    size: [f32; 2],
    /// Whether it repeats; otherwise a face shows all of it once.
    repeats: bool,
    paint: fn([f32; 2], u32) -> Canvas,
}

/// A surface that repeats every `size` metres.
fn tiled(size: [f32; 2], paint: fn([f32; 2], u32) -> Canvas) -> Recipe {
    Recipe { size, repeats: true, paint }
}

/// A picture of `size` metres.
fn picture(size: [f32; 2], paint: fn([f32; 2], u32) -> Canvas) -> Recipe {
    Recipe { size, repeats: false, paint }
}

impl Surface {
    /// All of them; a world's materials are in this order, without those that it has no use for.
    pub const ALL: [Self; 99] = {
        use Surface::*;
        [
            WallPaint,
            FloorTile,
            Carpet,
            CeilingTile,
            DoorLeaf,
            Skirting,
            Radiator,
            Opal,
            Enamel,
            Oak,
            Walnut,
            Resin,
            Steel,
            GreyCoat,
            DarkCoat,
            GreyPlastic,
            BlackPlastic,
            BluePlastic,
            RedCoat,
            GreenCoat,
            BlueFabric,
            GreyFabric,
            Cardboard,
            BoxSide,
            Leaf,
            Soil,
            Clay,
            CabinetFront,
            LockerFront,
            DrawerFront,
            Oscilloscope,
            PowerSupply,
            RackFront,
            Keyboard,
            Blind,
            ToolBoard,
            PartsDrawers,
            PeriodicTable,
            Sockets,
            HazardTape,
            LaneTape,
            FloorPlate,
            Copier,
            Notice,
            Flyer,
            AmberBottle,
            WhiteBottle,
            Computer,
            Duct,
            BoxFiles,
            PrintedBox,
            Binders,
            Books,
            OldBooks,
            Whiteboard,
            Noticeboard,
            Paper,
            SciencePoster,
            RobotPoster,
            ContourMap,
            ArtPrint,
            SafetyPoster,
            ExitSign,
            Clock,
            CodeScreen,
            PlotScreen,
            Outdoors,
            Asphalt,
            Pavers,
            Concrete,
            SootyConcrete,
            Lawn,
            Gravel,
            Earth,
            Manhole,
            Grate,
            Foliage,
            Hedge,
            Needles,
            Bark,
            Blossom,
            Brick,
            Plaster,
            RoofTile,
            Stone,
            Planks,
            Timber,
            HouseWindow,
            HouseDoor,
            RollerDoor,
            HouseNumber,
            ParkingSign,
            CarPaint,
            CarSide,
            CarFront,
            CarRear,
            Pane,
            Wheel,
            BinFront,
        ]
    };

    /// Its index among all.
    pub fn index(self) -> usize {
        self as usize
    }

    /// How its texture lies on a face. `shift` in 0..1 moves a repeating texture, so that no two pieces look alike.
    pub fn mapping(self, shift: [f32; 2]) -> Mapping {
        let [width, height] = self.recipe().size;
        self.mapping_from([shift[0] * width, shift[1] * height])
    }

    /// The same, with the shift in metres: faces that continue each other line up.
    pub fn mapping_from(self, offset: [f32; 2]) -> Mapping {
        let Recipe { size, repeats, .. } = self.recipe();
        if repeats { Mapping::Tiled { span: size, offset } } else { Mapping::Fitted }
    }

    fn recipe(self) -> Recipe {
        match self {
            Self::WallPaint => tiled([2.0, 2.0], building::wall_paint),
            Self::FloorTile => tiled([1.8, 1.8], building::floor_tile),
            Self::Carpet => tiled([1.0, 1.0], building::carpet),
            Self::CeilingTile => tiled([1.2, 1.2], building::ceiling_tile),
            Self::DoorLeaf => picture([1.0, 2.1], building::door_leaf),
            Self::Skirting => tiled([1.0, 1.0], building::skirting),
            Self::Radiator => picture([1.2, 0.6], building::radiator),
            Self::Opal => tiled([1.0, 1.0], building::opal),
            Self::Enamel => tiled([1.0, 1.0], building::enamel),
            Self::Oak => tiled([1.2, 1.2], stuff::oak),
            Self::Walnut => tiled([1.2, 1.2], stuff::walnut),
            Self::Resin => tiled([1.0, 1.0], stuff::resin),
            Self::Steel => tiled([0.6, 0.6], stuff::steel),
            Self::GreyCoat => tiled([1.0, 1.0], stuff::grey_coat),
            Self::DarkCoat => tiled([1.0, 1.0], stuff::dark_coat),
            Self::GreyPlastic => tiled([0.5, 0.5], stuff::grey_plastic),
            Self::BlackPlastic => tiled([0.5, 0.5], stuff::black_plastic),
            Self::BluePlastic => tiled([0.5, 0.5], stuff::blue_plastic),
            Self::RedCoat => tiled([0.5, 0.5], stuff::red_coat),
            Self::GreenCoat => tiled([0.5, 0.5], stuff::green_coat),
            Self::BlueFabric => tiled([0.4, 0.4], stuff::blue_fabric),
            Self::GreyFabric => tiled([0.4, 0.4], stuff::grey_fabric),
            Self::Cardboard => tiled([0.6, 0.6], stuff::cardboard),
            Self::BoxSide => picture([0.5, 0.4], stuff::box_side),
            Self::Leaf => tiled([0.15, 0.15], stuff::leaf),
            Self::Soil => tiled([0.3, 0.3], stuff::soil),
            Self::Clay => tiled([0.5, 0.5], stuff::clay),
            Self::CabinetFront => picture([0.9, 1.9], fronts::cabinet),
            Self::LockerFront => picture([0.4, 1.8], fronts::locker),
            Self::DrawerFront => picture([0.42, 0.6], fronts::drawers),
            Self::Oscilloscope => picture([0.38, 0.2], fronts::oscilloscope),
            Self::PowerSupply => picture([0.24, 0.16], fronts::power_supply),
            Self::RackFront => picture([0.6, 1.8], fronts::rack),
            Self::Keyboard => picture([0.44, 0.14], fronts::keyboard),
            Self::Blind => tiled([1.0, 1.0], fittings::blind),
            Self::ToolBoard => picture([1.2, 0.8], fittings::tool_board),
            Self::PartsDrawers => picture([0.6, 0.6], fittings::parts_drawers),
            Self::PeriodicTable => picture([1.4, 1.0], fittings::periodic_table),
            Self::Sockets => picture([0.16, 0.08], fittings::sockets),
            Self::HazardTape => tiled([1.0, 0.08], fittings::hazard_tape),
            Self::LaneTape => tiled([1.0, 0.06], fittings::lane_tape),
            Self::FloorPlate => picture([0.4, 0.4], fittings::floor_plate),
            Self::Copier => picture([0.6, 1.0], fittings::copier),
            Self::Notice => picture([0.21, 0.3], fittings::notice),
            Self::Flyer => picture([0.21, 0.3], fittings::flyer),
            Self::AmberBottle => picture([0.3, 0.2], fittings::amber_bottle),
            Self::WhiteBottle => picture([0.3, 0.2], fittings::white_bottle),
            Self::Computer => picture([0.19, 0.44], fittings::computer),
            Self::Duct => tiled([0.5, 0.5], fittings::duct),
            Self::BoxFiles => picture([0.6, 0.3], fittings::box_files),
            Self::PrintedBox => picture([0.4, 0.28], fittings::printed_box),
            Self::Binders => picture([0.9, 0.32], printed::binders),
            Self::Books => picture([0.9, 0.28], printed::books),
            Self::OldBooks => picture([0.9, 0.26], printed::old_books),
            Self::Whiteboard => picture([2.0, 1.2], printed::whiteboard),
            Self::Noticeboard => picture([1.5, 1.0], printed::noticeboard),
            Self::Paper => picture([0.3, 0.42], printed::page),
            Self::SciencePoster => picture([0.84, 1.19], printed::science_poster),
            Self::RobotPoster => picture([0.84, 1.19], printed::robot_poster),
            Self::ContourMap => picture([1.19, 0.84], printed::contour_map),
            Self::ArtPrint => picture([0.9, 0.9], printed::art_print),
            Self::SafetyPoster => picture([0.6, 0.84], printed::safety_poster),
            Self::ExitSign => picture([0.4, 0.2], printed::exit_sign),
            Self::Clock => picture([0.3, 0.3], printed::clock),
            Self::CodeScreen => picture([0.53, 0.3], fronts::code_screen),
            Self::PlotScreen => picture([0.53, 0.3], fronts::plot_screen),
            Self::Outdoors => picture([18.0, 9.0], outdoors::park),
            Self::Asphalt => tiled([2.5, 2.5], outdoor_ground::asphalt),
            Self::Pavers => tiled([2.0, 2.0], outdoor_ground::pavers),
            Self::Concrete => tiled([2.5, 2.5], outdoor_ground::concrete),
            Self::SootyConcrete => tiled([2.5, 2.5], outdoor_ground::sooty_concrete),
            Self::Lawn => tiled([1.6, 1.6], outdoor_ground::lawn),
            Self::Gravel => tiled([1.0, 1.0], outdoor_ground::gravel),
            Self::Earth => tiled([1.2, 1.2], outdoor_ground::earth),
            Self::Manhole => picture([0.7, 0.7], outdoor_ground::manhole),
            Self::Grate => picture([0.5, 0.5], outdoor_ground::grate),
            Self::Foliage => tiled([0.8, 0.8], outdoor_plants::foliage),
            Self::Hedge => tiled([0.8, 0.8], outdoor_plants::hedge),
            Self::Needles => tiled([0.7, 0.7], outdoor_plants::needles),
            Self::Bark => tiled([0.8, 0.8], outdoor_plants::bark),
            Self::Blossom => picture([0.6, 0.6], outdoor_plants::blossom),
            Self::Brick => tiled([2.0, 1.5], outdoor_house::brick),
            Self::Plaster => tiled([3.0, 3.0], outdoor_house::plaster),
            Self::RoofTile => tiled([2.0, 2.1], outdoor_house::roof_tile),
            Self::Stone => tiled([1.6, 1.0], outdoor_house::stone),
            Self::Planks => tiled([1.44, 1.8], outdoor_house::planks),
            Self::Timber => tiled([1.5, 0.6], outdoor_house::timber),
            Self::HouseWindow => picture([1.2, 1.5], outdoor_house::window),
            Self::HouseDoor => picture([1.1, 2.15], outdoor_house::house_door),
            Self::RollerDoor => picture([2.6, 2.2], outdoor_house::roller_door),
            Self::HouseNumber => picture([0.3, 0.24], outdoor_house::house_number),
            Self::ParkingSign => picture([0.42, 0.6], outdoor_house::parking_sign),
            Self::CarPaint => tiled([1.5, 1.5], outdoor_things::car_paint),
            Self::CarSide => picture([4.0, 1.45], outdoor_things::car_side),
            Self::CarFront => picture([1.64, 0.6], outdoor_things::car_front),
            Self::CarRear => picture([1.64, 0.7], outdoor_things::car_rear),
            Self::Pane => tiled([1.2, 1.2], outdoor_things::pane),
            Self::Wheel => picture([0.62, 0.62], outdoor_things::wheel),
            Self::BinFront => picture([0.56, 0.9], outdoor_things::bin_front),
        }
    }
}

/// A material for each of some surfaces, in their order.
pub fn materials(surfaces: &[Surface], seed: u64) -> Vec<Material> {
    surfaces
        .par_iter()
        .map(|&surface| {
            let Recipe { size, paint, .. } = surface.recipe();
            let seed = (seed as u32 ^ (seed >> 32) as u32).wrapping_add(1009 * surface as u32);
            Material { gloss: surface.gloss(), ..paint(size, seed).finish(&format!("{surface:?}")) }
        })
        .collect()
}

/// A material's mean albedo, linear: R, G, B, 830 nm.
pub fn mean_albedo(material: &Material) -> [f32; 4] {
    let linear: Vec<f64> = (0..=255).map(|byte| f64::from(substance::linear(byte as f32 / 255.0))).collect();
    let mut sum = [0.0; 4];
    for &[r, g, b, infrared] in &material.albedo {
        for (sum, value) in sum.iter_mut().zip([r, g, b].map(|byte| linear[byte as usize])) {
            *sum += value;
        }
        sum[3] += f64::from(infrared) / 255.0;
    }
    sum.map(|sum| (sum / (TEXTURE_SIZE * TEXTURE_SIZE) as f64) as f32)
}

#[cfg(test)]
mod tests;
