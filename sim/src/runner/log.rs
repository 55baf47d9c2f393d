//! What a run leaves behind in memory: the input of `evaluation` and `report`.

use nalgebra::{Isometry3, Matrix6};
use sunblind_estimator::image::{Image, InfraredImage, RgbImage};
use sunblind_estimator::mode::Energies;
use sunblind_estimator::odometry::FeatureTrack;
use sunblind_estimator::{Health, Mode, PoseSource, Timestamp};

use crate::evaluation::{Corrections, StampedPose};
use crate::modes::{self, StampedInformation, StampedReport};
use crate::scenario::Quality;
use crate::scenario::expect::Judged;
use crate::world::plan::Plan;

/// One run of one or more localisers through one recording or simulation.
pub struct RunLog {
    /// The recording's name, which is its folder's, or the scenario's.
    pub recording: String,
    /// What a reader should know first, one sentence each ("no calibration.toml: the Kinect's defaults are assumed").
    pub warnings: Vec<String>,
    /// The truth at the times of all tracks (interpolated), in time order; empty when the recording has none.
    pub truth: Vec<StampedPose>,
    /// What the localisers said; the first is the one that is judged.
    pub tracks: Vec<Track>,
    /// Whether the poses are of a robot with wheels (x forward, y left, z up); if not, they are of whatever carried the
    /// camera.
    pub has_wheels: bool,
    /// Images of a few instants.
    pub snapshots: Vec<Snapshot>,
    /// Small images of many instants, evenly spread over the run, without feature tracks.
    pub thumbnails: Vec<Snapshot>,
    /// What the images held, on average.
    pub energies: Energies,
    /// What the judged localiser's mode switch said, once a frame; empty for a localiser of the user's own.
    pub modes: Vec<StampedReport>,
    /// What the images held in truth; empty for a recording.
    pub information: Vec<StampedInformation>,
    /// The world from above; `None` for a recording.
    pub plan: Option<Plan>,
    /// The way that the robot was to take: x, y in the world, metres; empty for a recording.
    pub planned_path: Vec<[f64; 2]>,
    /// What had to hold, and whether it did; empty for a recording.
    pub expectations: Vec<Judged>,
    /// What is known of a simulated run alone; `None` for a recording.
    pub facts: Option<RunFacts>,
    /// SHA-256 over everything that was measured and every estimate, hex.
    pub digest: String,
    /// Wall time of the run, seconds.
    pub wall: f64,
    /// CPU time of the process during the run, seconds.
    pub cpu: f64,
}

/// What a run of a scenario knows beyond what a replay does.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFacts {
    /// The seed of all its random numbers.
    pub seed: u64,
    /// How finely the Kinect looked.
    pub quality: Quality,
    /// Simulated time, seconds.
    pub duration: f64,
    /// Length of the way that the robot truly went, metres.
    pub path: f64,
    /// The graphics adapter's name; `None` when nothing was rendered.
    pub adapter: Option<String>,
    /// Its driver with its version.
    pub driver: Option<String>,
    /// What simulating a camera frame cost, milliseconds of CPU over all threads.
    pub cpu_ms_per_frame: SimulationCost,
}

impl RunLog {
    /// How well the modes were chosen; `None` where nobody chose, or nobody knows.
    pub fn mode_score(&self) -> Option<modes::Score> {
        modes::score(&self.modes, &self.information)
    }

    /// How far the fused estimates leapt, by their names; of those that have wheels beside them.
    pub fn corrections(&self) -> Vec<(&str, Corrections)> {
        let Some(wheels) = self.track(PoseSource::Odometry.name()) else { return Vec::new() };
        let switches = modes::switches(&self.modes);
        let fused = [PoseSource::Ekf, PoseSource::Svsf].into_iter().filter_map(|source| self.track(source.name()));
        let of = |track: &'_ Track| Corrections::of(&track.frames, &wheels.frames, &switches);
        fused.filter_map(|track| Some((track.name.as_str(), of(track)?))).collect()
    }

    /// The track of this name.
    pub fn track(&self, name: &str) -> Option<&Track> {
        self.tracks.iter().find(|track| track.name == name)
    }

    /// The mean share of the depth images' pixels that have a value; `None` when no localiser counted them.
    pub fn depth_valid_share(&self) -> Option<f64> {
        let shares = |track: &Track| -> Vec<f64> {
            track.frames.iter().filter_map(|frame| Some(frame.counts?.depth_valid_share)).collect()
        };
        let shares = self.tracks.iter().map(shares).find(|shares| !shares.is_empty())?;
        Some(shares.iter().sum::<f64>() / shares.len() as f64)
    }
}

/// Milliseconds of CPU for each camera frame, the mean over the run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SimulationCost {
    /// Colour and infrared images.
    pub render: f64,
    /// Depth from the infrared image.
    pub depth: f64,
    /// Rigid bodies and wheels, from one frame to the next.
    pub physics: f64,
}

/// One of a localiser's estimates, frame by frame.
pub struct Track {
    /// File stem and key in `summary.json`: `mvo`, `mvo_paper`.
    pub name: String,
    /// For readers: "visual odometry, keyframes".
    pub label: String,
    /// Its effective parameters as TOML.
    pub parameters: String,
    /// One a frame, in time order; none for a frame by which a track that rests on wheels had not moved on.
    pub frames: Vec<FrameLog>,
}

/// One frame as one localiser saw it.
pub struct FrameLog {
    /// The instant that the pose is of: the frame's, or where wheels had carried the pose when the frame was worked on.
    pub time: Timestamp,
    /// Its pose, in the truth's world (placed there by the first pose) or, without truth, in the odom frame.
    pub world_from_body: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ) of that pose; m², m·rad, rad².
    pub covariance: Matrix6<f64>,
    /// Mode.
    pub mode: Mode,
    /// Health.
    pub health: Health,
    /// What the visual odometry counted; `None` for a localiser that reports nothing.
    pub counts: Option<FrameCounts>,
    /// Milliseconds by stage: registration, features, matching, motion; zeros when not observed.
    pub stage_ms: [f64; 4],
}

/// Counts of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameCounts {
    /// Features found.
    pub features: usize,
    /// Matches.
    pub matches: usize,
    /// Inliers.
    pub inliers: usize,
    /// Whether the frame became a keyframe.
    pub keyframe: bool,
    /// Share of the sensor's depth pixels with a value, 0–1.
    pub depth_valid_share: f64,
}

/// Images and tracked features of one instant.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// When.
    pub time: Timestamp,
    /// Colour image; black where the device gave infrared instead.
    pub rgb: RgbImage,
    /// Infrared image of the same instant, where there is one; black where only other instants of the run have one.
    pub infrared: Option<InfraredImage>,
    /// Z of the depth camera's pixels, metres; 0 = no value.
    pub depth: Image<f32>,
    /// Feature tracks of the judged localiser, in infrared pixels at night and in colour's otherwise.
    pub tracks: Vec<FeatureTrack>,
    /// The judged localiser's mode.
    pub mode: Mode,
}
