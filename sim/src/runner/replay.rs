//! A recording from its first measurement to its last: images are decoded ahead while the localisers work, on a fixed
//! number of threads, and the answers are the same for any number of them.

use std::num::NonZero;

use rayon::prelude::*;
use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};
use sunblind_estimator::{Measurement, Rig};
use thiserror::Error;

use super::driven::Driven;
use super::log::RunLog;
use super::session::Session;
use crate::record::{Reading, RecordError, Recording};

/// Images decoded together. Two batches are in memory at a time, about 50 MB of Kinect images, however long the
/// recording is.
const BATCH: usize = 32;

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

/// Drives every localiser through the whole recording. They get what was measured and nothing else: the truth is looked
/// at only once they are done.
///
/// # Errors
/// The first image, in the order of arrival, that can't be decoded.
pub fn replay(recording: &Recording, localizers: Vec<Driven>, options: &ReplayOptions) -> Result<RunLog, ReplayError> {
    let pool = ThreadPoolBuilder::new().num_threads(options.threads.get()).build()?;
    let rig = &recording.rig;
    let mut session = Session::new(localizers, rig.clone(), recording.frames.len(), options.on_frame);
    pool.install(|| {
        let stream = recording.stream();
        let mut batches = batches(&stream);
        let mut load_next = || batches.next().map(|batch| load(batch, rig)).transpose();
        let mut next = load_next()?;
        while let Some(batch) = next {
            let ((), loaded) = rayon::join(|| session.take(&batch), &mut load_next);
            next = loaded?;
        }
        Ok(session.finish(recording.name.clone(), recording.warnings.clone(), &recording.truth))
    })
}

/// Portions of a stream with up to [`BATCH`] images each.
fn batches(stream: &[Reading]) -> impl Iterator<Item = &[Reading]> {
    let mut images = 0;
    stream.chunk_by(move |_, next| {
        images += usize::from(next.is_image());
        !next.is_image() || !images.is_multiple_of(BATCH)
    })
}

fn load(batch: &[Reading], rig: &Rig) -> Result<Vec<Measurement>, RecordError> {
    let loaded: Vec<_> = batch.par_iter().map(|reading| reading.load(rig)).collect();
    // Collected twice, because rayon's own short cut returns whichever error came first on the clock.
    loaded.into_iter().collect()
}
