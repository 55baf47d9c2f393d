//! The estimator of the product: wires the rooms as the paper's figure does.

use std::sync::Arc;

use nalgebra::{Isometry3, Matrix6};
use serde::{Deserialize, Serialize};

use crate::camera::Rig;
use crate::fusion::{Fusion, UncertainPose, VisualPose};
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

/// Whose pose an estimate is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PoseSource {
    /// Wheels, and a gyro where there is one.
    Odometry,
    /// Visual odometry.
    Mvo,
    /// Both in the extended Kalman filter.
    Ekf,
    /// Both in the smooth variable structure filter.
    #[default]
    Svsf,
}

impl PoseSource {
    /// As in parameters and files: `svsf`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Odometry => "odometry",
            Self::Mvo => "mvo",
            Self::Ekf => "ekf",
            Self::Svsf => "svsf",
        }
    }
}

/// Colour and depth further apart than this are not of one frame: half a period at 30 Hz, rounded up. Seconds.
const MAX_PAIR_GAP: f64 = 0.02;

enum Odometry {
    Keyframes(Box<Keyframes>),
    FrameToFrame(Box<FrameToFrame>),
}

/// Multispectral visual odometry, fused with the wheels where the rig has some (paper A).
pub struct Estimator {
    rig: Rig,
    frames: FrameBuilder,
    odometry: Odometry,
    rgb: Option<(Timestamp, Arc<RgbImage>)>,
    depth: Option<(Timestamp, Arc<DepthImage>)>,
    /// Visual odometry's own.
    visual: Estimate,
    /// With wheels only.
    fusion: Option<Fusion>,
    pose_from: PoseSource,
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
            fusion: rig.drive.map(|drive| Fusion::new(params.fusion, drive)),
            pose_from: params.pose_from,
            rig,
            rgb: None,
            depth: None,
            visual: Estimate {
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
        if rgb_time.since(*depth_time).abs() > MAX_PAIR_GAP || self.visual.time >= Some(*rgb_time) {
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
        self.visual = Estimate {
            time: Some(time),
            odom_from_robot: robot_from_camera * pose.start_from_camera * robot_from_camera.inverse(),
            covariance: carry * pose.covariance * carry.transpose(),
            mode: Mode::Indoor,
            health: failure.map_or(Health::Good, Health::Lost),
        };
        if let Some(fusion) = &mut self.fusion {
            let Estimate { odom_from_robot, covariance, .. } = self.visual;
            let tracked = failure.is_none();
            // One that comes too late for the filters is still visual odometry's.
            let _ = fusion.handle_visual(VisualPose {
                time,
                start_from_robot: odom_from_robot,
                covariance,
                tracked,
                keyframe,
            });
        }
        failure.map_or(Disposition::Used, |failure| Disposition::Rejected(Rejection::NoMotion(failure)))
    }

    /// The four poses, those of a robot without wheels being one. Each starts at the identity: visual odometry's where
    /// the first image was taken, the others' at the first reading of either kind.
    pub fn estimates(&self) -> Vec<(PoseSource, Estimate)> {
        let sources = match self.fusion {
            Some(_) => &[PoseSource::Odometry, PoseSource::Mvo, PoseSource::Ekf, PoseSource::Svsf][..],
            None => &[PoseSource::Mvo],
        };
        sources.iter().map(|&source| (source, self.estimate_from(source))).collect()
    }

    fn estimate_from(&self, source: PoseSource) -> Estimate {
        match (&self.fusion, source) {
            (None, _) | (_, PoseSource::Mvo) => self.visual.clone(),
            (Some(fusion), PoseSource::Odometry) => {
                self.on_plane(fusion.wheels_read_at(), fusion.odometry(), Mode::Odometer)
            }
            (Some(fusion), PoseSource::Ekf) => self.on_plane(fusion.time(), fusion.ekf(), self.fused_mode()),
            (Some(fusion), PoseSource::Svsf) => self.on_plane(fusion.time(), fusion.svsf(), self.fused_mode()),
        }
    }

    /// "When visual information is not available, the WO localization system will be used" (paper A, §1).
    fn fused_mode(&self) -> Mode {
        if self.visual.health == Health::Good { self.visual.mode } else { Mode::Odometer }
    }

    fn on_plane(&self, time: Option<Timestamp>, pose: UncertainPose, mode: Mode) -> Estimate {
        let wheels_speak = self.fusion.as_ref().is_some_and(Fusion::wheels_speak);
        Estimate {
            time,
            odom_from_robot: pose.pose.to_isometry(),
            covariance: pose.covariance_in_space(),
            mode,
            health: if wheels_speak { Health::Good } else { self.visual.health },
        }
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
            MeasurementData::WheelTicks { left, right } => {
                disposition(self.fusion.as_mut().map(|fusion| fusion.handle_ticks(time, left, right)))
            }
            MeasurementData::Gyro(rate) => {
                disposition(self.fusion.as_mut().map(|fusion| fusion.handle_gyro(time, rate.z)))
            }
            _ => Disposition::Rejected(Rejection::Unsupported),
        }
    }

