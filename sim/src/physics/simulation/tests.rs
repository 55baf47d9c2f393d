//! The robot beside closed forms and published figures: speed, turns, slip, gyro.

mod terrain;

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Isometry2, Translation3, UnitQuaternion, Vector2};
use rayon::prelude::*;

use super::*;
use crate::physics::{Floor, FloorArea, Grip};
use crate::robot::{CameraMount, InertialNoise};
use crate::world::{Mesh, Object};

fn robot() -> RobotModel {
    RobotModel::p3at(&CameraMount::default())
}

fn place(x: f64, y: f64, heading: f64) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), heading);
    Isometry3::from_parts(Translation3::new(x, y, 0.0), rotation)
}

fn world(objects: Vec<Object>) -> World {
    World { name: "test".into(), objects, ..World::default() }
}

fn on(floors: impl Into<FloorPlan>) -> Simulation {
    Simulation::new(&world(Vec::new()), &robot(), floors.into(), &Isometry3::identity(), 1).unwrap()
}

fn drive(simulation: &mut Simulation, speed: f64, turn_rate: f64, seconds: f64) {
    for _ in 0..(seconds / STEP).round() as usize {
        simulation.step(VelocityCommand { speed, turn_rate });
    }
}

fn heading(simulation: &Simulation) -> f64 {
    simulation.world_from_robot().rotation.euler_angles().2
}

/// (left, right) wheel angles from ticks, rad.
fn wheel_angles(simulation: &Simulation) -> (f64, f64) {
    let angle = |ticks| ticks as f64 / EncoderParams::default().ticks_per_turn * 2.0 * PI;
    let (left, right) = simulation.ticks();
    (angle(left), angle(right))
}

/// A sheet from corner to corner to corner; counter-clockwise.
fn sheet(name: &str, corners: [[f32; 3]; 4]) -> Object {
    let mesh = Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() };
    Object { name: name.into(), mesh, material: 0, collides: true }
}

/// A wall across the robot's way, its face towards −x.
fn wall(x: f32) -> Object {
    sheet("wall", [[x, 2.0, 0.0], [x, -2.0, 0.0], [x, -2.0, 2.0], [x, 2.0, 2.0]])
}

#[test]
fn it_drives_as_fast_as_commanded() {
    let mut simulation = on(Floor::IDEAL);
    drive(&mut simulation, 0.5, 0.0, 4.0);
    let start = simulation.world_from_robot();
    drive(&mut simulation, 0.5, 0.0, 10.0);
    let speed = (start.inverse() * simulation.world_from_robot()).translation.x / 10.0;
    println!("commanded 0.5 m/s, drove {speed:.5}");
    assert!((speed / 0.5 - 1.0).abs() < 0.005, "{speed} m/s");
}

#[test]
fn it_drives_straight_on_an_even_floor() {
    let mut simulation = on(Floor::IDEAL);
    drive(&mut simulation, 0.5, 0.0, 22.0);
    let end = simulation.world_from_robot().translation;
    let drift = heading(&simulation).to_degrees();
    println!("{:.3} m: {drift:.2e}° and {:.2e} m aside", end.x, end.y);
    assert!(end.x > 10.0 && drift.abs() < 0.1, "{drift}° after {} m", end.x);
}

#[test]
fn it_spins_on_the_spot() {
    let mut simulation = on(Floor::IDEAL);
    let mut furthest: f64 = 0.0;
    for _ in 0..(20.0 / STEP) as usize {
        simulation.step(VelocityCommand { speed: 0.0, turn_rate: 1.0 });
        furthest = furthest.max(simulation.world_from_robot().translation.vector.xy().norm());
    }
    println!("spun, and strayed {:.3} mm", furthest * 1e3);
    assert!(furthest < 2e-3, "{furthest} m");
}

