//! How many seconds the robot drives in a second of processor time: on a bare floor, and in a room with furniture.

use cpu_time::ThreadTime;
use nalgebra::Isometry3;
use sunblind_sim::physics::{Floor, STEP, Simulation};
use sunblind_sim::robot::{CameraMount, InertialNoise, RobotModel, VelocityCommand};
use sunblind_sim::world::{Mesh, Object, World};

const SECONDS: f64 = 60.0;

/// A crate, 0.5 m along each edge.
fn crate_at(x: f32, y: f32) -> Object {
    let corner =
        |bits: usize| [x + 0.5 * (bits & 1) as f32, y + 0.5 * (bits >> 1 & 1) as f32, 0.5 * (bits >> 2 & 1) as f32];
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Mesh { positions: (0..8).map(corner).collect(), triangles, ..Mesh::default() };
    Object { name: format!("crate at {x}, {y}"), mesh, material: 0, collides: true }
}

fn simulated_seconds_per_cpu_second(objects: Vec<Object>, floor: Floor) -> f64 {
    let world = World { name: "bench".into(), objects, ..World::default() };
    let mut robot = RobotModel::p3at(&CameraMount::default());
    robot.gyro = Some(InertialNoise::pioneer_gyro());
    let mut simulation =
        Simulation::new(&world, &robot, floor.into(), &Isometry3::identity(), 1).expect("a sound world");
    let start = ThreadTime::now();
    for step in 0..(SECONDS / STEP) as usize {
        let turn_rate = 0.6 * (step as f64 * 2e-3).sin();
        simulation.step(VelocityCommand { speed: 0.5, turn_rate });
    }
    SECONDS / start.elapsed().as_secs_f64()
}

fn main() {
    let crates: Vec<_> = (-7..7)
        .flat_map(|i: i8| (-7..7).map(move |j: i8| (f32::from(i) * 2.0 + 1.0, f32::from(j) * 2.0 + 1.0)))
        .map(|(x, y)| crate_at(x, y))
        .collect();
    for (name, objects, floor) in [
        ("bare even floor", Vec::new(), Floor::IDEAL),
        ("bare tile", Vec::new(), Floor::TILE),
        ("tile, 196 crates", crates, Floor::TILE),
    ] {
        let speed = simulated_seconds_per_cpu_second(objects, floor);
        println!("{name:<20} {speed:7.1} simulated seconds a CPU second");
    }
}
