//! A calibration as the text of its file.

use std::fmt;

use nalgebra::Isometry3;
use sunblind_estimator::camera::{CameraModel, DepthEncoding};

use super::{Body, Calibration};
use crate::record::sensor::Sensor;

/// The text of its `calibration.toml`; read again it gives the same bits.
impl fmt::Display for Calibration {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { rig, body, latency } = self;
        writeln!(out, "registered = {}", rig.depth.registered_to_colour)?;
        writeln!(out, "alignment_sigma_px = {:?}", rig.alignment_sigma)?;
        writeln!(out, "\n[colour]")?;
        camera(out, &rig.colour)?;
        writeln!(out, "\n[depth]")?;
        camera(out, &rig.depth.model)?;
        match rig.depth.encoding {
            DepthEncoding::Linear { units_per_metre } => writeln!(out, "units_per_m = {units_per_metre:?}")?,
            DepthEncoding::KinectDisparity { offset, baseline } => {
                writeln!(out, "raw_offset = {offset:?}\nbaseline_m = {baseline:?}")?;
            }
        }
        let Isometry3 { rotation, translation } = rig.colour_from_depth;
        writeln!(out, "\n[colour_from_depth]")?;
        writeln!(out, "translation_m = {:?}", translation.vector.as_slice())?;
        writeln!(out, "rotation_xyzw = {:?}", rotation.coords.as_slice())?;
        match body {
            Body::Colour => writeln!(out, "\n[truth]\ncamera = \"colour\"")?,
            Body::Depth => writeln!(out, "\n[truth]\ncamera = \"depth\"")?,
            Body::Robot => {
                let Isometry3 { rotation, translation } = rig.robot_from_colour;
                let (translation, rotation) = (translation.vector, rotation.coords);
                writeln!(
                    out,
                    "\n[mount]\nrobot_from_colour = {{ translation_m = {:?}, rotation_xyzw = {:?} }}",
                    translation.as_slice(),
                    rotation.as_slice()
                )?;
            }
        }
        if let Some(drive) = rig.drive {
            let (ticks, track) = (drive.ticks_per_metre, drive.effective_track);
            writeln!(out, "\n[drive]\nticks_per_m = {ticks:?}\neffective_track_m = {track:?}")?;
        }
        let delayed: Vec<_> = Sensor::ALL.into_iter().filter(|&sensor| latency.nanos(sensor) != 0).collect();
        if !delayed.is_empty() {
            writeln!(out, "\n[latency]")?;
        }
        for sensor in delayed {
            writeln!(out, "{}_s = {:?}", sensor.stem(), latency.nanos(sensor) as f64 / 1e9)?;
        }
        Ok(())
    }
}

fn camera(out: &mut fmt::Formatter, camera: &CameraModel) -> fmt::Result {
    let CameraModel { width, height, fx, fy, cx, cy, distortion: d } = camera;
    writeln!(out, "width_px = {width}\nheight_px = {height}")?;
    writeln!(out, "fx_px = {fx:?}\nfy_px = {fy:?}\ncx_px = {cx:?}\ncy_px = {cy:?}")?;
    writeln!(out, "distortion = {:?}   # k1 k2 p1 p2 k3", [d.k1, d.k2, d.p1, d.p2, d.k3])
}
