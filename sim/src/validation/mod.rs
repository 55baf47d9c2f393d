//! The simulated device held against what is known of the real one: an [`Experiment`] for each target, which looks at
//! small worlds through the device's own images, and the [`Finding`]s that come of it.
//!
//! Where a figure was measured on real devices or follows from their published build, the target is *published*; where
//! nobody has published one, it is that of a *model* (photon counts of the dots against the sun's), and says no more
//! than that the simulation is what it claims to be.
//!
//! Sources: ROS `kinect_calibration/technical` (Konolige & Mihelich); Khoshelham & Elberink, *Accuracy and Resolution
//! of Kinect Depth Data* (2012); Nguyen, Izadi & Lovell, *Modeling Kinect Sensor Noise* (2012); Reichinger, *Kinect
//! Pattern Uncovered* (2011); Chow, Ang, Lichti & Teskey, *Performance Analysis of a Low-Cost Triangulation-Based 3D
//! Camera* (2012); depth frames of the TUM RGB-D benchmark and of 7-Scenes; libfreenect (row times); ARIA's parameters
//! of the P3-AT; spectra of surfaces (SLUM, ECOSTRESS) and of the sun (SPECTRL2).

pub mod bench;
mod colour;
mod darkness;
mod drive;
mod edges;
mod geometry;
mod office;
mod pattern;
pub mod scene;
mod skew;
pub mod statistics;
mod streams;
mod sun;
pub mod table;
mod warm_up;

use std::ops::RangeInclusive;

use thiserror::Error;

use crate::physics::WorldError;
use crate::render::RenderError;
use crate::simulator::SimulatorError;

/// What a target rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Measured on real devices, or their published build.
    Published,
    /// A model of the light: no measurement is known.
    Model,
}

impl Source {
    /// For tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::Model => "model",
        }
    }
}

/// How much is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// All of it.
    Full,
    /// Enough to see what broke.
    Reduced,
}

impl Effort {
    /// All of a list, or its first few.
    fn of<T>(self, list: &[T], few: usize) -> &[T] {
        match self {
            Self::Full => list,
            Self::Reduced => &list[..few],
        }
    }
}

/// One figure, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is, with its unit.
    pub what: String,
    /// What is published, or what the model says.
    pub target: f64,
    /// What passes for it.
    pub accepted: RangeInclusive<f64>,
    /// What the simulation has.
    pub measured: f64,
}

impl Finding {
    fn new(what: impl Into<String>, target: f64, accepted: RangeInclusive<f64>, measured: f64) -> Self {
        Self { what: what.into(), target, accepted, measured }
    }

    /// Whether it passes.
    pub fn held(&self) -> bool {
        self.accepted.contains(&self.measured)
    }
}

/// Why nothing could be measured.
#[derive(Debug, Error)]
pub enum ValidationError {
    /// No graphics adapter, or one that stopped working.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A world that no robot can drive in.
    #[error(transparent)]
    World(#[from] WorldError),
}

impl From<SimulatorError> for ValidationError {
    fn from(error: SimulatorError) -> Self {
        match error {
            SimulatorError::Render(error) => Self::Render(error),
            SimulatorError::World(error) => Self::World(error),
            SimulatorError::Scenario(fault) => unreachable!("the scenario is this room's own: {}", fault.problem),
        }
    }
}

type Findings = Result<Vec<Finding>, ValidationError>;

/// How one target is tested.
pub struct Experiment {
    /// The target's number: `V7`.
    pub target: &'static str,
    /// What it is about.
    pub about: &'static str,
    /// What it rests on.
    pub source: Source,
    run: fn(Effort) -> Findings,
}

impl Experiment {
    /// Measures.
    ///
    /// # Errors
    /// Nothing here can render.
    pub fn run(&self, effort: Effort) -> Findings {
        (self.run)(effort)
    }
}

/// Every target, in order.
pub const EXPERIMENTS: [Experiment; 17] = {
    use Source::{Model, Published};
    const fn of(target: &'static str, source: Source, about: &'static str, run: fn(Effort) -> Findings) -> Experiment {
        Experiment { target, about, source, run }
    }
    [
        of("V1", Published, "steps of depth", geometry::steps),
        of("V2", Published, "noise along the view", geometry::axial_noise),
        of("V3", Published, "grazing views", geometry::grazing),
        of("V4", Published, "jitter of edges", edges::jitter),
        of("V5", Published, "lamps without infrared", darkness::lamps),
        of("V6", Model, "darkness", darkness::darkness),
        of("V7", Published, "shadows beside near things", edges::shadows),
        of("V8", Published, "holes in a furnished room", office::holes),
        of("V9", Published, "the projector's pattern", pattern::counts),
        of("V10", Model, "overcast sky and shade", sun::soft_light),
        of("V11", Model, "full sun", sun::full_sun),
        of("V12", Model, "from some sun to too much", sun::drop_out),
        of("V13", Model, "low sun", sun::low_sun),
        of("V14", Published, "surfaces at 830 nm", colour::surfaces),
        of("V15", Published, "warm-up", warm_up::drift),
        of("V16", Published, "the robot's effective track", drive::track),
        of("V17", Published, "rolling shutter and streams", streams::timing),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_target_is_tested_once_and_in_order() {
        let numbers: Vec<_> = EXPERIMENTS.iter().map(|experiment| experiment.target.to_owned()).collect();
        assert_eq!(numbers, (1..=17).map(|number| format!("V{number}")).collect::<Vec<_>>());
    }
}
