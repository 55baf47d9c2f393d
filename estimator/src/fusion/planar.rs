//! Poses in the plane that the robot drives on, and how uncertain they are.

use std::f64::consts::PI;
use std::ops::Mul;

use nalgebra::{Isometry3, Matrix3, Matrix6, SMatrix, Translation3, UnitQuaternion, Vector3};

/// The same direction within [−π, π].
pub fn wrap_angle(angle: f64) -> f64 {
    // Within the range nothing is to be done, and nothing is: two trips through sine and arctangent would round.
    if angle.abs() <= PI { angle } else { angle.sin().atan2(angle.cos()) }
}

/// A rigid motion of the plane, `a_from_b`: where b's origin lies in a, and how far b is turned against a.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarPose {
    /// Forward, metres.
    pub x: f64,
    /// Left, metres.
    pub y: f64,
    /// Counter-clockwise from a's x to b's x, radians within [−π, π].
    pub heading: f64,
}

impl PlanarPose {
    /// From its numbers; the heading may have any number of turns in it.
    pub fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { x, y, heading: wrap_angle(heading) }
    }

    /// `b_from_a` of an `a_from_b`.
    pub fn inverse(&self) -> Self {
        let (sin, cos) = self.heading.sin_cos();
        Self::new(-cos * self.x - sin * self.y, sin * self.x - cos * self.y, -self.heading)
    }

    /// The ground track of a pose in space: the position without its height, and where the x axis points as seen from
    /// above. An x axis that points straight up or down points nowhere from above; the
    /// heading is then of no use, but a number.
    pub fn from_isometry(a_from_b: &Isometry3<f64>) -> Self {
        let forward = a_from_b.rotation * Vector3::x();
        Self { x: a_from_b.translation.x, y: a_from_b.translation.y, heading: forward.y.atan2(forward.x) }
    }

    /// The pose in space: on the ground, upright.
    pub fn to_isometry(&self) -> Isometry3<f64> {
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.heading);
        Isometry3::from_parts(Translation3::new(self.x, self.y, 0.0), rotation)
    }

    /// (x, y, heading).
    pub fn to_vector(&self) -> Vector3<f64> {
        Vector3::new(self.x, self.y, self.heading)
    }

    /// This pose with `error` added component by component.
    pub fn plus(&self, error: &Vector3<f64>) -> Self {
        Self::new(self.x + error.x, self.y + error.y, self.heading + error.z)
    }

    /// What has to be added to `other` to get this pose; the heading's part within [−π, π].
    pub fn minus(&self, other: &Self) -> Vector3<f64> {
        Vector3::new(self.x - other.x, self.y - other.y, wrap_angle(self.heading - other.heading))
    }

    /// Distance between the two positions, metres.
    pub fn distance(&self, other: &Self) -> f64 {
        (self.x - other.x).hypot(self.y - other.y)
    }

    /// The rotation of the plane that goes with (x, y, heading): turns x and y, leaves the heading.
    pub(super) fn turn(&self) -> Matrix3<f64> {
        let (sin, cos) = self.heading.sin_cos();
        Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
    }
}

impl Mul for PlanarPose {
    type Output = Self;

    /// `a_from_c = a_from_b * b_from_c`.
    fn mul(self, b_from_c: Self) -> Self {
        let (sin, cos) = self.heading.sin_cos();
        Self::new(
            self.x + cos * b_from_c.x - sin * b_from_c.y,
            self.y + sin * b_from_c.x + cos * b_from_c.y,
            self.heading + b_from_c.heading,
        )
    }
}

/// A planar `a_from_b` and the covariance of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncertainPose {
    /// The most likely pose.
    pub pose: PlanarPose,
    /// Covariance of (x, y, heading), in frame a; m², m·rad, rad².
    pub covariance: Matrix3<f64>,
}

impl UncertainPose {
    /// A pose known for certain.
    pub fn certain(pose: PlanarPose) -> Self {
        Self { pose, covariance: Matrix3::zeros() }
    }

