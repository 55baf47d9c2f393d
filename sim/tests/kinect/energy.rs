//! What the images of one place hold in lamplight, in the sun and at night: enough to tell them apart.

use nalgebra::Isometry3;
use sunblind_estimator::mode::{of_colour, of_depth, of_infrared};
use sunblind_sim::kinect::calibration::Calibration;
use sunblind_sim::validation::bench::Bench;
use sunblind_sim::validation::scene::{Light, room_world};

#[test]
fn energies_tell_lamplight_sun_and_night_apart() {
    let camera = Calibration::nominal().rig(Isometry3::identity()).depth;
    let energies = |light| {
        let mut bench = Bench::new(&room_world(12, light)).expect("a graphics adapter");
        let frame = bench.look().expect("a frame").frame;
        [of_colour(&frame.rgb), of_infrared(&frame.infrared), of_depth(&frame.depth_raw, &camera)]
    };
    let [lamps, sun, night] = [Light::LED, Light::sun(80.0), Light::led(0.05)].map(energies);
    println!("colour, infrared, depth: lamps {lamps:.3?}, sun {sun:.3?}, night {night:.3?}");
    let [rgb, infrared, depth] = [0, 1, 2];
    assert!(sun[depth] < 0.3 * lamps[depth].min(night[depth]), "the sun takes depth");
    assert!(night[rgb] < 0.2 * lamps[rgb].min(sun[rgb]), "the night takes colour");
    assert!((night[depth] / lamps[depth] - 1.0).abs() < 0.05, "and leaves depth");
    assert!(sun[infrared] > 2.0 * lamps[infrared].max(night[infrared]), "infrared is bright in the sun alone");
}
