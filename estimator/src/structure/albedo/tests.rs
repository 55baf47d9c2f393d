//! The recovered albedo beside the one that a room truly has.

use nalgebra::{Isometry3, Vector3};

use super::*;
use crate::dark_room::{self, DarkRoom, HEIGHT, Seen, WIDTH, Wall};

/// A wall two metres ahead, slightly aslant.
fn room(ambient: f64) -> DarkRoom {
    let normal = Vector3::new(0.1, 0.0, 1.0).normalize();
    DarkRoom { walls: vec![Wall { normal, distance: 2.0, is_textured: true }], ambient }
}

fn beside(metres: f64) -> Isometry3<f64> {
    Isometry3::translation(metres, 0.0, 0.0)
}

/// Correlation of two images away from the rim.
fn correlation(a: &[f32], b: &[f32]) -> f64 {
    let inside = (0..WIDTH * HEIGHT)
        .filter(|index| (40..600).contains(&(index % WIDTH)) && (40..440).contains(&(index / WIDTH)));
    let pairs: Vec<(f64, f64)> = inside.map(|index| (f64::from(a[index]), f64::from(b[index]))).collect();
    let count = pairs.len() as f64;
    let (mean_a, mean_b) = pairs.iter().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / count, y + b / count));
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in pairs {
        let (a, b) = (a - mean_a, b - mean_b);
        (aa, bb, ab) = (aa + a * a, bb + b * b, ab + a * b);
    }
    ab / (aa * bb).sqrt()
}

fn fidelity(albedo: &Albedo, seen: &Seen) -> f64 {
    let recovered: Vec<f32> =
        albedo.image.pixels().iter().map(|level| (f32::from(*level) / LEVELS_PER_E).exp()).collect();
    correlation(&recovered, seen.albedo.pixels())
}

#[test]
fn the_dots_are_learnt_and_divided_out() {
    for (ambient, first, later) in [(0.0, 0.9, 0.97), (0.02, 0.93, 0.97), (0.3, 0.95, 0.98)] {
        let room = room(ambient);
        let mut camera = AlbedoCamera::new(&dark_room::rig().depth);
        let mut fidelities = Vec::new();
        for step in 0..20 {
            let seen = room.seen_from(&beside(0.04 * f64::from(step)), step as u64);
            let albedo = camera.recover(&seen.infrared, &seen.depth);
            fidelities.push(fidelity(&albedo, &seen));
            camera.learn();
        }
        assert!(fidelities[0] > first, "{fidelities:?}");
        assert!(fidelities[19] > later, "{fidelities:?}");
    }
}
