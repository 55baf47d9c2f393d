//! What the estimator believes of its cameras: pinhole + Brown–Conrady distortion, and how they sit on the robot.
//!
//! Camera frames: x right, y down, z forward (REP-103 optical). Depth is Z, not range.

use nalgebra::{Isometry3, Point2, Point3, Vector3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::fusion::Drive;

/// Radial (k) and tangential (p) coefficients of Brown–Conrady, in OpenCV's order k1 k2 p1 p2 k3; no unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Distortion {
    /// Radial, r².
    pub k1: f64,
    /// Radial, r⁴.
    pub k2: f64,
    /// Tangential.
    pub p1: f64,
    /// Tangential.
    pub p2: f64,
    /// Radial, r⁶.
    pub k3: f64,
}

impl Distortion {
    /// Where the ray through the normalised point (x/z, y/z) lands once the lens has bent it.
    pub fn distort(&self, x: f64, y: f64) -> (f64, f64) {
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
        let dx = 2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x);
        let dy = self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y;
        (x * radial + dx, y * radial + dy)
    }

    /// The inverse of [`distort`](Self::distort) by fixed-point iteration (as OpenCV does it);
    /// 20 rounds reach 1e-9 within the view of a Kinect.
    pub fn undistort(&self, xd: f64, yd: f64) -> (f64, f64) {
        let (mut x, mut y) = (xd, yd);
        if *self == Self::default() {
            return (x, y);
        }
        for _ in 0..20 {
            let r2 = x * x + y * y;
            let radial = 1.0 + r2 * (self.k1 + r2 * (self.k2 + r2 * self.k3));
            let dx = 2.0 * self.p1 * x * y + self.p2 * (r2 + 2.0 * x * x);
            let dy = self.p1 * (r2 + 2.0 * y * y) + 2.0 * self.p2 * x * y;
            x = (xd - dx) / radial;
            y = (yd - dy) / radial;
        }
        (x, y)
    }
}

/// A pinhole camera with distortion. Lengths in pixels; pixel centres at whole numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraModel {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Focal length along x.
    pub fx: f64,
    /// Focal length along y.
    pub fy: f64,
    /// Principal point, x.
    pub cx: f64,
    /// Principal point, y.
    pub cy: f64,
    /// Lens distortion.
    pub distortion: Distortion,
}

impl CameraModel {
    /// The pixel where a point in the camera's frame (metres) appears; `None` when it lies behind the camera.
    /// The pixel may lie outside the image.
    pub fn project(&self, point: &Point3<f64>) -> Option<Point2<f64>> {
        if point.z <= 0.0 {
            return None;
        }
        let (x, y) = self.distortion.distort(point.x / point.z, point.y / point.z);
        Some(Point2::new(self.fx * x + self.cx, self.fy * y + self.cy))
    }

    /// The ray through a pixel, scaled to z = 1.
    pub fn ray(&self, pixel: &Point2<f64>) -> Vector3<f64> {
        let (x, y) = self.distortion.undistort((pixel.x - self.cx) / self.fx, (pixel.y - self.cy) / self.fy);
        Vector3::new(x, y, 1.0)
    }

    /// (width, height) in pixels.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    fn validate(&self, camera: &'static str) -> Result<(), RigError> {
        if self.width == 0 || self.height == 0 {
            return Err(RigError::EmptyImage { camera });
        }
        for (name, value) in [("fx", self.fx), ("fy", self.fy)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(RigError::FocalLength { camera, name, value });
            }
        }
        let Distortion { k1, k2, p1, p2, k3 } = self.distortion;
        if ![self.cx, self.cy, k1, k2, p1, p2, k3].iter().all(|value| value.is_finite()) {
            return Err(RigError::NotFinite { camera });
        }
        Ok(())
    }
}

/// What a depth pixel's `u16` means.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum DepthEncoding {
    /// Z in linear units; 0 = no value. OpenNI gives 1000 a metre, TUM RGB-D files 5000.
    Linear {
        /// Units in a metre.
        units_per_metre: f64,
    },
    /// Raw 11-bit disparity of a Kinect v1, 2047 = no value: z = 8·b·f / (offset − raw)
    /// (ROS `kinect_calibration/technical`; offset about 1090).
    KinectDisparity {
        /// Disparity of infinitely far, in eighths of a pixel.
        offset: f64,
        /// Projector to infrared camera, metres.
        baseline: f64,
    },
}

/// The depth camera (on a Kinect: the infrared camera).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DepthCamera {
    /// Its optics.
    pub model: CameraModel,
    /// Its values.
    pub encoding: DepthEncoding,
    /// Whether depth images already lie in the colour camera's pixels.
    pub registered_to_colour: bool,
}

