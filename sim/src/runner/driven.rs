//! A localiser with a name, and what of it can be looked into.

use std::sync::{Arc, Mutex, PoisonError};

use sunblind_estimator::mode::ModeReport;
use sunblind_estimator::odometry::FrameReport;
use sunblind_estimator::{Estimate, Estimator, EstimatorParams, Localizer, ParamError, PoseSource, Rig};

use super::stage_clock::StageClock;
use super::without_gyro::WithoutGyro;

/// A localiser that is to be driven.
pub struct Driven {
    /// What its estimates are called; the first is the one that it reports itself.
    pub(super) tracks: Vec<TrackName>,
    /// Its effective parameters as TOML; empty for a localiser of the user's own.
    pub(super) parameters: String,
    subject: Subject,
}

/// One of a localiser's estimates.
pub(super) struct TrackName {
    /// File stem and key in `summary.json`: `mvo`.
    pub name: String,
    /// For readers: "visual odometry, keyframes".
    pub label: String,
    /// Whether the counts and times of the frames are its doing.
    pub is_visual: bool,
}

enum Subject {
    /// The product's estimator, which says what it made of a frame and when it did what.
    Product {
        estimator: Box<Estimator>,
        /// In the order of the tracks.
        sources: Vec<PoseSource>,
        clock: Arc<Mutex<StageClock>>,
    },
    /// Any other; nothing but its estimate is known.
    Own(Box<dyn Localizer + Send>),
}

impl Driven {
    /// The product's estimator; `name` and `label` are its visual odometry's. On a rig with wheels it gives the tracks
    /// `odometry`, `ekf` and `svsf` as well, the one that the parameters have it report first.
    ///
    /// # Errors
    /// A parameter or a calibration that it can't run with.
    pub fn product(name: &str, label: &str, params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        let parameters = toml::to_string(&params).expect("the parameters are plain numbers and names");
        let reported = params.pose_from;
        let mut estimator = Box::new(Estimator::new(params, rig)?);
        let clock = Arc::new(Mutex::new(StageClock::default()));
        let observed = Arc::clone(&clock);
        estimator.observe_stages(Box::new(move |stage| {
            observed.lock().unwrap_or_else(PoisonError::into_inner).begin(stage);
        }));
        let mut sources: Vec<_> = estimator.estimates().into_iter().map(|(source, _)| source).collect();
        sources.sort_by_key(|source| (*source != reported, *source));
        let track = |source: &PoseSource| match source {
            PoseSource::Mvo => TrackName { name: name.into(), label: label.into(), is_visual: true },
            other => TrackName { name: other.name().into(), label: label_of(*other).into(), is_visual: false },
        };
        Ok(Self {
            tracks: sources.iter().map(track).collect(),
            parameters,
            subject: Subject::Product { estimator, sources, clock },
        })
    }

    /// The wheels' odometry without the gyro that is fitted, as the track `odometry_no_gyro`: what the gyro is worth, in one
    /// and the same drive.
    ///
    /// # Errors
    /// As [`Driven::product`].
    pub fn odometry_without_gyro(params: EstimatorParams, rig: Rig) -> Result<Self, ParamError> {
        let localizer = Box::new(WithoutGyro::new(params, rig)?);
        Ok(Self::own("odometry_no_gyro", "wheels alone, without the gyro", localizer))
    }

    /// A localiser of the user's own.
    pub fn own(name: &str, label: &str, localizer: Box<dyn Localizer + Send>) -> Self {
        let track = TrackName { name: name.into(), label: label.into(), is_visual: true };
        Self { tracks: vec![track], parameters: String::new(), subject: Subject::Own(localizer) }
    }

    /// What names it: its visual odometry's track, or its only one.
    pub(super) fn name(&self) -> &str {
        let visual = self.tracks.iter().find(|track| track.is_visual);
        visual.or(self.tracks.first()).map_or("", |track| &track.name)
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

    /// Its estimates, one a track.
    pub(super) fn estimates(&self) -> Vec<Estimate> {
        match &self.subject {
            Subject::Product { estimator, sources, .. } => {
                let mut estimates = estimator.estimates();
                estimates.sort_by_key(|(source, _)| sources.iter().position(|known| known == source));
                estimates.into_iter().map(|(_, estimate)| estimate).collect()
            }
            Subject::Own(localizer) => vec![localizer.estimate()],
        }
    }

    /// What it made of the newest frame that it worked on.
    pub(super) fn last_frame(&self) -> Option<&FrameReport> {
        match &self.subject {
            Subject::Product { estimator, .. } => estimator.last_frame(),
            Subject::Own(_) => None,
        }
    }

    /// How its mode came about.
    pub(super) fn mode_report(&self) -> Option<ModeReport> {
        match &self.subject {
            Subject::Product { estimator, .. } => Some(estimator.mode_report()),
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

fn label_of(source: PoseSource) -> &'static str {
    match source {
        PoseSource::Odometry => "wheels alone",
        PoseSource::Mvo => "visual odometry",
        PoseSource::Ekf => "wheels and vision, EKF",
        PoseSource::Svsf => "wheels and vision, SVSF",
    }
}
