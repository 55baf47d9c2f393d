//! The estimator of the product: wires the rooms as the paper's figure does.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::camera::{DepthCamera, Rig};
use crate::fusion::{Fusion, UncertainPose, VisualPose};
use crate::measurement::{
    Disposition, Estimate, Health, Localizer, Measurement, MeasurementData, Mode, Rejection, Streams,
};
use crate::mode::{ModeReport, ModeSwitch, Stream, of_colour, of_depth, of_infrared};
use crate::odometry::FrameReport;
use crate::params::{EstimatorParams, ParamError};
use crate::time::Timestamp;
use crate::vision::Vision;

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

/// Multispectral visual odometry, fused with the wheels where the rig has some (paper A).
pub struct Estimator {
    depth_camera: DepthCamera,
    modes: ModeSwitch,
    vision: Vision,
    /// With wheels only.
    fusion: Option<Fusion>,
    pose_from: PoseSource,
}

impl Estimator {
    /// Checks the parameters and the rig once.
    ///
    /// # Errors
    /// The first parameter or calibration number that can't be worked with.
    pub fn new(params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        rig.validate()?;
        params.validate()?;
        let modes = ModeSwitch::new(params.mode, params.switch);
        Ok(Self {
            depth_camera: rig.depth,
            vision: Vision::new(&params, &rig, modes.mode()),
            fusion: rig.drive.map(|drive| Fusion::new(params.fusion, drive)),
            pose_from: params.pose_from,
            modes,
        })
    }

    /// Has `observer` called at the beginning of each stage of each frame, for timing by the caller's clock.
    pub fn observe_stages(&mut self, observer: StageObserver) {
        self.vision.observe_stages(observer);
    }

    /// What was made of the newest frame; `None` before the first.
    pub fn last_frame(&self) -> Option<&FrameReport> {
        self.vision.report()
    }

    /// How the mode came about.
    pub fn mode_report(&self) -> ModeReport {
        self.modes.report()
    }

    /// Takes an image whose energy is `energy`, and localises once the images that the mode rests on are all there.
    fn look(&mut self, stream: Stream, time: Timestamp, energy: f64) -> Disposition {
        self.modes.see(stream, time, energy);
        let Some((visual, failure)) = self.vision.look(self.modes.mode()) else { return Disposition::Used };
        if let Some(fusion) = &mut self.fusion {
            // One that comes too late for the filters is still visual odometry's.
            let _ = fusion.handle_visual(VisualPose { doubt: self.modes.doubt(), ..visual });
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
            (None, _) | (_, PoseSource::Mvo) => self.vision.estimate().clone(),
            (Some(fusion), PoseSource::Odometry) => {
                self.on_plane(fusion.wheels_read_at(), fusion.odometry(), Mode::Odometer)
            }
            (Some(fusion), PoseSource::Ekf) => self.on_plane(fusion.time(), fusion.ekf(), self.fused_mode()),
            (Some(fusion), PoseSource::Svsf) => self.on_plane(fusion.time(), fusion.svsf(), self.fused_mode()),
        }
    }

    /// "When visual information is not available, the WO localization system will be used" (paper A, §1).
    fn fused_mode(&self) -> Mode {
        let visual = self.vision.estimate();
        if visual.health == Health::Good { visual.mode } else { Mode::Odometer }
    }

    fn on_plane(&self, time: Option<Timestamp>, pose: UncertainPose, mode: Mode) -> Estimate {
        let wheels_speak = self.fusion.as_ref().is_some_and(Fusion::wheels_speak);
        Estimate {
            time,
            odom_from_robot: pose.pose.to_isometry(),
            covariance: pose.covariance_in_space(),
            mode,
            health: if wheels_speak { Health::Good } else { self.vision.estimate().health },
        }
    }
}

