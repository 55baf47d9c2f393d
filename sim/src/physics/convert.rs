//! Between the engine's vectors (glam) and everyone else's (nalgebra).

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use rapier3d::math::{Matrix, Pose, Vector};

pub(super) fn vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(super) fn point(p: &Point3<f64>) -> Vector {
    vector(&p.coords)
}

pub(super) fn matrix(m: &Matrix3<f64>) -> Matrix {
    Matrix::from_cols_array(&m.as_slice().try_into().expect("nine entries"))
}

pub(super) fn pose(isometry: &Isometry3<f64>) -> Pose {
    (*isometry).into()
}

pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    (*pose).into()
}

pub(super) fn vector3(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}
