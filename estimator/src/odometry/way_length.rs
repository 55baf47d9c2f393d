//! How long a way without depth was: as the wheels say, less what they slip, as far as the ground that passes below tells.

use nalgebra::{Isometry3, Vector3};

use super::ground_patches::ground_patches;
use super::wheel_slip::WheelSlip;
use crate::camera::{CameraModel, Rig};
use crate::image::GrayImage;
use crate::motion::{EpipolarMotion, GroundPlane, Scale, scale_over_ground};

/// Which share of a camera's way the robot rolled. A camera high above the wheels swings ahead where the robot's nose goes
/// down and back where it goes up, by a sixteenth of the way on a bank in a lawn; of that the wheels know nothing, and it is
/// no slip.
#[derive(Clone, Copy, Debug)]
struct Lean {
    /// Along the camera's way, metres: what the wheels say of it, what leaning adds, and what was assumed of it.
    rolled: f64,
    leant: f64,
    assumed: f64,
}

impl Lean {
    /// Of a motion whose length is assumed and whose turn is right, beside what the wheels say, `start`; `lever` leads from
    /// where the robot stands to the camera, in the camera's frame.
    fn of(motion: &EpipolarMotion, start: &Isometry3<f64>, lever: &Vector3<f64>) -> Self {
        let (reference_from_camera, by_wheels) = (motion.camera_from_reference.inverse(), start.inverse());
        let gone = reference_from_camera.translation.vector;
        let swung = reference_from_camera.rotation * lever - by_wheels.rotation * lever;
        let along = gone.normalize();
        Self { rolled: by_wheels.translation.vector.dot(&along), leant: swung.dot(&along), assumed: gone.norm() }
    }

    /// By how much the camera went further than was assumed, if the robot went so far for each metre rolled.
    fn of_camera(&self, robot: &Scale) -> Scale {
        let value = (robot.value * self.rolled + self.leant) / self.assumed;
        Scale { value, sigma: robot.sigma * (self.rolled / self.assumed).abs() }
    }

    /// … and the other way round.
    fn of_robot(&self, camera: &Scale) -> Scale {
        let value = (camera.value * self.assumed - self.leant) / self.rolled;
        Scale { value, sigma: camera.sigma * (self.assumed / self.rolled).abs() }
    }
}

/// Learns what the wheels slip, from keyframe to keyframe.
pub(super) struct WayLength {
    camera: CameraModel,
    /// What the wheels stand on; `None` for a camera on the ground or below, and where the ground is not looked at.
    ground: Option<GroundPlane>,
    /// From where the robot stands to the camera, in the camera's frame, metres.
    lever: Vector3<f64>,
    /// `None` before the ground was seen.
    slip: Option<WheelSlip>,
}

impl WayLength {
    /// Nothing seen yet; `down` leads from the camera to the ground, in its frame. `looks`: whether the ground is looked at.
    pub fn new(rig: &Rig, down: Vector3<f64>, looks: bool) -> Self {
        let robot_from_colour = &rig.robot_from_colour;
        let height = robot_from_colour.translation.z;
        let ground = (looks && height > 0.0).then_some(GroundPlane { down, height });
        let lever = robot_from_colour.rotation.inverse() * robot_from_colour.translation.vector;
        Self { camera: rig.colour, ground, lever, slip: None }
    }

    /// Forgets what was seen.
    pub fn restart(&mut self) {
        self.slip = None;
    }

    /// Metres gone for each metre that the wheels roll; one, for certain, while nothing is known of it.
    pub fn share(&self) -> Scale {
        self.slip.map_or(Scale { value: 1.0, sigma: 0.0 }, |slip| slip.scale())
    }

    /// Learns from the ground in two views, between which the camera moved by `motion`, of which the length is assumed. `start`:
    /// the motion by the wheels; `stray`: σ of how far from there the camera may be, metres.
    pub fn look(
        &mut self,
        [reference, image]: [&GrayImage; 2],
        motion: &EpipolarMotion,
        start: &Isometry3<f64>,
        stray: f64,
    ) {
        let Some(ground) = self.ground else { return };
        let (gone, way) = (&motion.camera_from_reference, start.translation.vector.norm());
        let patches = ground_patches(reference, image, &self.camera, gone, &ground);
        let across = ground.down.cross(&Vector3::z()).normalize();
        let bow = across.dot(&(motion.covariance.fixed_view::<3, 3>(3, 3) * across)).sqrt();
        let lean = Lean::of(motion, start, &self.lever);
        self.slip = match scale_over_ground(&patches, gone, &ground, bow) {
            Some(look) => Some(self.slip.unwrap_or_default().seen(&lean.of_robot(&look), way, stray)),
            None => self.slip.map(|slip| slip.unseen(way)),
        };
    }

    /// The motion with the length that the wheels would have told without slip; as it is before the ground was seen.
    pub fn less_slip(&self, motion: EpipolarMotion, start: &Isometry3<f64>, stray: f64) -> EpipolarMotion {
        let Some(slip) = self.slip else { return motion };
        let Scale { value, sigma } = Lean::of(&motion, start, &self.lever).of_camera(&slip.scale());
        // In a turn the wheels' length errs by itself.
        motion.scaled(&Scale { value, sigma: sigma.hypot(stray / start.translation.vector.norm()) })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix6, UnitQuaternion};
    use proptest::prelude::*;

    use super::*;
    use crate::dark_room;

    proptest! {
        #[test]
        fn a_camera_that_leans_is_not_taken_for_wheels_that_slip(
            share in 0.85..1.05_f64,
            pitch in -0.06..0.06_f64,
            roll in -0.04..0.04_f64,
            turn in -0.1..0.1_f64,
        ) {
            let mut rig = dark_room::rig();
            let ahead = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(0.5, -0.5, 0.5, -0.5));
            rig.robot_from_colour = Isometry3::from_parts(Vector3::new(0.1, 0.0, 0.6).into(), ahead);
            // The robot in the frame where it was before; x ahead, nose down for a positive pitch.
            let of_camera = |way: f64, roll: f64, pitch: f64| {
                let turned = UnitQuaternion::from_euler_angles(roll, pitch, turn);
                let robot = Isometry3::from_parts(Vector3::new(way, 0.0, 0.0).into(), turned);
                (rig.robot_from_colour.inverse() * robot * rig.robot_from_colour).inverse()
            };
            let (start, truth) = (of_camera(0.4, 0.0, 0.0), of_camera(0.4 * share, roll, pitch));
            let mut assumed = truth;
            assumed.translation.vector *= start.translation.vector.norm() / truth.translation.vector.norm();
            let motion = EpipolarMotion {
                camera_from_reference: assumed,
                covariance: Matrix6::identity() * 1e-6,
                inliers: Vec::new(),
                turn_share: 1.0,
            };
            let length = WayLength::new(&rig, Vector3::y(), true);
            let lean = Lean::of(&motion, &start, &length.lever);
            let further = truth.translation.vector.norm() / assumed.translation.vector.norm();
            let robot = lean.of_robot(&Scale { value: further, sigma: 0.02 });
            // What the robot climbs, the wheels roll too.
            prop_assert!((robot.value - share).abs() < 0.004, "{robot:?}");
            let camera = lean.of_camera(&robot);
            prop_assert!((camera.value - further).abs() < 1e-9 && (camera.sigma - 0.02).abs() < 1e-9, "{camera:?}");
        }
    }
}
