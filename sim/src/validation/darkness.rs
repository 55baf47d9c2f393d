//! Lamps that have next to no 830 nm, and no lamps at all: depth does not mind, the colour camera does.

use sunblind_estimator::image::RgbImage;

use super::bench::{Bench, Sample, Wall};
use super::scene::{Light, chequered, facing_wall, object, world};
use super::statistics::{mean, spread};
use super::{Effort, Finding, Findings};
use crate::render::RenderError;

/// Where the wall is, metres.
const DISTANCE: f32 = 2.0;

/// The same wall in each light. It is not quite at right angles to the view, so as not to lie on one step of depth.
fn walls_in(lights: &[Light]) -> Result<Vec<Sample>, RenderError> {
    let walls: Vec<_> = lights.iter().map(|&light| Wall { light, angle: 5.0, ..Wall::at(DISTANCE) }).collect();
    Ok(Bench::look_at_all(&walls)?.iter().map(|seen| seen.about(f64::from(DISTANCE))).collect())
}

fn compared(name: &str, usual: &Sample, other: &Sample) -> [Finding; 2] {
    let change = 100.0 * (other.valid - usual.valid).abs();
    let ratio = other.noise() / usual.noise();
    [
        Finding::new(format!("change of valid depth, {name}, % points"), 0.0, 0.0..=2.0, change),
        Finding::new(format!("noise over that at 500 lx of LED, {name}"), 1.0, 0.9..=1.1, ratio),
    ]
}

/// V5. Chow et al. saw no difference with fluorescent light, nor with a desk lamp (a halogen one's infrared is that of
/// 2 klx of sun).
pub(super) fn lamps(effort: Effort) -> Findings {
    let all = [
        ("1000 lx of LED", Light::led(1000.0)),
        ("500 lx of halogen", Light::halogen(500.0)),
        ("50 lx of LED", Light::led(50.0)),
    ];
    let lamps = effort.of(&all, 2);
    let lights: Vec<_> = std::iter::once(Light::LED).chain(lamps.iter().map(|lamp| lamp.1)).collect();
    let samples = walls_in(&lights)?;
    Ok(lamps.iter().zip(&samples[1..]).flat_map(|(lamp, sample)| compared(lamp.0, &samples[0], sample)).collect())
}

/// How many times as large as its noise the difference between white and dark grey squares is, in a colour image.
fn contrast(light: Light) -> Result<f64, RenderError> {
    let board = chequered("board", [124, 124, 124, 50], [231, 231, 231, 200], 2);
    let wall = object("wall", facing_wall(DISTANCE, light), 0);
    let seen = Bench::new(&world("board", vec![wall], vec![board]))?.look()?;
    let green = |rgb: &RgbImage, x: usize| -> Vec<f64> {
        // Inside squares of 131 px, to both sides of the image's middle.
        (200..220).flat_map(|y| (x..x + 40).map(move |x| (x, y))).map(|(x, y)| f64::from(rgb.at(x, y)[1])).collect()
    };
    let (left, right) = (green(&seen.frame.rgb, 240), green(&seen.frame.rgb, 360));
    let noise = (0.5 * (spread(&left).powi(2) + spread(&right).powi(2))).sqrt();
    Ok((mean(&left) - mean(&right)).abs() / noise)
}

/// V6.
pub(super) fn darkness(_: Effort) -> Findings {
    let samples = walls_in(&[Light::LED, Light::NONE])?;
    let mut findings = compared("darkness", &samples[0], &samples[1]).to_vec();
    for (lux, target, accepted) in [(0.3, 0.0, 0.0..=1.0), (300.0, 20.0, 10.0..=f64::INFINITY)] {
        let what = format!("colour at {lux} lx: contrast of 0.8 to 0.2 over its noise in a pixel");
        findings.push(Finding::new(what, target, accepted, contrast(Light::led(lux))?));
    }
    Ok(findings)
}
