//! What surfaces are made of, in both bands: the one table of albedos.

/// Albedo of a matt surface: linear R, G, B, and at 830 nm.
pub type Substance = [f32; 4];

/// A colour given as sRGB hexadecimal, in linear R, G, B.
pub fn colour(hex: u32) -> [f32; 3] {
    [16, 8, 0].map(|shift| linear(((hex >> shift) & 255) as f32 / 255.0))
}

/// An opaque paint or plastic of a colour, with its own albedo at 830 nm.
pub fn coat(hex: u32, infrared: f32) -> Substance {
    let [r, g, b] = colour(hex);
    [r, g, b, infrared]
}

/// sRGB to linear (IEC 61966-2-1).
pub fn linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Linear to sRGB (IEC 61966-2-1).
pub fn encoded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

// Where each figure comes from. "Measured": spectral libraries (SLUM, ECOSTRESS). "Literature": remembered from it.
// "Guess": by analogy, the analogy named.

/// White wall paint. Literature: 0.80, 0.85, 0.85; 0.80–0.88 at 830 nm. A little soiled.
pub const WALL_PAINT: Substance = [0.79, 0.78, 0.74, 0.82];
/// Painted mineral fibre. Guess: as wall paint.
pub const CEILING: Substance = [0.80, 0.80, 0.78, 0.82];
/// Grey ceramic tile. Guess: between measured granite (0.41 → 0.43) and concrete.
pub const CERAMIC: Substance = [0.40, 0.39, 0.36, 0.44];
/// Cement, as grout. Measured concrete: 0.22, 0.28, 0.32 → 0.34; soiled.
pub const GROUT: Substance = [0.17, 0.155, 0.135, 0.2];
/// Dyed nylon carpet, blue-grey. Guess: dyes vanish, fibre stays (literature, dyed cotton: 0.3–0.7).
pub const CARPET: Substance = [0.075, 0.095, 0.135, 0.42];
/// Light wood, lacquered. Literature, untreated: 0.50, 0.40, 0.25 → 0.60–0.75.
pub const OAK: Substance = [0.48, 0.33, 0.19, 0.64];
/// Dark wood. Guess: tannins vanish too, 0.50.
pub const WALNUT: Substance = [0.17, 0.095, 0.055, 0.50];
/// Brushed steel or aluminium. Measured aluminium, its matt part: 0.53, 0.50, 0.45 → 0.53.
pub const STEEL: Substance = [0.47, 0.47, 0.46, 0.50];
/// Grey powder coat, titanium white with carbon black. Guess: both keep their tone, so grey stays.
pub const GREY_COAT: Substance = [0.50, 0.51, 0.50, 0.52];
/// Dark grey powder coat. Guess: as above.
pub const DARK_COAT: Substance = [0.075, 0.078, 0.085, 0.08];
/// Black plastic or rubber with carbon black. Literature: 0.04 → 0.04–0.06.
pub const CARBON_BLACK: Substance = [0.04, 0.04, 0.042, 0.05];
/// Light grey housing plastic. Guess: as white paint, toned with carbon.
pub const GREY_PLASTIC: Substance = [0.55, 0.54, 0.50, 0.57];
/// Black resin worktop. Guess: carbon black, slightly dusty.
pub const RESIN: Substance = [0.085, 0.085, 0.088, 0.095];
/// Cardboard. Guess: unbleached wood fibre, as untreated wood.
pub const CARDBOARD: Substance = [0.40, 0.28, 0.16, 0.62];
/// White paper. Guess: as white paint and white cotton (0.85).
pub const PAPER: Substance = [0.82, 0.82, 0.80, 0.84];
/// Undyed cloth. Literature, white cotton: 0.80–0.85 → 0.85; woven, so shadowed.
pub const CLOTH_AT_830: f32 = 0.55;
/// Cork. Guess: as bark and wood.
pub const CORK: Substance = [0.34, 0.20, 0.10, 0.55];
/// Green leaf. Measured deciduous: 0.05, 0.11, 0.06 → 0.55.
pub const LEAF: Substance = [0.05, 0.11, 0.045, 0.52];
/// Potting soil. Measured dark loam: 0.08, 0.05, 0.02 → 0.16.
pub const SOIL: Substance = [0.08, 0.05, 0.025, 0.16];
/// Fired clay. Measured brick: 0.31, 0.24, 0.17 → 0.35.
pub const CLAY: Substance = [0.36, 0.17, 0.09, 0.38];
/// White enamelled steel. Guess: as white paint.
pub const ENAMEL: Substance = [0.80, 0.81, 0.80, 0.80];
/// The face of a switched-off display: dark glass. Guess.
pub const DARK_GLASS: Substance = [0.025, 0.026, 0.03, 0.04];
/// Roller blind of glare-control fabric, PVC-coated polyester, pale grey. Guess: as grey paint, its holes dark.
pub const BLIND: Substance = [0.52, 0.52, 0.50, 0.54];
/// Opal lamp cover. Guess: as white plastic.
pub const OPAL: Substance = [0.85, 0.85, 0.85, 0.85];
/// Red enamel (organic pigment). Guess: vanishes like a dye, over white.
pub const RED_COAT: Substance = [0.50, 0.025, 0.02, 0.62];
/// Blue plastic (phthalocyanine). Guess: its red absorption ends before 830 nm.
pub const BLUE_PLASTIC: Substance = [0.03, 0.09, 0.33, 0.50];
/// Overcast sky as a painted backdrop: 830 nm falls a little less on it than on the sky's lux. Guess.
pub const SKY: Substance = [0.76, 0.84, 0.94, 0.80];

