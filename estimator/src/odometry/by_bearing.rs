//! Odometry without depth: features of colour images say how the camera turned and which way it went; how far, the wheels
//! and, where enough of it is seen, the ground that passes below; or, where the infrared image was taken at the same instant
//! and the parameters say so, the stereo camera that the two make (paper A, §3.2).

use nalgebra::{Isometry3, Point2, Vector3};
use serde::{Deserialize, Serialize};

use crate::camera::{CameraModel, Rig};
use crate::estimator::Stage;
use crate::features::matching::match_features;
use crate::features::surf::{Feature, Surf};
use crate::fusion::TurnDoubt;
use crate::geometry::adjoint;
use crate::image::{GrayImage, InfraredImage, RgbImage};
use crate::motion::{
    DepthPair, EpipolarMotion, Expected, MotionFailure, RayPair, Rolled, Scale, epipolar_motion, inverse_depth_motion,
};
use crate::params::EstimatorParams;
use crate::structure::{InverseDepth, Stereo};

use super::way_length::WayLength;
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
/// σ of how far a robot strays from the way that its wheels say, as a share of it: no side slip (paper A, Eq. 1). A guess.
const STRAY: f64 = 0.01;
/// … but where it turns it skids, and where about nobody knows: m/√rad, as in [`WheelOdometryParams`].
const STRAY_TURNING: f64 = 0.05;
/// By how much the variance is larger than independent features would make it: mismatches bend the valley in which going
/// aside and turning look alike. Of simulated pairs, one in ten mismatched, the normalised error squared is 12 where five
/// degrees of freedom would make it 5.
const SHARED: f64 = 2.5;

/// The least σ of a turn by the wheels, radians: they may claim to be certain.
const LEAST_TURN: f64 = 1e-5;

/// Fewest pairs with a depth by stereo that say how far; with fewer the wheels do.
const MIN_MEASURED: usize = 30;
/// σ of the way's length before stereo says anything, metres.
const UNKNOWN: f64 = 3.0;

/// How far the camera went, out of doors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OutdoorMethod {
    /// By the ground that passes below where enough of it is seen, else by the wheels.
    #[default]
    Temporal,
    /// By the disparity between colour and infrared, as in paper A; by the wheels where there is none.
    Stereo,
}

/// Parameters of odometry without depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OutdoorParams {
    /// What says how far the camera went.
    pub method: OutdoorMethod,
}

/// σ of how far from where the wheels say a camera may be on either side, metres.
fn stray(camera_from_reference: &Isometry3<f64>) -> f64 {
    let (way, turn) = (camera_from_reference.translation.vector.norm(), camera_from_reference.rotation.angle());
    (STRAY * way).hypot(STRAY_TURNING * turn.sqrt())
}

/// Where the wheels have a camera.
#[derive(Clone, Copy, Debug)]
pub struct CameraByWheels {
    /// Camera frame → where the robot was when its wheels were first read.
    pub odom_from_camera: Isometry3<f64>,
    /// How far the heading may have strayed by now.
    pub turn_doubt: TurnDoubt,
}

struct Keyframe {
    luma: GrayImage,
    features: Vec<Feature>,
    /// By stereo, of each feature; empty without.
    inverse_depths: Vec<Option<InverseDepth>>,
    pose: CameraPose,
    by_wheels: CameraByWheels,
}

/// Holds each frame against the newest keyframe.
pub struct ByBearing {
    params: EstimatorParams,
    camera: CameraModel,
    surf: Surf,
    stereo: Option<Stereo>,
    /// From the camera straight down, in its frame.
    down: Vector3<f64>,
    /// Until the keyframe. Where stereo says how far the camera went the ground is not looked at.
    length: WayLength,
    keyframe: Option<Keyframe>,
    last: CameraPose,
    /// See [`EpipolarMotion::turn_share`].
    turn_share: f64,
}

impl ByBearing {
    /// Nothing seen yet.
    pub fn new(params: &EstimatorParams, rig: &Rig) -> Self {
        let surf = Surf::new(params.surf);
        let stereo = (params.outdoor.method == OutdoorMethod::Stereo).then(|| Stereo::new(rig)).flatten();
        let down = rig.robot_from_colour.rotation.inverse() * -Vector3::z();
        Self {
            params: params.clone(),
            camera: rig.colour,
            surf,
            down,
            length: WayLength::new(rig, down, stereo.is_none()),
            stereo,
            keyframe: None,
            last: CameraPose::start(),
            turn_share: 1.0,
        }
    }

