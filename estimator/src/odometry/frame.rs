//! One instant: features that have a 3D point.

use nalgebra::Isometry3;

use crate::camera::Rig;
use crate::estimator::Stage;
use crate::features::surf::{Feature, Surf};
use crate::image::{DepthImage, RgbImage};
use crate::params::{EstimatorParams, Variant};
use crate::structure::{DenseView, DepthNoise, Landmark, Registration, depth_at, lift};

/// Features with depth, strongest first; `landmarks[i]` belongs to `features[i]`.
#[derive(Clone, Debug)]
pub struct Frame {
    /// In the image that the mode takes them from: colour or, at night, infrared.
    pub features: Vec<Feature>,
    /// In the colour camera's frame.
    pub landmarks: Vec<Landmark>,
    /// All pixels, where they are to help.
    pub view: Option<FrameView>,
}

/// A view, and where its camera sits.
#[derive(Clone, Debug)]
pub struct FrameView {
    /// Shade and depth.
    pub view: DenseView,
    /// Points in its camera's frame → the colour camera's.
    pub colour_from_camera: Isometry3<f64>,
}

/// The paper's own variant uses no depth beyond 2.4 m; ours weighs it by its uncertainty.
pub(super) fn depth_noise(params: &EstimatorParams) -> DepthNoise {
    let mut noise = params.depth_noise;
    if params.variant == Variant::Paper {
        noise.max_depth = noise.max_depth.min(params.paper.max_depth);
    }
    noise
}

/// Makes frames of colour and depth images.
pub struct FrameBuilder {
    registration: Registration,
    surf: Surf,
    noise: DepthNoise,
    rig: Rig,
}

impl FrameBuilder {
    /// Tables for one rig.
    pub fn new(params: &EstimatorParams, rig: &Rig) -> Self {
        let (registration, surf) = (Registration::new(rig), Surf::new(params.surf));
        Self { registration, surf, noise: depth_noise(params), rig: rig.clone() }
    }

    /// Registration, SURF, and the lift to 3D (paper A, §3.1: RGB feature + registered depth).
    pub fn build(&mut self, rgb: &RgbImage, depth: &DepthImage, stage: &mut dyn FnMut(Stage)) -> Frame {
        stage(Stage::Registration);
        let registered = self.registration.register(depth);
        stage(Stage::Features);
        let has_depth = |x: f32, y: f32, _: f32| depth_at(x, y, &registered, &self.noise).is_some();
        let (features, landmarks) = self
            .surf
            .detect_where(&rgb.to_luma(), has_depth)
            .into_iter()
            .filter_map(|feature| {
                let landmark = lift(&feature, &registered, &self.rig.colour, &self.noise)?;
                Some((feature, landmark))
            })
            .unzip();
        Frame { features, landmarks, view: None }
    }
}
