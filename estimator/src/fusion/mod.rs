//! Wheels and visual odometry together (paper A, §5): `wheel_odometry` (with `arc` and `gyro`) carries the pose on,
//! the motion since a keyframe (`visual`, of all its frames `pooled`) corrects it, in an `ekf` and in an `svsf` side by
//! side, which share `filter` and `gate` and stand on the keyframe's pose (`anchored`). What was seen of a turn teaches
//! the gyro its bias (`sighted_turn`).

mod anchored;
mod arc;
mod ekf;
mod filter;
mod gate;
mod gyro;
mod planar;
mod pooled;
mod sighted_turn;
mod svsf;
mod visual;
mod wheel_odometry;

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use crate::measurement::Rejection;
use crate::time::Timestamp;
use anchored::Anchored;
use sighted_turn::SightedTurn;

pub use arc::Arc;
pub use ekf::{Ekf, KalmanGain};
pub use filter::{Gain, Innovation, Outcome, PoseFilter, RangeBearing};
pub use gate::GateParams;
pub use gyro::GyroParams;
pub use planar::{PlanarPose, UncertainPose, wrap_angle};
pub use svsf::{Svsf, SvsfGain, SvsfParams};
pub(crate) use visual::VisualOnPlane;
pub use visual::VisualPose;
pub use wheel_odometry::{Drive, Step, TurnDoubt, WheelOdometry, WheelOdometryParams};

/// Parameters of the fusion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FusionParams {
    /// What the filters are given of visual odometry.
    pub visual: VisualMeasurement,
    /// How late a frame may come after the newest wheel reading, seconds. A Kinect's frame takes 0.1 s to arrive and to
    /// be worked on.
    #[serde(rename = "max_delay_s")]
    pub max_delay: f64,
    /// How long a frame waits for the wheel reading after it, seconds; then the wheels count as silent. A P3-AT reports
    /// every 0.1 s.
    #[serde(rename = "max_wait_s")]
    pub max_wait: f64,
    /// Noise of the wheels.
    pub wheels: WheelOdometryParams,
    /// The gyro, where one is fitted.
    pub gyro: GyroParams,
    /// The smooth variable structure filter.
    pub svsf: SvsfParams,
    /// What both filters let in.
    pub gate: GateParams,
}

impl Default for FusionParams {
    fn default() -> Self {
        Self {
            visual: VisualMeasurement::SinceKeyframe,
            max_delay: 1.0,
            max_wait: 0.25,
            wheels: WheelOdometryParams::default(),
            gyro: GyroParams::default(),
            svsf: SvsfParams::default(),
            gate: GateParams::default(),
        }
    }
}

/// The measurement z of paper A's Eq. 6, of which the paper does not say where it starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VisualMeasurement {
    /// The fused pose at the last keyframe ∘ the visual motion since.
    #[default]
    SinceKeyframe,
    /// The visual pose, integrated from the first image on. The filters then follow its drift and take its error for
    /// new at each frame; for comparison.
    FreeRunning,
}

/// Odometry and the two filters over it, at the instant of the newest reading.
///
/// The filters stand at the frame that was fused last; the way since then is kept in steps. A frame is fused at its own
/// instant, between two steps or within one, and the poses are then carried to now over the steps that are left.
#[derive(Clone, Debug)]
pub struct Fusion {
    params: FusionParams,
    /// The wheels alone.
    odometry: WheelOdometry,
    /// What carries the filters on: the same, but that its gyro's bias is learnt from what is seen, too.
    wheels: WheelOdometry,
    sighted_turn: SightedTurn,
    /// Metres gone for each metre that they roll, as the newest frame has it. Not within `wheels`: it is learnt against the way
    /// that they tell.
    way_share: f64,
    ekf: Anchored<KalmanGain>,
    svsf: Anchored<SvsfGain>,
    /// Where the filters stand; `None` before anything was measured.
    filtered_until: Option<Timestamp>,
    /// The way from there, without gaps but where wheels were silent.
    steps: VecDeque<Step>,
    /// Frames newer than the wheels.
    waiting: VecDeque<VisualPose>,
    /// Whether there was a frame.
    has_fused: bool,
    /// The newest instant of a reading of either kind.
    newest: Option<Timestamp>,
}

impl Fusion {
    /// At rest at the origin.
    pub fn new(params: FusionParams, drive: Drive) -> Self {
        let start = UncertainPose::default();
        let wheels = WheelOdometry::new(drive, params.wheels, params.gyro);
        Self {
            params,
            odometry: wheels.clone(),
            wheels,
            sighted_turn: SightedTurn::default(),
            way_share: 1.0,
            ekf: Anchored::new(Ekf::new(start, params.gate)),
            svsf: Anchored::new(Svsf::new(start, params.svsf, params.gate)),
            filtered_until: None,
            steps: VecDeque::new(),
            waiting: VecDeque::new(),
            has_fused: false,
            newest: None,
        }
    }

    /// The instant that the poses are of.
    pub fn time(&self) -> Option<Timestamp> {
        self.steps.back().map(|step| step.to).or(self.filtered_until)
    }

    /// Whether the wheels have been read lately: no frame waits for them in vain.
    pub fn wheels_speak(&self) -> bool {
        let (Some(read), Some(now)) = (self.wheels.time(), self.newest) else { return false };
        now.since(read) < self.params.max_wait
    }

    /// The newest wheel reading.
    pub fn wheels_read_at(&self) -> Option<Timestamp> {
        self.wheels.time()
    }

    /// `odom_from_robot` by the wheels alone.
    pub fn odometry(&self) -> UncertainPose {
        *self.odometry.odom_from_robot()
    }

