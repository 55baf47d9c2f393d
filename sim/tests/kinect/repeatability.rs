//! Equal inputs, equal bytes: whatever the number of threads that render and match.

use std::process::Command;

use glam::DAffine3;
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::kinect::{Imaging, Kinect};
use sunblind_sim::render::Sweep;

use sunblind_sim::validation::scene::{Light, looking_north, room_world};

const MARK: &str = "bytes: ";

#[test]
#[ignore = "the test below runs it, in processes of their own"]
fn print_bytes() {
    let world = room_world(12, Light::sun(0.5));
    let mut kinect = Kinect::new(&world, Calibration::nominal(), Imaging::default(), 5).expect("a graphics adapter");
    let mut bytes = Vec::new();
    for (frame, turn) in [(0, 0.0), (1, 0.004), (2, 0.03)] {
        let sweep = Sweep { start: looking_north(), end: looking_north() * DAffine3::from_rotation_y(turn) };
        let seen = kinect.capture(&sweep, frame).expect("a frame");
        bytes.extend_from_slice(seen.rgb.pixels().as_flattened());
        bytes.extend(seen.infrared.pixels().iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend(seen.depth_raw.pixels().iter().flat_map(|raw| raw.to_le_bytes()));
    }
    // FNV-1a.
    let digest = bytes
        .iter()
        .fold(0xCBF2_9CE4_8422_2325_u64, |digest, &byte| (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3));
    println!("{MARK}{digest:016x}");
}

#[test]
fn threads_do_not_change_a_byte() {
    let digest = |threads: &str| {
        let program = std::env::current_exe().expect("a test is a program");
        let run = Command::new(program)
            .args(["--exact", "repeatability::print_bytes", "--ignored", "--nocapture"])
            .envs([("LP_NUM_THREADS", threads), ("RAYON_NUM_THREADS", threads)])
            .output()
            .expect("it runs again");
        let text = String::from_utf8_lossy(&run.stdout).into_owned();
        let digest = text.split_once(MARK).map(|(_, rest)| rest[..16].to_owned());
        digest.unwrap_or_else(|| panic!("{text}{}", String::from_utf8_lossy(&run.stderr)))
    };
    let single = digest("1");
    assert_eq!(digest("2"), single);
    assert_eq!(digest("5"), single);
}
