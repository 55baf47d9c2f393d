//! What the shaders' reflection must hold, asked of the shader itself.

use glam::Vec3;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::device::Device;
use super::readback::Readback;
use super::shader;
use super::stage::{Binding, bind};
use crate::world::{Gloss, SHINIEST, SMOOTHEST};

const ASKING: &str = "
@group(0) @binding(0) var<storage, read_write> asked: array<array<vec4f, 2>>;
@compute @workgroup_size(64)
fn ask(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&asked) { return; }
    let light = asked[id.x][0];
    let eye = asked[id.x][1];
    let gloss = Gloss(light.w, eye.w);
    let glint = mirrored_between(gloss, vec3f(0.0, 0.0, 1.0), light.xyz, eye.xyz);
    asked[id.x][0] = vec4f(glint, scattered_share(gloss, light.z, eye.z), mirrored_share(gloss, eye.z), 0.0);
}
";

/// For pairs of unit vectors towards light and eye, the normal being z: what is mirrored (sr⁻¹), which share of what a
/// matt surface scatters is scattered, and which share is mirrored of even light.
fn reflections(gpu: &Device, gloss: Gloss, pairs: &[[Vec3; 2]]) -> Vec<[f32; 3]> {
    let asked: Vec<[f32; 8]> = (pairs.iter())
        .map(|[light, eye]| [light.x, light.y, light.z, gloss.reflectance, eye.x, eye.y, eye.z, gloss.roughness])
        .collect();
    let contents: &[u8] = bytemuck::cast_slice(&asked);
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let buffer = gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage });
    let (layout, group) = bind(gpu, wgpu::ShaderStages::COMPUTE, &[Binding::Output(&buffer)]);
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let source = wgpu::ShaderSource::Wgsl((shader::source("lib/gloss") + ASKING).into());
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&layout),
        module: &module,
        entry_point: Some("ask"),
        compilation_options: Default::default(),
        cache: None,
    });
    let readback = Readback::new(gpu, buffer.size());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((pairs.len() as u32).div_ceil(64), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&buffer, 0, readback.buffer(), 0, buffer.size());
    let submission = gpu.queue.submit([encoder.finish()]);
    let answers = readback
        .read(gpu, &submission, |bytes| bytemuck::cast_slice::<u8, [f32; 8]>(bytes).to_vec())
        .expect("an answer");
    answers.into_iter().map(|[glint, scattered, mirrored, ..]| [glint, scattered, mirrored]).collect()
}

fn direction(from_normal: f32, around: f32) -> Vec3 {
    let (sin, cos) = from_normal.sin_cos();
    Vec3::new(sin * around.cos(), sin * around.sin(), cos)
}

const GLOSSES: [Gloss; 7] = [
    Gloss::MATT,
    Gloss::SATIN,
    Gloss::VARNISH,
    Gloss::CAR_PAINT,
    Gloss::STEEL,
    Gloss::WATER,
    Gloss { reflectance: SHINIEST, roughness: 0.1 },
];

#[test]
fn light_and_eye_may_change_places() {
    let gpu = Device::open().expect("an adapter");
    let some = [0.1, 0.6, 1.1, 1.5].map(|angle| direction(angle, 3.0 * angle));
    let pairs: Vec<[Vec3; 2]> = some.iter().flat_map(|&light| some.map(|eye| [light, eye])).collect();
    let swapped: Vec<[Vec3; 2]> = pairs.iter().map(|&[light, eye]| [eye, light]).collect();
    for gloss in GLOSSES {
        for (there, back) in reflections(&gpu, gloss, &pairs).iter().zip(reflections(&gpu, gloss, &swapped)) {
            for (there, back) in [(there[0], back[0]), (there[1], back[1])] {
                assert!((there - back).abs() <= 1e-4 * there.abs(), "{gloss:?}: {there} and {back}");
            }
        }
    }
}

/// Middles of so many steps from 0 to 1, in pairs.
fn grid(steps: [usize; 2]) -> impl Iterator<Item = [f32; 2]> {
    (0..steps[0] * steps[1]).map(move |index| {
        let [row, column] = [index / steps[1], index % steps[1]];
        [(row as f32 + 0.5) / steps[0] as f32, (column as f32 + 0.5) / steps[1] as f32]
    })
}

