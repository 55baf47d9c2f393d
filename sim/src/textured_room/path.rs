//! How the camera is carried: a second of standing still, then a walk of 3 m in 5 s with a hand's sway.

use std::f64::consts::TAU;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Standing still at the start, seconds.
pub const STANDSTILL: f64 = 1.0;
/// When the walk has ended, seconds.
pub const ARRIVAL: f64 = 6.0;
/// How long speed takes to build up, and to fall, seconds.
const EASING: f64 = 0.8;

/// Where the walk leads: x, y, z in metres, then yaw (0 looks along +x, anticlockwise) and pitch (up) in degrees.
/// Evenly spaced in time. The fifth and sixth stand before the bare west wall.
const WAYPOINTS: [[f64; 5]; 8] = [
    [4.22, 1.50, 1.42, 89.0, -16.0],
    [3.86, 1.60, 1.44, 98.0, -17.0],
    [3.30, 1.75, 1.40, 112.0, -18.0],
    [2.80, 1.95, 1.43, 132.0, -16.0],
    [2.30, 2.12, 1.40, 157.0, -15.0],
    [1.97, 2.34, 1.42, 166.0, -18.0],
    [1.80, 2.62, 1.40, 157.0, -17.0],
    [1.86, 3.00, 1.41, 134.0, -14.0],
];

/// One swing of the hand: frequency in Hz, phase in turns, amplitude in the unit of what it moves.
type Swing = (f64, f64, f64);
/// Sideways and upwards, metres: a stride is two steps of about half a second.
const SWAY: [Swing; 2] = [(0.95, 0.10, 0.012), (2.3, 0.40, 0.003)];
const BOB: [Swing; 2] = [(1.9, 0.30, 0.009), (3.1, 0.80, 0.002)];
/// Yaw, pitch and roll, degrees.
const YAW: [Swing; 2] = [(0.7, 0.20, 0.8), (2.1, 0.65, 0.15)];
const PITCH: [Swing; 2] = [(1.1, 0.55, 0.7), (2.7, 0.15, 0.12)];
const ROLL: [Swing; 2] = [(0.8, 0.90, 1.6), (1.9, 0.35, 0.25)];

/// Pose of a camera (x right, y down, z forward) in the room `time` seconds after the start; z is up in the room.
pub fn world_from_camera(time: f64) -> Isometry3<f64> {
    let [x, y, z, yaw, pitch] = waypoint(progress(time));
    let sway = sum(&SWAY, time);
    let yaw = (yaw + sum(&YAW, time)).to_radians();
    let pitch = (pitch + sum(&PITCH, time)).to_radians();
    let roll = sum(&ROLL, time).to_radians();
    let right = Vector3::new(yaw.sin(), -yaw.cos(), 0.0);
    let forward = Vector3::new(yaw.cos() * pitch.cos(), yaw.sin() * pitch.cos(), pitch.sin());
    let level = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[right, forward.cross(&right), forward]));
    let rotation = level * Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
    let position = Vector3::new(x, y, z + sum(&BOB, time)) + right * sway;
    Isometry3::from_parts(Translation3::from(position), UnitQuaternion::from_rotation_matrix(&rotation))
}

/// The share of the walk that is done at `time`: speed rises and falls linearly, and is steady in between.
fn progress(time: f64) -> f64 {
    let length = ARRIVAL - STANDSTILL;
    let walked = (time - STANDSTILL).clamp(0.0, length);
    // Distance under a speed ramp of unit height that is cut off after EASING.
    let ramp = |t: f64| if t < EASING { t * t / (2.0 * EASING) } else { t - EASING / 2.0 };
    let whole = length - EASING;
    if walked < length / 2.0 { ramp(walked) / whole } else { 1.0 - ramp(length - walked) / whole }
}

/// Catmull–Rom through the waypoints; `progress` runs from 0 to 1.
fn waypoint(progress: f64) -> [f64; 5] {
    let last = WAYPOINTS.len() - 1;
    let position = progress * last as f64;
    let index = (position as usize).min(last - 1);
    let t = position - index as f64;
    let [a, b, c, d] = [index.saturating_sub(1), index, index + 1, (index + 2).min(last)].map(|index| WAYPOINTS[index]);
    std::array::from_fn(|k| {
        let (slope_b, slope_c) = ((c[k] - a[k]) / 2.0, (d[k] - b[k]) / 2.0);
        let rise = c[k] - b[k];
        b[k] + t * (slope_b + t * (3.0 * rise - 2.0 * slope_b - slope_c + t * (slope_b + slope_c - 2.0 * rise)))
    })
}

/// Swings that set in and die away with the walk.
fn sum(swings: &[Swing], time: f64) -> f64 {
    let set_in = ((time - STANDSTILL) / EASING).clamp(0.0, 1.0);
    let die_away = ((ARRIVAL - time) / EASING).clamp(0.0, 1.0);
    let strength = (set_in * set_in * (3.0 - 2.0 * set_in)).min(die_away * die_away * (3.0 - 2.0 * die_away));
    strength * swings.iter().map(|(hz, phase, amplitude)| amplitude * (TAU * (hz * time + phase)).sin()).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_stands_walks_and_stands_without_a_jerk() {
        let step = 1.0 / 300.0;
        let mut length = 0.0;
        let mut before = world_from_camera(0.0);
        for frame in 1..=2100 {
            let now = world_from_camera(f64::from(frame) * step);
            let moved = (now.translation.vector - before.translation.vector).norm();
            let turned = now.rotation.angle_to(&before.rotation);
            if f64::from(frame) * step <= STANDSTILL {
                assert_eq!(now, before);
            }
            // A walk: below 1.2 m/s and 60 °/s at every instant.
            assert!(moved / step < 1.2 && turned.to_degrees() / step < 60.0, "frame {frame}");
            length += moved;
            before = now;
        }
        assert!((3.0..4.0).contains(&length), "{length} m");
        assert_eq!(world_from_camera(ARRIVAL), world_from_camera(ARRIVAL + 5.0));
    }

    #[test]
    fn the_first_view_is_level_and_looks_north() {
        let world_from_camera = world_from_camera(0.0);
        let forward = world_from_camera * Vector3::z();
        assert!(forward.y > 0.9 && forward.z < 0.0);
        assert!((world_from_camera * Vector3::x()).z.abs() < 1e-12, "the horizon is tilted");
        assert!((world_from_camera * Vector3::y()).z < -0.9, "y must point down");
    }
}