    /// Whether the infrared image of the same instant is of use.
    pub fn wants_infrared(&self) -> bool {
        self.stereo.is_some()
    }

    /// What is left, in the newest motion since a keyframe, of the difference between the turn that was seen and the wheels'.
    pub fn turn_share(&self) -> f64 {
        self.turn_share
    }

    /// Metres gone for each metre that the wheels roll; one, for certain, while nothing is known of it.
    pub fn way_share(&self) -> Scale {
        self.length.share()
    }

    /// Gives the keyframe up: what comes next is seen from `pose`.
    pub fn restart(&mut self, pose: CameraPose) {
        (self.keyframe, self.last) = (None, pose);
        self.length.restart();
    }

    /// Follows one frame that the wheels say was taken at `by_wheels`: how many features it has, and its pose. `None` while
    /// the way is too short to tell. `infrared` is of the same instant.
    pub fn track(
        &mut self,
        rgb: &RgbImage,
        infrared: Option<&InfraredImage>,
        by_wheels: &CameraByWheels,
        stage: &mut dyn FnMut(Stage),
    ) -> Option<(usize, Tracking)> {
        let odom_from_camera = &by_wheels.odom_from_camera;
        let start =
            self.keyframe.as_ref().map(|keyframe| odom_from_camera.inverse() * keyframe.by_wheels.odom_from_camera);
        if start.is_some_and(|start| start.translation.vector.norm() < LEAST_WAY) {
            return None;
        }
        stage(Stage::Features);
        let luma = rgb.to_luma();
        let features = self.surf.detect(&luma);
        let found = features.len();
        let (Some(keyframe), Some(start)) = (&self.keyframe, start) else {
            self.remember(features, luma, infrared, by_wheels);
            return Some((found, self.failed(MotionFailure::NoReference, Vec::new(), true)));
        };
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
        let inverse_depths: Vec<Option<InverseDepth>> =
            matches.iter().map(|found| *keyframe.inverse_depths.get(found.to)?).collect();
        let turn = by_wheels.turn_doubt.sigma_since(&keyframe.by_wheels.turn_doubt);
        let motion = match self.motion(&pairs, &inverse_depths, &start, turn) {
            Ok(motion) => motion,
            Err(failure) => {
                // Too far gone to be recognised: the wheels alone have been right up to here.
                let is_far = start.translation.vector.norm() > MAX_WAY;
                if is_far {
                    self.remember(features, luma, infrared, by_wheels);
                }
                return Some((found, self.failed(failure, tracks, is_far)));
            }
        };
        for (track, &inlier) in tracks.iter_mut().zip(&motion.inliers) {
            track.inlier = inlier;
        }
        let mut flow: Vec<f32> = tracks.iter().filter(|track| track.inlier).map(FeatureTrack::length).collect();
        let middle = flow.len() / 2;
        let flow_is_long = *flow.select_nth_unstable_by(middle, f32::total_cmp).1 > MAX_FLOW;
        let is_keyframe = flow_is_long
            || start.translation.vector.norm() > MAX_WAY
            || (flow.len() as f64) < LEAST_OVERLAP * found as f64;
        if is_keyframe {
            self.length.look([&keyframe.luma, &luma], &motion, &start, stray(&start));
        }
        let motion = self.length.less_slip(motion, &start, stray(&start));
        let start_from_camera = keyframe.pose.start_from_camera * motion.camera_from_reference.inverse();
        let carry = adjoint(&start_from_camera);
        let covariance = keyframe.pose.covariance + carry * motion.covariance * carry.transpose();
        self.last = CameraPose { start_from_camera, covariance };
        self.turn_share = motion.turn_share;
        if is_keyframe {
            self.remember(features, luma, infrared, by_wheels);
        }
        Some((found, Tracking { pose: self.last.clone(), failure: None, tracks, keyframe: is_keyframe }))
    }

