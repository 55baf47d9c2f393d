//! The estimator of the product: wires the rooms as the paper's figure does.

use nalgebra::{Isometry3, Matrix6};

use crate::camera::Rig;
use crate::measurement::{Disposition, Estimate, Health, Localizer, Measurement, Mode, Rejection, Streams};
use crate::odometry::FrameReport;
use crate::params::{EstimatorParams, ParamError};

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

/// Multispectral visual odometry (paper A).
pub struct Estimator {
    estimate: Estimate,
    last_frame: Option<FrameReport>,
    observer: Option<StageObserver>,
}

impl Estimator {
    /// Checks the parameters and the rig once.
    ///
    /// # Errors
    /// The first parameter or calibration number that can't be worked with.
    pub fn new(_params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        rig.validate()?;
        Ok(Self {
            estimate: Estimate {
                time: None,
                odom_from_robot: Isometry3::identity(),
                covariance: Matrix6::zeros(),
                mode: Mode::Indoor,
                health: Health::Initialising,
            },
            last_frame: None,
            observer: None,
        })
    }

    /// Has `observer` called at the beginning of each stage of each frame, for timing by the caller's clock.
    pub fn observe_stages(&mut self, observer: StageObserver) {
        self.observer = Some(observer);
    }

    /// What was made of the newest frame; `None` before the first.
    pub fn last_frame(&self) -> Option<&FrameReport> {
        self.last_frame.as_ref()
    }
}

impl Localizer for Estimator {
    fn handle(&mut self, _measurement: Measurement) -> Disposition {
        Disposition::Rejected(Rejection::Unsupported)
    }

    fn estimate(&self) -> Estimate {
        self.estimate.clone()
    }

    fn wanted_streams(&self) -> Streams {
        Streams { rgb: true, infrared: false, depth: true }
    }
}