/// Effective over geometric track while spinning, from truth and encoders.
fn measured_track_ratio(floor: Floor, seed: u64) -> f64 {
    let start = Isometry3::identity();
    let mut simulation = Simulation::new(&world(Vec::new()), &robot(), floor.into(), &start, seed).unwrap();
    drive(&mut simulation, 0.0, 1.0, 3.0);
    let (start, (left, right)) = (heading(&simulation), wheel_angles(&simulation));
    drive(&mut simulation, 0.0, 1.0, 2.0);
    let turned = (heading(&simulation) - start).rem_euclid(2.0 * PI);
    let (left, right) = (wheel_angles(&simulation).0 - left, wheel_angles(&simulation).1 - right);
    (right - left) * robot().wheel_radius() / turned / robot().track()
}

#[test]
fn it_turns_about_the_track_of_the_closed_form() {
    for anisotropy in [0.25, 0.0, -0.2, -0.4] {
        let grip = Grip { anisotropy, ..Floor::IDEAL.grip };
        let floor = Floor { grip, ..Floor::IDEAL };
        let (measured, predicted) = (measured_track_ratio(floor, 1), floor.effective_track_ratio(&robot()));
        println!("anisotropy {anisotropy}: effective track {measured:.4} of the geometric, closed form {predicted:.4}");
        assert!((measured / predicted - 1.0).abs() < 0.01, "{measured} where {predicted} was expected");
    }
}

#[test]
fn hard_floors_widen_the_track_as_the_real_robots_do() {
    // Published multipliers for skid-steer robots on hard floors: 1.37 to 1.56; ARIA's for the P3-AT is 1.49.
    for (name, floor) in [("tile", Floor::TILE), ("concrete", Floor::CONCRETE)] {
        let ratios: Vec<f64> = (0..8).map(|seed| measured_track_ratio(floor, seed)).collect();
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        println!("{name}: effective track {mean:.4} of the geometric, {ratios:.3?}");
        assert!((1.35..1.75).contains(&mean), "{name}: {mean}");
    }
}

#[test]
fn slip_costs_the_speed_it_should() {
    for floor in [Floor::TILE, Floor::CARPET, Floor::CONCRETE, Floor::ASPHALT, Floor::GRASS, Floor::GRAVEL] {
        let even = Floor { variation: Floor::IDEAL.variation, ..floor };
        let mut simulation = on(even);
        drive(&mut simulation, 0.5, 0.0, 10.0);
        let (left, right) = wheel_angles(&simulation);
        let rolled = (left + right) / 2.0 * robot().wheel_radius();
        let measured = simulation.world_from_robot().translation.x / rolled;
        println!("true over encoder speed {measured:.4}, expected {:.4}", floor.speed_ratio());
        // The tyre sinks in by some 0.2 % of its radius.
        assert!((measured / floor.speed_ratio() - 1.0).abs() < 0.004, "{measured}");
    }
}

/// Paths of 20 s with curves, from two places.
#[test]
fn far_from_the_origin_the_path_is_the_same() {
    let path = |x: f64| {
        let start = place(x, 0.0, 0.3);
        let mut simulation = Simulation::new(&world(Vec::new()), &robot(), Floor::IDEAL.into(), &start, 1).unwrap();
        let mut path = Vec::new();
        for second in 0..20 {
            drive(&mut simulation, 0.5, 0.6 * f64::from(second % 3 - 1), 1.0);
            path.push(start.inverse() * simulation.world_from_robot());
        }
        path
    };
    let apart = path(0.0)
        .iter()
        .zip(path(1000.0))
        .map(|(near, far)| (near.translation.vector - far.translation.vector).norm())
        .fold(0.0, f64::max);
    println!("1 km away the path differs by {apart:.2e} m");
    assert!(apart < 1e-4, "{apart} m");
}

