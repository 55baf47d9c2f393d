//! What a Kinect frame costs: processor milliseconds over all threads, and milliseconds on the clock. Prints a table for
//! the yard at noon and for a plain room of ever more triangles, then how cost grows with triangles and with pixels.
//!
//! `cargo bench -p sunblind-sim --bench render [FRAMES]`, on an idle machine.

use std::path::Path;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use glam::DAffine3;
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::matcher::Matcher;
use sunblind_sim::kinect::projector::Projector;
use sunblind_sim::kinect::{FRAME_INTERVAL, Imaging, Kinect};
use sunblind_sim::light::LightState;
use sunblind_sim::render::Sweep;
use sunblind_sim::scenario::light::lamp_groups;
use sunblind_sim::scenario::{AnyScenario, Scenario, load};
use sunblind_sim::validation::scene::{Light, looking_north, room_world};
use sunblind_sim::world::World;

/// What one thing takes.
#[derive(Clone, Copy, Default)]
struct Cost {
    cpu: Duration,
    wall: Duration,
}

impl Cost {
    fn of<T>(work: impl FnOnce() -> T) -> (Self, T) {
        let (cpu, wall) = (ProcessTime::now(), Instant::now());
        let done = work();
        (Self { cpu: cpu.elapsed(), wall: wall.elapsed() }, done)
    }

    fn add(&mut self, other: Self) {
        self.cpu += other.cpu;
        self.wall += other.wall;
    }

    /// Milliseconds of one of so many.
    fn each(&self, times: usize) -> [f64; 2] {
        [self.cpu, self.wall].map(|duration| 1000.0 * duration.as_secs_f64() / times as f64)
    }
}

