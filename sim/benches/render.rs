//! What a Kinect frame costs: processor milliseconds over all threads, and milliseconds on the clock.
//!
//! `cargo bench -p sunblind-sim --bench render [FRAMES]`

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use glam::DAffine3;
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::matcher::Matcher;
use sunblind_sim::kinect::projector::Projector;
use sunblind_sim::kinect::{Imaging, Kinect};
use sunblind_sim::render::Sweep;
use sunblind_sim::validation::scene::{Light, looking_north, room_world};

fn main() {
    let frames = std::env::args().filter_map(|argument| argument.parse().ok()).next().unwrap_or(30);
    for cells in [4, 38, 90] {
        let world = room_world(cells, Light::LED);
        let triangles: usize = world.objects.iter().map(|object| object.mesh.triangles.len()).sum();
        for (motion, turn) in [("at rest", 0.0), ("turning 12°/s", 0.2 / 30.0)] {
            let mut kinect = Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1).expect("an adapter");
            let sweep = Sweep { start: looking_north(), end: looking_north() * DAffine3::from_rotation_y(turn) };
            println!("{triangles} triangles, {motion}, {}", kinect.adapter().driver);
            run(&mut kinect, &sweep, frames);
        }
    }
}

fn run(kinect: &mut Kinect, sweep: &Sweep, frames: u32) {
    let warm = kinect.capture(sweep, 0).expect("a frame");
    let mut stages: Vec<(&str, Duration, Duration)> = Vec::new();
    for _ in 0..frames {
        for (index, cost) in kinect.profile(sweep).expect("a frame").into_iter().enumerate() {
            if stages.len() == index {
                stages.push((cost.stage, Duration::ZERO, Duration::ZERO));
            }
            stages[index].1 += cost.cpu;
            stages[index].2 += cost.wall;
        }
    }
    for (stage, cpu, wall) in stages {
        report(stage, cpu, wall, frames);
    }
    let calibration = kinect.calibration();
    let matcher = Matcher::new(calibration, &Projector::of(calibration));
    measure("depth", frames, |_| drop(matcher.depth(&warm.infrared)));
    measure("whole frame", frames, |frame| drop(kinect.capture(sweep, frame)));
}

fn measure(what: &str, times: u32, mut work: impl FnMut(u64)) {
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    for time in 0..times {
        work(u64::from(time));
    }
    report(what, cpu.elapsed(), wall.elapsed(), times);
}

fn report(what: &str, cpu: Duration, wall: Duration, times: u32) {
    let milliseconds = |duration: Duration| 1000.0 * duration.as_secs_f64() / f64::from(times);
    println!("  {what:18} {:6.1} CPU ms  {:6.1} ms", milliseconds(cpu), milliseconds(wall));
}
