//! How a simulated unit is really built. What the estimator believes of it is another object ([`Rig`]).
//!
//! The device's frame is its infrared camera's: x right, y down, z forward. Seen from there the colour camera sits
//! 25 mm to the right and the projector 75 mm to the right, so shadows fall to the left of near things.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use sunblind_estimator::camera::{CameraModel, DepthCamera, DepthEncoding, Distortion, MAX_ALIGNMENT_SIGMA, Rig};

use super::matcher::NO_DEPTH;
use super::projector::PITCH;
use crate::random::stream;

/// Raw disparity of a surface at the reference distance: z = 8·b·f/(offset − raw) with the published offset of 1090,
/// 75 mm, 580 px and 1.20 m.
pub const REFERENCE_RAW: f64 = 800.0;
/// Raw steps in a pixel of disparity (ROS `kinect_calibration/technical`).
pub const STEPS_PER_PIXEL: f64 = 8.0;

/// How far units differ, as published calibrations of a dozen of them do: focal lengths, share; centres, pixels; turn of
/// the colour camera against the infrared one, degrees.
const FOCAL_SPREAD: f64 = 0.015;
const CENTRE_SPREAD: f64 = 12.0;
const TURN_SPREAD_DEG: f64 = 1.0;

/// The true optics of one unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The infrared camera, in which depth is measured.
    pub infrared: CameraModel,
    /// The colour camera.
    pub colour: CameraModel,
    /// Points in the infrared camera's frame → the colour camera's.
    pub colour_from_infrared: Isometry3<f64>,
    /// From the infrared camera to the projector, along x; metres.
    pub baseline: f64,
    /// Distance of the plane whose pattern the unit has stored; metres.
    pub reference_distance: f64,
    /// Tangent from one grid position of the projected pattern to the next.
    pub pattern_pitch: f64,
}

impl Calibration {
    /// A Kinect v1 with published typical values. Infrared: f 580 px (ROS `kinect_calibration/technical`), its lens
    /// taken as free of distortion, as published fits of it disagree even in sign. Colour: f 525 px (OpenNI) with the
    /// distortion of the TUM RGB-D benchmark's second unit. Baselines 25 mm (ROS) and 75 mm, reference at 1.20 m
    /// (OpenNI's conversion).
    pub fn nominal() -> Self {
        let camera = |focal_length, distortion| CameraModel {
            width: 640,
            height: 480,
            fx: focal_length,
            fy: focal_length,
            cx: 319.5,
            cy: 239.5,
            distortion,
        };
        let fr2 = Distortion { k1: 0.231222, k2: -0.784899, p1: -0.003257, p2: -0.000105, k3: 0.917205 };
        Self {
            infrared: camera(580.0, Distortion::default()),
            colour: camera(525.0, fr2),
            colour_from_infrared: Isometry3::from(Translation3::new(-0.025, 0.0, 0.0)),
            baseline: 0.075,
            reference_distance: 1.2,
            pattern_pitch: PITCH,
        }
    }

    /// The unit with a number, one of those that differ from the nominal one as real units do, evenly within ±1.5 % of
    /// the focal lengths, ±12 px of the centres and 1° between the cameras.
    pub fn drawn(number: u64) -> Self {
        let mut random = stream(number, "kinect unit", 0);
        let mut within = |reach: f64| random.random_range(-reach..=reach);
        let mut unit = Self::nominal();
        for camera in [&mut unit.infrared, &mut unit.colour] {
            let stretch = 1.0 + within(FOCAL_SPREAD);
            (camera.fx, camera.fy) = (camera.fx * stretch, camera.fy * stretch);
            (camera.cx, camera.cy) = (camera.cx + within(CENTRE_SPREAD), camera.cy + within(CENTRE_SPREAD));
        }
        let axis = Vector3::from_fn(|_, _| within(1.0));
        let turn = axis.cap_magnitude(1.0) * TURN_SPREAD_DEG.to_radians();
        unit.colour_from_infrared.rotation = UnitQuaternion::from_scaled_axis(turn);
        unit
    }

    /// The unit in a coarser make, that nobody sells: half the pixels along each edge, the same views, a pattern twice as
    /// wide. Pixel for pixel its images are about as hard to match as the full unit's, in any light; the least step of depth
    /// is twice as long.
    pub fn halved(mut self) -> Self {
        for camera in [&mut self.infrared, &mut self.colour] {
            (camera.width, camera.height) = (camera.width / 2, camera.height / 2);
            (camera.fx, camera.fy) = (camera.fx / 2.0, camera.fy / 2.0);
            // Pixel centres lie at whole numbers.
            let middle = |centre: f64| (centre + 0.5) / 2.0 - 0.5;
            (camera.cx, camera.cy) = (middle(camera.cx), middle(camera.cy));
        }
        self.pattern_pitch *= 2.0;
        self
    }

