//! Localisers at work on one stream of measurements, wherever it comes from: a recording, or a simulation that runs
//! with them. What they say depends on the stream alone.

use std::time::Instant;

use cpu_time::ProcessTime;
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use sunblind_estimator::{Estimate, Measurement, Rig, Streams, Timestamp};

use super::digest;
use super::driven::Driven;
use super::energies::MeanEnergies;
use super::follower::Follower;
use super::gallery::Gallery;
use super::log::RunLog;
use super::pairing::{Pairing, Shot};
use crate::evaluation::StampedPose;
use crate::record::Arrival;
use crate::truth;

/// Drives localisers; the first is the one that is judged.
pub struct Session<'a> {
    rig: Rig,
    followers: Vec<Follower>,
    pairing: Pairing,
    newest: Option<Arrival>,
    /// Over the frames, and over all that is in none.
    frame_hash: Sha256,
    other_hash: Option<Sha256>,
    gallery: Gallery,
    energies: MeanEnergies,
    on_frame: &'a (dyn Fn() + Sync),
    started: (Instant, ProcessTime),
}

/// A measurement, and the images of the frame that it completes.
struct Step<'a> {
    measurement: &'a Measurement,
    shot: Option<Shot>,
}

impl<'a> Session<'a> {
    /// Before the first measurement. `rig` says what depth values mean to whoever reads the report; `expected_frames`
    /// decides which frames are kept for it; `on_frame` is called after each frame.
    pub fn new(localizers: Vec<Driven>, rig: Rig, expected_frames: usize, on_frame: &'a (dyn Fn() + Sync)) -> Self {
        Self {
            rig,
            followers: localizers.into_iter().map(Follower::new).collect(),
            pairing: Pairing::default(),
            newest: None,
            frame_hash: Sha256::new(),
            other_hash: None,
            gallery: Gallery::new(expected_frames),
            energies: MeanEnergies::default(),
            on_frame,
            started: (Instant::now(), ProcessTime::now()),
        }
    }

    /// Hands the next measurements to every localiser, each on a thread of its own as far as there are threads. In how
    /// many portions a stream comes makes no difference.
    ///
    /// # Panics
    /// When they are not in the order of [`Arrival`].
    pub fn take(&mut self, measurements: &[Measurement]) {
        for measurement in measurements {
            let arrival = Some(Arrival::of(measurement));
            assert!(self.newest <= arrival, "handed over {arrival:?} after {:?}", self.newest);
            self.newest = arrival;
        }
        let steps = self.steps(measurements);
        self.energies.take(measurements, &self.rig);
        let Some((judged, others)) = self.followers.split_first_mut() else { return };
        let (rig, gallery, on_frame) = (&self.rig, &mut self.gallery, self.on_frame);
        let follow_judged = || {
            follow(judged, &steps, |judged, shot| {
                gallery.take(shot, rig, || judged.feature_tracks());
                on_frame();
            });
        };
        let follow_others = || others.par_iter_mut().for_each(|other| follow(other, &steps, |_, _| {}));
        rayon::join(follow_judged, follow_others);
    }

    /// Finds the frames, and adds all that was measured to the digest.
    fn steps<'m>(&mut self, measurements: &'m [Measurement]) -> Vec<Step<'m>> {
        let mut others = Vec::new();
        let mut steps = Vec::with_capacity(measurements.len());
        for measurement in measurements {
            let paired = self.pairing.take(measurement);
            others.extend(paired.alone);
            if !digest::may_be_in_a_frame(measurement) {
                others.push(measurement.clone());
            }
            steps.push(Step { measurement, shot: paired.shot });
        }
        let frame_digests: Vec<_> =
            steps.par_iter().filter_map(|step| Some(digest::of_frame(step.shot.as_ref()?))).collect();
        frame_digests.iter().for_each(|digest| self.frame_hash.update(digest));
        self.hash_others(&others);
        steps
    }

    fn hash_others(&mut self, others: &[Measurement]) {
        let digests: Vec<_> = others.par_iter().map(digest::of_measurement).collect();
        for digest in digests {
            self.other_hash.get_or_insert_default().update(digest);
        }
    }

    /// What the judged localiser says now; `None` without localisers.
    pub fn estimate(&self) -> Option<Estimate> {
        self.followers.first().map(|judged| judged.localizer().estimate())
    }

    /// The images that the judged localiser wants next.
    pub fn wanted_streams(&self) -> Option<Streams> {
        self.followers.first().map(|judged| judged.localizer().wanted_streams())
    }

    /// The log, after the last measurement. The truth is looked at only now: `recorded` is in time order (a time may
    /// repeat), and empty when there is none.
    pub fn finish(mut self, recording: String, mut warnings: Vec<String>, recorded: &[StampedPose]) -> RunLog {
        let left: Vec<_> = std::mem::take(&mut self.pairing).left().collect();
        self.hash_others(&left);
        let digest = self.digest();
        let mut times: Vec<Timestamp> = self.followers.iter().flat_map(Follower::times).flatten().collect();
        times.sort_unstable();
        times.dedup();
        let truth: Vec<StampedPose> = times.into_iter().filter_map(|time| truth::at(recorded, time)).collect();
        warnings.extend(self.truth_warning(recorded, &truth));
        warnings.extend(self.followers.iter().filter_map(Follower::warning));
        let modes = self.followers.first_mut().map_or_else(Vec::new, Follower::take_modes);
        let (started, cpu) = self.started;
        let [snapshots, thumbnails] = self.gallery.finish();
        RunLog {
            recording,
            warnings,
            digest,
            tracks: self.followers.into_iter().flat_map(|follower| follower.finish(&truth)).collect(),
            truth,
            has_wheels: self.rig.drive.is_some(),
            snapshots,
            thumbnails,
            energies: self.energies.means(),
            modes,
            information: Vec::new(),
            plan: None,
            planned_path: Vec::new(),
            expectations: Vec::new(),
            facts: None,
            wall: started.elapsed().as_secs_f64(),
            cpu: cpu.elapsed().as_secs_f64(),
        }
    }

    fn truth_warning(&self, recorded: &[StampedPose], truth: &[StampedPose]) -> Option<String> {
        if recorded.is_empty() {
            return Some("no ground truth: nothing is scored".to_owned());
        }
        let judged: Vec<Timestamp> = self.followers.first()?.times().next()?.collect();
        let is_covered = |time: &&Timestamp| truth.binary_search_by_key(*time, |pose| pose.time).is_ok();
        let uncovered = judged.len() - judged.iter().filter(is_covered).count();
        (uncovered > 0).then(|| {
            format!("the ground truth does not cover {uncovered} of {} frames; they are not scored", judged.len())
        })
    }

    /// SHA-256 over everything that was measured and every estimate, hex.
    fn digest(&self) -> String {
        let mut hash = Sha256::new_with_prefix(self.frame_hash.clone().finalize());
        for follower in &self.followers {
            hash.update(follower.digest());
        }
        if let Some(others) = &self.other_hash {
            hash.update(others.clone().finalize());
        }
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

fn follow(follower: &mut Follower, steps: &[Step], mut after_frame: impl FnMut(&Follower, &Shot)) {
    for Step { measurement, shot } in steps {
        follower.take(measurement);
        if let Some(shot) = shot {
            follower.log(shot.time);
            after_frame(follower, shot);
        }
    }
}
