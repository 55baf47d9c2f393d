//! Ground that is not level.

use nalgebra::Point3;

use super::*;
use crate::world::ground::{Ground, Terrain};
use crate::world::{campus, yard};

fn land(ground: Ground) -> World {
    World { name: "test".into(), ground, ..World::default() }
}

fn sampled(height: impl Fn(f64, f64) -> f64) -> Ground {
    Ground { terrain: Some(Terrain::sampled([-2.0, -3.0], [12.0, 5.0], 0.1, height)), ..Ground::default() }
}

fn even(floor: Floor) -> Floor {
    Floor { variation: Floor::IDEAL.variation, ..floor }
}

/// The robot at a place, as the ground has it there.
fn put(world: &World, floor: Floor, x: f64, y: f64, heading: f64) -> Simulation {
    let robot = robot();
    let start = world.ground.standing(x, y, heading, robot.wheelbase() / 2.0);
    Simulation::new(world, &robot, floor.into(), &start, 1).unwrap()
}

#[test]
fn the_robot_stands_on_the_terrain_wherever_it_is_put() {
    // Bent differently along x and y, so that no mistaken axis goes unseen.
    let world = land(sampled(|x, y| 0.3 + 0.1 * x - 0.05 * y + 0.004 * x * y));
    for [x, y, heading] in [[0.0, 0.0, 0.0], [8.0, 3.0, 1.0], [10.0, -2.0, -2.5], [1.0, 4.0, 3.0]] {
        let start = world.ground.standing(x, y, heading, robot().wheelbase() / 2.0);
        let simulation = put(&world, Floor::IDEAL, x, y, heading);
        let moved = start.inverse() * simulation.world_from_robot();
        assert!(moved.translation.vector.norm() < 3e-3, "{x}, {y}: {}", moved.translation.vector);
        assert!(moved.rotation.angle().to_degrees() < 0.3, "{x}, {y}: {}°", moved.rotation.angle().to_degrees());
        assert_eq!(simulation.bumps(), []);
    }
}

#[test]
fn level_terrain_is_a_level_floor() {
    let world = land(sampled(|_, _| 0.2));
    let mut simulation = put(&world, Floor::IDEAL, 0.0, 0.0, 0.0);
    drive(&mut simulation, 0.5, 0.0, 4.0);
    let (start, mut shaking) = (simulation.world_from_robot(), 0.0f64);
    for _ in 0..(8.0 / STEP) as usize {
        simulation.step(VelocityCommand { speed: 0.5, turn_rate: 0.0 });
        shaking = shaking.max(simulation.twist().linear.z.abs());
    }
    let way = (start.inverse() * simulation.world_from_robot()).translation.vector;
    println!("{way:.4?} in 8 s, up and down by {shaking:.1e} m/s");
    assert!((way.x / 4.0 - 1.0).abs() < 0.005 && way.y.abs() < 5e-3, "{way}");
    assert!(shaking < 2e-3, "{shaking} m/s");
}

#[test]
fn up_and_down_a_slope_of_8_degrees_it_is_as_fast_as_the_closed_form() {
    let rise = 8f64.to_radians().tan();
    let world = land(sampled(|x, _| rise * x.max(0.0)));
    for floor in [Floor::ASPHALT, Floor::GRASS].map(even) {
        for (x, heading) in [(1.0, 0.0), (11.0, PI)] {
            let mut simulation = put(&world, floor, x, 1.0, heading);
            drive(&mut simulation, 0.4, 0.0, 4.0);
            let start = simulation.world_from_robot();
            drive(&mut simulation, 0.4, 0.0, 10.0);
            let way = (simulation.world_from_robot().translation.vector - start.translation.vector).norm();
            let expected = 4.0 * floor.speed_ratio();
            println!("from x = {x}: {way:.4} m, expected {expected:.4}");
            assert!((way / expected - 1.0).abs() < 0.02, "{way} m where {expected} were expected");
        }
    }
}

