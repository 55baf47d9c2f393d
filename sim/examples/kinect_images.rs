//! Writes what a Kinect sees of a small room to PNG files: `kinect_images FOLDER [KILOLUX of sun]`.

use std::path::PathBuf;

use image::{GrayImage, Luma, Rgb};
use sunblind_sim::kinect::{Imaging, Kinect, calibration::Calibration, matcher::NO_DEPTH};
use sunblind_sim::render::Sweep;
use sunblind_sim::validation::scene::{Light, looking_north, room_world};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| "out".into()));
    let light = match arguments.next() {
        Some(kilolux) => Light::sun(kilolux.parse()?),
        None => Light::LED,
    };
    std::fs::create_dir_all(&folder)?;
    let world = room_world(20, light);
    let mut kinect = Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1)?;
    println!("{:?}", kinect.adapter());
    let mut sweep = Sweep::still(looking_north());
    sweep.end *= glam::DAffine3::from_rotation_y(0.0);
    let frame = kinect.capture(&sweep, 0)?;
    println!("{:?}", kinect.exposures());
    let (width, height) = (frame.rgb.width() as u32, frame.rgb.height() as u32);
    image::RgbImage::from_raw(width, height, frame.rgb.pixels().as_flattened().to_vec())
        .ok_or("size")?
        .save(folder.join("rgb.png"))?;
    let infrared = frame.infrared.pixels().iter().map(|&number| (number / 4) as u8).collect();
    GrayImage::from_raw(width, height, infrared).ok_or("size")?.save(folder.join("ir.png"))?;
    let truth = kinect.true_depth()?;
    let shade = |z: f64| ((z / 6.0).clamp(0.0, 1.0) * 235.0) as u8 + 20;
    let camera = kinect.calibration().rig(nalgebra::Isometry3::identity()).depth;
    let depth = |x: u32, y: u32| camera.depth_of(frame.depth_raw.at(x as usize, y as usize));
    GrayImage::from_fn(width, height, |x, y| Luma([depth(x, y).map_or(0, shade)])).save(folder.join("depth.png"))?;
    let error = image::RgbImage::from_fn(width, height, |x, y| {
        let true_z = f64::from(truth.at(x as usize, y as usize));
        match depth(x, y) {
            None => Rgb([0, 0, 0]),
            Some(z) => {
                let levels = 8.0 * 43.5 * (1.0 / true_z - 1.0 / z);
                let part = |sign: f64| (128.0 + sign * levels * 20.0).clamp(0.0, 255.0) as u8;
                Rgb([part(1.0), 128, part(-1.0)])
            }
        }
    });
    error.save(folder.join("depth_error.png"))?;
    let valid = frame.depth_raw.pixels().iter().filter(|&&raw| raw != NO_DEPTH).count();
    println!("{:.1} % of pixels have depth", 100.0 * valid as f64 / f64::from(width * height));
    Ok(())
}
