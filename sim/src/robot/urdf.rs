//! Reads a robot description (URDF). Links on fixed joints become one body with their parent: a frame without mass
//! would otherwise be a body without mass.

use std::collections::BTreeSet;
use std::path::PathBuf;

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, Vector3};
use thiserror::Error;
use urdf_rs::JointType;

use super::drive::DriveParams;
use super::encoder::EncoderParams;
use super::mass::Inertial;
use super::model::{CameraMount, Chassis, Geometry, RobotModel, Shape, Side, Wheel};

/// The joint that a [`CameraMount`] changes. Its child's origin is the lens.
const CAMERA_MOUNT_JOINT: &str = "kinect_mount";
/// The link whose frame is the camera's.
const CAMERA_FRAME: &str = "kinect_optical_frame";

/// Why a description gives no robot.
#[derive(Debug, Error)]
pub enum UrdfError {
    /// No such file, or no permission.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Not XML, or not URDF.
    #[error("not a robot description: {0}")]
    Syntax(#[from] urdf_rs::UrdfError),
    /// Several links without a parent, or none.
    #[error("a robot has one link that is no joint's child; here: {found:?}")]
    Root {
        /// Their names.
        found: Vec<String>,
    },
    /// Two joints with one child, or a joint to nowhere.
    #[error("link `{link}` must exist and hang on one joint only")]
    Tree {
        /// The child.
        link: String,
    },
    /// Arms and steering are not simulated.
    #[error("joint `{joint}` is {kind:?}; only `fixed`, and `continuous` for wheels, can be simulated")]
    JointKind {
        /// Which.
        joint: String,
        /// Its type.
        kind: JointType,
    },
    /// Meshes and capsules are no collision shapes here.
    #[error("link `{link}`: a collision shape must be a box, a cylinder or a sphere")]
    Shape {
        /// Which.
        link: String,
    },
    /// A wheel that cannot roll forward.
    #[error("wheel `{wheel}`: {what}")]
    Wheel {
        /// Its link.
        wheel: String,
        /// What is wrong, and what to write instead.
        what: &'static str,
    },
    /// Too few wheels to be skid-steered.
    #[error("a skid-steer robot has at least two wheels on each side; here: {left} left, {right} right")]
    TooFewWheels {
        /// y > 0.
        left: usize,
        /// y < 0.
        right: usize,
    },
    /// Nowhere to put the camera.
    #[error("no link or joint named `{name}`, which says where the camera sits")]
    NoCamera {
        /// What is missing.
        name: &'static str,
    },
    /// Negative or missing mass.
    #[error("`{body}` has a mass of {mass} kg and cannot be simulated")]
    Mass {
        /// Chassis or wheel.
        body: String,
        /// Found.
        mass: f64,
    },
}

/// The robot that `text` describes.
pub(super) fn load(text: &str, mount: &CameraMount) -> Result<RobotModel, UrdfError> {
    let mut robot = urdf_rs::read_from_string(text)?;
    apply(mount, &mut robot)?;
    let mut walk = Walk { robot: &robot, seen: BTreeSet::new(), wheels: Vec::new(), robot_from_camera: None };
    let root = root(&robot)?;
    let body = walk.body(&root, &Isometry3::identity(), Hangs::OnTheChassis)?;
    if !is_positive(body.inertial.mass) {
        return Err(UrdfError::Mass { body: root, mass: body.inertial.mass });
    }
    let count = |side| walk.wheels.iter().filter(|wheel| wheel.side == side).count();
    let (left, right) = (count(Side::Left), count(Side::Right));
    if left < 2 || right < 2 {
        return Err(UrdfError::TooFewWheels { left, right });
    }
    Ok(RobotModel {
        name: robot.name.clone(),
        chassis: Chassis { inertial: body.inertial, shapes: body.shapes },
        robot_from_camera: walk.robot_from_camera.ok_or(UrdfError::NoCamera { name: CAMERA_FRAME })?,
        wheels: walk.wheels,
        drive: DriveParams::default(),
        encoder: EncoderParams::default(),
        gyro: None,
        accelerometer: None,
    })
}

/// Moves the camera before the links are merged, so that its mass and its shape go with it.
fn apply(mount: &CameraMount, robot: &mut urdf_rs::Robot) -> Result<(), UrdfError> {
    let joint = robot
        .joints
        .iter_mut()
        .find(|joint| joint.name == CAMERA_MOUNT_JOINT)
        .ok_or(UrdfError::NoCamera { name: CAMERA_MOUNT_JOINT })?;
    if let Some(height) = mount.height {
        joint.origin.xyz[2] = height;
    }
    if let Some(tilt) = mount.tilt {
        // URDF turns about y, which points left: positive looks down.
        joint.origin.rpy[1] = -tilt;
    }
    Ok(())
}

fn root(robot: &urdf_rs::Robot) -> Result<String, UrdfError> {
    let children: BTreeSet<&str> = robot.joints.iter().map(|joint| joint.child.link.as_str()).collect();
    let mut found: Vec<String> = robot.links.iter().map(|link| link.name.clone()).collect();
    found.retain(|name| !children.contains(name.as_str()));
    match found.as_slice() {
        [root] => Ok(root.clone()),
        _ => Err(UrdfError::Root { found }),
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Hangs {
    OnTheChassis,
    OnAWheel,
}

/// Links that move as one, in one frame.
struct Body {
    inertial: Inertial,
    shapes: Vec<Shape>,
}

/// Goes down the tree of links and gathers what moves together.
struct Walk<'a> {
    robot: &'a urdf_rs::Robot,
    seen: BTreeSet<&'a str>,
    wheels: Vec<Wheel>,
    robot_from_camera: Option<Isometry3<f64>>,
}

impl<'a> Walk<'a> {
    /// The link and all that is fixed to it, in the frame of the body that it belongs to.
    fn body(&mut self, name: &str, body_from_link: &Isometry3<f64>, hangs: Hangs) -> Result<Body, UrdfError> {
        let robot = self.robot;
        let link = robot
            .links
            .iter()
            .find(|link| link.name == name)
            .filter(|link| self.seen.insert(&link.name))
            .ok_or_else(|| UrdfError::Tree { link: name.into() })?;
        if name == CAMERA_FRAME && hangs == Hangs::OnTheChassis {
            self.robot_from_camera = Some(*body_from_link);
        }
        let mut body = Body {
            inertial: inertial(&link.inertial).transformed(body_from_link),
            shapes: shapes(link, body_from_link)?,
        };
        for joint in robot.joints.iter().filter(|joint| joint.parent.link == name) {
            let child = &joint.child.link;
            let body_from_child = body_from_link * isometry(&joint.origin);
            match joint.joint_type {
                JointType::Fixed => {
                    let part = self.body(child, &body_from_child, hangs)?;
                    body.inertial = body.inertial.joined(&part.inertial);
                    body.shapes.extend(part.shapes);
                }
                JointType::Continuous if hangs == Hangs::OnTheChassis => {
                    let wheel = self.wheel(joint, &body_from_child)?;
                    self.wheels.push(wheel);
                }
                ref kind => return Err(UrdfError::JointKind { joint: joint.name.clone(), kind: kind.clone() }),
            }
        }
        Ok(body)
    }

    fn wheel(&mut self, joint: &urdf_rs::Joint, robot_from_wheel: &Isometry3<f64>) -> Result<Wheel, UrdfError> {
        let name = joint.child.link.clone();
        let wrong = |what| UrdfError::Wheel { wheel: name.clone(), what };
        let axle = robot_from_wheel.rotation * Vector3::from(joint.axis.xyz.0);
        if axle.normalize().y.abs() < 1.0 - 1e-9 {
            return Err(wrong("its axis must lie along the robot's y; write <axis xyz=\"0 1 0\"/>"));
        }
        // From here on the wheel's frame is parallel to the robot's.
        let parallel_from_wheel = Isometry3::from_parts(Translation3::identity(), robot_from_wheel.rotation);
        let body = self.body(&name, &parallel_from_wheel, Hangs::OnAWheel)?;
        let [Shape { robot_from_shape, geometry: Geometry::Cylinder { radius, length } }] = body.shapes[..] else {
            return Err(wrong("its collision shape must be one cylinder"));
        };
        if (robot_from_shape.rotation * Vector3::z()).y.abs() < 1.0 - 1e-9 {
            return Err(wrong("its cylinder must lie along the axle; write <origin rpy=\"1.5707963267948966 0 0\"/>"));
        }
        if !(is_positive(radius) && is_positive(length)) {
            return Err(wrong("its cylinder has no size"));
        }
        if !is_positive(body.inertial.mass) {
            return Err(UrdfError::Mass { body: name, mass: body.inertial.mass });
        }
        if !(joint.limit.effort > 0.0 && joint.limit.velocity > 0.0) {
            return Err(wrong("its motor needs a limit; write <limit effort=\"20\" velocity=\"10.81\"/>"));
        }
        let hub = Point3::from(robot_from_wheel.translation.vector);
        Ok(Wheel {
            side: if hub.y > 0.0 { Side::Left } else { Side::Right },
            hub,
            radius,
            width: length,
            inertial: body.inertial,
            max_torque: joint.limit.effort,
            max_speed: joint.limit.velocity,
            name,
        })
    }
}

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

fn shapes(link: &urdf_rs::Link, body_from_link: &Isometry3<f64>) -> Result<Vec<Shape>, UrdfError> {
    link.collision
        .iter()
        .map(|collision| {
            let geometry = match collision.geometry {
                urdf_rs::Geometry::Box { size } => Geometry::Box { size: size.0 },
                urdf_rs::Geometry::Cylinder { radius, length } => Geometry::Cylinder { radius, length },
                urdf_rs::Geometry::Sphere { radius } => Geometry::Sphere { radius },
                _ => return Err(UrdfError::Shape { link: link.name.clone() }),
            };
            Ok(Shape { robot_from_shape: body_from_link * isometry(&collision.origin), geometry })
        })
        .collect()
}

fn inertial(inertial: &urdf_rs::Inertial) -> Inertial {
    let urdf_rs::Inertia { ixx, ixy, ixz, iyy, iyz, izz } = inertial.inertia;
    let about_centre = Inertial {
        mass: inertial.mass.value,
        centre: Point3::origin(),
        inertia: Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz),
    };
    about_centre.transformed(&isometry(&inertial.origin))
}

fn isometry(pose: &urdf_rs::Pose) -> Isometry3<f64> {
    let [roll, pitch, yaw] = pose.rpy.0;
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::from(Vector3::from(pose.xyz.0)), rotation)
}

#[cfg(test)]
mod tests;
