//! Visual odometry from whichever images the mode rests on.

use std::collections::VecDeque;
use std::sync::Arc;

use nalgebra::{Isometry3, Matrix6};

use crate::camera::Rig;
use crate::estimator::{Stage, StageObserver};
use crate::fusion::{PlanarPose, TurnDoubt, VisualOnPlane, VisualPose};
use crate::geometry::adjoint;
use crate::image::{DepthImage, Image, InfraredImage, RgbImage};
use crate::measurement::{Estimate, Health, Mode, Rejection};
use crate::motion::{MotionFailure, Scale};
use crate::odometry::{
    ByBearing, CameraByWheels, CameraPose, Frame, FrameBuilder, FrameReport, FrameToFrame, Keyframes,
    NightFrameBuilder, Tracking,
};
use crate::params::{EstimatorParams, Variant};
use crate::time::Timestamp;

/// Images further apart than this are not of one frame: half a period at 30 Hz, rounded up. Seconds.
const MAX_PAIR_GAP: f64 = 0.02;
/// Images further apart than this are no stereo pair, seconds: at 1 m/s a millimetre, of a baseline of 25.
const MAX_STEREO_GAP: f64 = 0.001;
/// So long an infrared stream may be silent before colour no longer waits for it, seconds: three frames.
const INFRARED_SILENT: f64 = 0.1;

/// So long is remembered what the wheels said, seconds: longer than an image takes.
const WHEELS_KEPT: f64 = 1.0;
/// An image may be so much newer than the wheels, seconds.
const MAX_EXTRAPOLATION: f64 = 0.15;

enum Odometry {
    Keyframes(Box<Keyframes>),
    FrameToFrame(Box<FrameToFrame>),
}

impl Odometry {
    fn new(params: &EstimatorParams, rig: &Rig) -> Self {
        match params.variant {
            Variant::Keyframes => Self::Keyframes(Box::new(Keyframes::new(params, rig))),
            Variant::Paper => Self::FrameToFrame(Box::new(FrameToFrame::new(params))),
        }
    }

    fn track(&mut self, frame: Frame, stage: &mut dyn FnMut(Stage)) -> Tracking {
        match self {
            Self::Keyframes(odometry) => odometry.track(frame, stage),
            Self::FrameToFrame(odometry) => odometry.track(frame, stage),
        }
    }

    fn expect(&mut self, last_from_camera: Isometry3<f64>) {
        if let Self::Keyframes(odometry) = self {
            odometry.expect(last_from_camera);
        }
    }

    fn restart(&mut self, pose: CameraPose) {
        match self {
            Self::Keyframes(odometry) => odometry.restart(pose),
            Self::FrameToFrame(odometry) => odometry.restart(pose),
        }
    }
}

/// The newest image of a stream.
struct Newest<P> {
    size: (usize, usize),
    image: Option<(Timestamp, Arc<Image<P>>)>,
}

impl<P> Newest<P> {
    fn of_size(size: (usize, usize)) -> Self {
        Self { size, image: None }
    }

    /// Takes the next one.
    fn take(&mut self, time: Timestamp, image: Arc<Image<P>>) -> Result<(), Rejection> {
        if image.size() != self.size {
            return Err(Rejection::WrongSize { expected: self.size, found: image.size() });
        }
        if self.time() >= Some(time) {
            return Err(Rejection::OutOfOrder);
        }
        self.image = Some((time, image));
        Ok(())
    }

    fn time(&self) -> Option<Timestamp> {
        self.image.as_ref().map(|(time, _)| *time)
    }

    /// The image, if it was captured together with another one.
    fn at(&self, time: Timestamp) -> Option<(Timestamp, Arc<Image<P>>)> {
        self.image.clone().filter(|(own, _)| own.since(time).abs() <= MAX_PAIR_GAP)
    }
}

/// The newest images, and the pose by them.
pub(crate) struct Vision {
    rig: Rig,
    by_day: FrameBuilder,
    /// Where depth lies in the infrared image's pixels.
    by_night: Option<NightFrameBuilder>,
    by_bearing: ByBearing,
    odometry: Odometry,
    /// The camera's newest pose, of whichever odometry.
    pose: CameraPose,
    /// Of a robot on wheels.
    on_plane: Option<VisualOnPlane>,
    /// What the wheels have said lately.
    wheels: VecDeque<(Timestamp, PlanarPose, TurnDoubt)>,
    /// Where the wheels had the camera when that pose was found.
    found_at: Option<Isometry3<f64>>,
    /// What the odometry's keyframes are of.
    mode: Mode,
    rgb: Newest<[u8; 3]>,
    infrared: Newest<u16>,
    depth: Newest<u16>,
    estimate: Estimate,
    /// The newest instant that was worked on.
    last: Option<Timestamp>,
    report: Option<FrameReport>,
    observer: StageObserver,
}

