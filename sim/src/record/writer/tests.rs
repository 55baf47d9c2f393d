//! Recordings as they are written: whole or not at all, and read again to the bit.

use std::sync::Arc;

use nalgebra::{Isometry3, Vector3};
use sunblind_estimator::image::{DepthImage, InfraredImage, RgbImage};

use super::*;
use crate::record::Recording;

fn at(nanos: i64) -> Timestamp {
    Timestamp::from_nanos(nanos)
}

fn measured(time: Timestamp, data: MeasurementData) -> Measurement {
    Measurement { captured_at: time, available_at: time, data }
}

fn write(out: &Path, times: &[i64]) -> Result<(), WriteError> {
    let writer = RecordingWriter::create(out, &Calibration::kinect_default())?;
    for &time in times {
        let rgb = MeasurementData::Rgb(Arc::new(RgbImage::filled(4, 3, [1, 2, 3])));
        let depth = MeasurementData::Depth(Arc::new(DepthImage::filled(4, 3, 5001)));
        for data in [rgb, depth] {
            writer.write(&measured(at(time), data))?;
        }
        writer.write_truth(&StampedPose {
            time: at(time),
            world_from_body: Isometry3::translation(1.0, 2.0, 1.0 / 3.0),
        })?;
    }
    writer.finish()
}

#[test]
fn the_layout_is_the_documented_one() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("deep/demo");
    write(&out, &[0, 33_333_333]).unwrap();
    let read = |name| fs::read_to_string(out.join(name)).unwrap();
    assert!(read("rgb.txt").ends_with("\n0.033333333 rgb/0.033333333.png\n"));
    assert!(read("groundtruth.txt").contains("\n0.033333333 1 2 0.3333333333333333 0 0 0 1\n"));
    let depth = image::open(out.join("depth/0.000000000.png")).unwrap().into_luma16();
    assert_eq!(depth.get_pixel(3, 2).0, [5001]);
    assert!(read("depth.txt").starts_with("# depth images, 16-bit PNG, 5000 per metre"));
    let mut names: Vec<_> = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["calibration.toml", "depth", "depth.txt", "groundtruth.txt", "rgb", "rgb.txt"]);
    assert_eq!(fs::read_dir(out.parent().unwrap()).unwrap().count(), 1, "something was left beside");
}

#[test]
fn a_recording_is_replaced_whole_and_nothing_else_is() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("demo");
    write(&out, &[0, 500]).unwrap();
    write(&out, &[250]).unwrap();
    assert!(!out.join("rgb/0.000000500.png").exists() && out.join("rgb/0.000000250.png").exists());
    fs::remove_file(out.join("depth.txt")).unwrap();
    assert!(matches!(write(&out, &[0]), Err(WriteError::Folder(FolderError::Foreign { .. }))));
}

#[test]
fn an_unfinished_recording_leaves_nothing() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("demo");
    let writer = RecordingWriter::create(&out, &Calibration::kinect_default()).unwrap();
    writer.write(&measured(at(0), MeasurementData::AmbientLight(250.0))).unwrap();
    drop(writer);
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 0);
}

#[test]
fn images_may_come_in_any_order_and_lists_are_sorted() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("demo");
    let writer = RecordingWriter::create(&out, &Calibration::kinect_default()).unwrap();
    for time in [66, 0, 33] {
        let image = Arc::new(InfraredImage::filled(4, 3, 1023));
        writer.write(&measured(at(time), MeasurementData::Infrared(image))).unwrap();
    }
    writer.finish().unwrap();
    let list = fs::read_to_string(out.join("ir.txt")).unwrap();
    let times: Vec<_> = list.lines().skip(2).map(|line| &line[..11]).collect();
    assert_eq!(times, ["0.000000000", "0.000000033", "0.000000066"]);
}

#[test]
fn what_a_recording_cannot_tell_is_refused() {
    let scratch = tempfile::tempdir().unwrap();
    let latency = Latency::default().with(Sensor::Gyro, 0.01);
    let calibration = Calibration { latency, ..Calibration::kinect_default() };
    let writer = RecordingWriter::create(&scratch.path().join("demo"), &calibration).unwrap();
    let gyro = |captured: i64, available: i64| Measurement {
        captured_at: at(captured),
        available_at: at(available),
        data: MeasurementData::Gyro(Vector3::zeros()),
    };
    writer.write(&gyro(0, 10_000_000)).unwrap();
    assert!(matches!(writer.write(&gyro(1, 1)), Err(WriteError::Latency { sensor: "gyro", .. })));
    assert!(matches!(writer.write(&gyro(0, 10_000_000)), Err(WriteError::NotLater { .. })));
    let image = || measured(at(5), MeasurementData::Rgb(Arc::new(RgbImage::filled(4, 3, [0; 3]))));
    writer.write(&image()).unwrap();
    assert!(matches!(writer.write(&image()), Err(WriteError::NotLater { .. })));
}

#[test]
fn truth_is_read_bit_for_bit() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("demo");
    let mut calibration = Calibration::kinect_default();
    for camera in [&mut calibration.rig.colour, &mut calibration.rig.depth.model] {
        (camera.width, camera.height) = (4, 3);
    }
    let writer = RecordingWriter::create(&out, &calibration).unwrap();
    let truth: Vec<_> = (0..100)
        .map(|index| {
            let angle = Vector3::new(0.3, -0.7, 0.01) * f64::from(index);
            StampedPose { time: at(i64::from(index) * 10_000_001), world_from_body: Isometry3::new(angle / 3.0, angle) }
        })
        .collect();
    truth.iter().for_each(|pose| writer.write_truth(pose).unwrap());
    for data in [
        MeasurementData::Rgb(Arc::new(RgbImage::filled(4, 3, [9; 3]))),
        MeasurementData::Depth(Arc::new(DepthImage::filled(4, 3, 9))),
    ] {
        writer.write(&measured(at(0), data)).unwrap();
    }
    writer.finish().unwrap();
    assert_eq!(Recording::open(&out, None).unwrap().truth, truth);
}
