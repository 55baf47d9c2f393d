//! Every recording that can't be used is refused with one message that says what, where, and what to do; exit code 2,
//! and no output folder.

use std::fs;

use image::{ColorType, ImageFormat};
use sunblind_tests::command::{stderr_of, stdout_of, sunblind};
use sunblind_tests::tiny_recording::{HEIGHT, TinyRecording, WIDTH};

/// Replays `recording`, which must be refused with one line that holds every one of `parts`.
fn refused(recording: &TinyRecording, parts: &[&str]) {
    let command = sunblind().arg("replay").arg(recording.folder()).arg("--out").arg(recording.out()).output().unwrap();
    let stderr = stderr_of(&command);
    assert_eq!(command.status.code(), Some(2), "{stderr}");
    assert_eq!(stdout_of(&command), "");
    assert!(stderr.starts_with("error: ") && stderr.trim_end().lines().count() == 1, "one message: {stderr}");
    for part in parts {
        assert!(stderr.contains(part), "no {part:?} in: {stderr}");
    }
    let left: Vec<_> = fs::read_dir(recording.folder().parent().unwrap()).unwrap().flatten().collect();
    let names: Vec<_> = left.iter().map(fs::DirEntry::file_name).filter(|name| name != "tiny").collect();
    assert!(names.is_empty(), "left behind: {names:?}");
}

fn save(recording: &TinyRecording, file: &str, width: u32, height: u32, colour: ColorType) {
    let bytes = vec![7; (width * height) as usize * usize::from(colour.bytes_per_pixel())];
    image::save_buffer_with_format(recording.path(file), &bytes, width, height, colour, ImageFormat::Png).unwrap();
}

#[test]
fn no_such_folder() {
    let recording = TinyRecording::new(1);
    fs::remove_dir_all(recording.folder()).unwrap();
    refused(&recording, &["tiny: no such folder", "give the folder"]);
}

#[test]
fn a_file_instead_of_a_folder() {
    let recording = TinyRecording::new(1);
    fs::remove_dir_all(recording.folder()).unwrap();
    fs::write(recording.folder(), "").unwrap();
    refused(&recording, &["tiny: no such folder", "give the folder"]);
}

#[test]
fn a_list_is_missing() {
    for list in ["rgb.txt", "depth.txt"] {
        let recording = TinyRecording::new(2);
        recording.remove(list);
        refused(&recording, &[list, "no such file", "`timestamp filename`"]);
    }
}

#[test]
fn a_list_that_lists_nothing() {
    let recording = TinyRecording::new(2);
    recording.write("rgb.txt", "# only a comment\n\n");
    refused(&recording, &["rgb.txt: lists nothing", "`timestamp filename`"]);
}

#[test]
fn a_list_that_is_no_text() {
    let recording = TinyRecording::new(2);
    recording.write("rgb.txt", [0x89, 0x50, 0xff, 0xfe]);
    refused(&recording, &["rgb.txt: can't be read", "UTF-8"]);
}

#[test]
fn a_line_without_a_time_or_a_name() {
    let recording = TinyRecording::new(2);
    recording.replace("rgb.txt", "100.100 ", "rgb ");
    refused(&recording, &["rgb.txt:3:1: `rgb` is no time stamp", "write seconds"]);
    recording.replace("rgb.txt", "rgb rgb/1.png", "100.1");
    refused(&recording, &["rgb.txt:3:6: no file name", "`timestamp filename`"]);
}

#[test]
fn a_line_names_a_missing_image() {
    let recording = TinyRecording::new(3);
    recording.remove("depth/1.png");
    refused(&recording, &["depth.txt:3:9: ", "depth/1.png does not exist", "restore it or delete this line"]);
}

#[test]
fn time_goes_backwards_or_stands_still() {
    for (list, first, second) in [("rgb.txt", "100.000", "100.100"), ("depth.txt", "100.001", "100.101")] {
        for not_later in [first, "99"] {
            let recording = TinyRecording::new(2);
            recording.replace(list, second, not_later);
            refused(&recording, &[list, ":3:1: time stamp", "is not later than", "sort the lines"]);
        }
    }
    let recording = TinyRecording::new(2);
    recording.replace("groundtruth.txt", "100.100", "99");
    refused(&recording, &["groundtruth.txt:2:1: time stamp 99 s is not later than 100 s"]);
}