    fn estimate(&self) -> Estimate {
        self.estimate_from(self.pose_from)
    }

    fn wanted_streams(&self) -> Streams {
        Streams { rgb: true, infrared: false, depth: true }
    }
}

/// What became of a reading for which there may be no use.
fn disposition(taken: Option<Result<(), Rejection>>) -> Disposition {
    match taken {
        Some(Ok(())) => Disposition::Used,
        Some(Err(rejection)) => Disposition::Rejected(rejection),
        None => Disposition::Rejected(Rejection::Unsupported),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::Drive;
    use crate::image::Image;
    use nalgebra::Vector3;

    fn estimator(drive: Option<Drive>, pose_from: PoseSource) -> Estimator {
        let mut rig = Rig { drive, ..Rig::kinect_default() };
        // As a Kinect looks from a robot: x forward, y left, z up of what the camera has as z, −x, −y.
        rig.robot_from_colour.rotation =
            nalgebra::UnitQuaternion::new(Vector3::new(1.0, -1.0, 1.0).normalize() * 2.0944);
        Estimator::new(EstimatorParams { pose_from, ..EstimatorParams::default() }, rig).unwrap()
    }

    fn hand_over(estimator: &mut Estimator, millis: i64, data: MeasurementData) -> Disposition {
        let captured_at = Timestamp::from_nanos(millis * 1_000_000);
        estimator.handle(Measurement { captured_at, available_at: captured_at, data })
    }

    /// Two seconds at half a metre a second, in front of a camera that sees nothing.
    fn drive_blind(estimator: &mut Estimator) {
        for tenth in 0..=20 {
            let ticks = 6_900 * tenth;
            let wheels = MeasurementData::WheelTicks { left: ticks, right: ticks };
            assert_eq!(hand_over(estimator, 100 * tenth, wheels), Disposition::Used);
            assert_eq!(hand_over(estimator, 100 * tenth, MeasurementData::Gyro(Vector3::zeros())), Disposition::Used);
        }
        hand_over(estimator, 2_000, MeasurementData::Rgb(Arc::new(Image::filled(640, 480, [0; 3]))));
        let seen = hand_over(estimator, 2_000, MeasurementData::Depth(Arc::new(Image::filled(640, 480, 0))));
        assert!(matches!(seen, Disposition::Rejected(Rejection::NoMotion(_))));
    }

    #[test]
    fn without_wheels_there_is_visual_odometry_and_nothing_else() {
        let mut estimator = estimator(None, PoseSource::Svsf);
        for data in [MeasurementData::WheelTicks { left: 0, right: 0 }, MeasurementData::Gyro(Vector3::zeros())] {
            assert_eq!(hand_over(&mut estimator, 0, data), Disposition::Rejected(Rejection::Unsupported));
        }
        assert_eq!(estimator.estimates(), [(PoseSource::Mvo, estimator.estimate())]);
        assert_eq!(estimator.estimate().health, Health::Initialising);
    }

    #[test]
    fn a_blind_robot_goes_by_its_wheels() {
        for source in [PoseSource::Odometry, PoseSource::Ekf, PoseSource::Svsf] {
            let mut estimator = estimator(Some(Drive::default()), source);
            drive_blind(&mut estimator);
            let Estimate { time, odom_from_robot, covariance, mode, health } = estimator.estimate();
            assert_eq!((mode, health), (Mode::Odometer, Health::Good));
            assert_eq!(time, Some(Timestamp::from_nanos(2_000_000_000)));
            assert!((odom_from_robot.translation.vector - Vector3::x()).norm() < 1e-9);
            assert!(covariance[(0, 0)] > 0.0 && covariance[(2, 2)] == 0.0);
        }
    }

    #[test]
    fn all_four_poses_go_by_their_names() {
        let mut estimator = estimator(Some(Drive::default()), PoseSource::Mvo);
        drive_blind(&mut estimator);
        let estimates = estimator.estimates();
        let names: Vec<&str> = estimates.iter().map(|(source, _)| source.name()).collect();
        assert_eq!(names, ["odometry", "mvo", "ekf", "svsf"]);
        assert_eq!(estimator.estimate(), estimates[1].1);
        assert!(matches!(estimator.estimate().health, Health::Lost(_)));
        assert_eq!(estimates[2].1.odom_from_robot, estimates[3].1.odom_from_robot);
    }

    #[test]
    fn wheels_that_cannot_roll_are_refused() {
        let rig = Rig { drive: Some(Drive { ticks_per_metre: 0.0, ..Drive::default() }), ..Rig::kinect_default() };
        let Err(error) = Estimator::new(EstimatorParams::default(), rig) else { panic!("taken") };
        assert!(error.to_string().contains("ticks_per_metre"));
    }
}