impl DepthCamera {
    /// Z in metres of one pixel's value; `None` when the sensor saw nothing.
    pub fn depth_of(&self, value: u16) -> Option<f64> {
        match self.encoding {
            DepthEncoding::Linear { units_per_metre } => (value != 0).then(|| f64::from(value) / units_per_metre),
            DepthEncoding::KinectDisparity { offset, baseline } => {
                let disparity = (offset - f64::from(value)) / 8.0;
                (value < 2047 && disparity > 0.0).then(|| baseline * self.model.fx / disparity)
            }
        }
    }
}

/// What [`Rig::alignment_sigma`] is where a calibration does not say it, pixels. A guess after a recorded Kinect.
pub const UNCALIBRATED_SIGMA: f64 = 2.0;
/// Largest [`Rig::alignment_sigma`], pixels: cameras further out show each other nothing. A guess.
pub const MAX_ALIGNMENT_SIGMA: f64 = 50.0;

/// What the estimator believes of the sensors on the robot. The true calibration is another object, elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rig {
    /// The colour camera.
    pub colour: CameraModel,
    /// The depth (infrared) camera.
    pub depth: DepthCamera,
    /// Points in the depth camera's frame → the colour camera's.
    pub colour_from_depth: Isometry3<f64>,
    /// σ of where this calibration puts what one camera sees in the other's image, by its focal lengths, centres and turn
    /// together; pixels of the colour camera.
    pub alignment_sigma: f64,
    /// Points in the colour camera's frame → the robot's (x forward, y left, z up).
    /// For a hand-held camera the "robot" is whatever body the poses are wanted of.
    pub robot_from_colour: Isometry3<f64>,
    /// The driven wheels; `None` for a camera without any.
    pub drive: Option<Drive>,
}

impl Rig {
    /// A Kinect v1 as OpenNI describes it when nobody calibrated it: f 525 px, centre (319.5, 239.5), no distortion,
    /// depth registered to colour, 5000 units a metre as in TUM RGB-D files; the robot frame is the camera's.
    pub fn kinect_default() -> Self {
        let model = CameraModel {
            width: 640,
            height: 480,
            fx: 525.0,
            fy: 525.0,
            cx: 319.5,
            cy: 239.5,
            distortion: Distortion::default(),
        };
        Self {
            colour: model,
            depth: DepthCamera {
                model,
                encoding: DepthEncoding::Linear { units_per_metre: 5000.0 },
                registered_to_colour: true,
            },
            colour_from_depth: Isometry3::identity(),
            alignment_sigma: UNCALIBRATED_SIGMA,
            robot_from_colour: Isometry3::identity(),
            drive: None,
        }
    }

    /// Checks every number once, so that the estimator need not.
    ///
    /// # Errors
    /// The first thing that no camera can have.
    pub fn validate(&self) -> Result<(), RigError> {
        self.colour.validate("colour")?;
        self.depth.model.validate("depth")?;
        match self.depth.encoding {
            DepthEncoding::Linear { units_per_metre } if units_per_metre.is_finite() && units_per_metre > 0.0 => {}
            DepthEncoding::KinectDisparity { offset, baseline }
                if offset.is_finite() && baseline.is_finite() && baseline > 0.0 => {}
            encoding => return Err(RigError::DepthEncoding { encoding }),
        }
        if self.depth.registered_to_colour && self.depth.model.size() != self.colour.size() {
            return Err(RigError::RegisteredSize { depth: self.depth.model.size(), colour: self.colour.size() });
        }
        for (name, transform) in
            [("colour_from_depth", &self.colour_from_depth), ("robot_from_colour", &self.robot_from_colour)]
        {
            let rotation = transform.rotation.coords;
            if !transform.translation.vector.iter().chain(rotation.iter()).all(|value| value.is_finite())
                || (rotation.norm() - 1.0).abs() > 1e-6
            {
                return Err(RigError::Transform { name });
            }
        }
        if !(0.0..=MAX_ALIGNMENT_SIGMA).contains(&self.alignment_sigma) {
            return Err(RigError::Alignment { sigma: self.alignment_sigma });
        }
        if let Some(Drive { ticks_per_metre, effective_track }) = self.drive {
            for (name, value) in [("ticks_per_metre", ticks_per_metre), ("effective_track_m", effective_track)] {
                // Far beyond any robot, and far within what arithmetic bears.
                if !(1e-6..1e12).contains(&value) {
                    return Err(RigError::Drive { name, value });
                }
            }
        }
        Ok(())
    }
}