    /// Near where the wheels say, `start`, their turn off by a σ of `turn`; with its length, unless stereo knows better.
    fn motion(
        &self,
        pairs: &[RayPair],
        inverse_depths: &[Option<InverseDepth>],
        start: &Isometry3<f64>,
        turn: f64,
    ) -> Result<EpipolarMotion, MotionFailure> {
        let measured = inverse_depths.iter().flatten().count();
        let Some(stereo) = self.stereo.as_ref().filter(|_| measured >= MIN_MEASURED) else {
            return Ok(epipolar_motion(pairs, &self.by_wheels(start, turn), MIN_INLIERS)?.shared_by(SHARED));
        };
        let with_depth = pairs.iter().zip(inverse_depths).map(|(&rays, inverse_depth)| {
            let inverse_depth = inverse_depth.map_or(DepthPair::UNMEASURED, |found| (found.value, found.sigma));
            DepthPair { rays, inverse_depth }
        });
        let expected = Expected { camera_from_reference: *start, stray: stray(start), along: UNKNOWN };
        let shared_sigma = stereo.shared_sigma();
        let motion = inverse_depth_motion(&with_depth.collect::<Vec<_>>(), &expected, shared_sigma, MIN_INLIERS)?;
        Ok(motion.shared_by(SHARED))
    }

    fn by_wheels(&self, start: &Isometry3<f64>, turn: f64) -> Rolled {
        Rolled { camera_from_reference: *start, stray: stray(start), down: self.down, turn: turn.max(LEAST_TURN) }
    }

    fn remember(
        &mut self,
        features: Vec<Feature>,
        luma: GrayImage,
        infrared: Option<&InfraredImage>,
        by_wheels: &CameraByWheels,
    ) {
        let places: Vec<(f32, f32)> = features.iter().map(|feature| (feature.x, feature.y)).collect();
        let inverse_depths = match (&mut self.stereo, infrared) {
            (Some(stereo), Some(infrared)) => stereo.inverse_depths(&places, &luma, infrared),
            _ => Vec::new(),
        };
        let (pose, by_wheels) = (self.last.clone(), *by_wheels);
        self.keyframe = Some(Keyframe { luma, features, inverse_depths, pose, by_wheels });
    }

