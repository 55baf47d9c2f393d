//! Surfaces: the base colour, and what becomes of it at 830 nm.
//!
//! No glTF file says how its surfaces look at 830 nm. Where the material's extras do not (`"albedo_830nm"`), every texel
//! takes the largest of its three visible albedos: greys keep their tone, as carbon black, soot and white pigments do;
//! coloured pigments and dyes absorb in part of the visible band and leave 830 nm alone (a rule of thumb after the
//! reflectances of brick, soil, wood and cloth). It is wrong for leaves, which reflect five times more: give them an
//! albedo of their own (0.5).

use gltf::texture::WrappingMode;
use image::imageops::FilterType;
use serde::Deserialize;

use super::source::Source;
use crate::world::material::substance::{encoded, linear};
use crate::world::{Gloss, Material, TEXTURE_SIZE};

const TEXELS: usize = TEXTURE_SIZE * TEXTURE_SIZE;

/// What a material may say in its extras.
#[derive(Default, Deserialize)]
struct Extras {
    albedo_830nm: Option<f32>,
}

pub(super) fn material(source: &Source, material: &gltf::Material<'_>) -> Result<Material, String> {
    let name = material.name().map_or_else(|| "material".to_owned(), str::to_owned);
    describe(source, material, &name).map_err(|problem| format!("material \"{name}\": {problem}"))
}

/// Of what has no material: light grey.
pub(super) fn plain() -> Material {
    Material { name: "plain".into(), albedo: vec![[188, 188, 188, 128]; TEXELS], gloss: Gloss::MATT }
}

fn describe(source: &Source, material: &gltf::Material<'_>, name: &str) -> Result<Material, String> {
    let extras: Extras = match material.extras() {
        Some(extras) => serde_json::from_str(extras.get())
            .map_err(|error| format!("its extras: {error}; write \"albedo_830nm\": 0.4"))?,
        None => Extras::default(),
    };
    if extras.albedo_830nm.is_some_and(|albedo| !(0.0..=1.0).contains(&albedo)) {
        return Err("albedo_830nm in its extras: write a number from 0 to 1".into());
    }
    let look = material.pbr_metallic_roughness();
    let [red, green, blue, _] = look.base_color_factor();
    let colour = |texel: [u8; 4]| {
        let [r, g, b, _] = texel.map(|byte| linear(f32::from(byte) / 255.0));
        let visible = [r * red, g * green, b * blue];
        let infrared = extras.albedo_830nm.unwrap_or_else(|| visible.into_iter().fold(0.0, f32::max));
        let [r, g, b] = visible.map(|albedo| (255.0 * encoded(albedo)).round() as u8);
        [r, g, b, (255.0 * infrared).round() as u8]
    };
    let albedo = match look.base_color_texture() {
        Some(info) => {
            let sampler = info.texture().sampler();
            if [sampler.wrap_s(), sampler.wrap_t()].contains(&WrappingMode::MirroredRepeat) {
                return Err("its texture is mirrored at its edge; export it repeating".into());
            }
            let image = source.image(&info.texture().source())?;
            let size = TEXTURE_SIZE as u32;
            let fitted = image::imageops::resize(&image, size, size, FilterType::Triangle);
            fitted.pixels().map(|texel| colour(texel.0)).collect()
        }
        None => vec![colour([255; 4]); TEXELS],
    };
    Ok(Material { name: name.to_owned(), albedo, gloss: Gloss::MATT })
}