/// What a white body with this boundary gives back of light from one direction: mirrored, and scattered.
fn given_back(gpu: &Device, gloss: Gloss, light: Vec3) -> [f64; 2] {
    const STEPS: [usize; 2] = [300, 300];
    let count = (STEPS[0] * STEPS[1]) as f64;
    // Directions by equal shares of cosine-weighted solid angle.
    let eyes = grid(STEPS).map(|[share, turn]| direction(share.sqrt().asin(), turn * std::f32::consts::TAU));
    let pairs: Vec<[Vec3; 2]> = eyes.map(|eye| [light, eye]).collect();
    let scattered = reflections(gpu, gloss, &pairs).iter().map(|answer| f64::from(answer[1])).sum::<f64>() / count;
    // And by equal shares of the facets, as lobes may be narrow.
    let alpha = f64::from(gloss.roughness);
    let facets = grid(STEPS).map(|[share, turn]| {
        let slope = gloss.roughness * (share / (1.0 - share)).sqrt();
        direction(slope.atan(), turn * std::f32::consts::TAU)
    });
    let mirrored: Vec<([Vec3; 2], f64)> = facets
        .filter_map(|facet| {
            let eye = 2.0 * light.dot(facet) * facet - light;
            let cosine = f64::from(facet.z);
            let density =
                cosine * (alpha / (cosine * cosine * (alpha * alpha - 1.0) + 1.0)).powi(2) / std::f64::consts::PI;
            let weight = f64::from(4.0 * light.dot(facet) * eye.z) / density;
            (light.dot(facet) > 0.0 && eye.z > 0.0).then_some(([light, eye], weight))
        })
        .collect();
    let pairs: Vec<[Vec3; 2]> = mirrored.iter().map(|(pair, _)| *pair).collect();
    let answers = reflections(gpu, gloss, &pairs);
    let sum: f64 = answers.iter().zip(&mirrored).map(|(answer, (_, weight))| f64::from(answer[0]) * weight).sum();
    [sum / count, scattered]
}

#[test]
fn no_more_comes_back_than_came_and_what_the_boundary_leaves_the_body_scatters() {
    let gpu = Device::open().expect("an adapter");
    for gloss in GLOSSES {
        for angle in [0.05_f32, 0.8, 1.2, 1.45] {
            let light = direction(angle, 0.3);
            let [mirrored, scattered] = given_back(&gpu, gloss, light);
            let entered = 1.0 - f64::from(reflections(&gpu, gloss, &[[light, light]])[0][2]);
            assert!((scattered - entered).abs() < 2e-3, "{gloss:?} at {angle}: {scattered} of {entered}");
            assert!(mirrored + scattered < 1.02, "{gloss:?} at {angle}: {mirrored} + {scattered}");
        }
        let [mirrored, _] = given_back(&gpu, gloss, direction(0.05, 0.3));
        let lost_between_facets = 0.7 * f64::from(gloss.roughness * gloss.reflectance);
        assert!((mirrored - f64::from(gloss.reflectance)).abs() < lost_between_facets + 1e-3, "{gloss:?}: {mirrored}");
    }
}

#[test]
fn a_mirror_is_brightest_where_mirrors_are() {
    let gpu = Device::open().expect("an adapter");
    for gloss in [Gloss::GLASS, Gloss::CAR_PAINT, Gloss::VARNISH] {
        let light = direction(0.7, 0.0);
        let eyes: Vec<f32> = (0..1500).map(|step| 0.001 * step as f32).collect();
        let pairs: Vec<[Vec3; 2]> = eyes.iter().map(|&angle| [light, direction(angle, std::f32::consts::PI)]).collect();
        let seen = reflections(&gpu, gloss, &pairs);
        let brightest = (0..eyes.len()).max_by(|&a, &b| seen[a][0].total_cmp(&seen[b][0])).unwrap();
        assert!((eyes[brightest] - 0.7).abs() < 0.3 * gloss.roughness.max(SMOOTHEST), "{gloss:?}: {}", eyes[brightest]);
    }
}

#[test]
fn fresnel_follows_the_exact_law_of_glass_and_a_matt_surface_mirrors_nothing() {
    let gpu = Device::open().expect("an adapter");
    let angles = [0.0_f32, 0.5, 1.0, 1.2, 1.4];
    let pairs: Vec<[Vec3; 2]> = angles.iter().map(|&angle| [direction(angle, 0.0); 2]).collect();
    let one_face = Gloss { reflectance: 0.04, roughness: 0.1 };
    for (&angle, [.., share]) in angles.iter().zip(reflections(&gpu, one_face, &pairs)) {
        // Unpolarised, n = 1.5.
        let (cos, inner) = (angle.cos(), (1.0 - (angle.sin() / 1.5).powi(2)).sqrt());
        let [across, along] = [(cos - 1.5 * inner) / (cos + 1.5 * inner), (1.5 * cos - inner) / (1.5 * cos + inner)];
        let exact = 0.5 * (across * across + along * along);
        assert!((share - exact).abs() < 0.03, "{angle}: {share}, exactly {exact}");
    }
    assert!(reflections(&gpu, Gloss::MATT, &pairs).iter().all(|answer| *answer == [0.0, 1.0, 0.0]));
}
