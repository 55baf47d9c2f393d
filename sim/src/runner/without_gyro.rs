//! The wheels' odometry of a robot that has a gyro, as it would be without one.

use sunblind_estimator::mode::ModeChoice;
use sunblind_estimator::{
    Disposition, Estimate, Estimator, EstimatorParams, Localizer, Measurement, MeasurementData, ParamError, PoseSource,
    Rejection, Rig, Streams,
};

/// The product's estimator in mode `wheels`, from which the gyro is kept away.
pub(super) struct WithoutGyro(Estimator);

impl WithoutGyro {
    pub fn new(params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        let params = EstimatorParams { pose_from: PoseSource::Odometry, mode: ModeChoice::Wheels, ..params };
        Estimator::new(params, rig).map(Self)
    }
}

impl Localizer for WithoutGyro {
    fn handle(&mut self, measurement: Measurement) -> Disposition {
        match measurement.data {
            MeasurementData::Gyro(_) => Disposition::Rejected(Rejection::Unsupported),
            _ => self.0.handle(measurement),
        }
    }

    fn estimate(&self) -> Estimate {
        self.0.estimate()
    }

    fn wanted_streams(&self) -> Streams {
        self.0.wanted_streams()
    }
}
