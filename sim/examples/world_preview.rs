//! Pictures of the laboratory without a graphics adapter: ten places along its loop in visible light and at 830 nm, and
//! the plan from above.
//!
//! `cargo run --release --example world_preview -- OUT_FOLDER`

use std::path::PathBuf;
use std::time::Instant;

use glam::{DVec3, Vec3, Vec4};
use image::{Rgb, RgbImage, imageops};
use rayon::prelude::*;
use sunblind_sim::light::LightState;
use sunblind_sim::world::bake::{Effort, bake_cached};
use sunblind_sim::world::laboratory::{laboratory, loop_waypoints};
use sunblind_sim::world::material::substance::{encoded, linear};
use sunblind_sim::world::rays::Rays;
use sunblind_sim::world::{TEXTURE_SIZE, World};

/// A Kinect's picture at half resolution: width, height, focal length, pixels.
const VIEW: (u32, u32, f64) = (320, 240, 262.5);
/// Rays a pixel along each axis.
const SAMPLES: u32 = 3;
/// Height of the lens, metres.
const LENS: f64 = 0.60;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out/preview".into()));
    let start = Instant::now();
    let mut world = laboratory(1);
    let triangles: usize = world.objects.iter().map(|object| object.mesh.triangles.len()).sum();
    let vertices: usize = world.objects.iter().map(|object| object.mesh.positions.len()).sum();
    println!(
        "{} objects, {triangles} triangles, {vertices} vertices, built in {:.1?}",
        world.objects.len(),
        start.elapsed()
    );
    let start = Instant::now();
    let origin = bake_cached(&mut world, &Effort::default(), &folder.join("cache"), &|_| ())?;
    println!("light: {origin:?} in {:.1?}", start.elapsed());
    let mut light = world.transfer.irradiance(&world.transfer.weights(&LightState::default())).into_iter();
    for object in &mut world.objects {
        object.mesh.irradiance = light.by_ref().take(object.mesh.positions.len()).collect();
    }

    let rays = Rays::new(&world.objects).ok_or("an empty world")?;
    let radiosity = |origin: DVec3, direction: DVec3| look(&world, &rays, origin, direction);
    let points: Vec<DVec3> = loop_waypoints().into_iter().map(|[x, y]| DVec3::new(x, y, LENS)).collect();
    let (width, height, focal) = VIEW;
    let mut sheets = [(); 2].map(|()| RgbImage::new(2 * width, 5 * height));
    for place in 0..10 {
        let index = place * (points.len() - 1) / 10;
        let ahead = (points[index + 3] - points[index]).normalize();
        let right = ahead.cross(DVec3::Z);
        let pixels = render(width, height, |x, y| {
            let [u, v] = [(x - 0.5 * f64::from(width)) / focal, (y - 0.5 * f64::from(height)) / focal];
            radiosity(points[index], ahead + u * right - v * DVec3::Z)
        });
        let corner = ((place % 2) as u32 * width, (place / 2) as u32 * height);
        for (sheet, picture) in sheets.iter_mut().zip(developed(&pixels, width, height)) {
            imageops::replace(sheet, &picture, corner.0.into(), corner.1.into());
        }
    }
    let (width, height) = (1080, 810);
    let plan = render(width, height, |x, y| radiosity(DVec3::new(x / 90.0, 9.0 - y / 90.0, 2.25), -DVec3::Z));
    let [plan, _] = developed(&plan, width, height);
    let [visible, infrared] = sheets;
    for (name, picture) in [("visible", visible), ("infrared", infrared), ("plan", plan)] {
        let path = folder.join(name).with_extension("png");
        picture.save(&path)?;
        println!("{}", path.display());
    }
    Ok(())
}

/// Mean radiosity over each pixel, all four channels.
fn render(width: u32, height: u32, look: impl Fn(f64, f64) -> Vec4 + Sync) -> Vec<Vec4> {
    let offsets: Vec<f64> = (0..SAMPLES).map(|i| (f64::from(i) + 0.5) / f64::from(SAMPLES)).collect();
    let pixel = |index: u32| {
        let (x, y) = (f64::from(index % width), f64::from(index / width));
        let sum: Vec4 = offsets
            .iter()
            .flat_map(|dx| offsets.iter().map(move |dy| (dx, dy)))
            .map(|(dx, dy)| look(x + dx, y + dy))
            .sum();
        sum / (SAMPLES * SAMPLES) as f32
    };
    (0..width * height).into_par_iter().map(pixel).collect()
}

/// What the first surface on a ray sheds: irradiance × albedo.
fn look(world: &World, rays: &Rays, origin: DVec3, direction: DVec3) -> Vec4 {
    let Some(hit) = rays.first(origin, direction, f64::MAX) else { return Vec4::ZERO };
    let source = rays.source(&hit);
    let object = &world.objects[source.object];
    let corners = object.mesh.triangles[source.triangle];
    let [a, b, c] = object.mesh.corners(corners);
    let at = (origin + hit.distance * direction).as_vec3() - a;
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let share = |edge: Vec3| edge.dot(normal) / normal.length_squared();
    let (v, w) = (share(at.cross(ac)), share(ab.cross(at)));
    let weights = [1.0 - v - w, v, w];
    let (mut uv, mut light) = ([0.0; 2], Vec4::ZERO);
    for (weight, corner) in weights.into_iter().zip(corners.map(|corner| corner as usize)) {
        uv = [0, 1].map(|axis| uv[axis] + weight * object.mesh.uvs[corner][axis]);
        light += weight * Vec4::from(object.mesh.irradiance[corner]);
    }
    let [column, row] = uv.map(|t| ((t.rem_euclid(1.0) * TEXTURE_SIZE as f32) as usize).min(TEXTURE_SIZE - 1));
    let [r, g, b, infrared] = world.materials[object.material].albedo[row * TEXTURE_SIZE + column];
    let [r, g, b] = [r, g, b].map(|byte| linear(f32::from(byte) / 255.0));
    light * Vec4::new(r, g, b, f32::from(infrared) / 255.0)
}

/// The visible picture and the one at 830 nm, each exposed for its own mean (bright spots clipped out of it).
fn developed(pixels: &[Vec4], width: u32, height: u32) -> [RgbImage; 2] {
    let exposure = |value: &dyn Fn(&Vec4) -> f32| {
        let mut sorted: Vec<f32> = pixels.iter().map(value).collect();
        sorted.sort_by(f32::total_cmp);
        let mean = sorted[..sorted.len() * 9 / 10].iter().sum::<f32>() / (sorted.len() as f32 * 0.9);
        0.2 / mean.max(1e-9)
    };
    let (visible, infrared) = (exposure(&|pixel| pixel.y), exposure(&|pixel| pixel.w));
    // A soft shoulder, so that windows keep some of their picture.
    let tone = |value: f32| (255.0 * encoded((value * (1.0 + value / 6.0)) / (1.0 + value)).min(1.0)) as u8;
    [0, 1].map(|band| {
        RgbImage::from_fn(width, height, |x, y| {
            let pixel = pixels[(y * width + x) as usize];
            let values = if band == 0 { (visible * pixel).truncate() } else { Vec3::splat(infrared * pixel.w) };
            Rgb(values.to_array().map(tone))
        })
    })
}
