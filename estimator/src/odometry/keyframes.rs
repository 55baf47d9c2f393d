//! Odometry against a window of keyframes: standing still does not drift, and depth noise averages out.

use std::collections::VecDeque;

use nalgebra::{Isometry3, Matrix6, Translation3, Vector6};
use serde::{Deserialize, Serialize};

use crate::camera::Rig;
use crate::estimator::Stage;
use crate::features::matching::match_features;
use crate::geometry::adjoint;
use crate::motion::{Motion, MotionFailure, Pair, align, misfit, ransac, refine};
use crate::params::EstimatorParams;

use super::{CameraPose, FeatureTrack, Frame, FrameView, Tracking};

/// Parameters of the keyframes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct KeyframeParams {
    /// Keyframes that a frame is held against.
    pub window: usize,
    /// A frame becomes a keyframe when half of its features have moved further than this since the newest one,
    /// pixels …
    #[serde(rename = "max_flow_px")]
    pub max_flow: f64,
    /// … or when less than this share of its features is found in the newest one, 0–1.
    pub min_overlap: f64,
    /// σ of what rolling shutter and the depth's own bow bend each step between keyframes by, as a share of the step: of
    /// the distance gone, and of the turn, which swings the camera about the scene that it looks at. A guess.
    pub systematic_share: f64,
    /// The same of the calibration's error, for each radian that the cameras may be out of line. A guess: a recorded
    /// Kinect whose cameras were aligned to 2 px of 525 turns 6 % too little.
    pub share_per_misalignment: f64,
    /// After this many frames without motion the odometry gives the old keyframes up and starts from what it sees.
    pub max_lost_frames: usize,
    /// How far the camera may have gone during one lost frame: σ a frame, metres. A guess: 0.5 m/s at 15 Hz.
    #[serde(rename = "lost_sigma_m")]
    pub lost_translation: f64,
    /// How far it may have turned: σ a frame, radians. A guess: 30°/s at 15 Hz.
    #[serde(rename = "lost_sigma_rad")]
    pub lost_rotation: f64,
}

impl Default for KeyframeParams {
    fn default() -> Self {
        Self {
            window: 2,
            max_flow: 10.0,
            min_overlap: 0.3,
            systematic_share: 0.01,
            share_per_misalignment: 15.7,
            max_lost_frames: 3,
            lost_translation: 0.033,
            lost_rotation: 0.035,
        }
    }
}

/// Least share of a keyframe's pixels that must be seen in a frame, or that becomes a keyframe itself. A guess.
const LEAST_OVERLAP: f64 = 0.6;

/// Fewer features that agree may agree by chance or lie in one corner of the image, as before a bare wall with a door beside
/// it: then all pixels are asked. A guess.
const FEW: usize = 60;

/// A motion by all pixels, in the start frame.
struct ByAllPixels {
    motion: Motion,
    flow: f64,
    overlap: f64,
}

struct Keyframe {
    pose: CameraPose,
    frame: Frame,
}

/// Holds each frame against the newest keyframes.
pub struct Keyframes {
    params: EstimatorParams,
    /// σ of what bends each step, as a share of it: all that is known of this rig.
    systematic_share: f64,
    /// Newest last; empty before the first frame and after a [`restart`](Self::restart).
    window: VecDeque<Keyframe>,
    /// Whether there was a frame before.
    started: bool,
    /// The pose of the last frame, its covariance grown by the frames lost since.
    last: CameraPose,
    /// The camera's motion since the last pose, as it is expected: as wheels say, or like the one before.
    step: Isometry3<f64>,
    lost_frames: usize,
}

impl Keyframes {
    /// Nothing seen yet.
    pub fn new(params: &EstimatorParams, rig: &Rig) -> Self {
        let KeyframeParams { systematic_share, share_per_misalignment, .. } = params.keyframes;
        Self {
            params: params.clone(),
            systematic_share: systematic_share.hypot(share_per_misalignment * rig.alignment_sigma / rig.colour.fx),
            window: VecDeque::new(),
            started: false,
            last: CameraPose::start(),
            step: Isometry3::identity(),
            lost_frames: 0,
        }
    }

    /// Gives the keyframes up: what comes next shows other images, or another place, and is seen from `pose`.
    pub fn restart(&mut self, pose: CameraPose) {
        (self.last, self.started) = (pose, true);
        self.window.clear();
        self.lost_frames = 0;
    }