// Outdoors.

/// Asphalt, some years old. Measured: 0.15, 0.13, 0.11 → 0.16 (SLUM); 0.09, 0.07, 0.05 → 0.11 (ECOSTRESS); between.
pub const ASPHALT: Substance = [0.125, 0.113, 0.094, 0.150];
/// Concrete. Measured: 0.32, 0.28, 0.22 → 0.34, 0.36, 0.33, 0.26 → 0.37; a little soiled.
pub const CONCRETE: Substance = [0.29, 0.26, 0.21, 0.33];
/// Concrete under years of exhaust. A guess: a third of it, as carbon black has 0.04 in both bands.
pub const SOOTY_CONCRETE: Substance = [0.10, 0.093, 0.082, 0.12];
/// A lawn. Measured: 0.05 at 650 nm, 0.11, 0.04 → 0.49; red as a camera sees it reaches down to 580 nm, where grass is
/// brighter (a guess).
pub const GRASS: Substance = [0.063, 0.11, 0.041, 0.49];
/// Conifer's needles. Measured: 0.05, 0.11, 0.05 → 0.51; a dark kind.
pub const NEEDLES: Substance = [0.035, 0.075, 0.036, 0.45];
/// Bark. Guess: as dark untreated wood; tannins vanish in part.
pub const BARK: Substance = [0.16, 0.12, 0.085, 0.33];
/// Pebbles. Measured granite: 0.41, 0.39, 0.34 → 0.43; limestone: 0.41, 0.36, 0.26 → 0.45.
pub const PEBBLE: Substance = [0.41, 0.37, 0.30, 0.44];
/// Natural stone of a wall. Measured limestone: 0.41, 0.36, 0.26 → 0.45; weathered.
pub const STONE: Substance = [0.34, 0.30, 0.225, 0.38];
/// Brick. Measured: 0.31, 0.24, 0.17 → 0.35, range 0.10–0.63; a red one.
pub const BRICK: Substance = [0.31, 0.15, 0.10, 0.36];
/// Roof tiles. Measured: 0.17, 0.10, 0.08 → 0.22.
pub const ROOF_TILE: Substance = [0.17, 0.10, 0.08, 0.22];
/// Lime plaster, painted ochre (iron oxide). Guess: white paint below 600 nm less the oxide, which is clear at 830 nm but
/// for its band at 870.
pub const OCHRE_PLASTER: Substance = [0.60, 0.46, 0.27, 0.60];
/// Untreated wood, weathered grey. Guess: as untreated wood (0.50, 0.40, 0.25 → 0.60–0.75), darkened.
pub const WEATHERED_WOOD: Substance = [0.27, 0.225, 0.175, 0.46];
/// Cast iron, worn and rusty. Guess: near measured galvanised steel (0.08, 0.04, 0.02 → 0.08).
pub const IRON: Substance = [0.085, 0.075, 0.066, 0.105];
/// A window pane before a dark room; it mirrors some sky, which a matt surface can only hint at. Literature: 0.08 specular.
pub const PANE: Substance = [0.05, 0.06, 0.072, 0.055];