    fn failed(&self, failure: MotionFailure, tracks: Vec<FeatureTrack>, keyframe: bool) -> Tracking {
        Tracking { pose: self.last.clone(), failure: Some(failure), tracks, keyframe }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::dark_room::{self, DarkRoom, Wall};
    use crate::image::Image;

    /// Walls on either side, and the ground.
    fn lane() -> DarkRoom {
        let wall = |x: f64, y: f64, z: f64, distance: f64| Wall {
            normal: Vector3::new(x, y, z).normalize(),
            distance,
            is_textured: true,
        };
        let walls = vec![wall(0.9, 0.0, 1.0, 2.5), wall(-0.9, 0.1, 1.0, 3.0), wall(0.0, 1.0, 0.0, 0.6)];
        DarkRoom { walls, ambient: 0.0 }
    }

    /// By wheels whose turns are worth nothing.
    fn rolled(odom_from_camera: Isometry3<f64>) -> CameraByWheels {
        let turn_doubt = TurnDoubt { variance: odom_from_camera.translation.vector.norm(), drift: 0.0 };
        CameraByWheels { odom_from_camera, turn_doubt }
    }

    /// A colour image of an albedo.
    fn grey(albedo: &Image<f32>) -> RgbImage {
        let pixels = albedo.pixels().iter().map(|&share| [(255.0 * share) as u8; 3]).collect();
        Image::from_pixels(albedo.width(), albedo.height(), pixels).unwrap()
    }

    #[test]
    fn wheels_that_turn_too_little_are_corrected_and_the_length_is_theirs() {
        let room = lane();
        let mut odometry = ByBearing::new(&EstimatorParams::default(), &dark_room::rig());
        let at = |way: f64, turn: f64| Isometry3::new(Vector3::new(0.5 * turn * way, 0.0, way), Vector3::y() * turn);
        let mut last = None;
        for step in 0..=20 {
            // Half a degree each step, of which the wheels miss a tenth; they roll 5 % too far.
            let (way, turn) = (0.03 * f64::from(step), 0.0087 * f64::from(step));
            let albedo = room.seen_from(&at(way, turn), u64::from(step as u32)).albedo;
            let found = odometry.track(&grey(&albedo), None, &rolled(at(1.05 * way, 0.9 * turn)), &mut |_| {});
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
    fn how_far_wheels_slip_the_ground_tells() {
        let wall =
            |x: f64, y: f64, z: f64, distance: f64| Wall { normal: Vector3::new(x, y, z), distance, is_textured: true };
        let walls = vec![wall(0.0, 1.0, 0.0, 0.6), wall(0.0, 0.0, 1.0, 7.0), wall(1.0, 0.0, 0.0, 1.5)];
        let room = DarkRoom { walls, ambient: 0.0 };
        let mut rig = dark_room::rig();
        let turned = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(0.5, -0.5, 0.5, -0.5));
        rig.robot_from_colour = Isometry3::from_parts(Vector3::new(0.0, 0.0, 0.6).into(), turned);
        let mut odometry = ByBearing::new(&EstimatorParams::default(), &rig);
        let at = |way: f64| Isometry3::translation(0.0, 0.0, way);
        for step in 0..=32 {
            let way = 0.1 * f64::from(step);
            let rgb = grey(&room.albedo(&rig.colour, &at(way)));
            // The wheels spin: one metre in sixteen is none.
            let _ = odometry.track(&rgb, None, &rolled(at(way / 0.94)), &mut |_| {});
        }
        let Scale { value, sigma } = odometry.way_share();
        // Half way from what hard floors do to what six looks of half a metre say, and sure of neither.
        assert!((value - 0.94).abs() < 0.03 && (0.01..0.04).contains(&sigma), "{value} {sigma}");
        let gone = odometry.last.start_from_camera.translation.z;
        assert!((gone - 3.2).abs() < 0.15, "{gone}");
    }

    #[test]
    fn stereo_says_how_far_whatever_the_wheels_say() {
        let room = lane();
        let mut rig = dark_room::rig();
        rig.colour_from_depth.translation.x = -0.025;
        rig.alignment_sigma = 0.17;
        let outdoor = OutdoorParams { method: OutdoorMethod::Stereo };
        let mut odometry = ByBearing::new(&EstimatorParams { outdoor, ..EstimatorParams::default() }, &rig);
        assert!(odometry.wants_infrared());
        let mut last = None;
        for step in 0..=20 {
            let (way, turn) = (0.03 * f64::from(step), 0.0087 * f64::from(step));
            let at = |way: f64| Isometry3::new(Vector3::new(0.5 * turn * way, 0.0, way), Vector3::y() * turn);
            let rgb = grey(&room.albedo(&rig.colour, &at(way)));
            let infrared = room.albedo(&rig.depth.model, &(at(way) * rig.colour_from_depth));
            let reversed = infrared.pixels().iter().map(|&share| (700.0 - 500.0 * share) as u16).collect();
            let infrared = Image::from_pixels(640, 480, reversed).unwrap();
            // The wheels spin: they claim a sixth more than there was.
            let found = odometry.track(&rgb, Some(&infrared), &rolled(at(1.17 * way)), &mut |_| {});
            last = found.map(|(_, tracking)| (tracking, at(way))).or(last);
        }
        let (Tracking { pose, failure, .. }, expected) = last.unwrap();
        assert_eq!(failure, None);
        let gone = pose.start_from_camera.translation.vector;
        let sigma = pose.covariance[(2, 2)].sqrt();
        assert!((gone - expected.translation.vector).norm() < 0.02, "{gone}");
        assert!((0.005..0.1).contains(&sigma), "{sigma}");
    }

    #[test]
    fn standing_still_says_nothing() {
        let mut odometry = ByBearing::new(&EstimatorParams::default(), &dark_room::rig());
        let rgb = Image::filled(640, 480, [90; 3]);
        assert!(odometry.track(&rgb, None, &rolled(Isometry3::identity()), &mut |_| {}).is_some(), "the keyframe");
        assert!(odometry.track(&rgb, None, &rolled(Isometry3::identity()), &mut |_| {}).is_none());
    }
}
