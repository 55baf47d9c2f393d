//! The Kinect on a thread of its own: it renders a frame while the robot drives on and the estimator thinks.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use cpu_time::ThreadTime;
use nalgebra::Isometry3;
use rayon::ThreadPoolBuilder;
use sunblind_estimator::image::Image;
use sunblind_estimator::{MeasurementData, Timestamp};

use super::video::Carried;
use crate::kinect::{Kinect, KinectFrame};
use crate::light::LightState;
use crate::modes::{DEPTH_STEP, Information, Seen};
use crate::render::{Adapter, RenderError, Sweep};

/// One frame's images, of one instant.
pub(super) struct Images {
    pub captured_at: Timestamp,
    /// Those that the device's streams carried.
    pub data: Vec<MeasurementData>,
    /// What there was in all of them, for the judge.
    pub information: Information,
    /// What finding depth in the infrared image took.
    pub depth_cost: Duration,
}

struct Order {
    captured_at: Timestamp,
    world_from_infrared: Sweep,
    light: LightState,
    carried: Carried,
    covered: bool,
    frame: u64,
}

/// A Kinect that is told where it is and answers later, in the same order.
pub(super) struct Eye {
    adapter: Adapter,
    orders: Option<Sender<Order>>,
    answers: Receiver<Result<Images, RenderError>>,
    worker: Option<JoinHandle<()>>,
    /// Captured, but not asked for yet.
    open: VecDeque<Timestamp>,
    ordered: u64,
}

impl Eye {
    /// Opens it. With `true_depth`, depth is geometry instead of what the device makes of its infrared image.
    pub fn open(mut kinect: Kinect, true_depth: bool) -> Self {
        let adapter = kinect.adapter().clone();
        let (orders, received) = channel::<Order>();
        let (answer, answers) = channel();
        let work = move || {
            // Depth is found by this thread alone: the other cores are the estimator's and the renderer's. Should the
            // pool not be had, all cores help, with the same result.
            let _pool = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
            for order in received {
                if answer.send(capture(&mut kinect, order, true_depth)).is_err() {
                    return;
                }
            }
        };
        let worker = std::thread::spawn(work);
        Self { adapter, orders: Some(orders), answers, worker: Some(worker), open: VecDeque::new(), ordered: 0 }
    }

    /// What renders.
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// Has a frame taken, exposed about `captured_at`, with a hand on the device or without.
    pub fn capture(
        &mut self,
        captured_at: Timestamp,
        world_from_infrared: Sweep,
        light: LightState,
        carried: Carried,
        covered: bool,
    ) {
        let order = Order { captured_at, world_from_infrared, light, carried, covered, frame: self.ordered };
        self.ordered += 1;
        self.open.push_back(captured_at);
        if let Some(orders) = &self.orders {
            // Without a worker the answer will tell.
            let _ = orders.send(order);
        }
    }

    /// When the oldest frame was captured that nobody has asked for.
    pub fn oldest(&self) -> Option<Timestamp> {
        self.open.front().copied()
    }

    /// Waits for that frame.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    ///
    /// # Panics
    /// When the worker did, or there is no such frame.
    pub fn wait(&mut self) -> Result<Images, RenderError> {
        self.open.pop_front().expect("somebody asked for a frame that was never taken");
        match self.answers.recv() {
            Ok(images) => images,
            Err(_) => match self.worker.take().map(JoinHandle::join) {
                Some(Err(panic)) => std::panic::resume_unwind(panic),
                _ => unreachable!("the worker ends only with its orders"),
            },
        }
    }
}

impl Drop for Eye {
    fn drop(&mut self) {
        self.orders = None;
        // A frame that nobody waits for any more is finished, so that the adapter is let go in order.
        let _ = self.worker.take().map(JoinHandle::join);
    }
}

fn capture(kinect: &mut Kinect, order: Order, true_depth: bool) -> Result<Images, RenderError> {
    kinect.illuminate(&order.light);
    kinect.cover(order.covered);
    let exposed = kinect.expose(&order.world_from_infrared, order.frame)?;
    let chips = kinect.chips();
    let started = ThreadTime::now();
    let KinectFrame { rgb, infrared, mut depth_raw } = kinect.develop(&exposed)?;
    let depth_cost = started.elapsed();
    if true_depth {
        let depth = kinect.true_depth()?;
        let raw = depth.pixels().iter().map(|&z| kinect.calibration().raw_of(f64::from(z))).collect();
        depth_raw = Image::from_pixels(depth.width(), depth.height(), raw).expect("one value a pixel");
    }
    let information = Information::of(&Seen {
        rgb: &rgb,
        infrared: &infrared,
        depth: &depth_raw,
        chips,
        depth_camera: &kinect.calibration().rig(Isometry3::identity()).depth,
        true_depth: &kinect.true_depth_of_every(DEPTH_STEP)?,
    });
    let mut data = vec![MeasurementData::Depth(Arc::new(depth_raw))];
    data.extend(order.carried.colour.then(|| MeasurementData::Rgb(Arc::new(rgb))));
    data.extend(order.carried.infrared.then(|| MeasurementData::Infrared(Arc::new(infrared))));
    Ok(Images { captured_at: order.captured_at, data, information, depth_cost })
}
