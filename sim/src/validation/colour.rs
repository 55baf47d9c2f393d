//! Surfaces in two bands, as both cameras see them.

use glam::Vec3;

use super::bench::{Bench, Seen};
use super::scene::{Light, object, panel, world};
use super::statistics::mean;
use super::{Effort, Finding, Findings};
use crate::render::RenderError;
use crate::world::material::substance::{Substance, encoded};
use crate::world::{Gloss, Material, TEXTURE_SIZE};

// Measured spectra (ECOSTRESS, SLUM); red at 650 nm, and 830 nm.
const GRASS: Substance = [0.05, 0.11, 0.04, 0.49];
const ASPHALT: Substance = [0.125, 0.113, 0.094, 0.15];
const CONCRETE: Substance = [0.29, 0.26, 0.21, 0.33];
/// Equally bright in all bands.
const GREY: Substance = [0.25; 4];

/// How far the panels are, metres.
const DISTANCE: f32 = 1.0;

/// To the left a surface, to the right grey, both in the sun.
fn beside_grey(surface: Substance) -> Result<Seen, RenderError> {
    let light = Light::sun(20.0);
    let half = |left: f32| panel(Vec3::new(left, DISTANCE, -2.0), [2.0 * Vec3::X, 4.0 * Vec3::Z], 4, light);
    let material = |name: &str, [red, green, blue, infrared]: Substance| {
        let byte = |value: f32| (255.0 * value).round() as u8;
        let texel = [byte(encoded(red)), byte(encoded(green)), byte(encoded(blue)), byte(infrared)];
        Material { name: name.into(), albedo: vec![texel; TEXTURE_SIZE * TEXTURE_SIZE], gloss: Gloss::MATT }
    };
    let objects = vec![object("surface", half(-2.0), 0), object("grey", half(0.0), 1)];
    Bench::new(&world("panels", objects, vec![material("surface", surface), material("grey", GREY)]))?.look()
}

/// 830 nm over red, from both cameras' images.
fn infrared_over_red(surface: Substance) -> Result<f64, RenderError> {
    let seen = beside_grey(surface)?;
    let over_grey = |value: &dyn Fn(usize, usize) -> f64| {
        let side = |first: usize| {
            mean(&(180..300).flat_map(|y| (first..first + 60).map(move |x| value(x, y))).collect::<Vec<_>>())
        };
        side(200) / side(380)
    };
    let infrared = over_grey(&|x, y| f64::from(seen.frame.infrared.at(x, y)));
    let red = over_grey(&|x, y| (f64::from(seen.frame.rgb.at(x, y)[0]) / 255.0).powf(2.2));
    Ok(infrared / red)
}

/// V14: what tells plants from stone.
pub(super) fn surfaces(_: Effort) -> Findings {
    let even = |target: f64| 0.7 * target..=1.3 * target;
    Ok(vec![
        Finding::new("830 nm over red, grass", 5.0, 5.0..=15.0, infrared_over_red(GRASS)?),
        Finding::new("830 nm over red, asphalt", 1.2, even(1.2), infrared_over_red(ASPHALT)?),
        Finding::new("830 nm over red, concrete", 1.2, even(1.2), infrared_over_red(CONCRETE)?),
    ])
}
