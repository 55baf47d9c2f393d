//! A localiser with a name, and what of it can be looked into.

use std::sync::{Arc, Mutex, PoisonError};

use sunblind_estimator::odometry::FrameReport;
use sunblind_estimator::{Estimator, EstimatorParams, Localizer, ParamError, Rig};

use super::stage_clock::StageClock;

/// A localiser that is to be driven.
pub struct Driven {
    /// File stem and key in `summary.json`: `mvo`.
    pub name: String,
    /// For readers: "visual odometry, keyframes".
    pub label: String,
    /// Its effective parameters as TOML; empty for a localiser of the user's own.
    pub parameters: String,
    subject: Subject,
}

enum Subject {
    /// The product's estimator, which says what it made of a frame and when it did what.
    Product { estimator: Box<Estimator>, clock: Arc<Mutex<StageClock>> },
    /// Any other; nothing but its estimate is known.
    Own(Box<dyn Localizer + Send>),
}

impl Driven {
    /// The product's estimator.
    ///
    /// # Errors
    /// A parameter or a calibration that it can't run with.
    pub fn product(name: &str, label: &str, params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        let parameters = toml::to_string(&params).expect("the parameters are plain numbers and names");
        let mut estimator = Box::new(Estimator::new(params, rig)?);
        let clock = Arc::new(Mutex::new(StageClock::default()));
        let observed = Arc::clone(&clock);
        estimator.observe_stages(Box::new(move |stage| {
            observed.lock().unwrap_or_else(PoisonError::into_inner).begin(stage);
        }));
        Ok(Self { name: name.into(), label: label.into(), parameters, subject: Subject::Product { estimator, clock } })
    }

    /// A localiser of the user's own.
    pub fn own(name: &str, label: &str, localizer: Box<dyn Localizer + Send>) -> Self {
        Self { name: name.into(), label: label.into(), parameters: String::new(), subject: Subject::Own(localizer) }
    }

    pub(super) fn localizer(&self) -> &dyn Localizer {
        match &self.subject {
            Subject::Product { estimator, .. } => estimator.as_ref(),
            Subject::Own(localizer) => localizer.as_ref(),
        }
    }

    pub(super) fn localizer_mut(&mut self) -> &mut dyn Localizer {
        match &mut self.subject {
            Subject::Product { estimator, .. } => estimator.as_mut(),
            Subject::Own(localizer) => localizer.as_mut(),
        }
    }

    /// What it made of the newest frame that it worked on.
    pub(super) fn last_frame(&self) -> Option<&FrameReport> {
        match &self.subject {
            Subject::Product { estimator, .. } => estimator.last_frame(),
            Subject::Own(_) => None,
        }
    }

    /// Milliseconds by stage since the last call.
    pub(super) fn take_stage_ms(&self) -> [f64; 4] {
        match &self.subject {
            Subject::Product { clock, .. } => clock.lock().unwrap_or_else(PoisonError::into_inner).take(),
            Subject::Own(_) => [0.0; 4],
        }
    }
}
