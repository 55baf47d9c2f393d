#[path = "../tests/scene/mod.rs"]
mod scene;
use scene::*;
use sunblind_sim::kinect::{Imaging, Kinect, calibration::Calibration};
use sunblind_sim::render::Sweep;
fn main() {
    let world = room_world(38, Light::LED);
    let mut kinect = Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1).unwrap();
    for turn in [0.0, 0.2 / 30.0] {
        let sweep = Sweep { start: looking_north(), end: looking_north() * glam::DAffine3::from_rotation_y(turn) };
        let mut best: Vec<(&str, f64)> = Vec::new();
        for _ in 0..15 {
            for (i, c) in kinect.profile(&sweep).unwrap().into_iter().enumerate() {
                let ms = c.cpu.as_secs_f64() * 1000.0;
                if best.len() == i { best.push((c.stage, ms)); }
                best[i].1 = best[i].1.min(ms);
            }
        }
        for (n, ms) in best { print!("{n} {ms:.1}; "); }
        println!();
    }
}