#[test]
fn two_runs_are_equal_bit_for_bit() {
    let mut model = robot();
    model.gyro = Some(InertialNoise::pioneer_gyro());
    model.accelerometer = Some(InertialNoise::mems_accelerometer());
    let run = || {
        let walls = world(vec![wall(4.0)]);
        let floors = FloorPlan {
            elsewhere: Floor::TILE,
            areas: vec![FloorArea { min: [1.0, -1.0], max: [3.0, 1.0], floor: Floor::CARPET }],
        };
        let mut simulation = Simulation::new(&walls, &model, floors, &Isometry3::identity(), 7).unwrap();
        let mut bits = Vec::new();
        for step in 0..(60.0 / STEP) as usize {
            let turn_rate = 0.5 * (step as f64 * 1e-3).sin();
            simulation.step(VelocityCommand { speed: 0.4, turn_rate });
            let pose = simulation.world_from_robot();
            bits.extend(pose.translation.vector.iter().chain(pose.rotation.coords.iter()).map(|value| value.to_bits()));
            bits.extend(simulation.gyro().unwrap().iter().map(|value| value.to_bits()));
            bits.extend(simulation.accelerometer().unwrap().iter().map(|value| value.to_bits()));
            bits.push(simulation.ticks().0 as u64);
            bits.push(simulation.ticks().1 as u64);
        }
        bits
    };
    assert!(run() == run());
}

#[test]
fn a_wall_stops_it_while_its_wheels_slip() {
    let mut simulation =
        Simulation::new(&world(vec![wall(1.5)]), &robot(), Floor::TILE.into(), &Isometry3::identity(), 1).unwrap();
    assert_eq!(simulation.bumps(), []);
    drive(&mut simulation, 0.5, 0.0, 8.0);
    let pose = simulation.world_from_robot();
    let (left, right) = wheel_angles(&simulation);
    let rolled = (left + right) / 2.0 * robot().wheel_radius();
    println!("stands at {:.3} m after rolling {rolled:.3} m; {:?}", pose.translation.x, simulation.bumps());
    // 0.313 m from the middle to the bumper's edge.
    assert!((pose.translation.x - (1.5 - 0.313)).abs() < 0.02, "at {}", pose.translation.x);
    assert!(simulation.twist().linear.norm() < 0.05, "{:?}", simulation.twist());
    assert!(rolled > 3.0, "rolled {rolled} m");
    assert!(simulation.bumps().iter().any(|bump| bump.object == Some(0) && bump.force > 50.0));
}

#[test]
fn it_climbs_a_ramp_and_parks_on_it() {
    // 10°, from x = 1 m on; 4 m long.
    let (rise, run) = (4.0 * 10_f64.to_radians().sin(), 4.0 * 10_f64.to_radians().cos());
    let (top, end) = (rise as f32, (1.0 + run) as f32);
    let ramp = sheet("ramp", [[1.0, -2.0, 0.0], [end, -2.0, top], [end, 2.0, top], [1.0, 2.0, 0.0]]);
    let mut simulation =
        Simulation::new(&world(vec![ramp]), &robot(), Floor::IDEAL.into(), &Isometry3::identity(), 1).unwrap();
    drive(&mut simulation, 0.5, 0.0, 6.0);
    let pose = simulation.world_from_robot();
    let pitch = -pose.rotation.euler_angles().1.to_degrees();
    assert!((pitch - 10.0).abs() < 0.1 && pose.translation.z > 0.2, "{pitch}° at {}", pose.translation.vector);
    drive(&mut simulation, 0.0, 0.0, 5.0);
    let parked = simulation.world_from_robot();
    drive(&mut simulation, 0.0, 0.0, 10.0);
    let crept = (simulation.world_from_robot().translation.vector - parked.translation.vector).norm();
    println!("crept {:.2} mm in 10 s on 10°", crept * 1e3);
    assert!(crept < 5e-3, "{crept} m");
}