/// One row of the table, milliseconds a frame.
struct Row {
    what: String,
    /// Of the world, and of those the mean that a frame draws, three views together.
    triangles: [usize; 2],
    /// Passes, then depth: name and CPU.
    stages: Vec<(&'static str, f64)>,
    cpu: f64,
    wall: f64,
}

/// A place to look from, and what is to be seen there.
struct Scene {
    name: &'static str,
    world: World,
    light: Option<LightState>,
    /// One for each frame.
    sweeps: Vec<Sweep>,
}

fn main() {
    let frames = std::env::args().filter_map(|argument| argument.parse().ok()).next().unwrap_or(40);
    let full = Calibration::nominal();
    let scenes: Vec<Scene> = [yard(frames)].into_iter().chain([15, 38, 95].map(|cells| room(cells, frames))).collect();
    let mut rows = Vec::new();
    for scene in &scenes {
        for shutter in [true, false] {
            rows.push(scene.measure(&full, shutter, "640×480"));
        }
    }
    let coarse = scenes[0].measure(&full.clone().halved(), true, "320×240");
    let exponent = |from: &Row, to: &Row, growth: f64| (to.cpu / from.cpu).ln() / growth.ln();
    let of_triangles = |from: &Row, to: &Row| exponent(from, to, to.triangles[0] as f64 / from.triangles[0] as f64);
    let (pixels, few, many) =
        (exponent(&coarse, &rows[0], 4.0), of_triangles(&rows[2], &rows[4]), of_triangles(&rows[4], &rows[6]));
    rows.insert(2, coarse);
    print(&rows);
    println!("CPU grows as pixels^{pixels:.2}, and as triangles^{few:.2} up to 15 k, triangles^{many:.2} up to 90 k.");
}

fn print(rows: &[Row]) {
    let stages: Vec<&str> = rows[0].stages.iter().map(|(stage, _)| *stage).collect();
    println!("CPU ms a frame: | triangles | drawn | {} | **all** | ms on the clock | frames/s", stages.join(" | "));
    println!("|---|{}", "---|".repeat(stages.len() + 5));
    for Row { what, triangles: [all, drawn], stages, cpu, wall } in rows {
        let stages: Vec<String> = stages.iter().map(|(_, cpu)| format!("{cpu:.1}")).collect();
        let stages = stages.join(" | ");
        println!("| {what} | {all} | {drawn} | {stages} | **{cpu:.1}** | {wall:.1} | {:.0} |", 1000.0 / wall);
    }
}

impl Scene {
    /// `shutter`: whether what moves is blurred, and rows are exposed one after the other.
    fn measure(&self, unit: &Calibration, shutter: bool, size: &str) -> Row {
        let imaging = Imaging { motion_blur: shutter, rolling_shutter: shutter, ..Imaging::default() };
        let mut kinect = Kinect::new(&self.world, unit.clone(), imaging, 1).expect("an adapter");
        if let Some(light) = &self.light {
            kinect.illuminate(light);
        }
        let matcher = Matcher::new(unit, &Projector::of(unit));
        kinect.capture(&self.sweeps[0], 0).expect("a frame");
        let (mut stages, mut whole, mut drawn) = (Vec::<(&str, Cost)>::new(), Cost::default(), 0);
        for (frame, sweep) in self.sweeps.iter().enumerate() {
            let (cost, images) = Cost::of(|| kinect.capture(sweep, frame as u64).expect("a frame"));
            whole.add(cost);
            drawn += kinect.triangles_drawn(sweep).into_iter().sum::<usize>();
            let mut passes: Vec<(&str, Cost)> = (kinect.profile(sweep).expect("a frame").into_iter())
                .map(|pass| (pass.stage, Cost { cpu: pass.cpu, wall: pass.wall }))
                .collect();
            passes.push(("depth", Cost::of(|| matcher.depth(&images.infrared)).0));
            match stages.is_empty() {
                true => stages = passes,
                false => stages.iter_mut().zip(passes).for_each(|(sum, pass)| sum.1.add(pass.1)),
            }
        }
        let frames = self.sweeps.len();
        let [cpu, wall] = whole.each(frames);
        let shutter = if shutter { "blur and rolling shutter" } else { "neither" };
        Row {
            what: format!("{}, {size}, {shutter}", self.name),
            triangles: [self.world.objects.iter().map(|object| object.mesh.triangles.len()).sum(), drawn / frames],
            stages: stages.into_iter().map(|(stage, cost)| (stage, cost.each(frames)[0])).collect(),
            cpu,
            wall,
        }
    }
}

/// A room with so many squares along an edge of its walls; the Kinect turns by 12°/s.
fn room(cells: u32, frames: usize) -> Scene {
    let turned = looking_north() * DAffine3::from_rotation_y(0.4 * FRAME_INTERVAL / 2.0);
    let sweep = Sweep { start: looking_north(), end: turned };
    Scene { name: "room", world: room_world(cells, Light::LED), light: None, sweeps: vec![sweep; frames] }
}

/// The yard at noon from places evenly spread along the way of its scenario, driving. Says what getting there takes.
fn yard(frames: usize) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/yard_noon.toml");
    let Ok(AnyScenario::Robot(scenario)) = load(&file) else { panic!("{} is a robot's", file.display()) };
    let warm = || scenario.lit_world(&|_| ()).expect("the light");
    // Whether the light was there already nobody knows: the second time it is.
    warm();
    let (loading, world) = Cost::of(warm);
    let light = scenario.light.at(0.0, &lamp_groups(&world));
    let sweeps = along_the_way(&scenario, &world, frames);
    let (opening, mut kinect) =
        Cost::of(|| Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1).expect("an adapter"));
    kinect.illuminate(&light);
    let (first, _) = Cost::of(|| kinect.capture(&sweeps[0], 0).expect("a frame"));
    println!("{}, {} cores", kinect.adapter().driver, std::thread::available_parallelism().map_or(0, usize::from));
    for (what, cost) in [
        ("the yard with its light from the cache", loading),
        ("adapter, shaders, upload", opening),
        ("first frame, exposures settled", first),
    ] {
        let [cpu, wall] = cost.each(1);
        println!("start-up: {what}: {cpu:.0} CPU ms, {wall:.0} ms");
    }
    Scene { name: "yard", world, light: Some(light), sweeps }
}

fn along_the_way(scenario: &Scenario, world: &World, count: usize) -> Vec<Sweep> {
    let path = scenario.path.shape().expect("a path");
    let robot = scenario.robot_model().expect("a robot");
    let robot_from_infrared = robot.robot_from_camera * Calibration::nominal().colour_from_infrared;
    (0..count)
        .map(|index| {
            let place = path.at(path.length() * (index as f64 + 0.5) / count as f64);
            let (x, y) = (place.position.x, place.position.y);
            let standing = world.ground.standing(x, y, place.heading, robot.wheelbase() / 2.0);
            Sweep::driving(&standing, &robot_from_infrared, [scenario.path.speed, place.curvature], FRAME_INTERVAL)
        })
        .collect()
}