    /// Says how the camera has moved since the pose that was found last, for all that is known without images: from there
    /// the search begins.
    pub fn expect(&mut self, last_from_camera: Isometry3<f64>) {
        self.step = last_from_camera;
    }

    /// Follows one frame.
    pub fn track(&mut self, frame: Frame, stage: &mut dyn FnMut(Stage)) -> Tracking {
        let needed = self.params.ransac.min_inliers;
        let found = frame.features.len();
        let too_few = MotionFailure::TooFewFeatures { found, needed };
        if found < needed && !frame.view.as_ref().is_some_and(FrameView::shows_much) {
            return self.lose(frame, too_few, Vec::new());
        }
        if self.window.is_empty() && self.started {
            return self.lose(frame, MotionFailure::NoReference, Vec::new());
        }
        if self.window.is_empty() {
            self.remember(frame);
            return Tracking { pose: self.last.clone(), failure: None, tracks: Vec::new(), keyframe: true };
        }
        stage(Stage::Matching);
        let (pairs, mut tracks) = self.pairs(&frame);
        stage(Stage::Motion);
        let sparse =
            ransac(&pairs, &self.params.ransac).and_then(|start| refine(&pairs, &start, needed, &self.params.refine));
        let agreeing = sparse.as_ref().map_or(0, Motion::inlier_count);
        let asks_all = frame.view.as_ref().is_some_and(|view| view.always || agreeing < FEW);
        let dense = asks_all.then(|| self.by_all_pixels(&frame, sparse.as_ref().ok())).flatten();
        let motion = match (sparse, &dense) {
            (Ok(sparse), None) => sparse,
            (sparse, Some(dense)) => {
                let inliers = sparse.map_or_else(|_| vec![false; pairs.len()], |sparse| sparse.inliers);
                Motion { inliers, ..dense.motion.clone() }
            }
            (Err(_), None) if found < needed => return self.lose(frame, too_few, tracks),
            (Err(failure), None) => return self.lose(frame, failure, tracks),
        };
        for (track, &inlier) in tracks.iter_mut().zip(&motion.inliers) {
            track.inlier = inlier;
        }
        let newest = &self.window[self.window.len() - 1];
        let by_pixels = dense.as_ref().and(frame.view.as_ref()).map_or(0.0, |view| view.systematic_share);
        let systematic = systematic_covariance(
            &newest.pose.start_from_camera,
            &motion.reference_from_camera,
            median_depth(&frame),
            self.systematic_share.hypot(by_pixels),
        );
        let before = std::mem::replace(
            &mut self.last,
            CameraPose {
                start_from_camera: motion.reference_from_camera,
                covariance: newest.pose.covariance + motion.covariance + systematic,
            },
        );
        self.step = before.start_from_camera.inverse() * self.last.start_from_camera;
        self.lost_frames = 0;
        let keyframe = match dense {
            Some(dense) => dense.flow > self.params.keyframes.max_flow || dense.overlap < LEAST_OVERLAP,
            None => self.has_moved_on(&tracks, found),
        };
        if keyframe {
            self.remember(frame);
        }
        Tracking { pose: self.last.clone(), failure: None, tracks, keyframe }
    }

    /// Against the newest keyframe by all pixels, where both frames have them; from the motion by features or from the one
    /// that is expected, whichever explains the pixels better.
    fn by_all_pixels(&self, frame: &Frame, sparse: Option<&Motion>) -> Option<ByAllPixels> {
        let newest = self.window.back()?;
        let (reference, view) = (newest.frame.view.as_ref()?, frame.view.as_ref()?);
        let start_from_keyframe = newest.pose.start_from_camera * reference.colour_from_camera;
        let camera_from_colour = view.colour_from_camera.inverse();
        let relative =
            |start_from_camera: &Isometry3<f64>| camera_from_colour * start_from_camera.inverse() * start_from_keyframe;
        let expected = relative(&(self.last.start_from_camera * self.step));
        let by_features = sparse.map(|sparse| relative(&sparse.reference_from_camera));
        let cost = |motion: &Isometry3<f64>| misfit(&reference.view, &view.view, motion);
        let start = by_features.filter(|found| cost(found) <= cost(&expected)).unwrap_or(expected);
        let found = align(&reference.view, &view.view, &start, self.params.refine.max_weakest_sigma).ok()?;
        let start_from_view = start_from_keyframe * found.camera_from_reference.inverse();
        let carry = adjoint(&start_from_view);
        let motion = Motion {
            reference_from_camera: start_from_view * camera_from_colour,
            covariance: carry * found.covariance * carry.transpose(),
            inliers: Vec::new(),
        };
        Some(ByAllPixels { motion, flow: found.flow, overlap: found.overlap })
    }