    /// What this unit's raw values mean.
    pub fn depth_encoding(&self) -> DepthEncoding {
        let reference_disparity = self.baseline * self.infrared.fx / self.reference_distance;
        let offset = REFERENCE_RAW + STEPS_PER_PIXEL * reference_disparity;
        DepthEncoding::KinectDisparity { offset, baseline: self.baseline }
    }

    /// The raw value of a surface at `z` metres; [`NO_DEPTH`] where there is none.
    pub fn raw_of(&self, z: f64) -> u16 {
        let per_distance = 1.0 / self.reference_distance - 1.0 / z;
        let raw = (REFERENCE_RAW + STEPS_PER_PIXEL * self.baseline * self.infrared.fx * per_distance).round();
        if z > 0.0 && (0.0..f64::from(NO_DEPTH)).contains(&raw) { raw as u16 } else { NO_DEPTH }
    }

    /// What a perfect calibration of this unit would tell the estimator.
    pub fn rig(&self, robot_from_colour: Isometry3<f64>) -> Rig {
        let encoding = self.depth_encoding();
        Rig {
            drive: None,
            colour: self.colour,
            depth: DepthCamera { model: self.infrared, encoding, registered_to_colour: false },
            colour_from_depth: self.colour_from_infrared,
            alignment_sigma: 0.0,
            robot_from_colour,
        }
    }
}

/// What a calibration leaves: how far what is believed of a unit is from how it is built. Standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// Of the cameras' centres along x and y, and of what their focal lengths move at the image's edge; pixels.
    pub pixels: f64,
    /// Of the turn between the cameras, about each axis; degrees.
    pub degrees: f64,
}

