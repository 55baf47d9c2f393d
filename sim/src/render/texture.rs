//! Albedo textures with their mip levels, one array layer a material.

use std::iter;

use half::f16;
use wgpu::util::{DeviceExt, TextureDataOrder};

use super::device::{Device, RenderError};
use crate::world::{Gloss, Material, SHINIEST, SMOOTHEST, TEXTURE_SIZE};

const LEVELS: u32 = TEXTURE_SIZE.ilog2() + 1;

/// All materials, and after them a white one that nothing is made of: OpenGL takes an array of one layer for none.
pub(super) fn albedo_array(gpu: &Device, materials: &[Material]) -> Result<wgpu::TextureView, RenderError> {
    let layers = materials.len() + 1;
    let limit = gpu.device.limits().max_texture_array_layers;
    if layers > limit as usize {
        return Err(RenderError::TooManyMaterials { materials: layers, limit });
    }
    let white = vec![[u8::MAX; 4]; TEXTURE_SIZE * TEXTURE_SIZE];
    let mut texels: Vec<u8> = Vec::new();
    for material in materials {
        if material.albedo.len() != white.len() {
            return Err(RenderError::Material { name: material.name.clone(), texels: material.albedo.len() });
        }
        append_with_mips(&mut texels, &material.albedo);
    }
    append_with_mips(&mut texels, &white);
    let descriptor = wgpu::TextureDescriptor {
        label: Some("albedos"),
        size: wgpu::Extent3d {
            width: TEXTURE_SIZE as u32,
            height: TEXTURE_SIZE as u32,
            depth_or_array_layers: layers as u32,
        },
        mip_level_count: LEVELS,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, &texels);
    Ok(texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    }))
}

/// How each material mirrors, in a row: reflectance, roughness. After them the white one's.
pub(super) fn gloss_row(gpu: &Device, materials: &[Material]) -> wgpu::TextureView {
    let glosses = materials.iter().map(|material| material.gloss).chain(iter::once(Gloss::MATT));
    let texels: Vec<[f16; 2]> = glosses
        .map(|gloss| [gloss.reflectance.min(SHINIEST), gloss.roughness.max(SMOOTHEST)].map(f16::from_f32))
        .collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("glosses"),
        size: wgpu::Extent3d { width: texels.len() as u32, height: 1, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rg16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let halves: Vec<u16> = texels.as_flattened().iter().map(|number| number.to_bits()).collect();
    let bytes = bytemuck::cast_slice(&halves);
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, bytes);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn append_with_mips(texels: &mut Vec<u8>, albedo: &[[u8; 4]]) {
    let mut level = albedo.to_vec();
    let mut size = TEXTURE_SIZE;
    loop {
        texels.extend_from_slice(level.as_flattened());
        if size == 1 {
            return;
        }
        level = halved(&level, size);
        size /= 2;
    }
}

/// Means of 2×2 texels. Of light, not of its sRGB encoding: its square is near enough to light, and exact at both ends.
fn halved(texels: &[[u8; 4]], size: usize) -> Vec<[u8; 4]> {
    let half = size / 2;
    (0..half * half)
        .map(|index| {
            let corner = 2 * (index / half) * size + 2 * (index % half);
            let quad = [corner, corner + 1, corner + size, corner + size + 1].map(|at| texels[at].map(f32::from));
            std::array::from_fn(|channel| {
                let values = quad.map(|texel| texel[channel]);
                let mean = match channel {
                    3 => values.iter().sum::<f32>() / 4.0,
                    _ => (values.iter().map(|value| value * value).sum::<f32>() / 4.0).sqrt(),
                };
                mean.round() as u8
            })
        })
        .collect()
}
