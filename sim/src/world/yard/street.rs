//! The yard's gate, and the street beyond it: where a car that passes at night has its headlights, one place after another.

use glam::{Vec2, Vec3, vec3};

use crate::light::{CAR_PLACES, LampKind, headlights};
use crate::world::Lamp;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Scene};
use crate::world::shape::Place;

/// Where the car is and where it heads, metres and degrees anticlockwise from east: it comes straight at the gate, and
/// the street bends away before it.
const COURSE: [([f32; 2], f32); CAR_PLACES] =
    [([-20.0, 5.4], -2.0), ([-14.5, 5.0], -6.0), ([-9.5, 4.2], -8.0), ([-6.5, 3.2], -20.0)];
/// The middle of the gate.
const GATE: Vec3 = vec3(0.1, 3.9, 0.65);
/// A car's two dipped headlights, candela: twice what ECE R112 asks of one on the road ahead (15 lx at 25 m).
const INTENSITY: f32 = 20_000.0;
/// Where the beam has a third of that, degrees off its axis. A guess.
const BEAM_WIDTH: f32 = 15.0;
/// Half the edge of the panel that stands for both, metres.
const HALF_EDGE: f32 = 0.15;

/// A barred gate of two wings from one point to another: light passes, robots do not.
pub(super) fn gate(scene: &mut Scene, [from, to]: [[f32; 2]; 2]) {
    let [from, to] = [from, to].map(Vec2::from);
    scene.piece("gate", Kind::Solid, Place::along(from, to), |piece| {
        let length = from.distance(to);
        let mut upright = |x: f32, half: f32, top: f32| {
            piece.block(Surface::DarkCoat, [x - half, -half, 0.06], [x + half, half, top]);
        };
        for end in [0.05, length / 2.0 - 0.04, length / 2.0 + 0.04, length - 0.05] {
            upright(end, 0.035, 1.95);
        }
        let bars = (length / 0.13).floor() as u32;
        for bar in 1..bars {
            upright(length * bar as f32 / bars as f32, 0.01, 1.8);
        }
        for z in [0.18, 1.66] {
            piece.block(Surface::DarkCoat, [0.05, -0.02, z], [length - 0.05, 0.02, z + 0.05]);
        }
    });
}

/// Adds the headlights. What they shed on the gate is right; a panel sheds light on a half space, which beside the beam
/// meets the outer side of walls.
pub(super) fn passing_car(scene: &mut Scene) {
    for (index, ([x, y], heading)) in COURSE.into_iter().enumerate() {
        let centre = vec3(x, y, 0.65);
        let ahead = (GATE - centre).normalize();
        let off = (ahead.y.atan2(ahead.x).to_degrees() - heading) / BEAM_WIDTH;
        let area = (2.0 * HALF_EDGE).powi(2);
        // A flat panel of exitance M has M · A / π candela along its normal.
        let exitance = INTENSITY * (-off * off).exp() * std::f32::consts::PI / area;
        let across = Vec3::Z.cross(ahead).normalize();
        let up = ahead.cross(across);
        scene.lamp(Lamp {
            name: format!("passing car, place {index}"),
            centre: centre.to_array(),
            half_edges: [(HALF_EDGE * across).to_array(), (HALF_EDGE * up).to_array()],
            exitance: LampKind::Halogen.exitance(exitance),
            group: headlights(index),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_beam_sweeps_past_the_gate() {
        let mut scene = Scene::default();
        passing_car(&mut scene);
        let world = scene.finish("street", 1);
        let at_the_gate = world.lamps.iter().map(|lamp| {
            let way = GATE - Vec3::from(lamp.centre);
            let [across, up] = lamp.half_edges.map(Vec3::from);
            let area = 4.0 * across.length() * up.length();
            let lux = crate::light::illuminance(&lamp.exitance) * area / std::f32::consts::PI / way.length_squared();
            assert!(across.cross(up).normalize().dot(way.normalize()) > 0.999, "{} looks away", lamp.name);
            lux
        });
        let lux: Vec<f32> = at_the_gate.collect();
        // Brightest before the bend; a car's beam sheds some hundred lux ten metres ahead.
        assert!(lux[0] > 20.0 && lux[1] > lux[0] && lux[2] > lux[1] && lux[3] < 0.5 * lux[2], "{lux:?}");
        assert!((100.0..400.0).contains(&lux[2]), "{lux:?}");
    }
}
