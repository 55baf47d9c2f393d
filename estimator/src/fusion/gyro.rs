//! The turn since the last wheel reading as a gyro feels it, and the gyro's bias, learnt while the wheels stand still or
//! from what was seen.

use serde::{Deserialize, Serialize};

use super::sighted_turn::Lesson;
use crate::time::Timestamp;

/// Parameters of the gyro. The defaults describe a MEMS gyro of the P3-AT's time (ADXRS300 class: 0.1 °/s/√Hz).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GyroParams {
    /// Angle random walk, rad/√s. Data sheet class; real ones on a shaking robot may be worse.
    #[serde(rename = "noise_rad_per_sqrt_s")]
    pub noise: f64,
    /// σ of the bias before the robot has stood still for the first time, rad/s. 0.02 °/s: what 0.1 °/s/√Hz of noise leave
    /// of it when it was averaged for half a minute before. ARIA's driver averages for a second, and leaves 0.1; a raw MEMS
    /// gyro is off by a degree a second.
    #[serde(rename = "bias_rad_per_s")]
    pub bias: f64,
    /// How fast the bias wanders, rad/s/√s. Twice what Allan variances of consumers' gyros say, 0.0005 °/s/√s at most: those
    /// were taken at one temperature.
    #[serde(rename = "bias_walk_rad_per_s_per_sqrt_s")]
    pub bias_walk: f64,
    /// The bias is learnt once the wheels have stood still for so long, seconds: the chassis rocks a little after a
    /// stop.
    #[serde(rename = "rest_s")]
    pub rest: f64,
    /// A rate above this, rad/s, is no bias: somebody turns the robot whose wheels stand still.
    #[serde(rename = "max_bias_rad_per_s")]
    pub max_bias: f64,
    /// A gyro that has said nothing for so long, seconds, is left out until it speaks again.
    #[serde(rename = "max_gap_s")]
    pub max_gap: f64,
}

impl Default for GyroParams {
    fn default() -> Self {
        Self { noise: 0.0017, bias: 3.5e-4, bias_walk: 1.75e-5, rest: 0.5, max_bias: 0.1, max_gap: 0.1 }
    }
}

/// A turn and how uncertain it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// Radians.
    pub angle: f64,
    /// Of its noise, rad².
    pub variance: f64,
    /// σ of what the bias adds, radians: its sign is that of the turns' before.
    pub drift: f64,
    /// σ of what the bias has added since it was learnt, radians.
    pub drifted: f64,
}

/// Integrates the rate between wheel readings.
#[derive(Clone, Debug)]
pub(super) struct HeadingGyro {
    params: GyroParams,
    /// Newest reading: when, and rad/s.
    last: Option<(Timestamp, f64)>,
    /// Turn since the last wheel reading, with the bias in it; radians.
    angle: f64,
    /// Until when `angle` reaches, and over how many seconds.
    reached: Option<Timestamp>,
    covered: f64,
    bias: f64,
    bias_variance: f64,
    /// How long the wheels have stood still, and since when the bias has not been learnt; seconds.
    still_for: f64,
    unlearnt_for: f64,
}

impl HeadingGyro {
    pub fn new(params: GyroParams) -> Self {
        Self {
            params,
            last: None,
            angle: 0.0,
            reached: None,
            covered: 0.0,
            bias: 0.0,
            bias_variance: params.bias * params.bias,
            still_for: 0.0,
            unlearnt_for: 0.0,
        }
    }

    /// When the newest reading was taken.
    pub fn last_reading(&self) -> Option<Timestamp> {
        self.last.map(|(time, _)| time)
    }

    /// Takes one rate, rad/s counter-clockwise.
    pub fn take(&mut self, time: Timestamp, rate: f64) {
        let (before, last_rate) = self.last.replace((time, rate)).unwrap_or((time, rate));
        if time.since(before) > self.params.max_gap {
            // Across a gap nothing is known; the angle so far is kept, but no longer covers the interval.
            self.reached = Some(time);
            return;
        }
        self.reach(time, 0.5 * (last_rate + rate));
    }

    fn reach(&mut self, time: Timestamp, rate: f64) {
        let from = *self.reached.get_or_insert(time);
        let dt = time.since(from);
        if dt > 0.0 {
            self.angle += rate * dt;
            self.covered += dt;
            self.reached = Some(time);
        }
    }