impl Residual {
    /// What a calibration with this residual believes instead of `rig`; the seed draws which.
    pub fn of(&self, mut rig: Rig, seed: u64) -> Rig {
        let mut random = stream(seed, "calibration residual", 0);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        for camera in [&mut rig.depth.model, &mut rig.colour] {
            let stretch = 1.0 + self.pixels * normal() / (camera.width as f64 / 2.0);
            (camera.fx, camera.fy) = (camera.fx * stretch, camera.fy * stretch);
            (camera.cx, camera.cy) = (camera.cx + self.pixels * normal(), camera.cy + self.pixels * normal());
        }
        let turn = Vector3::from_fn(|_, _| normal()) * self.degrees.to_radians();
        rig.colour_from_depth.rotation = UnitQuaternion::from_scaled_axis(turn) * rig.colour_from_depth.rotation;
        // Both cameras' centres, and the turn between them.
        let sigma = (2.0_f64.sqrt() * self.pixels).hypot(rig.colour.fx * self.degrees.to_radians());
        rig.alignment_sigma = sigma.min(MAX_ALIGNMENT_SIGMA);
        rig
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point2;

    #[test]
    fn the_nominal_unit_has_the_published_offset() {
        let DepthEncoding::KinectDisparity { offset, baseline } = Calibration::nominal().depth_encoding() else {
            panic!("a Kinect gives raw disparity");
        };
        assert!((offset - 1090.0).abs() < 1e-9 && (baseline - 0.075).abs() < 1e-9, "{offset}, {baseline}");
    }

    #[test]
    fn raw_values_mean_what_the_encoding_says() {
        let unit = Calibration::nominal();
        let depth = unit.rig(Isometry3::identity()).depth;
        for z in [0.5, 1.2, 3.7, 9.0] {
            let step = z * z / (STEPS_PER_PIXEL * unit.baseline * unit.infrared.fx);
            assert!((depth.depth_of(unit.raw_of(z)).unwrap() - z).abs() < 0.51 * step, "{z} m");
        }
        for nothing in [0.0, 0.1, -1.0, f64::NAN] {
            assert_eq!(unit.raw_of(nothing), NO_DEPTH, "{nothing} m");
        }
    }

    #[test]
    fn units_differ_as_far_as_real_ones_and_no_further() {
        let nominal = Calibration::nominal();
        let units: Vec<_> = (0..200).map(Calibration::drawn).collect();
        assert_eq!(units[7], Calibration::drawn(7));
        let largest = |of: &dyn Fn(&Calibration) -> f64| units.iter().map(|unit| of(unit).abs()).fold(0.0, f64::max);
        for (reach, off) in [
            (0.015, largest(&|unit| unit.infrared.fx / 580.0 - 1.0)),
            (0.015, largest(&|unit| unit.colour.fy / 525.0 - 1.0)),
            (12.0, largest(&|unit| unit.infrared.cx - nominal.infrared.cx)),
            (12.0, largest(&|unit| unit.colour.cy - nominal.colour.cy)),
            (1.0, largest(&|unit| unit.colour_from_infrared.rotation.angle().to_degrees())),
        ] {
            assert!((0.9 * reach..=reach * (1.0 + 1e-9)).contains(&off), "{off} of {reach}");
        }
        assert!(units.iter().all(|unit| unit.rig(Isometry3::identity()).validate().is_ok()));
    }

    #[test]
    fn a_halved_unit_sees_the_same_in_fewer_pixels() {
        let (unit, halved) = (Calibration::drawn(5), Calibration::drawn(5).halved());
        for (full, half) in [(unit.infrared, halved.infrared), (unit.colour, halved.colour)] {
            assert_eq!((half.width, half.height), (320, 240));
            // The corner between four pixels that become one.
            for (x, y) in [(0.5, 0.5), (320.5, 240.5), (638.5, 478.5)] {
                let [ray, coarse] = [full.ray(&[x, y].into()), half.ray(&[(x - 0.5) / 2.0, (y - 0.5) / 2.0].into())];
                assert!((ray - coarse).norm() < 1e-9, "({x}, {y})");
            }
        }
        let depth = halved.rig(Isometry3::identity()).depth;
        let step = 4.0 / (STEPS_PER_PIXEL * 0.075 * halved.infrared.fx);
        assert!((depth.depth_of(halved.raw_of(2.0)).unwrap() - 2.0).abs() < 0.51 * step);
        assert_eq!(halved.rig(Isometry3::identity()).validate(), Ok(()));
    }

    #[test]
    fn a_residual_parts_belief_from_truth_by_its_size() {
        let rig = Calibration::drawn(3).rig(Isometry3::identity());
        let none = Residual { pixels: 0.0, degrees: 0.0 };
        let close = |a: &Rig, b: &Rig| (a.colour_from_depth.rotation.angle_to(&b.colour_from_depth.rotation)) < 1e-9;
        let same = none.of(rig.clone(), 1);
        assert!(same.colour == rig.colour && same.depth == rig.depth && close(&same, &rig));
        let residual = Residual { pixels: 0.1, degrees: 0.01 };
        let mean_square = |of: &dyn Fn(&Rig) -> f64| {
            (0..400).map(|seed| of(&residual.of(rig.clone(), seed)).powi(2)).sum::<f64>() / 400.0
        };
        let centre = mean_square(&|believed| believed.colour.cx - rig.colour.cx).sqrt();
        let edge = mean_square(&|believed| 320.0 * (believed.depth.model.fx / rig.depth.model.fx - 1.0)).sqrt();
        let turn = mean_square(&|believed| {
            believed.colour_from_depth.rotation.angle_to(&rig.colour_from_depth.rotation).to_degrees()
        });
        let turn = (turn / 3.0).sqrt();
        // Where something far ahead, seen by the depth camera, is put in the colour image.
        let column = |believed: &Rig| {
            let pixel = Point2::new(rig.depth.model.cx, rig.depth.model.cy);
            let ray = believed.colour_from_depth.rotation * believed.depth.model.ray(&pixel);
            believed.colour.project(&ray.into()).unwrap().x
        };
        let shift = mean_square(&|believed| column(believed) - column(&rig)).sqrt();
        let said = residual.of(rig.clone(), 0).alignment_sigma;
        for (expected, found) in [(0.1, centre), (0.1, edge), (0.01, turn), (said, shift)] {
            assert!((found / expected - 1.0).abs() < 0.15, "{found} where {expected} was expected");
        }
    }

    #[test]
    fn a_rig_that_is_far_out_is_still_one_the_estimator_accepts() {
        // As much as a scenario may ask for.
        let residual = Residual { pixels: 50.0, degrees: 5.0 };
        assert_eq!(residual.of(Calibration::nominal().rig(Isometry3::identity()), 1).validate(), Ok(()));
    }

    #[test]
    fn the_nominal_rig_is_one_the_estimator_accepts() {
        assert_eq!(Calibration::nominal().rig(Isometry3::identity()).validate(), Ok(()));
    }
}
