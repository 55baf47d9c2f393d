//! One instant: features that have a 3D point.

use nalgebra::Isometry3;

use crate::camera::{CameraModel, Rig};
use crate::estimator::Stage;
use crate::features::surf::{Feature, Surf};
use crate::image::{DepthImage, GrayImage, Image, RgbImage};
use crate::params::{EstimatorParams, Variant};
use crate::structure::{DenseView, DepthNoise, Landmark, Registration, ViewMaker, depth_at, lift};

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
    /// Whether all pixels are asked even where features say how the camera moved.
    pub always: bool,
    /// σ of what alignment by all pixels errs by besides, as a share of the step: slopes that depth's noise makes of a flat
    /// wall move with the camera and say that nothing moved.
    pub systematic_share: f64,
}

impl FrameView {
    /// Whether enough of it has depth to be followed without features.
    pub(super) fn shows_much(&self) -> bool {
        let depth = self.view.depth.pixels();
        depth.iter().filter(|z| **z > 0.0).count() as f64 > LEAST_FILLED * depth.len() as f64
    }
}

/// Share of a view's pixels that must have depth, 0–1. A guess.
const LEAST_FILLED: f64 = 0.3;

/// By day all pixels are asked where there is next to nothing but a bare wall. A guess.
const BARE_SHARE: f64 = 0.4;

/// Levels of shade that brightness grows by when it grows e-fold: a change of exposure is the same offset everywhere, and
/// a tenth more is well above noise.
const LEVELS_PER_E: f32 = 100.0;

/// σ of shade, levels: one of 50 grey levels, where a dark image is noisy by so much. A guess.
const SHADE_NOISE: f32 = 2.0;

/// The paper's own variant uses no depth beyond 2.4 m; ours weighs it by its uncertainty.
pub(super) fn depth_noise(params: &EstimatorParams) -> DepthNoise {
    let mut noise = params.depth_noise;
    if params.variant == Variant::Paper {
        noise.max_depth = noise.max_depth.min(params.paper.max_depth);
    }
    noise
}

/// For the views that keyframes are aligned by; the paper's own variant has none.
pub(super) fn view_maker(params: &EstimatorParams, camera: &CameraModel, shade_noise: f32) -> Option<ViewMaker> {
    (params.variant == Variant::Keyframes).then(|| ViewMaker::new(camera, shade_noise))
}

/// Makes frames of colour and depth images.
pub struct FrameBuilder {
    registration: Registration,
    surf: Surf,
    views: Option<ViewMaker>,
    noise: DepthNoise,
    rig: Rig,
}

impl FrameBuilder {
    /// Tables for one rig.
    pub fn new(params: &EstimatorParams, rig: &Rig) -> Self {
        let (registration, surf) = (Registration::new(rig), Surf::new(params.surf));
        let views = view_maker(params, &rig.colour, SHADE_NOISE);
        Self { registration, surf, views, noise: depth_noise(params), rig: rig.clone() }
    }

    /// Registration, SURF, and the lift to 3D (paper A, §3.1: RGB feature + registered depth); all pixels besides, for
    /// places without texture.
    pub fn build(&mut self, rgb: &RgbImage, depth: &DepthImage, stage: &mut dyn FnMut(Stage)) -> Frame {
        stage(Stage::Registration);
        let registered = self.registration.register(depth);
        stage(Stage::Features);
        let has_depth = |x: f32, y: f32, _: f32| depth_at(x, y, &registered, &self.noise).is_some();
        let luma = rgb.to_luma();
        let (features, landmarks) = self
            .surf
            .detect_where(&luma, has_depth)
            .into_iter()
            .filter_map(|feature| {
                let landmark = lift(&feature, &registered, &self.rig.colour, &self.noise)?;
                Some((feature, landmark))
            })
            .unzip();
        let view = self.views.as_ref().map(|views| FrameView {
            view: views.view(&shade(&luma), &registered),
            colour_from_camera: Isometry3::identity(),
            always: false,
            systematic_share: BARE_SHARE,
        });
        Frame { features, landmarks, view }
    }
}

/// Brightness in levels that a change of exposure adds the same to everywhere; above 0.
fn shade(luma: &GrayImage) -> Image<f32> {
    let levels: Vec<f32> = (0..=u8::MAX).map(|value| 1.0 + LEVELS_PER_E * (1.0 + f32::from(value)).ln()).collect();
    let pixels = luma.pixels().iter().map(|&value| levels[usize::from(value)]).collect();
    Image::from_pixels(luma.width(), luma.height(), pixels).expect("same size in and out")
}
