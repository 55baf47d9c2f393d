//! The estimator of the product: wires the rooms as the paper's figure does.

use std::sync::Arc;

use nalgebra::{Isometry3, Matrix6};

use crate::camera::Rig;
use crate::geometry::adjoint;
use crate::image::{DepthImage, RgbImage};
use crate::measurement::{
    Disposition, Estimate, Health, Localizer, Measurement, MeasurementData, Mode, Rejection, Streams,
};
use crate::odometry::{FrameBuilder, FrameReport, FrameToFrame, Keyframes, Tracking};
use crate::params::{EstimatorParams, ParamError, Variant};
use crate::time::Timestamp;

/// A part of the work on one frame, named to whoever holds a clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Depth carried into the colour image.
    Registration,
    /// SURF.
    Features,
    /// Descriptors compared.
    Matching,
    /// Motion estimated.
    Motion,
    /// The frame is finished.
    Done,
}

/// Called when a stage begins; the estimator itself has no clock.
pub type StageObserver = Box<dyn FnMut(Stage) + Send>;

/// Colour and depth further apart than this are not of one frame: half a period at 30 Hz, rounded up. Seconds.
const MAX_PAIR_GAP: f64 = 0.02;

enum Odometry {
    Keyframes(Box<Keyframes>),
    FrameToFrame(Box<FrameToFrame>),
}

/// Multispectral visual odometry (paper A).
pub struct Estimator {
    rig: Rig,
    frames: FrameBuilder,
    odometry: Odometry,
    rgb: Option<(Timestamp, Arc<RgbImage>)>,
    depth: Option<(Timestamp, Arc<DepthImage>)>,
    estimate: Estimate,
    last_frame: Option<FrameReport>,
    observer: StageObserver,
}

impl Estimator {
    /// Checks the parameters and the rig once.
    ///
    /// # Errors
    /// The first parameter or calibration number that can't be worked with.
    pub fn new(params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        rig.validate()?;
        params.validate()?;
        Ok(Self {
            frames: FrameBuilder::new(&params, &rig),
            odometry: match params.variant {
                Variant::Keyframes => Odometry::Keyframes(Box::new(Keyframes::new(&params))),
                Variant::Paper => Odometry::FrameToFrame(Box::new(FrameToFrame::new(&params))),
            },
            rig,
            rgb: None,
            depth: None,
            estimate: Estimate {
                time: None,
                odom_from_robot: Isometry3::identity(),
                covariance: Matrix6::zeros(),
                mode: Mode::Indoor,
                health: Health::Initialising,
            },
            last_frame: None,
            observer: Box::new(|_| {}),
        })
    }

    /// Has `observer` called at the beginning of each stage of each frame, for timing by the caller's clock.
    pub fn observe_stages(&mut self, observer: StageObserver) {
        self.observer = observer;
    }

    /// What was made of the newest frame; `None` before the first.
    pub fn last_frame(&self) -> Option<&FrameReport> {
        self.last_frame.as_ref()
    }

    /// Takes one image of a stream whose last one was captured at `last`.
    fn check(
        &self,
        captured_at: Timestamp,
        last: Option<Timestamp>,
        size: (usize, usize),
        expected: (usize, usize),
    ) -> Option<Rejection> {
        if size != expected {
            return Some(Rejection::WrongSize { expected, found: size });
        }
        last.is_some_and(|last| captured_at <= last).then_some(Rejection::OutOfOrder)
    }

    /// Localises once colour and depth of one instant are both there.
    fn localise(&mut self) -> Disposition {
        let (Some((rgb_time, rgb)), Some((depth_time, depth))) = (&self.rgb, &self.depth) else {
            return Disposition::Used;
        };
        if rgb_time.since(*depth_time).abs() > MAX_PAIR_GAP || self.estimate.time >= Some(*rgb_time) {
            return Disposition::Used;
        }
        let time = *rgb_time;
        let frame = self.frames.build(rgb, depth, &mut self.observer);
        let features = frame.features.len();
        let valid = depth.pixels().iter().filter(|&&value| self.rig.depth.depth_of(value).is_some()).count();
        let depth_valid_share = valid as f64 / depth.pixels().len() as f64;
        let Tracking { pose, failure, tracks, keyframe } = match &mut self.odometry {
            Odometry::Keyframes(odometry) => odometry.track(frame, &mut self.observer),
            Odometry::FrameToFrame(odometry) => odometry.track(frame, &mut self.observer),
        };
        (self.observer)(Stage::Done);
        self.last_frame = Some(FrameReport {
            time,
            features,
            matches: tracks.len(),
            inliers: tracks.iter().filter(|track| track.inlier).count(),
            keyframe,
            depth_valid_share,
            tracks,
        });
        let robot_from_camera = self.rig.robot_from_colour;
        let carry = adjoint(&robot_from_camera);
        self.estimate = Estimate {
            time: Some(time),
            odom_from_robot: robot_from_camera * pose.start_from_camera * robot_from_camera.inverse(),
            covariance: carry * pose.covariance * carry.transpose(),
            mode: Mode::Indoor,
            health: failure.map_or(Health::Good, Health::Lost),
        };
        failure.map_or(Disposition::Used, |failure| Disposition::Rejected(Rejection::NoMotion(failure)))
    }
}

impl Localizer for Estimator {
    fn handle(&mut self, measurement: Measurement) -> Disposition {
        let time = measurement.captured_at;
        match measurement.data {
            MeasurementData::Rgb(image) => {
                let last = self.rgb.as_ref().map(|(time, _)| *time);
                if let Some(rejection) = self.check(time, last, image.size(), self.rig.colour.size()) {
                    return Disposition::Rejected(rejection);
                }
                self.rgb = Some((time, image));
                self.localise()
            }
            MeasurementData::Depth(image) => {
                let last = self.depth.as_ref().map(|(time, _)| *time);
                if let Some(rejection) = self.check(time, last, image.size(), self.rig.depth.model.size()) {
                    return Disposition::Rejected(rejection);
                }
                self.depth = Some((time, image));
                self.localise()
            }
            _ => Disposition::Rejected(Rejection::Unsupported),
        }
    }

    fn estimate(&self) -> Estimate {
        self.estimate.clone()
    }

    fn wanted_streams(&self) -> Streams {
        Streams { rgb: true, infrared: false, depth: true }
    }
}