#[test]
fn ground_may_lie_below_the_origin() {
    let level = sheet("level", [[-2.0, -2.0, 0.0], [1.0, -2.0, 0.0], [1.0, 2.0, 0.0], [-2.0, 2.0, 0.0]]);
    let slope = sheet("slope", [[1.0, -2.0, 0.0], [6.0, -2.0, -0.5], [6.0, 2.0, -0.5], [1.0, 2.0, 0.0]]);
    let mut simulation =
        Simulation::new(&world(vec![level, slope]), &robot(), Floor::TILE.into(), &Isometry3::identity(), 1).unwrap();
    assert!(simulation.world_from_robot().translation.z.abs() < 1e-3);
    drive(&mut simulation, 0.5, 0.0, 8.0);
    let place = simulation.world_from_robot().translation;
    assert!((place.z + 0.1 * (place.x - 1.0)).abs() < 2e-3, "{}", place.vector);
}

#[test]
fn seams_in_the_floor_are_not_felt() {
    // Tiles of half a metre, each an object of its own.
    let tile =
        |i: f32, j: f32| sheet("tile", [[i, j, 0.0], [i + 0.5, j, 0.0], [i + 0.5, j + 0.5, 0.0], [i, j + 0.5, 0.0]]);
    let floor: Vec<_> = (0..60).map(|n| tile((n / 6) as f32 * 0.5 - 1.0, (n % 6) as f32 * 0.5 - 1.5)).collect();
    let mut tiled = Simulation::new(&world(floor), &robot(), Floor::IDEAL.into(), &Isometry3::identity(), 1).unwrap();
    let mut plain = on(Floor::IDEAL);
    drive(&mut tiled, 0.5, 0.1, 6.0);
    drive(&mut plain, 0.5, 0.1, 6.0);
    assert_eq!(tiled.world_from_robot(), plain.world_from_robot());
}

#[test]
fn it_feels_gravity_and_its_own_turning() {
    let mut model = robot();
    model.gyro = Some(InertialNoise::ideal());
    model.accelerometer = Some(InertialNoise::ideal());
    let mut simulation =
        Simulation::new(&world(Vec::new()), &model, Floor::IDEAL.into(), &Isometry3::identity(), 1).unwrap();
    let at_rest = simulation.accelerometer().unwrap();
    assert!((at_rest - Vector3::new(0.0, 0.0, GRAVITY)).norm() < 1e-3, "{at_rest}");
    drive(&mut simulation, 0.5, 0.8, 6.0);
    // Settled in a circle: ω along z, v·ω towards its centre, on the left.
    let twist = simulation.twist();
    let (gyro, accelerometer) = (simulation.gyro().unwrap(), simulation.accelerometer().unwrap());
    assert!((gyro - twist.angular).norm() < 1e-12 && (gyro.z - 0.8).abs() < 0.03, "{gyro}");
    assert!((accelerometer.y - gyro.z * twist.linear.x).abs() < 0.01, "{accelerometer}");
    assert!(on(Floor::IDEAL).gyro().is_none());
}

#[test]
fn encoders_count_what_the_wheels_roll() {
    let mut simulation = on(Floor::IDEAL);
    drive(&mut simulation, 0.5, 0.0, 4.0);
    let before = simulation.ticks();
    drive(&mut simulation, 0.5, 0.0, 2.0);
    println!("{:?} ticks in a metre", (simulation.ticks().0 - before.0, simulation.ticks().1 - before.1));
    // 1 m at 138 ticks a millimetre, on both sides.
    for (before, after) in [(before.0, simulation.ticks().0), (before.1, simulation.ticks().1)] {
        assert!((after - before - 138_000).abs() < 300, "{}", after - before);
    }
    let mut coarse = robot();
    coarse.encoder.ticks_per_turn = 10.0;
    let mut simulation =
        Simulation::new(&world(Vec::new()), &coarse, Floor::IDEAL.into(), &Isometry3::identity(), 1).unwrap();
    drive(&mut simulation, 0.5, 0.0, 6.0);
    let rolled = simulation.world_from_robot().translation.x / 0.111;
    let expected = (rolled / (2.0 * PI) * 10.0) as i64;
    assert!((simulation.ticks().0 - expected).abs() <= 1, "{} for {expected}", simulation.ticks().0);
}