#[test]
fn it_crosses_the_yards_lawn_without_stumbling() {
    // Over the bank and its bumps, up and down 8°.
    let world = land(yard::ground());
    let floor = even(Floor::GRASS);
    let mut simulation = put(&world, floor, 16.7, 4.0, FRAC_PI_2);
    drive(&mut simulation, 0.4, 0.0, 2.0);
    let place = |simulation: &Simulation| simulation.world_from_robot().translation.vector;
    let (mut last, mut way, mut tilt, mut jolts) = (place(&simulation), 0.0, 0.0f64, 0.0);
    let seconds = 28.0;
    for step in 0..(seconds / STEP) as usize {
        let before = simulation.twist().linear.z;
        // Someone keeps it on its way.
        let off = heading(&simulation) - FRAC_PI_2 - 0.5 * (last.x - 16.7);
        simulation.step(VelocityCommand { speed: 0.4, turn_rate: -off.clamp(-0.3, 0.3) });
        jolts += ((simulation.twist().linear.z - before) / STEP).powi(2);
        tilt = tilt.max((simulation.world_from_robot().rotation * Vector3::z()).z.acos());
        assert_eq!(simulation.bumps(), [], "step {step}");
        if step % 20 == 0 {
            way += (place(&simulation) - last).norm();
            last = place(&simulation);
        }
    }
    let jolts = (jolts * STEP / seconds).sqrt();
    let expected = 0.4 * seconds * floor.speed_ratio();
    println!("{way:.3} m, expected {expected:.3}; leant by {:.1}°; {jolts:.2} m/s² rms", tilt.to_degrees());
    assert!((way / expected - 1.0).abs() < 0.02, "{way} m where {expected} were expected");
    assert!((7.0..13.0).contains(&tilt.to_degrees()), "{}°", tilt.to_degrees());
    assert!(jolts < 0.8, "{jolts} m/s² rms");
    assert!(last.y > 14.0, "got to {last}");
}

#[test]
fn two_runs_over_the_yard_are_equal_bit_for_bit() {
    let world = land(yard::ground());
    let run = || {
        let start = world.ground.standing(10.0, 9.0, 0.3, 0.13);
        let mut simulation = Simulation::new(&world, &robot(), FloorPlan::from(&world.ground), &start, 7).unwrap();
        let mut bits = Vec::new();
        for step in 0..(20.0 / STEP) as usize {
            simulation.step(VelocityCommand { speed: 0.4, turn_rate: 0.5 * (step as f64 * 1e-3).sin() });
            let pose = simulation.world_from_robot();
            bits.extend(pose.translation.vector.iter().chain(pose.rotation.coords.iter()).map(|value| value.to_bits()));
        }
        bits
    };
    assert!(run() == run());
}

/// Drives a world's loop to its end, on what the world has for floors; steered by the truth.
fn drive_round(world: &World, points: &[[f64; 2]]) -> Simulation {
    let heading = (points[1][1] - points[0][1]).atan2(points[1][0] - points[0][0]);
    let start = world.ground.standing(points[0][0], points[0][1], heading, robot().wheelbase() / 2.0);
    let mut simulation = Simulation::new(world, &robot(), FloorPlan::from(&world.ground), &start, 3).unwrap();
    let mut next = 0;
    while next + 1 < points.len() {
        let robot_from_world = simulation.world_from_robot().inverse();
        let towards = |index: usize| {
            let height = simulation.world_from_robot().translation.z;
            robot_from_world * Point3::new(points[index][0], points[index][1], height)
        };
        // Pure pursuit, half a metre ahead.
        while next + 1 < points.len() && towards(next).coords.norm() < 0.5 {
            next += 1;
        }
        let ahead = towards(next);
        let turn_rate = 0.4 * 2.0 * ahead.y / ahead.coords.norm_squared();
        for _ in 0..10 {
            simulation.step(VelocityCommand { speed: 0.4, turn_rate });
        }
        let at = simulation.world_from_robot().translation.vector;
        assert_eq!(simulation.bumps(), [], "at {at}");
        assert!(simulation.elapsed() < 0.4 * points.len() as f64, "stuck at {at}");
    }
    simulation
}

#[test]
fn it_drives_round_the_yard_and_round_the_campus_and_bumps_into_nothing() {
    for (world, points) in [(yard::yard(1), yard::loop_waypoints()), (campus::campus(1), campus::loop_waypoints())] {
        let simulation = drive_round(&world, &points);
        let end = simulation.world_from_robot().translation.vector;
        let off = (end.xy() - Vector2::from(points[0])).norm();
        println!("{}: round in {:.0} s", world.name, simulation.elapsed());
        assert!(off < 0.6 && (end.z - world.ground.height(end.x, end.y)).abs() < 0.01, "{off} m from the start");
    }
}