    /// `a_from_c` of `a_from_b` and `b_from_c` with independent errors (Smith, Self & Cheeseman 1990, Eqs. 10–13).
    pub fn compose(&self, b_from_c: &Self) -> Self {
        let pose = self.pose * b_from_c.pose;
        let (dx, dy) = (pose.x - self.pose.x, pose.y - self.pose.y);
        let by_first = Matrix3::new(1.0, 0.0, -dy, 0.0, 1.0, dx, 0.0, 0.0, 1.0);
        let by_second = self.pose.turn();
        let covariance =
            by_first * self.covariance * by_first.transpose() + by_second * b_from_c.covariance * by_second.transpose();
        Self { pose, covariance: symmetric(&covariance) }
    }

    /// This pose after a motion; the same one where that would leave no finite numbers.
    pub(super) fn carried(&self, motion: &Self) -> Self {
        let carried = self.compose(motion);
        if carried.is_finite() { carried } else { *self }
    }

    /// The ground track of a pose in space whose covariance is that of a left perturbation (ρ, φ), as in
    /// [`Estimate`](crate::Estimate). With p the position and f the x axis, to first order
    /// δp = ρ + φ × p and δf = φ × f, so δheading = (fx δfy − fy δfx) / (fx² + fy²): a tilted robot's roll and pitch
    /// reach its heading, and height turns them into a shift.
    pub fn from_isometry(a_from_b: &Isometry3<f64>, covariance: &Matrix6<f64>) -> Self {
        let p = a_from_b.translation.vector;
        let f = a_from_b.rotation * Vector3::x();
        let level = (f.x * f.x + f.y * f.y).max(1e-12);
        #[rustfmt::skip]
        let jacobian = SMatrix::<f64, 3, 6>::from_row_slice(&[
            1.0, 0.0, 0.0, 0.0, p.z, -p.y,
            0.0, 1.0, 0.0, -p.z, 0.0, p.x,
            0.0, 0.0, 0.0, -f.z * f.x / level, -f.z * f.y / level, 1.0,
        ]);
        Self {
            pose: PlanarPose::from_isometry(a_from_b),
            covariance: symmetric(&(jacobian * covariance * jacobian.transpose())),
        }
    }

    /// The covariance of a left perturbation (ρ, φ) of the pose in space. Height, roll and pitch are certain: that the
    /// robot stands on the plane is what a planar estimate takes for granted.
    pub fn covariance_in_space(&self) -> Matrix6<f64> {
        // The inverse of the projection above: ρ = δp − δheading × p.
        let mut jacobian = SMatrix::<f64, 6, 3>::zeros();
        jacobian[(0, 0)] = 1.0;
        jacobian[(1, 1)] = 1.0;
        jacobian[(0, 2)] = self.pose.y;
        jacobian[(1, 2)] = -self.pose.x;
        jacobian[(5, 2)] = 1.0;
        jacobian * self.covariance * jacobian.transpose()
    }

    /// Whether every number is one.
    pub fn is_finite(&self) -> bool {
        self.pose.to_vector().iter().chain(self.covariance.iter()).all(|value| value.is_finite())
    }
}