#[test]
fn encoders_stand_still_with_the_robot() {
    let mut simulation = on(Floor::IDEAL);
    drive(&mut simulation, 0.5, 0.3, 5.0);
    drive(&mut simulation, 0.0, 0.0, 5.0);
    let before = simulation.ticks();
    drive(&mut simulation, 0.0, 0.0, 10.0);
    let (left, right) = (simulation.ticks().0 - before.0, simulation.ticks().1 - before.1);
    println!("{left} and {right} ticks in 10 s at rest");
    // A third of a millimetre.
    assert!(left.abs() < 46 && right.abs() < 46, "{left}, {right}");
}

/// End error of dead reckoning over the path length, on a square of 5 m with turns on the spot, by one who knows the
/// floor's mean grip.
fn odometry_drift(floor: Floor, seed: u64) -> f64 {
    let start = Isometry3::identity();
    let mut simulation = Simulation::new(&world(Vec::new()), &robot(), floor.into(), &start, seed).unwrap();
    let track = robot().track() * floor.effective_track_ratio(&robot());
    let mut odom_from_robot = Isometry2::<f64>::identity();
    let mut last = wheel_angles(&simulation);
    let mut path = 0.0;
    let mut step = |simulation: &mut Simulation, speed, turn_rate| {
        let before = simulation.world_from_robot().translation.vector;
        simulation.step(VelocityCommand { speed, turn_rate });
        path += (simulation.world_from_robot().translation.vector - before).norm();
        let now = wheel_angles(simulation);
        let (left, right) = ((now.0 - last.0) * 0.111, (now.1 - last.1) * 0.111);
        last = now;
        let forward = (left + right) / 2.0 * floor.speed_ratio();
        odom_from_robot *= Isometry2::new(Vector2::new(forward, 0.0), (right - left) / track);
    };
    for _ in 0..4 {
        let corner = simulation.world_from_robot();
        while (corner.inverse() * simulation.world_from_robot()).translation.vector.norm() < 5.0 {
            step(&mut simulation, 0.5, 0.0);
        }
        while simulation.twist().linear.norm() > 1e-3 {
            step(&mut simulation, 0.0, 0.0);
        }
        let corner = simulation.world_from_robot();
        while (corner.inverse() * simulation.world_from_robot()).rotation.angle() < FRAC_PI_2 {
            step(&mut simulation, 0.0, 0.6);
        }
        while simulation.twist().angular.z.abs() > 1e-3 {
            step(&mut simulation, 0.0, 0.0);
        }
    }
    let truth = simulation.world_from_robot().translation.vector.xy();
    (truth - odom_from_robot.translation.vector).norm() / path
}

#[test]
fn dead_reckoning_drifts_as_users_report() {
    // Users' reports: 1–2 % of the distance and 5–15 % of the angle on hard floors, 3–5 % and as much on soft ground.
    let (hard, soft) = (0.02..0.10, 0.04..0.15);
    for (name, floor, expected) in [
        ("tile", Floor::TILE, &hard),
        ("carpet", Floor::CARPET, &hard),
        ("concrete", Floor::CONCRETE, &hard),
        ("asphalt", Floor::ASPHALT, &hard),
        ("grass", Floor::GRASS, &soft),
        ("gravel", Floor::GRAVEL, &soft),
    ] {
        let drifts: Vec<f64> = (0..8_u64).into_par_iter().map(|seed| odometry_drift(floor, seed)).collect();
        let rms = (drifts.iter().map(|drift| drift * drift).sum::<f64>() / drifts.len() as f64).sqrt();
        println!("{name}: drift {:.2} % rms, {:.4?}", rms * 1e2, drifts);
        assert!(expected.contains(&rms), "{name}: {rms}");
    }
    let ideal = odometry_drift(Floor::IDEAL, 0);
    println!("ideal: {:.3} %", ideal * 1e2);
    assert!(ideal < 0.01, "{ideal}");
}