impl Vision {
    /// Nothing seen yet.
    pub fn new(params: &EstimatorParams, rig: &Rig, mode: Mode) -> Self {
        Self {
            by_day: FrameBuilder::new(params, rig),
            by_night: NightFrameBuilder::new(params, rig),
            by_bearing: ByBearing::new(params, rig),
            odometry: Odometry::new(params, rig),
            pose: CameraPose::start(),
            on_plane: rig.drive.map(|_| VisualOnPlane::default()),
            wheels: VecDeque::new(),
            found_at: None,
            mode,
            rgb: Newest::of_size(rig.colour.size()),
            infrared: Newest::of_size(rig.depth.model.size()),
            depth: Newest::of_size(rig.depth.model.size()),
            estimate: Estimate {
                time: None,
                odom_from_robot: Isometry3::identity(),
                covariance: Matrix6::zeros(),
                mode,
                health: Health::Initialising,
            },
            last: None,
            report: None,
            observer: Box::new(|_| {}),
            rig: rig.clone(),
        }
    }

    /// Has `observer` called at the beginning of each stage.
    pub fn observe_stages(&mut self, observer: StageObserver) {
        self.observer = observer;
    }

    /// Visual odometry's own pose.
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// What was made of the newest frame.
    pub fn report(&self) -> Option<&FrameReport> {
        self.report.as_ref()
    }

    /// Takes a colour image.
    pub fn take_rgb(&mut self, time: Timestamp, image: Arc<RgbImage>) -> Result<(), Rejection> {
        self.rgb.take(time, image)
    }

    /// Takes an infrared image.
    pub fn take_infrared(&mut self, time: Timestamp, image: Arc<InfraredImage>) -> Result<(), Rejection> {
        self.infrared.take(time, image)
    }

    /// Whether infrared is of use out of doors.
    pub fn wants_infrared(&self) -> bool {
        self.by_bearing.wants_infrared()
    }

    /// Takes a depth image.
    pub fn take_depth(&mut self, time: Timestamp, image: Arc<DepthImage>) -> Result<(), Rejection> {
        self.depth.take(time, image)
    }

    /// Takes where the wheels alone say that the robot is, and how far its heading may have strayed by then.
    pub fn take_wheels(&mut self, time: Timestamp, odom_from_robot: PlanarPose, turn_doubt: TurnDoubt) {
        self.wheels.push_back((time, odom_from_robot, turn_doubt));
        while self.wheels.front().is_some_and(|(old, ..)| time.since(*old) > WHEELS_KEPT) {
            self.wheels.pop_front();
        }
    }

    /// Where the wheels say that the colour camera was at an instant, going on as before for a little while.
    fn camera_by_wheels(&self, time: Timestamp) -> Option<CameraByWheels> {
        let after = self.wheels.partition_point(|(read, ..)| *read < time).clamp(1, self.wheels.len().max(2) - 1);
        let ((from, start, doubt), (to, end, later)) = (self.wheels.get(after - 1)?, self.wheels.get(after)?);
        let share = time.since(*from) / to.since(*from);
        let step = (start.inverse() * *end).to_vector() * share;
        let is_near = time.since(*to) < MAX_EXTRAPOLATION && share > -1.0;
        let odom_from_robot = *start * PlanarPose::new(step.x, step.y, step.z);
        is_near.then(|| CameraByWheels {
            odom_from_camera: odom_from_robot.to_isometry() * self.rig.robot_from_colour,
            turn_doubt: doubt.towards(later, share),
        })
    }

    /// Works on the newest instant once the images that `mode` rests on are all there: the pose, which is `tracked` if
    /// a motion was found, and why not if not. Of a mode that rests on no image it only counts depth.
    pub fn look(&mut self, mode: Mode) -> Option<(VisualPose, Option<MotionFailure>)> {
        if self.mode != mode {
            self.mode = mode;
            self.odometry.restart(self.pose.clone());
            self.by_bearing.restart(self.pose.clone());
        }
        if mode == Mode::Outdoor && !self.wheels.is_empty() {
            return self.look_at_bearings();
        }
        let depth = self.depth.time()?;
        match mode {
            Mode::Indoor => {
                let ((time, rgb), (_, depth)) = (self.rgb.at(depth)?, self.depth.at(depth)?);
                self.is_new(time).then_some(())?;
                let frame = self.by_day.build(&rgb, &depth, &mut self.observer);
                Some(self.follow(time, frame))
            }
            Mode::Night if self.by_night.is_some() => {
                let ((time, infrared), (_, depth)) = (self.infrared.at(depth)?, self.depth.at(depth)?);
                self.is_new(time).then_some(())?;
                let frame = self.by_night.as_mut()?.build(&infrared, &depth, &mut self.observer);
                let followed = self.follow(time, frame);
                // Images of one and the same view would teach the view instead of the dots.
                if let Some(by_night) = self.by_night.as_mut().filter(|_| followed.0.keyframe) {
                    by_night.learn();
                }
                Some(followed)
            }
            _ => {
                let time = depth;
                if self.is_new(time) {
                    self.estimate.health = Health::Lost(MotionFailure::NotSought);
                    self.put_down(time, 0, Tracking::none());
                }
                None
            }
        }
    }