#[test]
fn colour_and_depth_on_different_clocks() {
    let recording = TinyRecording::new(1);
    recording.replace("depth.txt", "100.001", "200.001");
    refused(&recording, &["within 20 ms", "same clock"]);
}

#[test]
fn a_damaged_image() {
    for file in ["rgb/1.png", "depth/1.png"] {
        let recording = TinyRecording::new(3);
        for share in [0.9, 0.5, 0.01, 0.0] {
            recording.truncate(file, share);
            refused(&recording, &[file, "again"]);
        }
        recording.write(file, "this is no image");
        refused(&recording, &[file, "can't be decoded", "again"]);
    }
}

#[test]
fn a_truncated_jpeg() {
    let recording = TinyRecording::new(2);
    let jpeg = recording.path("rgb/1.jpg");
    image::open(recording.path("rgb/1.png")).unwrap().save(&jpeg).unwrap();
    recording.replace("rgb.txt", "rgb/1.png", "rgb/1.jpg");
    recording.truncate("rgb/1.jpg", 0.8);
    refused(&recording, &["rgb/1.jpg: the file ends before the image does"]);
}

#[test]
fn an_image_of_the_wrong_size() {
    let recording = TinyRecording::new(2);
    save(&recording, "rgb/1.png", WIDTH + 1, HEIGHT, ColorType::Rgb8);
    refused(&recording, &["rgb/1.png: the image is 65×48 px", "64×48 px for [colour]", "calibration.toml"]);
    let recording = TinyRecording::new(2);
    save(&recording, "depth/1.png", WIDTH, HEIGHT / 2, ColorType::L16);
    refused(&recording, &["depth/1.png: the image is 64×24 px", "64×48 px for [depth]"]);
}

#[test]
fn depth_that_is_not_16_bit_grey() {
    let kinds = [(ColorType::L8, "8-bit grey"), (ColorType::Rgb8, "8-bit colour"), (ColorType::Rgb16, "16-bit colour")];
    for (colour, found) in kinds {
        let recording = TinyRecording::new(2);
        save(&recording, "depth/1.png", WIDTH, HEIGHT, colour);
        refused(&recording, &["depth/1.png: ", "16-bit grey PNG", found, "export"]);
    }
}

#[test]
fn a_calibration_without_a_focal_length() {
    let recording = TinyRecording::new(1);
    recording.replace("calibration.toml", "fx_px = 52.5\n", "");
    refused(&recording, &["calibration.toml:3:1: [colour] has no fx_px; write fx_px = "]);
    recording.replace("calibration.toml", "height_px = 48\n", "height_px = 48\nfx_px = 0\n");
    refused(&recording, &["calibration.toml:6:9: fx_px is 0; write a positive number, such as 525.0"]);
}

#[test]
fn a_calibration_that_is_no_toml() {
    let recording = TinyRecording::new(1);
    recording.replace("calibration.toml", "fy_px = 52.5", "fy_px = ");
    refused(&recording, &["calibration.toml:7:"]);
}

#[test]
fn a_calibration_that_is_not_there() {
    let recording = TinyRecording::new(1);
    let output = sunblind().arg("replay").arg(recording.folder()).args(["--calibration", "missing.toml"]).output();
    let output = output.unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr_of(&output).contains("missing.toml: no such file"), "{}", stderr_of(&output));
}

#[test]
fn a_truth_that_is_no_pose() {
    for (from, to, expected) in [
        ("100.000 2 ", "100.000 NaN ", "groundtruth.txt:1:9: `NaN` is no finite number"),
        ("100.000 2 ", "100.000 2 x ", "groundtruth.txt:1:11: `x` is no finite number"),
        ("100.000 2 ", "100.000 ", "groundtruth.txt:1:22: 6 of 7 numbers"),
        ("100.000 2 ", "100.000 2 2 ", "groundtruth.txt:1:25: `1` is one field too many"),
        ("0 0 0 1\n", "0 0 0 2\n", "groundtruth.txt:1:9: the quaternion's length is 2.0000, not 1"),
    ] {
        let recording = TinyRecording::new(2);
        recording.replace("groundtruth.txt", from, to);
        refused(&recording, &[expected, "write `timestamp tx ty tz qx qy qz qw`"]);
    }
}

