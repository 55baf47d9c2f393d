//! A furnished room, a camera carried through it, and its recording with known truth, made in seconds on the CPU: for
//! the demo, and for tests on machines that have no real recording.
//!
//! It stands in until the renderer can synthesise the device's infrared image. What it lacks: depth is geometry plus
//! published errors, not matched dots; both images are taken at one instant, without rolling shutter
//! or automatic exposure; surfaces are matt; sunlight does not disturb it.
//!
//! The room is the same every time; the seed changes the sensors' noise only. From bottom to top: `noise`, `material`
//! with its patterns (`surface`, `print`, `art`, `drawing`), `solid` and `scene` (what a ray meets), `layout` with its
//! `furniture` and `things`, `light`, `texture` and `lit_scene` (light baked onto surfaces, since nothing moves but the
//! camera), `lens`, `colour` and `depth` (the cameras), `path`.

mod art;
mod colour;
mod depth;
mod drawing;
mod furniture;
mod layout;
mod lens;
mod light;
mod lit_scene;
mod material;
mod noise;
mod path;
mod print;
mod rig;
mod scenario;
mod scene;
mod solid;
mod surface;
#[cfg(test)]
mod tests;
mod texture;
mod things;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::Isometry3;
use rayon::prelude::*;
use sunblind_estimator::image::{DepthImage, RgbImage};
use sunblind_estimator::{Measurement, MeasurementData, Rig, Timestamp};

use crate::evaluation::StampedPose;
use crate::random::stream;
use crate::record::writer::{RecordingWriter, WriteError};
use crate::record::{Body, Calibration, Latency};
use colour::{ColourCamera, SAMPLES};
use depth::DepthSensor;
use layout::furnished_room;
use lit_scene::{LitScene, Pose};

pub use path::world_from_camera;
pub use rig::{BASELINE, rig};
pub use scenario::Scenario;

/// How long the colour camera's shutter is open, seconds; a guess for a room in daylight.
const EXPOSURE: f64 = 0.010;

/// The room, lit, and the device in it.
pub struct TexturedRoom {
    scene: LitScene,
    rig: Rig,
    colour: ColourCamera,
    depth: DepthSensor,
}

/// What the device delivers at one instant, and where it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Colour image.
    pub rgb: RgbImage,
    /// Depth image, in the depth camera's pixels.
    pub depth: DepthImage,
    /// True pose of the depth camera in the middle of the exposure.
    pub world_from_depth: Isometry3<f64>,
}

impl TexturedRoom {
    /// Builds and lights the room: a few seconds of computing, shared by all threads.
    pub fn new() -> Self {
        let rig = rig();
        let (colour, depth) = (ColourCamera::new(&rig.colour), DepthSensor::new(&rig.depth.model));
        Self { scene: LitScene::new(furnished_room()), rig, colour, depth }
    }

    /// The cameras.
    pub fn rig(&self) -> &Rig {
        &self.rig
    }

    /// Frame number `index` of a scenario. Frames don't depend on each other.
    pub fn frame(&self, scenario: &Scenario, index: usize) -> Frame {
        let noise = |name, wanted: bool| wanted.then(|| stream(scenario.seed, name, index as u64));
        let time = scenario.time_of(index);
        let world_from_depth = world_from_camera(time);
        let depth_from_colour = self.rig.colour_from_depth.inverse();
        let during_exposure = std::array::from_fn(|sample: usize| {
            let when: f64 = time + EXPOSURE * SAMPLES[sample].when;
            Pose::from(&(world_from_camera(when) * depth_from_colour))
        });
        Frame {
            rgb: self.colour.shoot(&self.scene, &during_exposure, noise("colour noise", scenario.kinect.colour_noise)),
            depth: self.depth.shoot(
                self.scene.geometry(),
                &Pose::from(&world_from_depth),
                noise("depth noise", scenario.kinect.depth_noise),
            ),
            world_from_depth,
        }
    }
}

impl Default for TexturedRoom {
    fn default() -> Self {
        Self::new()
    }
}

/// Records a scenario into the folder `out`; `progress` hears (frames done, frames in all) after each frame, from any
/// thread. Equal scenarios give equal bytes, however many threads there are.
///
/// # Errors
/// When `out` holds something else than a recording, or the disk refuses; then nothing is left behind.
pub fn record(scenario: &Scenario, out: &Path, progress: impl Fn(usize, usize) + Sync) -> Result<(), WriteError> {
    // The truth is the depth camera's.
    let calibration = Calibration { rig: rig(), body: Body::Depth, latency: Latency::default() };
    let writer = RecordingWriter::create(out, &calibration)?;
    let room = TexturedRoom::new();
    let (done, frames) = (AtomicUsize::new(0), scenario.frames());
    // Whole frames in parallel: no thread waits for another, and drawing overlaps with compressing.
    let truth = (0..frames)
        .into_par_iter()
        .map(|index| {
            let time = Timestamp::from_nanos((scenario.time_of(index) * 1e9).round() as i64);
            let Frame { rgb, depth, world_from_depth } = room.frame(scenario, index);
            for data in [MeasurementData::Rgb(Arc::new(rgb)), MeasurementData::Depth(Arc::new(depth))] {
                writer.write(&Measurement { captured_at: time, available_at: time, data })?;
            }
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, frames);
            Ok(StampedPose { time, world_from_body: world_from_depth })
        })
        .collect::<Result<Vec<_>, WriteError>>()?;
    truth.iter().try_for_each(|pose| writer.write_truth(pose))?;
    writer.finish()
}