    /// The turn over the `dt` seconds up to a wheel reading at `time`, and a fresh start from there; `None` when the
    /// gyro has not watched the whole interval. `moved`: whether the wheels turned.
    pub fn turn_until(&mut self, time: Timestamp, dt: f64, moved: bool) -> Option<Turn> {
        let (heard, rate) = self.last?;
        if time.since(heard) <= self.params.max_gap {
            self.reach(time, rate);
        }
        let (angle, covered) = (std::mem::take(&mut self.angle), std::mem::take(&mut self.covered));
        self.still_for = if moved { 0.0 } else { self.still_for + dt };
        self.bias_variance += self.params.bias_walk.powi(2) * dt;
        // Readings come at their own pace: a turn that covers most of the interval stands for all of it.
        if covered < 0.5 * dt || covered <= 0.0 {
            self.unlearnt_for += dt;
            return None;
        }
        let mean_rate = angle / covered;
        if self.still_for > self.params.rest && mean_rate.abs() < self.params.max_bias {
            // What a gyro at rest reads is its bias.
            self.learn(mean_rate - self.bias, self.params.noise.powi(2) / covered);
            self.unlearnt_for = 0.0;
        }
        let before = self.unlearnt_for;
        self.unlearnt_for += dt;
        Some(Turn {
            angle: (mean_rate - self.bias) * dt,
            variance: self.params.noise.powi(2) * dt,
            drift: self.bias_variance.sqrt() * dt,
            drifted: self.bias_variance.sqrt() * before,
        })
    }

    /// Scalar Kalman filter: by how much the bias seems to be larger, rad/s, and the variance of that.
    fn learn(&mut self, off: f64, variance: f64) {
        let total = self.bias_variance + variance;
        if total > 0.0 {
            let gain = self.bias_variance / total;
            self.bias += gain * off;
            self.bias_variance *= 1.0 - gain;
        }
    }

    /// From turns that were seen.
    pub fn learn_by_sight(&mut self, lesson: &Lesson) {
        let seconds = lesson.drift / self.bias_variance.sqrt();
        self.learn(lesson.error / seconds, lesson.variance / (seconds * seconds));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(secs: f64) -> Timestamp {
        Timestamp::from_secs(secs).unwrap()
    }

    /// Gyro at 100 Hz, wheels at 10 Hz, for `seconds` from `start`; the sum of the turns.
    fn run(gyro: &mut HeadingGyro, start: f64, seconds: f64, rate: impl Fn(f64) -> f64, moved: bool) -> Option<f64> {
        let mut sum = 0.0;
        for step in 1..=(seconds * 100.0).round() as usize {
            let time = start + step as f64 * 0.01;
            gyro.take(at(time), rate(time));
            if step % 10 == 0 {
                sum += gyro.turn_until(at(time), 0.1, moved)?.angle;
            }
        }
        Some(sum)
    }

    #[test]
    fn a_rate_becomes_an_angle() {
        let mut gyro = HeadingGyro::new(GyroParams::default());
        let turned = run(&mut gyro, 0.0, 10.0, |time| 0.5 * (0.3 * time).sin(), true).unwrap();
        assert!((turned - 0.5 / 0.3 * (1.0 - 3.0_f64.cos())).abs() < 1e-3, "{turned}");
    }

    #[test]
    fn the_bias_is_learnt_at_rest_and_taken_off_after() {
        let raw = GyroParams { bias: 0.02, ..GyroParams::default() };
        let mut gyro = HeadingGyro::new(raw);
        run(&mut gyro, 0.0, 5.0, |_| 0.03, false);
        let turned = run(&mut gyro, 5.0, 10.0, |_| 0.2 + 0.03, true).unwrap();
        assert!((turned - 2.0).abs() < 0.01, "{turned}");
        // A robot that is carried round turns, but its gyro has no such bias.
        let mut carried = HeadingGyro::new(raw);
        run(&mut carried, 0.0, 5.0, |_| 1.0, false);
        assert_eq!(carried.bias, 0.0);
    }

    #[test]
    fn a_silent_gyro_is_left_out_and_taken_up_again() {
        let mut gyro = HeadingGyro::new(GyroParams::default());
        run(&mut gyro, 0.0, 1.0, |_| 0.1, true);
        assert_eq!(gyro.turn_until(at(1.5), 0.5, true), None);
        assert_eq!(gyro.turn_until(at(1.6), 0.1, true), None);
        gyro.take(at(1.65), 0.1);
        gyro.take(at(1.7), 0.1);
        gyro.turn_until(at(1.7), 0.1, true);
        let turned = run(&mut gyro, 1.7, 1.0, |_| 0.1, true).unwrap();
        assert!((turned - 0.1).abs() < 1e-3);
    }
}