    /// Pairs with every keyframe, the newest first, and the tracks to the newest; references in the start frame.
    fn pairs(&self, frame: &Frame) -> (Vec<Pair>, Vec<FeatureTrack>) {
        let (mut pairs, mut tracks) = (Vec::new(), Vec::new());
        for (age, keyframe) in self.window.iter().rev().enumerate() {
            for found in match_features(&frame.features, &keyframe.frame.features, &self.params.matching) {
                let landmark = &keyframe.frame.landmarks[found.to];
                pairs.push(Pair {
                    camera: frame.landmarks[found.from],
                    reference: landmark.moved(&keyframe.pose.start_from_camera),
                });
                if age == 0 {
                    let (from, to) = (&keyframe.frame.features[found.to], &frame.features[found.from]);
                    tracks.push(FeatureTrack::between(from, to));
                }
            }
        }
        (pairs, tracks)
    }

    /// Whether the newest keyframe no longer shows what is seen now.
    fn has_moved_on(&self, tracks: &[FeatureTrack], features: usize) -> bool {
        let params = &self.params.keyframes;
        let mut flow: Vec<f32> = tracks.iter().filter(|track| track.inlier).map(FeatureTrack::length).collect();
        if (flow.len() as f64) < params.min_overlap * features as f64 {
            return true;
        }
        let middle = flow.len() / 2;
        flow.get(middle).is_some()
            && f64::from(*flow.select_nth_unstable_by(middle, f32::total_cmp).1) > params.max_flow
    }

    /// Makes `frame`, seen from the last pose, the newest keyframe.
    fn remember(&mut self, frame: Frame) {
        self.started = true;
        self.window.push_back(Keyframe { pose: self.last.clone(), frame });
        if self.window.len() > self.params.keyframes.window {
            self.window.pop_front();
        }
    }

    /// A frame without motion: the pose stays and is trusted less. After too many of them the keyframes are given
    /// up, or a camera that has moved on while it was covered would stay lost for ever.
    fn lose(&mut self, frame: Frame, failure: MotionFailure, tracks: Vec<FeatureTrack>) -> Tracking {
        let params = &self.params.keyframes;
        self.lost_frames += 1;
        self.step = Isometry3::identity();
        let (translation, rotation) = (params.lost_translation, params.lost_rotation);
        let growth = Vector6::new(translation, translation, translation, rotation, rotation, rotation);
        // The perturbation acts at the camera; seen from the start frame its rotation swings the camera's position.
        let carry = adjoint(&self.last.start_from_camera);
        self.last.covariance += carry * Matrix6::from_diagonal(&growth.component_mul(&growth)) * carry.transpose();
        let start_over = match failure {
            MotionFailure::NoReference => true,
            MotionFailure::TooFewFeatures { .. } => false,
            _ => self.lost_frames > params.max_lost_frames,
        };
        if start_over {
            self.window.clear();
            self.remember(frame);
        }
        Tracking { pose: self.last.clone(), failure: Some(failure), tracks, keyframe: start_over }
    }
}

/// Covariance, in the start frame, of an error of `share` of the step from a keyframe to a camera. What looks at a
/// scene confuses turning with going sideways round it, so the error turns about the scene, `distance` ahead.
fn systematic_covariance(
    start_from_keyframe: &Isometry3<f64>,
    start_from_camera: &Isometry3<f64>,
    distance: f64,
    share: f64,
) -> Matrix6<f64> {
    let step = start_from_keyframe.inverse() * start_from_camera;
    let (gone, turned) = (share * step.translation.vector.norm(), share * step.rotation.angle());
    let sigmas = Vector6::new(gone, gone, gone, turned, turned, turned);
    let carry = adjoint(&(start_from_camera * Translation3::new(0.0, 0.0, distance)));
    carry * Matrix6::from_diagonal(&sigmas.component_mul(&sigmas)) * carry.transpose()
}

/// Median Z of a frame's landmarks, metres; 0 when it has none.
fn median_depth(frame: &Frame) -> f64 {
    let mut depths: Vec<f64> = frame.landmarks.iter().map(|landmark| landmark.position.z).collect();
    let middle = depths.len() / 2;
    if depths.is_empty() { 0.0 } else { *depths.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

#[cfg(test)]
mod tests;
