//! A robot with wheels that drives a gentle bend towards a painted wall: all that its sensors measure, in a second or
//! two, made up from geometry.

use std::path::Path;
use std::sync::Arc;

use nalgebra::{Isometry3, Point2, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use sunblind_estimator::camera::{CameraModel, DepthCamera, DepthEncoding, Distortion};
use sunblind_estimator::fusion::Drive;
use sunblind_estimator::image::Image;
use sunblind_estimator::{Measurement, MeasurementData, Rig, Timestamp};
use sunblind_sim::evaluation::StampedPose;
use sunblind_sim::record::writer::{RecordingWriter, WriteError};
use sunblind_sim::record::{Arrival, Body, Calibration, Latency, Sensor};

/// Frames a second; so often the wheels are read, too.
const RATE: i64 = 10;
/// Speed along the bend, m/s.
const SPEED: f64 = 0.3;
/// Turn rate, rad/s.
const TURN: f64 = -0.12;
/// The wall is the world's plane with this x, metres.
const WALL: f64 = 3.0;
const WIDTH: usize = 320;
const HEIGHT: usize = 240;

/// What the robot measured, and what it is.
pub struct TinyDrive {
    /// Sensors and their latencies.
    pub calibration: Calibration,
    /// In the order of arrival.
    pub measurements: Vec<Measurement>,
    /// Where the robot was, 100 times a second.
    pub truth: Vec<StampedPose>,
}

impl TinyDrive {
    /// A drive with `frames` frames.
    pub fn new(frames: i64) -> Self {
        let latency = Latency::default()
            .with(Sensor::Colour, 0.066_666_667)
            .with(Sensor::Depth, 0.066_666_667)
            .with(Sensor::Infrared, 0.05)
            .with(Sensor::Wheels, 0.01);
        let calibration = Calibration { rig: rig(), body: Body::Robot, latency };
        let mut measurements = Vec::new();
        let mut measure = |time: Timestamp, data: MeasurementData| {
            let available_at = calibration.latency.available_at(Sensor::of(&data), time);
            measurements.push(Measurement { captured_at: time, available_at, data });
        };
        let end = frames * 1_000_000_000 / RATE;
        let every = |millis: i64| (0..).map(move |index| index * millis * 1_000_000).take_while(move |&at| at <= end);
        for at in every(20) {
            let time = Timestamp::from_nanos(at);
            measure(time, MeasurementData::Gyro(Vector3::new(1e-7, -1.0 / 3.0e4, TURN)));
            measure(time, MeasurementData::Accelerometer(Vector3::new(0.0, SPEED * TURN, 9.81)));
        }
        for at in every(1000 / RATE) {
            let time = Timestamp::from_nanos(at);
            measure(time, ticks(time.as_secs(), calibration.rig.drive.expect("it has wheels")));
        }
        measure(Timestamp::from_nanos(0), MeasurementData::AmbientLight(250.125));
        for at in every(1000 / RATE).take(frames as usize) {
            let time = Timestamp::from_nanos(at + 33_333_333);
            let (rgb, depth, infrared) = images(&calibration.rig, &world_from_robot(time.as_secs()));
            measure(time, MeasurementData::Rgb(Arc::new(rgb)));
            measure(time, MeasurementData::Depth(Arc::new(depth)));
            if at % 500_000_000 == 0 {
                measure(time, MeasurementData::Infrared(Arc::new(infrared)));
            }
        }
        measurements.sort_by_key(Arrival::of);
        let pose = |at| {
            let time = Timestamp::from_nanos(at);
            StampedPose { time, world_from_body: world_from_robot(time.as_secs()) }
        };
        Self { calibration, truth: every(10).map(pose).collect(), measurements }
    }

    /// Writes it as a recording.
    ///
    /// # Errors
    /// As the writer's.
    pub fn record(&self, out: &Path) -> Result<(), WriteError> {
        let writer = RecordingWriter::create(out, &self.calibration)?;
        self.measurements.iter().try_for_each(|measurement| writer.write(measurement))?;
        self.truth.iter().try_for_each(|pose| writer.write_truth(pose))?;
        writer.finish()
    }
}

fn rig() -> Rig {
    let model = CameraModel {
        width: WIDTH,
        height: HEIGHT,
        fx: 262.7,
        fy: 262.3,
        cx: 160.1,
        cy: 119.4,
        distortion: Distortion::default(),
    };
    // Camera z is the robot's forward, camera x its right.
    let looking_ahead = UnitQuaternion::from_quaternion(Quaternion::new(0.5, -0.5, 0.5, -0.5));
    Rig {
        colour: model,
        depth: DepthCamera {
            model: CameraModel { fx: 292.8, fy: 292.8, ..model },
            encoding: DepthEncoding::KinectDisparity { offset: 1090.3, baseline: 0.075 },
            registered_to_colour: false,
        },
        colour_from_depth: Isometry3::new(Vector3::new(-0.025, 0.0003, 0.001), Vector3::new(0.002, -0.004, 0.001)),
        alignment_sigma: 0.0,
        robot_from_colour: Isometry3::from_parts(Translation3::new(0.1, 0.01, 0.6), looking_ahead),
        drive: Some(Drive::default()),
    }
}

fn world_from_robot(t: f64) -> Isometry3<f64> {
    let (radius, turned) = (SPEED / TURN, TURN * t);
    let start_from_robot =
        Isometry3::new(Vector3::new(radius * turned.sin(), radius * (1.0 - turned.cos()), 0.0), Vector3::z() * turned);
    Isometry3::new(Vector3::new(0.4, -0.2, 0.0), Vector3::z() * 0.2) * start_from_robot
}

/// Counts of wheels that don't slip; the left counter is about to run over.
fn ticks(t: f64, drive: Drive) -> MeasurementData {
    let rolled = |side: f64| ((SPEED + side * 0.5 * TURN * drive.effective_track) * t * drive.ticks_per_metre) as i64;
    MeasurementData::WheelTicks { left: (i64::MAX - 1000).wrapping_add(rolled(-1.0)), right: rolled(1.0) - 77 }
}

/// What the cameras of a robot see of the wall: colour, raw disparity, infrared.
fn images(rig: &Rig, world_from_robot: &Isometry3<f64>) -> (Image<[u8; 3]>, Image<u16>, Image<u16>) {
    let world_from_colour = world_from_robot * rig.robot_from_colour;
    let world_from_depth = world_from_colour * rig.colour_from_depth;
    let seen = |camera: &CameraModel, world_from_camera: &Isometry3<f64>| {
        let (camera, pose) = (*camera, *world_from_camera);
        (0..WIDTH * HEIGHT).map(move |index| {
            let pixel = Point2::new((index % WIDTH) as f64, (index / WIDTH) as f64);
            let ray = pose.rotation * camera.ray(&pixel);
            let z = (WALL - pose.translation.x) / ray.x;
            let spot = Point3::from(pose.translation.vector + ray * z);
            (z, paint(spot.y, spot.z))
        })
    };
    let DepthEncoding::KinectDisparity { offset, baseline } = rig.depth.encoding else { unreachable!("see rig") };
    let raw = |z: f64| (offset - 8.0 * baseline * rig.depth.model.fx / z).round() as u16;
    let rgb = seen(&rig.colour, &world_from_colour).map(|(_, paint)| [paint, 255 - paint, paint / 2]).collect();
    let depth = seen(&rig.depth.model, &world_from_depth).map(|(z, _)| raw(z)).collect();
    let infrared = seen(&rig.depth.model, &world_from_depth).map(|(_, paint)| u16::from(paint) * 4 + 3).collect();
    let image = "one value a pixel";
    (
        Image::from_pixels(WIDTH, HEIGHT, rgb).expect(image),
        Image::from_pixels(WIDTH, HEIGHT, depth).expect(image),
        Image::from_pixels(WIDTH, HEIGHT, infrared).expect(image),
    )
}

/// Smooth blotches of 0.3 m, 0.1 m and 0.04 m.
fn paint(y: f64, z: f64) -> u8 {
    let octave = |size: f64| {
        let (u, v) = (y / size, z / size);
        let (column, row) = (u.floor(), v.floor());
        let smooth = |x: f64| x * x * (3.0 - 2.0 * x);
        let (a, b) = (smooth(u - column), smooth(v - row));
        let at = |dx: f64, dy: f64| lattice((column + dx) as i64, (row + dy) as i64, (size * 1e3) as i64);
        (at(0.0, 0.0) * (1.0 - a) + at(1.0, 0.0) * a) * (1.0 - b) + (at(0.0, 1.0) * (1.0 - a) + at(1.0, 1.0) * a) * b
    };
    (255.0 * (0.3 * octave(0.3) + 0.4 * octave(0.1) + 0.3 * octave(0.04))) as u8
}

/// A value from 0 to 1 that looks random.
fn lattice(column: i64, row: i64, seed: i64) -> f64 {
    let mut hash =
        (column.wrapping_mul(0x9e37_79b9) ^ row.wrapping_mul(0x85eb_ca6b) ^ seed.wrapping_mul(0xc2b2_ae35)) as u64;
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x2c1b_3c6d_297a_2d39);
    hash = (hash ^ (hash >> 29)).wrapping_mul(0x1656_67b1_9e37_79f9);
    (hash >> 40) as f64 / (1_u64 << 24) as f64
}
