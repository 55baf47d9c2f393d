//! One instant in the dark: features of the albedo at 830 nm, the projector being the lamp (paper A, §3.3).

use crate::camera::Rig;
use crate::estimator::Stage;
use crate::features::surf::Surf;
use crate::image::{DepthImage, InfraredImage};
use crate::params::EstimatorParams;
use crate::structure::{ALBEDO_NOISE, AlbedoCamera, DepthNoise, ViewMaker, depth_at, lift};

use super::{Frame, FrameView, depth_noise, view_maker};

/// Least scale of a feature, pixels. Smaller ones lie on what is left of single dots, which are fixed to the sensor.
const MIN_SCALE: f32 = 2.8;

/// [`FrameView::systematic_share`] in the dark, where most of what is asked has an albedo to hold on to. A guess.
const ALBEDO_SHARE: f64 = 0.06;

/// Makes frames of infrared and depth images.
pub struct NightFrameBuilder {
    camera: AlbedoCamera,
    views: Option<ViewMaker>,
    surf: Surf,
    noise: DepthNoise,
    rig: Rig,
}

impl NightFrameBuilder {
    /// For one rig; `None` where depth does not lie in the infrared image's pixels.
    pub fn new(params: &EstimatorParams, rig: &Rig) -> Option<Self> {
        let camera = (!rig.depth.registered_to_colour).then(|| AlbedoCamera::new(&rig.depth))?;
        let (views, surf) = (view_maker(params, &rig.depth.model, ALBEDO_NOISE), Surf::new(params.surf));
        Some(Self { camera, views, surf, noise: depth_noise(params), rig: rig.clone() })
    }

    /// The albedo, SURF on it, and the lift to 3D.
    pub fn build(&mut self, infrared: &InfraredImage, depth: &DepthImage, stage: &mut dyn FnMut(Stage)) -> Frame {
        stage(Stage::Registration);
        let albedo = self.camera.recover(infrared, depth);
        stage(Stage::Features);
        let has_depth =
            |x: f32, y: f32, scale: f32| scale >= MIN_SCALE && depth_at(x, y, &albedo.depth, &self.noise).is_some();
        let (features, landmarks) = self
            .surf
            .detect_where(&albedo.image, has_depth)
            .into_iter()
            .filter_map(|feature| {
                let landmark = lift(&feature, &albedo.depth, &self.rig.depth.model, &self.noise)?;
                Some((feature, landmark.moved(&self.rig.colour_from_depth)))
            })
            .unzip();
        let view = self.views.as_ref().map(|views| FrameView {
            view: views.view(&albedo.levels, &albedo.depth),
            colour_from_camera: self.rig.colour_from_depth,
            always: true,
            systematic_share: ALBEDO_SHARE,
        });
        Frame { features, landmarks, view }
    }

    /// Learns the projector's dots from the image of the last frame. To be called once the view has changed.
    pub fn learn(&mut self) {
        self.camera.learn();
    }
}

#[cfg(test)]
mod tests;
