//! What shaders are told, member for member as their WGSL structs; a test compares the layouts.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, UVec2, Vec2, Vec3, Vec4};

/// `Camera` in `shaders/lib/camera.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Camera {
    pub clip_from_world: Mat4,
    pub camera_from_world: Mat4,
    pub turn: Vec3,
    pub exposure: f32,
    pub shift: Vec3,
    pub readout: f32,
    pub focal: Vec2,
    pub pitch: Vec2,
    pub centre: Vec2,
    pub texel: Vec2,
    pub size: UVec2,
    pub vignetting: f32,
    pub nearest: f32,
}

/// `Daylight` in `shaders/lib/daylight.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Daylight {
    pub map_from_camera: Mat4,
    pub beam: Vec4,
    pub level: Vec4,
    pub rise: Vec4,
    pub glow: Vec4,
    pub ground: Vec4,
    pub towards: Vec3,
    pub map_texel: f32,
    pub up: Vec3,
    pub map_step: f32,
}

/// `Projector` in `shaders/lib/projector.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Projector {
    pub baseline: f32,
    pub toe_in: f32,
    pub pincushion: f32,
    pub peak_irradiance: f32,
    pub tiles: Vec2,
    pub map: Vec2,
    pub tile_brightness: [Vec4; 3],
}

/// How the colour camera's chip turns light into numbers, in one frame. `ColourSensor` in
/// `shaders/colour_sensor.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ColourSensor {
    /// Electrons of a pixel for 1 cd/m², during the exposure.
    pub electrons_per_luminance: f32,
    /// Electrons squared.
    pub read_variance: f32,
    /// 1 with photon noise, 0 without.
    pub shot_noise: f32,
    /// Another for every frame.
    pub noise_key: u32,
    /// Share of full scale for an electron in R, G, B, gains included.
    pub level_per_electron: Vec3,
    /// None.
    pub padding: u32,
}

/// How the infrared camera's chip turns light into numbers, in one frame. `InfraredSensor` in
/// `shaders/infrared_sensor.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct InfraredSensor {
    /// Of the filter, nm.
    pub bandwidth: f32,
    /// Electrons of a pixel for 1 W m⁻² sr⁻¹, during the exposure.
    pub electrons_per_radiance: f32,
    /// Electrons squared.
    pub read_variance: f32,
    /// 1 with photon noise, 0 without.
    pub shot_noise: f32,
    /// Digital numbers for an electron, gain included.
    pub numbers_per_electron: f32,
    /// Standard deviation of the dots' brightness by laser speckle, share.
    pub speckle_contrast: f32,
    /// Another for every frame.
    pub noise_key: u32,
    /// Another for every place the device is at: speckle stays while nothing moves.
    pub speckle_key: u32,
    /// Electrons of a pixel by light that makes no image, during the exposure.
    pub stray_electrons: f32,
}

#[cfg(test)]
mod tests {
    use std::mem::{offset_of, size_of};

    use super::*;
    use crate::render::shader;

    /// Compares members and size with the WGSL struct of the same name.
    fn assert_layout(shader: &str, name: &str, size: usize, members: &[(&str, usize)]) {
        let module = shader::parsed(shader);
        let mut types = module.types.iter().map(|(_, kind)| kind);
        let kind = types.find(|kind| kind.name.as_deref() == Some(name)).unwrap();
        let naga::TypeInner::Struct { members: expected, span } = &kind.inner else {
            panic!("{name} is no struct");
        };
        let expected: Vec<_> =
            expected.iter().map(|member| (member.name.as_deref().unwrap(), member.offset as usize)).collect();
        assert_eq!(members, expected, "{name}");
        assert_eq!(size, *span as usize, "{name}");
    }

    macro_rules! assert_same_layout {
        ($shader:literal, $name:ident: $($member:ident),*) => {
            let members = [$((stringify!($member), offset_of!($name, $member))),*];
            assert_layout($shader, stringify!($name), size_of::<$name>(), &members);
        };
    }

    #[test]
    fn layouts_are_those_of_the_shaders() {
        assert_same_layout!("lib/camera", Camera: clip_from_world, camera_from_world, turn, exposure, shift, readout,
            focal, pitch, centre, texel, size, vignetting, nearest);
        assert_same_layout!("lib/daylight", Daylight: map_from_camera, beam, level, rise, glow, ground, towards,
            map_texel, up, map_step);
        assert_same_layout!("lib/projector", Projector: baseline, toe_in, pincushion, peak_irradiance, tiles, map,
            tile_brightness);
        assert_same_layout!("colour_sensor", ColourSensor: electrons_per_luminance, read_variance, shot_noise,
            noise_key, level_per_electron, padding);
        assert_same_layout!("infrared_sensor", InfraredSensor: bandwidth, electrons_per_radiance, read_variance,
            shot_noise, numbers_per_electron, speckle_contrast, noise_key, speckle_key, stray_electrons);
    }
}
