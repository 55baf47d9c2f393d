//! What the filters take from visual odometry: the motion since its keyframe, brought down to the plane.

use nalgebra::{Isometry3, Matrix3, Matrix6};

use super::planar::UncertainPose;
use crate::geometry::adjoint;
use crate::time::Timestamp;

/// The least σ of a visual motion, metres and radians: below it depth errors that all frames share are larger than any
/// noise. A guess, a tenth of a Kinect's step at 1 m.
const LEAST_SIGMA: f64 = 3e-4;

/// No number of a pose or its covariance is larger, metres and radians: the earth is 4e7 m round.
const LARGEST: f64 = 1e8;

/// One frame's pose as visual odometry has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisualPose {
    /// When the frame was captured.
    pub time: Timestamp,
    /// The robot in the frame where it was at the first image.
    pub start_from_robot: Isometry3<f64>,
    /// Covariance of a left perturbation (ρ, φ), in the start frame; contains the keyframe's own.
    pub covariance: Matrix6<f64>,
    /// Whether the frame's motion was found; otherwise the pose is an old one.
    pub tracked: bool,
    /// Whether the frames after this one are measured against it.
    pub keyframe: bool,
    /// What the variance of the motion since the keyframe is to be multiplied by: 1, or more where the images it rests on
    /// are of doubtful use.
    pub doubt: f64,
    /// What is left, in the motion since the keyframe, of the difference between the turn that was seen and the one by the
    /// wheels and gyro: 1, or less where the pose is a compromise of both.
    pub turn_share: f64,
    /// Metres gone for each metre that the wheels roll, as far as was seen of the ground; 1 where nothing was.
    pub way_share: f64,
    /// σ of what the length of the way since the keyframe shares with that of the ways before, as a share of it; 0 where
    /// each is measured by itself.
    pub shared_sigma: f64,
}

impl VisualPose {
    /// A keyframe whose motion was found, in images that nobody doubts and without the wheels' help.
    pub fn keyframe(time: Timestamp, start_from_robot: Isometry3<f64>, covariance: Matrix6<f64>) -> Self {
        let (doubt, turn_share, way_share, shared_sigma) = (1.0, 1.0, 1.0, 0.0);
        let (tracked, keyframe) = (true, true);
        Self { time, start_from_robot, covariance, tracked, keyframe, doubt, turn_share, way_share, shared_sigma }
    }

    /// `keyframe_from_robot` in the plane of `keyframe`'s robot. Only what came after the keyframe is in the covariance,
    /// and the tilt that the pose may have gathered before is in neither.
    pub(super) fn since(&self, keyframe: &Self) -> UncertainPose {
        let keyframe_from_start = keyframe.start_from_robot.inverse();
        let keyframe_from_robot = keyframe_from_start * self.start_from_robot;
        let carry = adjoint(&keyframe_from_start);
        let on_plane = |covariance: &Matrix6<f64>| {
            let mut planar =
                UncertainPose::from_isometry(&keyframe_from_robot, &(carry * covariance * carry.transpose()));
            planar.covariance += Matrix3::from_diagonal_element(LEAST_SIGMA * LEAST_SIGMA);
            planar
        };
        let since = on_plane(&(self.covariance - keyframe.covariance));
        // A pose that is surer than its keyframe was not measured from it: then its own covariance has to do.
        let mut since = if since.covariance.cholesky().is_some() { since } else { on_plane(&self.covariance) };
        since.covariance *= self.doubt;
        since
    }

    /// Whether a robot may have it: finite numbers, small enough that no square of them runs over.
    pub(super) fn is_possible(&self) -> bool {
        let pose = &self.start_from_robot;
        let numbers = pose.translation.vector.iter().chain(pose.rotation.coords.iter());
        numbers
            .chain(self.covariance.iter())
            .chain([&self.doubt, &self.turn_share, &self.way_share, &self.shared_sigma])
            .all(|value| value.abs() < LARGEST)
    }
}

/// Visual odometry of a robot on wheels: brought down to the plane from keyframe to keyframe, as the filters take it. In
/// space, the tilt that it gathers on the way would bend all that comes after.
#[derive(Clone, Debug, Default)]
pub(crate) struct VisualOnPlane {
    keyframe: Option<VisualPose>,
    start_from_keyframe: UncertainPose,
}

impl VisualOnPlane {
    /// `start_from_robot` at a frame.
    pub fn take(&mut self, frame: &VisualPose) -> UncertainPose {
        let since = self.keyframe.map_or_else(UncertainPose::default, |keyframe| frame.since(&keyframe));
        let start_from_robot = self.start_from_keyframe.compose(&since);
        if frame.keyframe || self.keyframe.is_none() {
            (self.keyframe, self.start_from_keyframe) = (Some(*frame), start_from_robot);
        }
        start_from_robot
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::planar::PlanarPose;
    use crate::geometry::exp_se3;
    use nalgebra::Vector6;

    #[test]
    fn only_the_way_since_the_keyframe_counts() {
        let time = Timestamp::from_nanos(0);
        // Four metres off and tilted by what has gathered on the way.
        let start_from_robot = exp_se3(&Vector6::new(4.0, 1.0, 0.1, 0.02, -0.03, 0.8));
        let keyframe = VisualPose::keyframe(time, start_from_robot, Matrix6::identity() * 0.04);
        let motion = PlanarPose::new(0.1, 0.02, 0.05);
        let start_from_robot = keyframe.start_from_robot * motion.to_isometry();
        // A millimetre each way at the robot, a milliradian of turn about it.
        let carry = adjoint(&start_from_robot);
        let covariance = keyframe.covariance + carry * (Matrix6::identity() * 1e-6) * carry.transpose();
        let since = VisualPose { start_from_robot, covariance, ..keyframe }.since(&keyframe);
        assert!(since.pose.minus(&motion).norm() < 1e-9);
        let expected = Matrix3::identity() * (1e-6 + LEAST_SIGMA * LEAST_SIGMA);
        assert!((since.covariance - expected).norm() < 1e-8, "{}", since.covariance);
        let doubtful = VisualPose { start_from_robot, covariance, doubt: 4.0, ..keyframe }.since(&keyframe);
        assert!((doubtful.covariance - since.covariance * 4.0).norm() < 1e-12);
        let surer = VisualPose { covariance: Matrix6::identity() * 0.01, ..keyframe };
        assert!(surer.since(&keyframe).covariance.cholesky().is_some());
    }

    #[test]
    fn a_tilt_that_has_gathered_does_not_bend_the_way() {
        let mut on_plane = VisualOnPlane::default();
        let frame = |start_from_robot: Isometry3<f64>, keyframe: bool| VisualPose {
            keyframe,
            ..VisualPose::keyframe(Timestamp::from_nanos(0), start_from_robot, Matrix6::identity() * 0.04)
        };
        // Half a radian of roll and pitch: in space a metre ahead is 88 cm seen from above.
        let mut tilted = exp_se3(&Vector6::new(0.0, 0.0, 0.0, 0.2, -0.5, 0.0));
        let step = PlanarPose::new(0.1, 0.0, 0.1);
        let mut expected = PlanarPose::default();
        on_plane.take(&frame(tilted, true));
        for number in 1..=20 {
            (tilted, expected) = (tilted * step.to_isometry(), expected * step);
            let found = on_plane.take(&frame(tilted, number % 3 == 0));
            assert!(found.pose.minus(&expected).norm() < 1e-9, "{found:?}");
        }
    }
}