/// A recording with wheels and an infrared image.
fn robot() -> TinyRecording {
    let recording = TinyRecording::new(2);
    let calibration = fs::read_to_string(recording.path("calibration.toml")).unwrap();
    let mount = "[mount]\nrobot_from_colour = { translation_m = [0, 0, 0], rotation_xyzw = [0, 0, 0, 1] }";
    let drive = "[drive]\nticks_per_m = 138000.0\neffective_track_m = 0.588";
    recording.write("calibration.toml", format!("{calibration}\n{mount}\n\n{drive}\n"));
    recording.write("odometry.txt", "# timestamp left_ticks right_ticks\n100.0 0 0\n100.1 1380 1381\n");
    recording.write("gyro.txt", "100.0 0 0 0.01\n100.1 0 0 0.02\n");
    recording.write("ir.txt", "100.05 ir/0.png\n");
    fs::create_dir(recording.path("ir")).unwrap();
    image::ImageBuffer::from_pixel(WIDTH, HEIGHT, image::Luma([1023_u16])).save(recording.path("ir/0.png")).unwrap();
    recording
}

#[test]
fn wheels_that_count_nothing() {
    let line = "write `timestamp left_ticks right_ticks`: seconds, encoder counts, or delete this line";
    for (from, to, expected) in [
        ("100.1 1380 1381", "100.1 1380.5 1381", "odometry.txt:3:7: `1380.5` is no whole number"),
        ("100.1 1380 1381", "100.1 1380", "odometry.txt:3:11: 1 of 2 numbers"),
        ("100.1 1380 1381", "100.1 1380 1381 5", "odometry.txt:3:17: `5` is one field too many"),
    ] {
        let recording = robot();
        recording.replace("odometry.txt", from, to);
        refused(&recording, &[expected, line]);
    }
    let recording = robot();
    recording.replace("odometry.txt", "100.1 ", "100.0 ");
    refused(&recording, &["odometry.txt:3:1: time stamp 100 s is not later than 100 s"]);
    recording.write("odometry.txt", "# nothing\n");
    refused(&recording, &["odometry.txt: lists nothing", "`timestamp left_ticks right_ticks`"]);
}

#[test]
fn a_gyro_that_is_no_number() {
    let recording = robot();
    recording.replace("gyro.txt", "0.02", "NaN");
    refused(&recording, &["gyro.txt:2:11: `NaN` is no finite number", "`timestamp wx wy wz`: seconds, rad/s"]);
}

#[test]
fn infrared_that_is_none() {
    let recording = robot();
    save(&recording, "ir/0.png", WIDTH, HEIGHT, ColorType::L16);
    refused(&recording, &["ir/0.png: an infrared value is 1799, but a Kinect's have 10 bits", "without scaling"]);
    save(&recording, "ir/0.png", WIDTH, HEIGHT, ColorType::L8);
    refused(&recording, &["ir/0.png: infrared must be 16-bit grey PNG, this image is 8-bit grey"]);
    save(&recording, "ir/0.png", WIDTH, HEIGHT + 8, ColorType::L16);
    refused(&recording, &["ir/0.png: the image is 64×56 px", "64×48 px for [depth]"]);
    recording.remove("ir/0.png");
    refused(&recording, &["ir.txt:1:8: the image", "ir/0.png does not exist"]);
}

#[test]
fn a_drive_that_no_robot_has() {
    let recording = robot();
    recording.replace("calibration.toml", "ticks_per_m = 138000.0", "ticks_per_m = -1");
    refused(&recording, &["calibration.toml:30:15: ticks_per_m is -1; write a positive number, such as 138000.0"]);
    let recording = robot();
    recording.replace("calibration.toml", "[mount]\nrobot_from_colour", "#");
    refused(&recording, &["calibration.toml:28:1: [drive] needs to know where the camera sits", "write [mount]"]);
    let recording = robot();
    recording.replace("calibration.toml", "[drive]", "[latency]\nrgb = 0.1\n\n[drive]");
    refused(&recording, &["calibration.toml:30:1: unknown variant `rgb`, expected one of `gyro_s`"]);
}