/// The symmetric part: what rounding does to a covariance is taken out.
pub(super) fn symmetric(covariance: &Matrix3<f64>) -> Matrix3<f64> {
    (covariance + covariance.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::exp_se3;
    use nalgebra::Vector6;
    use proptest::prelude::*;

    fn pose() -> impl Strategy<Value = PlanarPose> {
        (-9.0..9.0_f64, -9.0..9.0_f64, -3.1..3.1_f64).prop_map(|(x, y, heading)| PlanarPose::new(x, y, heading))
    }

    fn tilted() -> impl Strategy<Value = Isometry3<f64>> {
        (pose(), -0.6..0.6_f64, -0.6..0.6_f64, -1.0..1.0_f64).prop_map(|(pose, roll, pitch, z)| {
            let mut isometry = pose.to_isometry() * UnitQuaternion::from_euler_angles(roll, pitch, 0.0);
            isometry.translation.z = z;
            isometry
        })
    }

    proptest! {
        #[test]
        fn planar_motions_are_motions_in_space(a in pose(), b in pose()) {
            let (planar, space) = ((a * b).to_isometry(), a.to_isometry() * b.to_isometry());
            prop_assert!((planar.to_homogeneous() - space.to_homogeneous()).norm() < 1e-9);
            prop_assert!((a * a.inverse()).to_vector().norm() < 1e-9);
            prop_assert!(PlanarPose::from_isometry(&a.to_isometry()).minus(&a).norm() < 1e-12);
        }

        #[test]
        fn an_angle_keeps_its_direction(angle in -1e3..1e3_f64) {
            let wrapped = wrap_angle(angle);
            prop_assert!(wrapped.abs() <= PI);
            prop_assert!((wrapped.sin() - angle.sin()).abs() + (wrapped.cos() - angle.cos()).abs() < 1e-9);
        }

        #[test]
        fn the_projection_is_that_of_a_perturbed_pose(pose in tilted(), xi in prop::array::uniform6(-1e-5..1e-5_f64)) {
            let xi = Vector6::from(xi);
            let perturbed = PlanarPose::from_isometry(&(exp_se3(&xi) * pose));
            let moved = perturbed.minus(&PlanarPose::from_isometry(&pose));
            // A covariance of rank one is the perturbation itself.
            let projected = UncertainPose::from_isometry(&pose, &(xi * xi.transpose())).covariance;
            prop_assert!((projected - moved * moved.transpose()).norm() < 1e-12, "{projected}");
        }

        #[test]
        fn composition_carries_both_errors(a in pose(), b in pose(), error in prop::array::uniform6(-1e-5..1e-5_f64)) {
            let (first, second) = (Vector3::new(error[0], error[1], error[2]), Vector3::new(error[3], error[4], error[5]));
            let moved = (a.plus(&first) * b.plus(&second)).minus(&(a * b));
            let with_a = UncertainPose { pose: a, covariance: first * first.transpose() };
            let with_b = UncertainPose { pose: b, covariance: second * second.transpose() };
            let by_a = with_a.compose(&UncertainPose::certain(b)).covariance;
            let by_b = UncertainPose::certain(a).compose(&with_b).covariance;
            prop_assert!((with_a.compose(&with_b).covariance - by_a - by_b).norm() < 1e-15);
            // Rank one each: together they are the outer product without its mixed terms.
            let (by_a, by_b) = (largest(&by_a), largest(&by_b));
            let alike = [by_a + by_b, by_a - by_b, by_b - by_a, -by_a - by_b].iter().any(|sum| (sum - moved).norm() < 1e-8);
            prop_assert!(alike);
        }

        #[test]
        fn a_planar_covariance_survives_space(pose in pose(), root in prop::array::uniform9(-1.0..1.0_f64)) {
            let root = Matrix3::from_row_slice(&root);
            let planar = UncertainPose { pose, covariance: root * root.transpose() };
            let back = UncertainPose::from_isometry(&pose.to_isometry(), &planar.covariance_in_space());
            prop_assert!((back.covariance - planar.covariance).norm() < 1e-9);
        }
    }

    /// The vector whose outer product a matrix of rank one is, but for its sign.
    fn largest(matrix: &Matrix3<f64>) -> Vector3<f64> {
        let eigen = matrix.symmetric_eigen();
        let index = eigen.eigenvalues.imax();
        eigen.eigenvectors.column(index) * eigen.eigenvalues[index].max(0.0).sqrt()
    }

    #[test]
    fn straight_up_is_no_heading_and_no_panic() {
        let up = Isometry3::rotation(Vector3::y() * -std::f64::consts::FRAC_PI_2);
        let planar = UncertainPose::from_isometry(&up, &Matrix6::identity());
        assert!(planar.is_finite());
    }
}
