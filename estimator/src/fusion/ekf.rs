//! The extended Kalman filter (paper A, Eqs. 5–11).

use nalgebra::{Matrix3, Matrix3x2};

use super::filter::{Gain, Innovation, PoseFilter};
use super::gate::GateParams;
use super::planar::UncertainPose;

/// The gain with the least mean square error, were all noise as it is said to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct KalmanGain;

/// Extended Kalman filter over (x, y, heading).
pub type Ekf = PoseFilter<KalmanGain>;

impl Ekf {
    /// Starts from an estimate.
    pub fn new(start: UncertainPose, gate: GateParams) -> Self {
        Self::with_gain(start, KalmanGain, gate)
    }
}

impl Gain for KalmanGain {
    /// K = P Hᵀ (H P Hᵀ + R)⁻¹ (Eq. 9).
    fn for_pose(&self, seen: &Innovation<3>) -> Option<Matrix3<f64>> {
        Some(seen.predicted * seen.covariance().try_inverse()?)
    }

    fn for_landmark(&self, seen: &Innovation<2>) -> Option<Matrix3x2<f64>> {
        Some(seen.predicted * seen.jacobian.transpose() * seen.covariance().try_inverse()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fusion::{Outcome, PlanarPose, RangeBearing};
    use adskalman::{CovarianceUpdateMethod, ObservationModel, StateAndCovariance, TransitionModelLinearNoControl};
    use nalgebra::{Matrix2, Point2, U3, Vector2, Vector3};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// A step that leaves the state as it is, and a measurement of all of it, for the crate that serves as oracle.
    struct Linear {
        identity: Matrix3<f64>,
        noise: Matrix3<f64>,
    }

    #[allow(non_snake_case)]
    impl TransitionModelLinearNoControl<f64, U3> for Linear {
        fn F(&self) -> &Matrix3<f64> {
            &self.identity
        }
        fn FT(&self) -> &Matrix3<f64> {
            &self.identity
        }
        fn Q(&self) -> &Matrix3<f64> {
            &self.noise
        }
    }

    #[allow(non_snake_case)]
    impl ObservationModel<f64, U3, U3> for Linear {
        fn H(&self) -> &Matrix3<f64> {
            &self.identity
        }
        fn HT(&self) -> &Matrix3<f64> {
            &self.identity
        }
        fn R(&self) -> &Matrix3<f64> {
            &self.noise
        }
    }

    #[test]
    fn with_a_certain_heading_it_is_the_linear_kalman_filter() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut number = move || random.random_range(-1.0..1.0);
        let mut ekf = Ekf::new(UncertainPose::default(), GateParams::open());
        let mut oracle = StateAndCovariance::new(Vector3::zeros(), Matrix3::zeros());
        for _ in 0..200 {
            let (identity, mut root) = (Matrix3::identity(), Matrix3::from_fn(|_, _| 0.2 * number()));
            // No noise on the heading: with a certain one everything is linear.
            root.row_mut(2).fill(0.0);
            let motion =
                UncertainPose { pose: PlanarPose::new(number(), number(), 0.0), covariance: root * root.transpose() };
            ekf.predict(&motion);
            oracle = Linear { identity, noise: motion.covariance }.predict(&oracle);
            *oracle.state_mut() += motion.pose.to_vector();

            let root = Matrix3::from_fn(|_, _| 0.3 * number());
            let noise = root * root.transpose() + identity * 0.01;
            let away = Vector3::new(number(), number(), number());
            let measured = UncertainPose { pose: ekf.estimate().pose.plus(&away), covariance: noise };
            assert_eq!(ekf.update_pose(&measured), Outcome::Fused);
            let joseph = CovarianceUpdateMethod::JosephForm;
            oracle = Linear { identity, noise }.update(&oracle, &measured.pose.to_vector(), joseph).unwrap();

            assert!((ekf.estimate().pose.to_vector() - oracle.state()).norm() < 1e-9);
            assert!((ekf.estimate().covariance - oracle.covariance()).norm() < 1e-9);
        }
    }

    #[test]
    fn the_update_is_the_information_filters() {
        // P⁻¹ + Hᵀ R⁻¹ H, the other textbook form, with a heading that is uncertain.
        let root = Matrix3::new(0.3, 0.0, 0.0, 0.1, 0.2, 0.0, -0.05, 0.1, 0.15);
        let start = UncertainPose { pose: PlanarPose::new(1.0, 2.0, 0.5), covariance: root * root.transpose() };
        let mut ekf = Ekf::new(start, GateParams::open());
        let noise = Matrix3::from_diagonal(&Vector3::new(0.04, 0.01, 0.02));
        let away = Vector3::new(0.1, -0.2, 0.05);
        ekf.update_pose(&UncertainPose { pose: start.pose.plus(&away), covariance: noise });
        let (prior, measured) = (start.covariance.try_inverse().unwrap(), noise.try_inverse().unwrap());
        let covariance = (prior + measured).try_inverse().unwrap();
        assert!((ekf.estimate().covariance - covariance).norm() < 1e-12);
        assert!((ekf.estimate().pose.minus(&start.pose) - covariance * measured * away).norm() < 1e-12);
    }

    #[test]
    fn landmarks_bring_the_pose_home() {
        let truth = PlanarPose::new(0.3, -0.2, 3.0);
        let start = UncertainPose { pose: PlanarPose::new(0.0, 0.0, -3.1), covariance: Matrix3::identity() * 0.1 };
        let mut ekf = Ekf::new(start, GateParams::open());
        for round in 0..20 {
            let landmark = Point2::new(3.0 * f64::from(round % 3) - 3.0, 2.0);
            let seen = Vector2::new(landmark.x - truth.x, landmark.y - truth.y);
            let sighting = RangeBearing {
                range: seen.norm(),
                bearing: seen.y.atan2(seen.x) - truth.heading,
                covariance: Matrix2::from_diagonal(&Vector2::new(0.01, 0.0025)),
            };
            assert_eq!(ekf.update_landmark(&sighting, &landmark), Outcome::Fused);
        }
        assert!(ekf.estimate().pose.minus(&truth).norm() < 0.02, "{:?}", ekf.estimate());
        // On the landmark itself there is no bearing.
        let here = Point2::new(ekf.estimate().pose.x, ekf.estimate().pose.y);
        let sighting = RangeBearing { range: 1.0, bearing: 0.0, covariance: Matrix2::identity() };
        assert_eq!(ekf.update_landmark(&sighting, &here), Outcome::Unusable);
    }

    #[test]
    fn a_gate_finds_its_way_back() {
        let gate = GateParams { enabled: true, ..GateParams::default() };
        let start = UncertainPose { covariance: Matrix3::identity() * 1e-4, ..UncertainPose::default() };
        let mut ekf = Ekf::new(start, gate);
        let far = UncertainPose { pose: PlanarPose::new(1.0, 0.0, 0.0), covariance: Matrix3::identity() * 1e-4 };
        for _ in 0..gate.max_refusals {
            assert_eq!(ekf.update_pose(&far), Outcome::Gated);
        }
        // Both are as sure, and one is wrong: half way, and as unsure as that. The next time it is let in as it is.
        assert_eq!(ekf.update_pose(&far), Outcome::Fused);
        assert!((ekf.estimate().pose.x - 0.5).abs() < 1e-9, "{:?}", ekf.estimate());
        assert_eq!(ekf.update_pose(&far), Outcome::Fused);
        assert!((ekf.estimate().pose.x - 1.0).abs() < 0.01, "{:?}", ekf.estimate());
    }
}
