//! The two cameras of the simulated device. One made-up unit, inside the published spread of real ones
//! (Burrus, TUM fr1–fr3, 7-Scenes: colour f 517–535 px, infrared f 571–595 px, colour 20–25 mm beside infrared).

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use sunblind_estimator::Rig;
use sunblind_estimator::camera::{CameraModel, DepthCamera, DepthEncoding, Distortion};

/// Projector to infrared camera, metres; the projector sits at +x (ROS `kinect_calibration/technical`).
pub const BASELINE: f64 = 0.075;

/// What a depth image counts in: as TUM RGB-D files do.
pub const UNITS_PER_METRE: f64 = 5000.0;

/// Columns of both images.
pub const WIDTH: usize = 640;
/// Rows of both images.
pub const HEIGHT: usize = 480;

/// The device's true calibration, which is also what its `calibration.toml` says. Depth is not registered to colour;
/// the robot frame is the colour camera's.
pub fn rig() -> Rig {
    Rig {
        colour: CameraModel {
            width: WIDTH,
            height: HEIGHT,
            fx: 525.4,
            fy: 524.9,
            cx: 322.1,
            cy: 244.6,
            // A third of what TUM publishes for fr1: a guess at an average unit.
            distortion: Distortion { k1: 0.09, k2: -0.19, p1: -0.0012, p2: 0.0008, k3: 0.05 },
        },
        depth: DepthCamera {
            model: CameraModel {
                width: WIDTH,
                height: HEIGHT,
                fx: 585.6,
                fy: 585.6,
                cx: 317.2,
                cy: 239.1,
                distortion: Distortion::default(),
            },
            encoding: DepthEncoding::Linear { units_per_metre: UNITS_PER_METRE },
            registered_to_colour: false,
        },
        // Known as it is.
        alignment_sigma: 0.0,
        colour_from_depth: Isometry3::from_parts(
            Translation3::new(-0.025, 0.0004, -0.0012),
            UnitQuaternion::from_scaled_axis(Vector3::new(0.003, -0.006, 0.001)),
        ),
        robot_from_colour: Isometry3::identity(),
        drive: None,
    }
}
