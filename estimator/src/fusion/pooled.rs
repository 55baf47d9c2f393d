//! The motion since a keyframe, as all frames since then say it together.
//!
//! The frames of one keyframe share its error, and each has one of its own: both see the same landmarks with the same
//! noise. The shared half stays however many frames there are; the own half averages out. Between the frames the wheels
//! carry on what was seen, so that neither a frame in doubt nor one that is wrong takes the place of better ones before it.

use nalgebra::Matrix3;

use super::planar::{UncertainPose, symmetric};

/// Share of a motion's variance that is its frame's own. A guess where most of it is calibration's, which is all shared.
const OWN_SHARE: f64 = 0.5;
/// Largest squared Mahalanobis distance between a frame and those before it, χ² of 99 %. Beyond it one of the two is wrong.
const CONTRADICTION: f64 = 11.34;

/// `keyframe_from_robot` as one or more frames have it.
#[derive(Clone, Copy, Debug)]
struct Sight {
    /// With the frames' own error alone.
    motion: UncertainPose,
    /// Covariance of the error that they share.
    shared: Matrix3<f64>,
}

impl Sight {
    fn of(measured: &UncertainPose) -> Self {
        Self {
            motion: UncertainPose { covariance: measured.covariance * OWN_SHARE, ..*measured },
            shared: measured.covariance * (1.0 - OWN_SHARE),
        }
    }

    fn carried(&self, step: &UncertainPose) -> Self {
        Self { motion: self.motion.carried(step), ..*self }
    }

    /// For the filters: with both errors.
    fn measurement(&self) -> UncertainPose {
        UncertainPose { covariance: self.motion.covariance + self.shared, ..self.motion }
    }

    /// `None` where the two contradict each other.
    fn joined(&self, newest: &Self) -> Option<Self> {
        let error = newest.motion.pose.minus(&self.motion.pose);
        let information = (self.motion.covariance + newest.motion.covariance).try_inverse()?;
        if error.dot(&(information * error)) > CONTRADICTION {
            return None;
        }
        let gain = self.motion.covariance * information;
        let covariance = symmetric(&(self.motion.covariance - gain * self.motion.covariance));
        let motion = UncertainPose { pose: self.motion.pose.plus(&(gain * error)), covariance };
        // One error, felt in each frame as strongly as its σ says: of the mean it has no more than the mean variance.
        let weight = gain.trace() / 3.0;
        Some(Self { motion, shared: self.shared * (1.0 - weight) + newest.shared * weight })
    }
}

/// `keyframe_from_robot` as all frames since the keyframe have it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pooled {
    /// `None` before the first frame.
    sight: Option<Sight>,
    is_contradicted: bool,
}

impl Pooled {
    /// After a step of the wheels.
    pub fn carried(&self, step: &UncertainPose) -> Self {
        Self { sight: self.sight.map(|sight| sight.carried(step)), ..*self }
    }

    /// Takes one more frame; what all say then, with its covariance. One frame that contradicts those before is left out. If
    /// the next one does so, too, it stands alone: by then they may be what is wrong, or the wheels that carried them on.
    pub fn take(&mut self, measured: &UncertainPose) -> UncertainPose {
        let newest = Sight::of(measured);
        let joined = self.sight.map_or(Some(newest), |sight| sight.joined(&newest));
        self.is_contradicted = joined.is_none() && !self.is_contradicted;
        if !self.is_contradicted {
            self.sight = Some(joined.unwrap_or(newest));
        }
        self.sight.unwrap_or(newest).measurement()
    }

    /// Whether the newest frame was left out.
    pub fn is_contradicted(&self) -> bool {
        self.is_contradicted
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::PlanarPose;

    fn seen(x: f64, sigma: f64) -> UncertainPose {
        UncertainPose { pose: PlanarPose::new(x, 0.0, 0.0), covariance: Matrix3::from_diagonal_element(sigma * sigma) }
    }

    #[test]
    fn of_many_frames_the_own_error_averages_out_and_the_shared_one_stays() {
        let (count, sigma) = (16, 0.01);
        let mut pooled = Pooled::default();
        let found = (0..count).map(|number| pooled.take(&seen(0.004 * f64::from(number % 2), sigma))).last().unwrap();
        assert!((found.pose.x - 0.002).abs() < 1e-9, "{found:?}");
        let expected = sigma * sigma * (1.0 - OWN_SHARE + OWN_SHARE / f64::from(count));
        assert!((found.covariance - Matrix3::from_diagonal_element(expected)).norm() < 1e-9, "{found:?}");
    }

    #[test]
    fn a_doubtful_frame_does_not_take_the_place_of_a_good_one() {
        let mut pooled = Pooled::default();
        pooled.take(&seen(0.1, 0.003));
        // 3 cm on by the wheels, within a millimetre; the next frame is 2 cm off and says that it may be.
        let found = pooled.carried(&seen(0.03, 0.001)).take(&seen(0.15, 0.03));
        assert!((found.pose.x - 0.13).abs() < 0.001, "{found:?}");
        assert!(found.covariance[(0, 0)].sqrt() < 0.004, "{found:?}");
    }

    #[test]
    fn one_frame_that_contradicts_is_left_out_and_a_second_is_believed() {
        let mut pooled = Pooled::default();
        let [here, there, elsewhere] = [0.1, 0.2, 0.3].map(|x| seen(x, 0.003));
        let mut take = |frame: &UncertainPose| (pooled.take(frame).pose.x, pooled.is_contradicted());
        assert_eq!([&here, &there, &here].map(&mut take), [(0.1, false), (0.1, true), (0.1, false)]);
        assert_eq!([&there, &elsewhere, &elsewhere].map(&mut take), [(0.1, true), (0.3, false), (0.3, false)]);
    }
}
