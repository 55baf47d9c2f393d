//! Colour and infrared as a stereo camera, 25 mm apart (paper A, §3.2): depth where the projector is outshone.

use nalgebra::{Point2, Vector3};

use crate::camera::{CameraModel, Rig};
use crate::features::cross_spectral::{Band, CrossMatch, CrossSpectral, CrossSpectralParams};
use crate::image::{GrayImage, InfraredImage};

/// Nothing nearer is sought, metres: a Kinect on a robot sees nothing so near.
const NEAREST: f64 = 0.5;
/// What the believed calibration may be off by, rows and columns; pixels. The best of them leave a fifth of a pixel.
const SLACK: f64 = 2.0;
/// Half the edge of the window that a match looks at: what is not seen begins with an edge of its own. Pixels.
const WINDOW: f32 = 16.0;
/// Levels of an infrared pixel.
const LEVELS: usize = 1024;

/// 1/Z in the colour camera's frame: what disparity is proportional to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseDepth {
    /// 1/m; of what is far away noise may make it negative.
    pub value: f64,
    /// Its σ but for the calibration's error, which all share; 1/m.
    pub sigma: f64,
}

/// The two cameras of a rig.
pub struct Stereo {
    colour: CameraModel,
    /// The infrared camera's place in the colour camera's frame, metres.
    infrared_at: Vector3<f64>,
    /// As in [`Rig`].
    alignment_sigma: f64,
    /// For each pixel of the colour camera, where the infrared one sees what is infinitely far; `None` outside its image.
    places: Vec<Option<(f32, f32)>>,
    matcher: CrossSpectral,
    band: Band,
}

impl Stereo {
    /// For one rig; `None` where the calibration does not say where the infrared camera is, or says that it is not beside
    /// the colour camera.
    pub fn new(rig: &Rig) -> Option<Self> {
        let infrared_at = rig.colour_from_depth.translation.vector;
        let is_beside = infrared_at.x.abs() > 2.0 * infrared_at.yz().norm() && infrared_at.x.abs() > 1e-3;
        (is_beside && !rig.depth.registered_to_colour).then_some(())?;
        let (colour, infrared) = (rig.colour, rig.depth.model);
        let (right, below) = ((infrared.width - 1) as f64, (infrared.height - 1) as f64);
        let place = |index: usize| {
            let pixel = Point2::new((index % colour.width) as f64, (index / colour.width) as f64);
            let ray = rig.colour_from_depth.rotation.inverse_transform_vector(&colour.ray(&pixel));
            let seen = infrared.project(&ray.into())?;
            let is_inside = (0.0..=right).contains(&seen.x) && (0.0..=below).contains(&seen.y);
            is_inside.then_some((seen.x as f32, seen.y as f32))
        };
        let most = -colour.fx * infrared_at.x / NEAREST;
        let rows = SLACK + (colour.fy * infrared_at.y / NEAREST).abs();
        let columns = ((most.min(0.0) - SLACK) as f32, (most.max(0.0) + SLACK) as f32);
        Some(Self {
            colour,
            infrared_at,
            alignment_sigma: rig.alignment_sigma,
            places: (0..colour.width * colour.height).map(place).collect(),
            matcher: CrossSpectral::new(CrossSpectralParams::default()),
            band: Band { rows: rows as f32, columns },
        })
    }

    /// σ of what the calibration's error shifts all inverse depths by, 1/m.
    pub fn shared_sigma(&self) -> f64 {
        self.of_disparity(self.alignment_sigma)
    }

    /// How much inverse depth, 1/m, so many pixels of disparity are.
    fn of_disparity(&self, pixels: f64) -> f64 {
        pixels / (self.colour.fx * self.infrared_at.x.abs())
    }

    /// The inverse depth at places (column, row) of the colour image, of which the infrared image is of the same instant.
    pub fn inverse_depths(
        &mut self,
        places: &[(f32, f32)],
        luma: &GrayImage,
        infrared: &InfraredImage,
    ) -> Vec<Option<InverseDepth>> {
        let aligned = self.aligned(infrared, luma);
        let matches = self.matcher.match_points(places, luma, &aligned, &self.band);
        let triangulated = |found: CrossMatch| self.is_seen_about(found.infrared).then(|| self.triangulated(&found));
        matches.into_iter().map(|found| found.and_then(triangulated)).collect()
    }

    /// Whether the infrared camera sees all that is about a pixel of the colour camera.
    fn is_seen_about(&self, (x, y): (f32, f32)) -> bool {
        let (width, height) = self.colour.size();
        [(-WINDOW, -WINDOW), (WINDOW, -WINDOW), (-WINDOW, WINDOW), (WINDOW, WINDOW)].iter().all(|(dx, dy)| {
            // At the colour image's own border nothing is missing.
            let column = (x + dx).clamp(0.0, (width - 1) as f32) as usize;
            let row = (y + dy).clamp(0.0, (height - 1) as f32) as usize;
            self.places[row * width + column].is_some()
        })
    }

    /// What the infrared camera would see if it looked as the colour camera does, with the colour image's grey levels
    /// ("first scaled and histogram-adjusted to look like RGB"): as many pixels are darker as in the colour image.
    fn aligned(&self, infrared: &InfraredImage, luma: &GrayImage) -> GrayImage {
        let at = |(x, y): (f32, f32)| infrared.between(x, y).round() as u16;
        let seen: Vec<Option<u16>> = self.places.iter().map(|place| place.map(at)).collect();
        let (mut darker, mut levels) = (vec![0_usize; LEVELS], [0_usize; 256]);
        for (value, &grey) in seen.iter().zip(luma.pixels()) {
            if let Some(value) = value {
                darker[usize::from(*value).min(LEVELS - 1)] += 1;
                levels[usize::from(grey)] += 1;
            }
        }
        let (mut below, mut grey, mut below_grey) = (0, 0, levels[0]);
        let grey_of: Vec<u8> = darker
            .iter()
            .map(|&count| {
                // The middle one of those with the value.
                let rank = below + count / 2;
                below += count;
                while below_grey <= rank && grey < 255 {
                    grey += 1;
                    below_grey += levels[grey];
                }
                grey as u8
            })
            .collect();
        let pixels = seen.iter().map(|value| value.map_or(0, |value| grey_of[usize::from(value).min(LEVELS - 1)]));
        let (width, height) = self.colour.size();
        GrayImage::from_pixels(width, height, pixels.collect()).expect("as many pixels as places")
    }

    fn triangulated(&self, found: &CrossMatch) -> InverseDepth {
        let ray = |(x, y): (f32, f32)| self.colour.ray(&Point2::new(f64::from(x), f64::from(y)));
        let (here, there, at) = (ray(found.colour), ray(found.infrared), self.infrared_at);
        // z·here − at ∥ there, along x.
        let value = (here.x - there.x) / (at.x - at.z * there.x);
        InverseDepth { value, sigma: self.of_disparity(f64::from(found.sigma)) }
    }
}

#[cfg(test)]
mod tests;
