//! Depth of surfaces in even light: steps, noise, edges, shadows.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::bench::{BASELINE_FOCAL, Bench, Report, Seen, Wall, gallery, line, mean, spread};
use crate::scene::{self, Light, block, even, facing_wall, object};

/// Nguyen et al., equation 4: axial noise in millimetres; `angle` in radians.
fn nguyen(z: f64, angle: f64) -> f64 {
    let facing = 1.2 + 1.9 * (z - 0.4).powi(2);
    let grazing = 0.1 * angle * angle / (z.sqrt() * (std::f64::consts::FRAC_PI_2 - angle).powi(2));
    facing + if angle > 60_f64.to_radians() { grazing } else { 0.0 }
}

/// Khoshelham & Elberink: half of a resolution of 2.85e-5 z² cm, in millimetres.
fn khoshelham(z: f64) -> f64 {
    1.425 * z * z
}

#[test]
fn depth_comes_in_the_published_steps() {
    let wall = Wall { angle: 60.0, ..Wall::at(2.5) };
    let seen = Bench::new(&gallery(&[wall])).look_at(0);
    // True depth of every raw value.
    let mut levels: BTreeMap<u16, Vec<f64>> = BTreeMap::new();
    for (x, y) in (60..420).flat_map(|y| (24..616).map(move |x| (x, y))) {
        let z = seen.true_depth(x, y);
        if (1.4..5.0).contains(&z) && seen.depth(x, y).is_some() {
            levels.entry(seen.frame.depth_raw.at(x, y)).or_default().push(z);
        }
    }
    // But for the few values of wrong matches and of the range's ends.
    levels.retain(|_, depths| depths.len() >= 20);
    let (first, last) = (*levels.keys().next().unwrap(), *levels.keys().last().unwrap());
    let mut report = Report::default();
    // Every value in between is used: steps are steps of one.
    report.expect(
        "V1 raw values used of those in range",
        1.0,
        1.0..=1.0,
        levels.len() as f64 / f64::from(last - first + 1),
    );
    let inverse: Vec<_> = levels.iter().map(|(&raw, depths)| [f64::from(raw), mean(depths).recip()]).collect();
    let [offset, slope] = line(&inverse);
    let nominal = 1.0 / (8.0 * BASELINE_FOCAL);
    report.expect("V1 step over z², 1/m", nominal, 0.96 * nominal..=1.04 * nominal, -slope);
    report.expect("V1 raw value of infinity", 1090.0, 1087.0..=1093.0, -offset / slope);
    // Between values ten apart, as single steps are as large as the noise.
    let centres: Vec<f64> = levels.values().map(|depths| mean(depths)).collect();
    let steps: Vec<_> = centres.windows(11).map(|z| [z[5].ln(), ((z[10] - z[0]) / 10.0).ln()]).collect();
    report.expect("V1 exponent of z in the step", 2.0, 1.95..=2.05, line(&steps)[1]);
    report.finish();
}

#[test]
fn noise_along_the_view_grows_as_published() {
    // No wall is quite at right angles to the view: one that is could lie on a step of depth throughout.
    let walls = [(1.0, 5.0), (2.0, 5.0), (3.0, 5.0), (4.0, 5.0), (2.0, 30.0), (2.0, 58.0)];
    let mut bench = Bench::new(&gallery(&walls.map(|(distance, angle)| Wall { angle, ..Wall::at(distance) })));
    let mut report = Report::default();
    let mut noises = vec![];
    for (number, (distance, angle)) in walls.into_iter().enumerate() {
        let z = f64::from(distance);
        let sample = bench.look_at(number).about(z);
        let (low, high) = (khoshelham(z).min(nguyen(z, 0.0)), khoshelham(z).max(nguyen(z, 0.0)));
        let what = format!("V2 axial noise at {z} m, {angle}°, mm");
        report.expect(&what, (low + high) / 2.0, 0.7 * low..=1.3 * high, sample.noise());
        report.expect("   wrong by more than a pixel, share", 0.0, 0.0..=0.001, sample.wrong());
        noises.push(sample.noise());
    }
    assert!(noises[..4].windows(2).all(|pair| pair[0] < pair[1]), "a wall further away is noisier: {noises:.2?}");
    report.finish();
}

