//! Mass, and how several parts make one body.

use nalgebra::{Isometry3, Matrix3, Point3};

/// Mass, centre of mass and inertia of a rigid body. Kilograms, metres, kg·m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// Mass.
    pub mass: f64,
    /// Centre of mass, in the body's frame.
    pub centre: Point3<f64>,
    /// About the centre of mass, along the body's axes.
    pub inertia: Matrix3<f64>,
}

impl Inertial {
    /// Nothing at all.
    pub fn massless() -> Self {
        Self { mass: 0.0, centre: Point3::origin(), inertia: Matrix3::zeros() }
    }

    /// The same body seen from frame a.
    pub fn transformed(&self, a_from_body: &Isometry3<f64>) -> Self {
        let rotation = a_from_body.rotation.to_rotation_matrix();
        Self {
            mass: self.mass,
            centre: a_from_body * self.centre,
            inertia: rotation.matrix() * self.inertia * rotation.matrix().transpose(),
        }
    }

    /// The two welded together; both in one frame.
    pub fn joined(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return Self::massless();
        }
        let centre = Point3::from((self.centre.coords * self.mass + other.centre.coords * other.mass) / mass);
        Self { mass, centre, inertia: self.inertia_about(&centre) + other.inertia_about(&centre) }
    }

    /// Parallel axes (Huygens–Steiner).
    fn inertia_about(&self, point: &Point3<f64>) -> Matrix3<f64> {
        let arm = self.centre - point;
        self.inertia + (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * self.mass
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Translation3, UnitQuaternion, Vector3};

    fn rod() -> Inertial {
        // 1 m along x, 3 kg: m l²/12 across, nothing along.
        Inertial {
            mass: 3.0,
            centre: Point3::origin(),
            inertia: Matrix3::from_diagonal(&Vector3::new(0.0, 0.25, 0.25)),
        }
    }

    #[test]
    fn two_rods_end_to_end_are_one_long_rod() {
        let shifted = rod().transformed(&Translation3::new(1.0, 0.0, 0.0).into());
        let long = rod().joined(&shifted);
        assert_eq!(long.mass, 6.0);
        assert!((long.centre - Point3::new(0.5, 0.0, 0.0)).norm() < 1e-12);
        // m l²/12 of 6 kg over 2 m.
        assert!((long.inertia - Matrix3::from_diagonal(&Vector3::new(0.0, 2.0, 2.0))).norm() < 1e-12);
    }

    #[test]
    fn inertia_turns_with_the_body() {
        let upright = rod().transformed(&Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2),
        ));
        assert!((upright.inertia - Matrix3::from_diagonal(&Vector3::new(0.25, 0.25, 0.0))).norm() < 1e-12);
    }

    #[test]
    fn a_massless_frame_adds_nothing() {
        assert_eq!(rod().joined(&Inertial::massless()), rod());
    }
}
