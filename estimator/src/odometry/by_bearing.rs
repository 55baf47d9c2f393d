//! Odometry without depth: features of colour images say how the camera turned and which way it went, the wheels how far.

use nalgebra::{Isometry3, Point2};

use crate::camera::CameraModel;
use crate::estimator::Stage;
use crate::features::matching::match_features;
use crate::features::surf::{Feature, Surf};
use crate::geometry::adjoint;
use crate::image::RgbImage;
use crate::motion::{MotionFailure, RayPair, epipolar_motion};
use crate::params::EstimatorParams;

use super::{CameraPose, FeatureTrack, Tracking};

/// Shortest way between two views that says something, metres: what a metre away is moves by 25 px.
const LEAST_WAY: f64 = 0.05;
/// A frame becomes a keyframe when half of its features have moved further than this, pixels. Far more than with depth:
/// a longer way says more of its direction, and each link adds its error.
const MAX_FLOW: f32 = 40.0;
/// … or the way is longer than this, metres …
const MAX_WAY: f64 = 0.5;
/// … or less than this share of its features is found again.
const LEAST_OVERLAP: f64 = 0.25;
/// Fewest pairs that agree: mismatches near the epipolar line are many more than near a point.
const MIN_INLIERS: usize = 40;
/// σ of how far a robot strays from the way that its wheels say, as a share of it: no side slip (paper A, Eq. 1) but on
/// gravel. A guess.
const STRAY: f64 = 0.02;
/// By how much the variance is larger than independent features would make it: frames share a keyframe's noise, and
/// mismatches bend the valley in which going aside and turning look alike. From simulated pairs, one in ten mismatched.
const SHARED: f64 = 9.0;

struct Keyframe {
    features: Vec<Feature>,
    pose: CameraPose,
    /// By the wheels.
    odom_from_camera: Isometry3<f64>,
}

/// Holds each frame against the newest keyframe.
pub struct ByBearing {
    params: EstimatorParams,
    camera: CameraModel,
    surf: Surf,
    keyframe: Option<Keyframe>,
    last: CameraPose,
}

impl ByBearing {
    /// Nothing seen yet.
    pub fn new(params: &EstimatorParams, camera: &CameraModel) -> Self {
        let surf = Surf::new(params.surf);
        Self { params: params.clone(), camera: *camera, surf, keyframe: None, last: CameraPose::start() }
    }

    /// Gives the keyframe up: what comes next is seen from `pose`.
    pub fn restart(&mut self, pose: CameraPose) {
        (self.keyframe, self.last) = (None, pose);
    }

    /// Follows one frame that the wheels say was taken at `odom_from_camera`: how many features it has, and its pose.
    /// `None` while the way is too short to tell.
    pub fn track(
        &mut self,
        rgb: &RgbImage,
        odom_from_camera: &Isometry3<f64>,
        stage: &mut dyn FnMut(Stage),
    ) -> Option<(usize, Tracking)> {
        let Some(keyframe) = &self.keyframe else {
            stage(Stage::Features);
            let features = self.surf.detect(&rgb.to_luma());
            let found = features.len();
            self.remember(features, odom_from_camera);
            return Some((found, self.failed(MotionFailure::NoReference, Vec::new(), true)));
        };
        let start = odom_from_camera.inverse() * keyframe.odom_from_camera;
        if start.translation.vector.norm() < LEAST_WAY {
            return None;
        }
        stage(Stage::Features);
        let features = self.surf.detect(&rgb.to_luma());
        let found = features.len();
        stage(Stage::Matching);
        let matches = match_features(&features, &keyframe.features, &self.params.matching);
        let ray = |feature: &Feature| self.camera.ray(&Point2::new(f64::from(feature.x), f64::from(feature.y)));
        let sigma = self.params.depth_noise.pixel_sigma / self.camera.fx;
        let pairs: Vec<RayPair> = matches
            .iter()
            .map(|found| {
                let (to, from) = (&features[found.from], &keyframe.features[found.to]);
                // σ of a feature grows with its scale, and there are two of them.
                let sigma = sigma * f64::from(to.scale.hypot(from.scale)) * std::f64::consts::FRAC_1_SQRT_2;
                RayPair { reference: ray(from), camera: ray(to), sigma }
            })
            .collect();
        let mut tracks: Vec<FeatureTrack> = matches
            .iter()
            .map(|found| FeatureTrack::between(&keyframe.features[found.to], &features[found.from]))
            .collect();
        stage(Stage::Motion);
        let motion = match epipolar_motion(&pairs, &start, STRAY, MIN_INLIERS) {
            Ok(motion) => motion,
            Err(failure) => {
                // Too far gone to be recognised: the wheels alone have been right up to here.
                let is_far = start.translation.vector.norm() > MAX_WAY;
                if is_far {
                    self.remember(features, odom_from_camera);
                }
                return Some((found, self.failed(failure, tracks, is_far)));
            }
        };
        for (track, &inlier) in tracks.iter_mut().zip(&motion.inliers) {
            track.inlier = inlier;
        }
        let start_from_camera = keyframe.pose.start_from_camera * motion.camera_from_reference.inverse();
        let carry = adjoint(&start_from_camera);
        let covariance = keyframe.pose.covariance + carry * motion.covariance * carry.transpose() * SHARED;
        let mut flow: Vec<f32> = tracks.iter().filter(|track| track.inlier).map(FeatureTrack::length).collect();
        let middle = flow.len() / 2;
        let flow_is_long = *flow.select_nth_unstable_by(middle, f32::total_cmp).1 > MAX_FLOW;
        let is_keyframe = flow_is_long
            || start.translation.vector.norm() > MAX_WAY
            || (flow.len() as f64) < LEAST_OVERLAP * found as f64;
        self.last = CameraPose { start_from_camera, covariance };
        if is_keyframe {
            self.remember(features, odom_from_camera);
        }
        Some((found, Tracking { pose: self.last.clone(), failure: None, tracks, keyframe: is_keyframe }))
    }