/// A calibration that describes no robot.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RigError {
    /// Focal length missing, zero, negative or not a number.
    #[error("{camera} camera: {name} is {value} px; a focal length is a positive number (a Kinect's is about 525)")]
    FocalLength {
        /// Which camera.
        camera: &'static str,
        /// Which of the two.
        name: &'static str,
        /// The value found.
        value: f64,
    },
    /// No pixels.
    #[error("{camera} camera: width and height must be at least 1 px")]
    EmptyImage {
        /// Which camera.
        camera: &'static str,
    },
    /// NaN or infinite optics.
    #[error("{camera} camera: the centre and the distortion must be finite numbers")]
    NotFinite {
        /// Which camera.
        camera: &'static str,
    },
    /// Unusable depth units.
    #[error("depth camera: unusable encoding {encoding:?}; TUM RGB-D files have 5000 units a metre")]
    DepthEncoding {
        /// The encoding found.
        encoding: DepthEncoding,
    },
    /// Registered depth must lie in the colour image's pixels.
    #[error("depth is said to be registered to colour, but depth has {depth:?} px and colour {colour:?} px")]
    RegisteredSize {
        /// Depth (width, height).
        depth: (usize, usize),
        /// Colour (width, height).
        colour: (usize, usize),
    },
    /// No standard deviation of images that belong together.
    #[error("alignment_sigma_px is {sigma}; write 0 to {MAX_ALIGNMENT_SIGMA}, such as 0.2 for a good calibration")]
    Alignment {
        /// The value found, pixels.
        sigma: f64,
    },
    /// Wheels that can't roll.
    #[error("drive: {name} is {value}; it is a positive number (a P3-AT has 138000 counts a metre, 0.588 m of track)")]
    Drive {
        /// Which of the two.
        name: &'static str,
        /// The value found.
        value: f64,
    },
    /// NaN, or a rotation that is none.
    #[error("{name}: not a rigid transform (finite translation, unit quaternion)")]
    Transform {
        /// Which transform.
        name: &'static str,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// TUM fr1's colour camera: the strongest distortion of the published Kinect calibrations.
    fn fr1() -> CameraModel {
        CameraModel {
            width: 640,
            height: 480,
            fx: 517.3,
            fy: 516.5,
            cx: 318.6,
            cy: 255.3,
            distortion: Distortion { k1: 0.2624, k2: -0.9531, p1: -0.0054, p2: 0.0026, k3: 1.1633 },
        }
    }

    proptest! {
        #[test]
        fn a_pixel_survives_ray_and_projection(x in 0.0..639.0_f64, y in 0.0..479.0_f64, z in 0.3..9.0_f64) {
            let camera = fr1();
            let pixel = Point2::new(x, y);
            let back = camera.project(&Point3::from(camera.ray(&pixel) * z)).unwrap();
            prop_assert!((back - pixel).norm() < 1e-4, "{pixel} came back as {back}");
        }
    }

    #[test]
    fn projection_equals_opencv() {
        // cv2.projectPoints((0.3, -0.2, 1.5), 0, 0, K, D) , OpenCV 5.0.0.
        let pixel = fr1().project(&Point3::new(0.3, -0.2, 1.5)).unwrap();
        assert!((pixel - Point2::new(423.656_870_773_192_5, 185.260_977_700_999_43)).norm() < 1e-6, "{pixel}");
    }

    #[test]
    fn nothing_behind_the_camera_is_seen() {
        assert_eq!(fr1().project(&Point3::new(0.1, 0.1, -1.0)), None);
        assert_eq!(fr1().project(&Point3::new(0.1, 0.1, 0.0)), None);
    }

    #[test]
    fn raw_disparity_follows_the_published_curve() {
        let mut camera = Rig::kinect_default().depth;
        camera.encoding = DepthEncoding::KinectDisparity { offset: 1090.0, baseline: 0.075 };
        camera.model.fx = 580.0;
        // The reference plane of OpenNI's own conversion: 1.20 m is raw 800.
        assert!((camera.depth_of(800).unwrap() - 1.2).abs() < 1e-9);
        // The published step between neighbouring levels, 0.00287 z².
        let (near, far) = (camera.depth_of(917).unwrap(), camera.depth_of(918).unwrap());
        assert!(((far - near) / (near * near) - 0.00287).abs() < 5e-5, "{near} to {far}");
        assert_eq!(camera.depth_of(2047), None);
        assert_eq!(camera.depth_of(1090), None);
    }

    #[test]
    fn a_zero_focal_length_is_refused_by_name() {
        let mut rig = Rig::kinect_default();
        rig.colour.fx = 0.0;
        assert!(rig.validate().unwrap_err().to_string().contains("fx"));
        assert!(Rig::kinect_default().validate().is_ok());
    }
}
