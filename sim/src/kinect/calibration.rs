//! How a simulated unit is really built. What the estimator believes of it is another object ([`Rig`]).
//!
//! The device's frame is its infrared camera's: x right, y down, z forward. Seen from there the colour camera sits
//! 25 mm to the right and the projector 75 mm to the right, so shadows fall to the left of near things.

use nalgebra::{Isometry3, Translation3};
use sunblind_estimator::camera::{CameraModel, DepthCamera, DepthEncoding, Distortion, Rig};

use super::matcher::NO_DEPTH;

/// Raw disparity of a surface at the reference distance: z = 8·b·f/(offset − raw) with the published offset of 1090,
/// 75 mm, 580 px and 1.20 m.
pub const REFERENCE_RAW: f64 = 800.0;
/// Raw steps in a pixel of disparity (ROS `kinect_calibration/technical`).
pub const STEPS_PER_PIXEL: f64 = 8.0;

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
        }
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
            robot_from_colour,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn the_nominal_rig_is_one_the_estimator_accepts() {
        assert_eq!(Calibration::nominal().rig(Isometry3::identity()).validate(), Ok(()));
    }
}