#[test]
fn grazing_views_are_noisier_and_at_last_blind() {
    let angles: [f32; 4] = [65.0, 70.0, 75.0, 85.0];
    let mut bench = Bench::new(&gallery(&angles.map(|angle| Wall { angle, ..Wall::at(2.0) })));
    let mut report = Report::default();
    for (number, angle) in angles.into_iter().enumerate() {
        let sample = bench.look_at(number).about(2.0);
        if angle < 75.0 {
            let target = nguyen(2.0, f64::from(angle).to_radians());
            report.expect(
                &format!("V3 axial noise at 2 m, {angle}°, mm"),
                target,
                target / 2.0..=target * 2.0,
                sample.noise(),
            );
        } else {
            // Blind past 80°, give or take 5°.
            let (target, accepted) = if angle < 80.0 { (1.0, 0.5..=1.0) } else { (0.0, 0.0..=0.5) };
            report.expect(&format!("V3 valid share at 2 m, {angle}°"), target, accepted, sample.valid);
        }
    }
    report.finish();
}

/// Half the width of the block below, metres.
const HALF_WIDTH: f32 = 0.25;

/// A block's front at `near` metres, a wall at `far`.
fn block_before_wall(near: f32, far: f32) -> Seen {
    let middle = Vec3::new(0.0, near + 0.05, 0.0);
    let front = block(middle, Vec3::new(2.0 * HALF_WIDTH, 0.1, 0.8), Light::LED);
    let objects = vec![object("block", front, 0), object("wall", facing_wall(far, Light::LED), 0)];
    Bench::new(&scene::world("block", objects, vec![even("paint", [200, 200, 200], 0.8)])).look()
}

/// Of each row across the block: the first and last columns with its depth, and those of the wall's beside them.
struct Edges {
    wall_ends: Vec<f64>,
    block_begins: Vec<f64>,
    block_ends: Vec<f64>,
    wall_begins: Vec<f64>,
}

impl Edges {
    fn of(seen: &Seen, near: f64, far: f64) -> Self {
        let mut edges = Self { wall_ends: vec![], block_begins: vec![], block_ends: vec![], wall_begins: vec![] };
        let half = (580.0 * f64::from(HALF_WIDTH) / near) as usize;
        for y in 180..300 {
            let is = |x: &usize, z: f64| seen.depth(*x, y).is_some_and(|depth| (depth / z - 1.0).abs() < 0.1);
            let about = |edge: usize| edge - 40..edge + 40;
            let (left, right) = (about(320 - half), about(320 + half));
            let found = [
                left.clone().rev().find(|x| is(x, far)),
                left.clone().find(|x| is(x, near)),
                right.clone().rev().find(|x| is(x, near)),
                right.clone().find(|x| is(x, far)),
            ];
            let [wall_end, block_begin, block_end, wall_begin] =
                found.map(|column| column.expect("a block before a wall") as f64);
            edges.wall_ends.push(wall_end);
            edges.block_begins.push(block_begin);
            edges.block_ends.push(block_end);
            edges.wall_begins.push(wall_begin);
        }
        edges
    }
}

#[test]
fn edges_jitter_as_published() {
    // Nguyen et al.: 0.8 px from both edges of a target, at all distances together.
    let mut variances = vec![];
    for (near, far) in [(1.0, 2.0), (1.5, 3.0), (2.0, 4.0)] {
        let edges = Edges::of(&block_before_wall(near, far), f64::from(near), f64::from(far));
        let jitter = [spread(&edges.block_begins), spread(&edges.block_ends)];
        println!("jitter at {near} m, left and right, px: {jitter:.2?}");
        variances.extend(jitter.map(|jitter| jitter * jitter));
    }
    let mut report = Report::default();
    report.expect("V4 lateral noise, px", 0.8, 0.5..=1.2, mean(&variances).sqrt());
    report.finish();
}

#[test]
fn shadows_fall_to_the_left_as_wide_as_geometry_says() {
    let mut report = Report::default();
    for (near, far) in [(1.0, 2.0), (1.5, 3.0), (2.0, 4.0), (1.0, 4.0)] {
        let edges = Edges::of(&block_before_wall(near, far), f64::from(near), f64::from(far));
        let gap = |from: &[f64], to: &[f64]| mean(to) - mean(from) - 1.0;
        let target = BASELINE_FOCAL * f64::from(1.0 / near - 1.0 / far);
        let left = gap(&edges.wall_ends, &edges.block_begins);
        report.expect(&format!("V7 shadow of {near} m on {far} m, px"), target, target - 2.0..=target + 2.0, left);
        let right = gap(&edges.block_ends, &edges.wall_begins);
        report.expect(&format!("V7 gap at its right, {near} m on {far} m, px"), 0.0, 0.0..=2.0, right);
    }
    report.finish();
}
