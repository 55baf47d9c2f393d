//! A recording from its first frame to its last: images are decoded ahead while the localisers work, on a fixed number
//! of threads, and the answers are the same for any number of them.

use std::num::NonZero;
use std::time::Instant;

use cpu_time::ProcessTime;
use rayon::prelude::*;
use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};
use sha2::{Digest, Sha256};
use sunblind_estimator::Rig;
use sunblind_estimator::image::{Image, RgbImage};
use thiserror::Error;

use super::driven::Driven;
use super::follower::Follower;
use super::log::{RunLog, Snapshot};
use super::truth;
use crate::evaluation::StampedPose;
use crate::record::{Frame, FrameFiles, RecordError, Recording};

/// Frames decoded together. Two batches are in memory at a time, about 50 MB of Kinect images, however long the
/// recording is.
const BATCH: usize = 16;
/// Instants whose images are kept for the report.
const SNAPSHOTS: usize = 6;

/// How a recording is replayed; what comes out does not depend on it.
pub struct ReplayOptions<'a> {
    /// Threads that work at a time.
    pub threads: NonZero<usize>,
    /// Called after each frame of the first localiser.
    pub on_frame: &'a (dyn Fn() + Sync),
}

impl Default for ReplayOptions<'_> {
    /// As many threads as the machine has cores to offer; nobody is told.
    fn default() -> Self {
        Self { threads: std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN), on_frame: &|| {} }
    }
}

/// Why a replay ended early.
#[derive(Debug, Error)]
pub enum ReplayError {
    /// An image could not be used.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The operating system gave no threads.
    #[error("can't start the threads: {0}; ask for fewer with --threads")]
    Threads(#[from] ThreadPoolBuildError),
}

/// Drives every localiser through the whole recording. They get the images and nothing else: the truth is looked at
/// only once they are done.
///
/// # Errors
/// The first image, in the order of time, that can't be decoded.
pub fn replay(recording: &Recording, localizers: Vec<Driven>, options: &ReplayOptions) -> Result<RunLog, ReplayError> {
    let pool = ThreadPoolBuilder::new().num_threads(options.threads.get()).build()?;
    let (started, cpu) = (Instant::now(), ProcessTime::now());
    let run = pool.install(|| Run::through(recording, localizers, options.on_frame))?;
    let (wall, cpu) = (started.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());

    let frames = &recording.frames;
    let truth: Vec<StampedPose> =
        frames.iter().filter_map(|frame| truth::at(&recording.truth, frame.rgb.time)).collect();
    let mut warnings = recording.warnings.clone();
    if recording.truth.is_empty() {
        warnings.push("no ground truth: nothing is scored".to_owned());
    } else if truth.len() < frames.len() {
        let uncovered = frames.len() - truth.len();
        warnings.push(format!(
            "the ground truth does not cover {uncovered} of {} frames; they are not scored",
            frames.len()
        ));
    }
    warnings.extend(run.followers.iter().filter_map(Follower::warning));
    Ok(RunLog {
        recording: recording.name.clone(),
        warnings,
        digest: run.digest(),
        tracks: run.followers.into_iter().map(|follower| follower.finish(&truth)).collect(),
        truth,
        snapshots: run.snapshots,
        wall,
        cpu,
    })
}

/// The replay under way.
struct Run<'a> {
    recording: &'a Recording,
    /// The first is the one that is judged.
    followers: Vec<Follower>,
    images: Sha256,
    snapshots: Vec<Snapshot>,
    on_frame: &'a (dyn Fn() + Sync),
}

impl<'a> Run<'a> {
    fn through(
        recording: &'a Recording,
        localizers: Vec<Driven>,
        on_frame: &'a (dyn Fn() + Sync),
    ) -> Result<Self, RecordError> {
        let followers = localizers.into_iter().map(Follower::new).collect();
        let mut run = Self { recording, followers, images: Sha256::new(), snapshots: Vec::new(), on_frame };
        let mut batches = recording.frames.chunks(BATCH);
        let mut decode_next = || decode(batches.next().unwrap_or_default(), &recording.rig);
        let mut batch = decode_next()?;
        while !batch.is_empty() {
            let ((), next) = rayon::join(|| run.follow(&batch), &mut decode_next);
            batch = next?;
        }
        Ok(run)
    }

    /// Hands a batch to every localiser, each on a thread of its own as far as there are threads.
    fn follow(&mut self, batch: &[Decoded]) {
        for Decoded { digest, .. } in batch {
            self.images.update(digest);
        }
        let Some((judged, others)) = self.followers.split_first_mut() else { return };
        let follow_judged = || {
            for Decoded { frame, .. } in batch {
                judged.take(frame);
                if is_snapshot(judged.frames_taken() - 1, self.recording.frames.len()) {
                    self.snapshots.push(snapshot(frame, judged, &self.recording.rig));
                }
                (self.on_frame)();
            }
        };
        let follow_others =
            || others.par_iter_mut().for_each(|other| batch.iter().for_each(|Decoded { frame, .. }| other.take(frame)));
        rayon::join(follow_judged, follow_others);
    }

    /// SHA-256 over every image and every estimate, hex.
    fn digest(&self) -> String {
        let mut hash = Sha256::new_with_prefix(self.images.clone().finalize());
        for follower in &self.followers {
            hash.update(follower.digest());
        }
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// A decoded frame and the SHA-256 of its images.
struct Decoded {
    frame: Frame,
    digest: [u8; 32],
}

fn decode(batch: &[FrameFiles], rig: &Rig) -> Result<Vec<Decoded>, RecordError> {
    let decoded: Vec<_> = batch
        .par_iter()
        .map(|files| files.decode(rig).map(|frame| Decoded { digest: digest(&frame), frame }))
        .collect();
    // Collected twice, because rayon's own short cut returns whichever error came first on the clock.
    decoded.into_iter().collect()
}

/// SHA-256 over a frame's times, sizes and pixels.
fn digest(frame: &Frame) -> [u8; 32] {
    let Frame { rgb_time, depth_time, rgb, depth } = frame;
    let mut hash = Sha256::new();
    for (time, (width, height)) in [(rgb_time, rgb.size()), (depth_time, depth.size())] {
        hash.update(time.as_nanos().to_le_bytes());
        hash.update((width as u64).to_le_bytes());
        hash.update((height as u64).to_le_bytes());
    }
    hash.update(rgb.pixels().as_flattened());
    hash.update(depth.pixels().iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>());
    hash.finalize().into()
}

/// Whether frame `index` of `count` is kept for the report: the middles of [`SNAPSHOTS`] equal parts.
fn is_snapshot(index: usize, count: usize) -> bool {
    (0..SNAPSHOTS).any(|part| (2 * part + 1) * count / (2 * SNAPSHOTS) == index)
}

fn snapshot(frame: &Frame, follower: &Follower, rig: &Rig) -> Snapshot {
    let metres = frame.depth.pixels().iter().map(|&value| rig.depth.depth_of(value).unwrap_or(0.0) as f32);
    let (width, height) = frame.depth.size();
    Snapshot {
        time: frame.rgb_time,
        rgb: RgbImage::clone(&frame.rgb),
        depth: Image::from_pixels(width, height, metres.collect()).expect("one value a pixel"),
        tracks: follower.feature_tracks(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapshots_are_spread_evenly() {
        let kept = |count| (0..count).filter(|&index| is_snapshot(index, count)).collect::<Vec<_>>();
        assert_eq!(kept(300), [25, 75, 125, 175, 225, 275]);
        assert_eq!(kept(3), [0, 1, 2]);
        assert_eq!(kept(1), [0]);
    }
}