    fn remember(&mut self, features: Vec<Feature>, odom_from_camera: &Isometry3<f64>) {
        self.keyframe = Some(Keyframe { features, pose: self.last.clone(), odom_from_camera: *odom_from_camera });
    }

    fn failed(&self, failure: MotionFailure, tracks: Vec<FeatureTrack>, keyframe: bool) -> Tracking {
        Tracking { pose: self.last.clone(), failure: Some(failure), tracks, keyframe }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;
    use crate::dark_room::{self, DarkRoom, Wall};
    use crate::image::Image;

    #[test]
    fn wheels_that_turn_too_little_are_corrected_and_the_length_is_theirs() {
        let wall = |x: f64, y: f64, z: f64, distance: f64| Wall {
            normal: Vector3::new(x, y, z).normalize(),
            distance,
            is_textured: true,
        };
        let walls = vec![wall(0.9, 0.0, 1.0, 2.5), wall(-0.9, 0.1, 1.0, 3.0), wall(0.0, 1.0, 0.0, 0.6)];
        let room = DarkRoom { walls, ambient: 0.0 };
        let mut odometry = ByBearing::new(&EstimatorParams::default(), &dark_room::rig().colour);
        let at = |way: f64, turn: f64| Isometry3::new(Vector3::new(0.5 * turn * way, 0.0, way), Vector3::y() * turn);
        let mut last = None;
        for step in 0..=20 {
            // Half a degree each step, of which the wheels miss a tenth; they roll 5 % too far.
            let (way, turn) = (0.03 * f64::from(step), 0.0087 * f64::from(step));
            let albedo = room.seen_from(&at(way, turn), u64::from(step as u32)).albedo;
            let grey = albedo.pixels().iter().map(|&share| [(255.0 * share) as u8; 3]).collect();
            let rgb = Image::from_pixels(albedo.width(), albedo.height(), grey).unwrap();
            let found = odometry.track(&rgb, &at(1.05 * way, 0.9 * turn), &mut |_| {});
            last = found.map(|(_, tracking)| (tracking, at(1.05 * way, turn))).or(last);
        }
        let (Tracking { pose, failure, .. }, expected) = last.unwrap();
        assert_eq!(failure, None);
        let turned: UnitQuaternion<f64> = pose.start_from_camera.rotation;
        assert!(turned.angle_to(&expected.rotation) < 0.004, "{}", turned.angle_to(&expected.rotation));
        let gone = pose.start_from_camera.translation.vector;
        assert!((gone - expected.translation.vector).norm() < 0.02, "{gone}");
        // Nothing is known of the length, the rest is.
        assert!(pose.covariance[(2, 2)] > 1.0 && pose.covariance[(4, 4)] < 1e-4);
    }

    #[test]
    fn standing_still_says_nothing() {
        let mut odometry = ByBearing::new(&EstimatorParams::default(), &dark_room::rig().colour);
        let rgb = Image::filled(640, 480, [90; 3]);
        assert!(odometry.track(&rgb, &Isometry3::identity(), &mut |_| {}).is_some(), "the keyframe");
        assert!(odometry.track(&rgb, &Isometry3::identity(), &mut |_| {}).is_none());
    }
}