impl Localizer for Estimator {
    fn handle(&mut self, measurement: Measurement) -> Disposition {
        let time = measurement.captured_at;
        match measurement.data {
            MeasurementData::Rgb(image) => match self.vision.take_rgb(time, Arc::clone(&image)) {
                Ok(()) => self.look(Stream::Rgb, time, of_colour(&image)),
                Err(rejection) => Disposition::Rejected(rejection),
            },
            MeasurementData::Infrared(image) => match self.vision.take_infrared(time, Arc::clone(&image)) {
                Ok(()) => self.look(Stream::Infrared, time, of_infrared(&image)),
                Err(rejection) => Disposition::Rejected(rejection),
            },
            MeasurementData::Depth(image) => match self.vision.take_depth(time, Arc::clone(&image)) {
                Ok(()) => self.look(Stream::Depth, time, of_depth(&image, &self.depth_camera)),
                Err(rejection) => Disposition::Rejected(rejection),
            },
            MeasurementData::WheelTicks { left, right } => {
                self.modes.pass(time);
                let taken = self.fusion.as_mut().map(|fusion| fusion.handle_ticks(time, left, right));
                if let (Some(Ok(())), Some(fusion)) = (&taken, &self.fusion) {
                    self.vision.take_wheels(time, fusion.dead_reckoning(), fusion.turn_doubt());
                }
                disposition(taken)
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
        let wanted = self.modes.wanted();
        let stereo = self.modes.mode() == Mode::Outdoor && self.vision.wants_infrared();
        Streams { infrared: wanted.infrared || stereo, ..wanted }
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
    use crate::dark_room::{self, DarkRoom, Wall};
    use crate::fusion::Drive;
    use crate::image::Image;
    use crate::mode::ModeChoice;
    use crate::motion::MotionFailure;
    use nalgebra::{Isometry3, Vector3};

    fn estimator(drive: Option<Drive>, pose_from: PoseSource) -> Estimator {
        let mut rig = Rig { drive, ..Rig::kinect_default() };
        // As a Kinect looks from a robot: x forward, y left, z up of what the camera has as z, −x, −y.
        rig.robot_from_colour.rotation =
            nalgebra::UnitQuaternion::new(Vector3::new(1.0, -1.0, 1.0).normalize() * 2.0944);
        // That nothing is seen for long is no reason to change the mode.
        let mode = ModeChoice::Indoor;
        Estimator::new(EstimatorParams { pose_from, mode, ..EstimatorParams::default() }, rig).unwrap()
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
    fn by_wheels_alone_no_image_counts() {
        let rig = Rig { drive: Some(Drive::default()), ..Rig::kinect_default() };
        let params = EstimatorParams { mode: ModeChoice::Wheels, ..EstimatorParams::default() };
        let mut estimator = Estimator::new(params, rig).unwrap();
        assert_eq!(estimator.wanted_streams(), Streams { rgb: false, infrared: false, depth: false });
        // What stands still before the camera says that the robot does.
        let image = Image::from_pixels(640, 480, (0..640 * 480).map(|i: u32| [(i * i % 251) as u8; 3]).collect());
        let image = Arc::new(image.unwrap());
        for tenth in 0..=20 {
            let ticks = 6_900 * tenth;
            hand_over(&mut estimator, 100 * tenth, MeasurementData::WheelTicks { left: ticks, right: ticks });
            hand_over(&mut estimator, 100 * tenth, MeasurementData::Rgb(Arc::clone(&image)));
            let seen = hand_over(
                &mut estimator,
                100 * tenth,
                MeasurementData::Depth(Arc::new(Image::filled(640, 480, 9_000))),
            );
            assert_eq!(seen, Disposition::Used);
        }
        let [odometry, mvo, ekf, svsf] = &estimator.estimates()[..] else { panic!("four poses") };
        assert_eq!(odometry.1.odom_from_robot, ekf.1.odom_from_robot);
        assert_eq!(odometry.1.odom_from_robot, svsf.1.odom_from_robot);
        assert_eq!((svsf.1.mode, svsf.1.health), (Mode::Odometer, Health::Good));
        assert_eq!(mvo.1.health, Health::Lost(MotionFailure::NotSought));
        assert_eq!(estimator.last_frame().unwrap().depth_valid_share, 1.0);
    }

    #[test]
    fn when_the_light_goes_out_infrared_carries_on() {
        let params = EstimatorParams { pose_from: PoseSource::Mvo, ..EstimatorParams::default() };
        let mut estimator = Estimator::new(params, dark_room::rig()).unwrap();
        let normal = Vector3::new(0.1, 0.0, 1.0).normalize();
        let room = DarkRoom { walls: vec![Wall { normal, distance: 2.0, is_textured: true }], ambient: 0.0 };
        let black = Arc::new(Image::filled(640, 480, [1; 3]));
        let mut began = None;
        for frame in 0..40_i32 {
            let seen = room.seen_from(&Isometry3::translation(0.02 * f64::from(frame), 0.0, 0.0), frame as u64);
            let millis = 66 * i64::from(frame);
            hand_over(&mut estimator, millis, MeasurementData::Rgb(Arc::clone(&black)));
            hand_over(&mut estimator, millis, MeasurementData::Infrared(Arc::new(seen.infrared)));
            hand_over(&mut estimator, millis, MeasurementData::Depth(Arc::new(seen.depth)));
            let Estimate { mode, health, .. } = estimator.estimate();
            if mode == Mode::Night && health == Health::Good {
                began.get_or_insert(frame);
            }
        }
        // The first frame has none to be held against.
        let began = began.unwrap();
        assert!((1..3).contains(&began), "{began}");
        let gone = estimator.estimate().odom_from_robot.translation.vector;
        let expected = Vector3::x() * (0.02 * f64::from(40 - began));
        assert!((gone - expected).norm() < 0.01, "{gone} instead of {expected}");
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
