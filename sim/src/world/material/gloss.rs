//! What mirrors, and how sharply: the one table of surfaces' boundaries. What passes a boundary is the albedo's business.

use super::Surface;

/// A surface's boundary, the same in both bands: glass, water and lacquer bend 830 nm as visible light within a hundredth,
/// and mirror it alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gloss {
    /// Share of light that is mirrored at normal incidence; towards grazing it grows to 1 (Schlick). 0: matt. Not above
    /// [`SHINIEST`].
    pub reflectance: f32,
    /// α of the GGX distribution: about the typical slope of the facets that mirror. Not below [`SMOOTHEST`].
    pub roughness: f32,
}

/// The sun's disc is 0.0047 rad in radius: from a smoother surface its glint would be no smaller. With that, float glass.
pub const SMOOTHEST: f32 = 0.006;
/// Polished silver.
pub const SHINIEST: f32 = 0.97;

// Reflectances of clear things are ((n − 1)/(n + 1))², n at 589 nm from handbooks. Roughnesses are guesses by how sharp
// a lamp's image is in such a thing.

impl Gloss {
    /// Mirrors nothing, as all that is porous, woven or rough does but for a little; unglazed tiles, walked upon, as well.
    pub const MATT: Self = Self { reflectance: 0.0, roughness: 1.0 };
    /// Two faces of a pane, n = 1.52. Literature: 0.08.
    pub const GLASS: Self = Self { reflectance: 0.08, roughness: SMOOTHEST };
    /// Still water, n = 1.33.
    pub const WATER: Self = Self { reflectance: 0.02, roughness: 0.01 };
    /// Clear coat over paint, n = 1.5.
    pub const CAR_PAINT: Self = Self { reflectance: 0.04, roughness: 0.03 };
    /// Brushed steel. Literature: iron 0.56 at 589 nm, 0.62 at 830 nm; brushing leaves half of it to the lobe (a guess), the
    /// rest is in its albedo.
    pub const STEEL: Self = Self { reflectance: 0.3, roughness: 0.25 };
    /// Satin lacquer on wood, n = 1.5.
    pub const VARNISH: Self = Self { reflectance: 0.04, roughness: 0.2 };
    /// Enamel, moulded plastic, a whiteboard, n = 1.5.
    pub const ENAMEL: Self = Self { reflectance: 0.04, roughness: 0.15 };
    /// Powder coat and grained plastic, n = 1.5.
    pub const SATIN: Self = Self { reflectance: 0.04, roughness: 0.35 };
}

impl Surface {
    /// How it mirrors.
    pub(super) fn gloss(self) -> Gloss {
        use Surface::*;
        match self {
            Pane | HouseWindow | Oscilloscope | CodeScreen | PlotScreen | AmberBottle | Clock => Gloss::GLASS,
            CarPaint | CarSide | CarFront | CarRear => Gloss::CAR_PAINT,
            Steel | Duct => Gloss::STEEL,
            DoorLeaf | Oak | Walnut | HouseDoor => Gloss::VARNISH,
            Radiator | Enamel | Opal | Whiteboard | WhiteBottle | BluePlastic | BinFront | ParkingSign => Gloss::ENAMEL,
            GreyCoat | DarkCoat | RedCoat | GreenCoat | GreyPlastic | BlackPlastic | CabinetFront | LockerFront
            | DrawerFront | RollerDoor | Resin | Copier | Computer => Gloss::SATIN,
            _ => Gloss::MATT,
        }
    }
}
