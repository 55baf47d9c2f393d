//! A gyro's or an accelerometer's errors: a bias drawn at switch-on, its random walk, white noise.

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// How wrong a three-axis sensor is. In the sensor's own unit u: rad/s for a gyro, m/s² for an accelerometer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertialNoise {
    /// Standard deviation of the bias at switch-on, u.
    pub bias: f64,
    /// How the bias wanders, u/√s.
    pub bias_walk: f64,
    /// White noise, u/√Hz.
    pub density: f64,
}

impl InertialNoise {
    /// A gyro as it was sold for Pioneers. Noise: ADXRS300's data sheet, 0.1 °/s/√Hz. Bias: what that noise leaves of it after
    /// the robot has stood for 100 s, a guess; ARIA's driver waits three seconds and averages one. Walk: the largest of
    /// those published of consumers' MEMS gyros, by their Allan variance: 0.00023 (Kalibr's ADIS16448) to 0.0005 °/s/√s (a
    /// tracker's, in libsurvive's wiki).
    pub fn pioneer_gyro() -> Self {
        let [density, walk] = [0.1_f64, 0.0005].map(f64::to_radians);
        Self { bias: density / 100.0_f64.sqrt(), bias_walk: walk, density }
    }

    /// A consumer's MEMS accelerometer, 300 µg/√Hz; all three figures are guesses.
    pub fn mems_accelerometer() -> Self {
        Self { bias: 0.05, bias_walk: 1e-3, density: 300e-6 * 9.81 }
    }

    /// Without any error.
    pub const fn ideal() -> Self {
        Self { bias: 0.0, bias_walk: 0.0, density: 0.0 }
    }
}

/// The sensor at work.
#[derive(Clone, Debug)]
pub struct InertialSensor {
    noise: InertialNoise,
    bias: Vector3<f64>,
    random: ChaCha8Rng,
}

impl InertialSensor {
    /// Switched on: the bias is drawn.
    pub fn new(noise: InertialNoise, mut random: ChaCha8Rng) -> Self {
        let bias = normal(&mut random) * noise.bias;
        Self { noise, bias, random }
    }

    /// The reading when `truth` held during the last `duration` seconds. One reading's noise is the mean of white
    /// noise over that time, so that two readings of 5 ms averaged are one of 10 ms.
    pub fn read(&mut self, truth: &Vector3<f64>, duration: f64) -> Vector3<f64> {
        self.bias += normal(&mut self.random) * self.noise.bias_walk * duration.sqrt();
        truth + self.bias + normal(&mut self.random) * (self.noise.density / duration.sqrt())
    }
}

fn normal(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| StandardNormal.sample(random))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    /// Mean and standard deviation of the x axis.
    fn statistics(readings: &[Vector3<f64>]) -> (f64, f64) {
        let count = readings.len() as f64;
        let mean = readings.iter().map(|reading| reading.x).sum::<f64>() / count;
        let variance = readings.iter().map(|reading| (reading.x - mean).powi(2)).sum::<f64>() / count;
        (mean, variance.sqrt())
    }

    #[test]
    fn white_noise_has_its_density() {
        let noise = InertialNoise { density: 0.02, ..InertialNoise::ideal() };
        let mut sensor = InertialSensor::new(noise, stream(1, "gyro", 0));
        let readings: Vec<_> = (0..20_000).map(|_| sensor.read(&Vector3::x(), 0.005)).collect();
        let (mean, deviation) = statistics(&readings);
        assert!((mean - 1.0).abs() < 0.01, "mean {mean}");
        assert!((deviation / (0.02 / 0.005_f64.sqrt()) - 1.0).abs() < 0.03, "deviation {deviation}");
    }

    #[test]
    fn the_bias_wanders_as_told() {
        let noise = InertialNoise { bias_walk: 0.1, ..InertialNoise::ideal() };
        let ends: Vec<_> = (0..2000)
            .map(|run| {
                let mut sensor = InertialSensor::new(noise, stream(1, "gyro", run));
                (0..100).fold(Vector3::zeros(), |_, _| sensor.read(&Vector3::zeros(), 0.04))
            })
            .collect();
        // After 4 s: 0.1 · √4.
        let (_, deviation) = statistics(&ends);
        assert!((deviation / 0.2 - 1.0).abs() < 0.06, "deviation {deviation}");
    }

    #[test]
    fn an_ideal_sensor_tells_the_truth() {
        let mut sensor = InertialSensor::new(InertialNoise::ideal(), stream(1, "gyro", 0));
        let truth = Vector3::new(0.1, -0.2, 9.81);
        assert_eq!(sensor.read(&truth, 0.005), truth);
    }
}