    /// Where the wheels have brought the robot, with the gyro's bias as far as it is known; for the way between two frames.
    pub fn dead_reckoning(&self) -> PlanarPose {
        self.wheels.odom_from_robot().pose
    }

    /// How far dead reckoning's heading may have strayed since the beginning.
    pub fn turn_doubt(&self) -> TurnDoubt {
        self.wheels.turn_doubt()
    }

    /// `odom_from_robot` by the extended Kalman filter.
    pub fn ekf(&self) -> UncertainPose {
        self.ekf.odom_from_robot()
    }

    /// `odom_from_robot` by the smooth variable structure filter.
    pub fn svsf(&self) -> UncertainPose {
        self.svsf.odom_from_robot()
    }

    /// Takes encoder counts.
    ///
    /// # Errors
    /// As [`WheelOdometry::handle_ticks`].
    pub fn handle_ticks(&mut self, time: Timestamp, left: i64, right: i64) -> Result<(), Rejection> {
        // Both say the same of a reading, and both must have it, even one that is refused.
        let _ = self.odometry.handle_ticks(time, left, right);
        let mut step = self.wheels.handle_ticks(time, left, right)?;
        if let Some(step) = &mut step {
            step.arc.distance *= self.way_share;
        }
        self.newest = self.newest.max(Some(time));
        let start = *self.filtered_until.get_or_insert(time);
        // Where wheels were silent the filters may have gone on without them; of a late step only the rest is new.
        let known = self.time().unwrap_or(start);
        if let Some(step) = step.filter(|step| step.to > known) {
            if step.from > known {
                self.drive(self.unseen(known, step.from));
            }
            self.drive(if step.from < known { step.split(known).1 } else { step });
        }
        self.fuse_waiting(time);
        self.forget();
        Ok(())
    }

    /// Takes the gyro's rate about the robot's z axis, rad/s.
    ///
    /// # Errors
    /// As [`WheelOdometry::handle_gyro`].
    pub fn handle_gyro(&mut self, time: Timestamp, rate: f64) -> Result<(), Rejection> {
        let _ = self.odometry.handle_gyro(time, rate);
        self.wheels.handle_gyro(time, rate)
    }

    /// Takes a frame's pose. A frame that is newer than the wheels waits for them, so that their way up to it is known.
    ///
    /// # Errors
    /// [`Rejection::OutOfOrder`] for a frame that came too late, or no later than the last one, and
    /// [`Rejection::ImpossiblePose`].
    pub fn handle_visual(&mut self, visual: VisualPose) -> Result<(), Rejection> {
        let last = self.waiting.back().map(|waiting| waiting.time).or(self.filtered_until.filter(|_| self.has_fused));
        let too_late = self.filtered_until.is_some_and(|until| visual.time < until);
        if too_late || last.is_some_and(|last| visual.time <= last) {
            return Err(Rejection::OutOfOrder);
        }
        if !visual.is_possible() {
            return Err(Rejection::ImpossiblePose);
        }
        self.newest = self.newest.max(Some(visual.time));
        self.filtered_until.get_or_insert(visual.time);
        self.waiting.push_back(visual);
        self.fuse_waiting(visual.time);
        Ok(())
    }

    /// Fuses the frames that the wheels have caught up with, and those that have waited too long at `now`.
    fn fuse_waiting(&mut self, now: Timestamp) {
        while let Some(frame) = self.waiting.front().copied() {
            let Some(known) = self.time() else { return };
            if frame.time > known {
                if now.since(frame.time) < self.params.max_wait {
                    return;
                }
                self.drive(self.unseen(known, frame.time));
            }
            self.waiting.pop_front();
            self.fuse(frame);
        }
    }

    fn fuse(&mut self, frame: VisualPose) {
        self.predict_until(frame.time);
        let free_running = self.params.visual == VisualMeasurement::FreeRunning;
        self.ekf.take(&frame, free_running);
        self.svsf.take(&frame, free_running);
        if let Some(lesson) = self.sighted_turn.see(&frame) {
            self.wheels.learn_by_sight(&lesson);
        }
        self.way_share = frame.way_share;
        self.has_fused = true;
        // Both now stand at the frame; what the wheels have told since is driven again from there.
        for index in 0..self.steps.len() {
            let step = self.steps[index];
            self.carry(&step);
        }
    }

    /// What may have happened while no wheel was read.
    fn unseen(&self, from: Timestamp, to: Timestamp) -> Step {
        Step { from, to, arc: self.params.wheels.unseen(to.since(from)) }
    }

    fn drive(&mut self, step: Step) {
        self.carry(&step);
        self.steps.push_back(step);
    }

    fn carry(&mut self, step: &Step) {
        self.ekf.carry(&step.arc);
        self.svsf.carry(&step.arc);
    }

    /// Moves the filters along the steps up to an instant.
    fn predict_until(&mut self, time: Timestamp) {
        while let Some(step) = self.steps.pop_front() {
            if step.from >= time {
                self.steps.push_front(step);
                break;
            }
            let (before, after) = step.split(time.min(step.to));
            self.ekf.predict(&before.arc);
            self.svsf.predict(&before.arc);
            self.sighted_turn.drive(&before.arc);
            if after.to > after.from {
                self.steps.push_front(after);
                break;
            }
        }
        self.filtered_until = Some(time);
    }

    /// Gives up the steps that no frame can come for any more.
    fn forget(&mut self) {
        let Some(newest) = self.steps.back().map(|step| step.to) else { return };
        let max_delay = self.params.max_delay;
        let Some(old) = self.steps.iter().take_while(|step| newest.since(step.to) > max_delay).last() else { return };
        self.predict_until(old.to);
        for index in 0..self.steps.len() {
            let step = self.steps[index];
            self.carry(&step);
        }
    }
}

#[cfg(test)]
mod tests;
