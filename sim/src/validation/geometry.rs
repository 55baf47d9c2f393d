//! Depth of walls in even light: steps, noise, grazing views.

use std::collections::BTreeMap;

use super::bench::{BASELINE_FOCAL, Bench, Wall};
use super::statistics::{line, mean};
use super::{Effort, Finding, Findings};

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

/// V1: z = b·f/((1090 − raw)/8), ROS `kinect_calibration/technical`.
pub(super) fn steps(_: Effort) -> Findings {
    let wall = Wall { angle: 60.0, ..Wall::at(2.5) };
    let seen = &Bench::look_at_all(&[wall])?[0];
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
    let ends = levels.keys().next().zip(levels.keys().last());
    let in_range = ends.map_or(f64::NAN, |(first, last)| f64::from(last - first + 1));
    let inverse: Vec<_> = levels.iter().map(|(&raw, depths)| [f64::from(raw), mean(depths).recip()]).collect();
    let [offset, slope] = line(&inverse);
    let nominal = 1.0 / (8.0 * BASELINE_FOCAL);
    // Between values ten apart, as single steps are as large as the noise.
    let centres: Vec<f64> = levels.values().map(|depths| mean(depths)).collect();
    let steps: Vec<_> = centres.windows(11).map(|z| [z[5].ln(), ((z[10] - z[0]) / 10.0).ln()]).collect();
    Ok(vec![
        Finding::new("raw values used of those in range, share", 1.0, 1.0..=1.0, levels.len() as f64 / in_range),
        Finding::new("step over z², 1/m", nominal, 0.96 * nominal..=1.04 * nominal, -slope),
        Finding::new("raw value of infinity", 1090.0, 1087.0..=1093.0, -offset / slope),
        Finding::new("exponent of z in the step", 2.0, 1.95..=2.05, line(&steps)[1]),
    ])
}

/// V2: between the curves of Khoshelham and of Nguyen, which hold up to 60°.
pub(super) fn axial_noise(effort: Effort) -> Findings {
    // No wall is quite at right angles to the view: one that is could lie on a step of depth throughout.
    let all: [(f32, f32); 6] = [(1.0, 5.0), (3.0, 5.0), (2.0, 58.0), (2.0, 5.0), (4.0, 5.0), (2.0, 30.0)];
    let mut views = effort.of(&all, 3).to_vec();
    views.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let walls: Vec<_> = views.iter().map(|&(distance, angle)| Wall { angle, ..Wall::at(distance) }).collect();
    let mut findings = Vec::new();
    for ((distance, angle), seen) in views.into_iter().zip(Bench::look_at_all(&walls)?) {
        let z = f64::from(distance);
        let sample = seen.about(z);
        let (low, high) = (khoshelham(z).min(nguyen(z, 0.0)), khoshelham(z).max(nguyen(z, 0.0)));
        let noise = format!("axial noise at {z} m, {angle}°, mm");
        findings.push(Finding::new(noise, (low + high) / 2.0, 0.7 * low..=1.3 * high, sample.noise()));
        let wrong = format!("wrong by more than a pixel at {z} m, {angle}°, share");
        findings.push(Finding::new(wrong, 0.0, 0.0..=0.001, sample.wrong()));
    }
    Ok(findings)
}

/// V3: noisier past 60°, blind past 80° give or take 5°.
pub(super) fn grazing(effort: Effort) -> Findings {
    let mut angles = effort.of(&[70.0_f32, 85.0, 65.0, 75.0], 2).to_vec();
    angles.sort_by(f32::total_cmp);
    let walls: Vec<_> = angles.iter().map(|&angle| Wall { angle, ..Wall::at(2.0) }).collect();
    let finding = |(angle, seen): (f32, super::bench::Seen)| {
        let sample = seen.about(2.0);
        if angle < 75.0 {
            let target = nguyen(2.0, f64::from(angle).to_radians());
            let what = format!("axial noise at 2 m, {angle}°, mm");
            return Finding::new(what, target, target / 2.0..=target * 2.0, sample.noise());
        }
        let (target, accepted) = if angle < 80.0 { (1.0, 0.5..=1.0) } else { (0.0, 0.0..=0.5) };
        Finding::new(format!("valid at 2 m, {angle}°, share"), target, accepted, sample.valid)
    };
    Ok(angles.into_iter().zip(Bench::look_at_all(&walls)?).map(finding).collect())
}