    fn is_new(&self, time: Timestamp) -> bool {
        self.last < Some(time)
    }

    /// The direction from colour, the length from the wheels or from infrared beside it.
    fn look_at_bearings(&mut self) -> Option<(VisualPose, Option<MotionFailure>)> {
        let (time, rgb) = self.rgb.image.clone().filter(|(time, _)| self.is_new(*time))?;
        let mut infrared = None;
        if self.by_bearing.wants_infrared()
            && let Some((taken, image)) = &self.infrared.image
        {
            let behind = time.since(*taken);
            if behind > MAX_STEREO_GAP && behind < INFRARED_SILENT {
                return None;
            }
            infrared = (behind.abs() <= MAX_STEREO_GAP).then(|| Arc::clone(image));
        }
        let by_wheels = self.camera_by_wheels(time)?;
        let tracked = self.by_bearing.track(&rgb, infrared.as_deref(), &by_wheels, &mut self.observer);
        (self.observer)(Stage::Done);
        let Some((features, tracking)) = tracked else {
            self.put_down(time, 0, Tracking::none());
            return None;
        };
        let (visual, failure) = self.found(time, features, tracking);
        let turn_share = self.by_bearing.turn_share();
        let Scale { value: way_share, sigma: shared_sigma } = self.by_bearing.way_share();
        Some((VisualPose { turn_share, way_share, shared_sigma, ..visual }, failure))
    }

    fn follow(&mut self, time: Timestamp, frame: Frame) -> (VisualPose, Option<MotionFailure>) {
        let features = frame.features.len();
        let at = self.camera_by_wheels(time).map(|by_wheels| by_wheels.odom_from_camera);
        if let (Some(found_at), Some(at)) = (self.found_at, at) {
            self.odometry.expect(found_at.inverse() * at);
        }
        let tracking = self.odometry.track(frame, &mut self.observer);
        (self.observer)(Stage::Done);
        if tracking.failure.is_none() || tracking.keyframe {
            self.found_at = at;
        }
        self.found(time, features, tracking)
    }

    fn found(&mut self, time: Timestamp, features: usize, tracking: Tracking) -> (VisualPose, Option<MotionFailure>) {
        self.pose = tracking.pose.clone();
        let robot_from_camera = self.rig.robot_from_colour;
        let carry = adjoint(&robot_from_camera);
        let (pose, failure, keyframe) = (&tracking.pose, tracking.failure, tracking.keyframe);
        let start_from_robot = robot_from_camera * pose.start_from_camera * robot_from_camera.inverse();
        let covariance = carry * pose.covariance * carry.transpose();
        let tracked = failure.is_none();
        let visual = VisualPose { tracked, keyframe, ..VisualPose::keyframe(time, start_from_robot, covariance) };
        let on_plane = self.on_plane.as_mut().map(|on_plane| on_plane.take(&visual));
        let (odom_from_robot, covariance) = on_plane.map_or((visual.start_from_robot, visual.covariance), |on_plane| {
            (on_plane.pose.to_isometry(), on_plane.covariance_in_space())
        });
        let health = failure.map_or(Health::Good, Health::Lost);
        self.estimate = Estimate { time: Some(time), odom_from_robot, covariance, mode: self.mode, health };
        self.put_down(time, features, tracking);
        (visual, failure)
    }

    fn put_down(&mut self, time: Timestamp, features: usize, tracking: Tracking) {
        let Tracking { tracks, keyframe, .. } = tracking;
        let depth = self.depth.image.as_ref().map_or(&[][..], |(_, depth)| depth.pixels());
        let valid = depth.iter().filter(|&&value| self.rig.depth.depth_of(value).is_some()).count();
        self.last = Some(time);
        self.report = Some(FrameReport {
            time,
            mode: self.mode,
            features,
            matches: tracks.len(),
            inliers: tracks.iter().filter(|track| track.inlier).count(),
            keyframe,
            depth_valid_share: valid as f64 / depth.len().max(1) as f64,
            tracks,
        });
    }
}
