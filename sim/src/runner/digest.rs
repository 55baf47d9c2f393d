//! Fingerprints of what was measured.

use sha2::{Digest, Sha256};
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};

use super::pairing::Shot;
use crate::record::Sensor;

/// Whether it is an image of a kind that frames are made of.
pub(super) fn may_be_in_a_frame(measurement: &Measurement) -> bool {
    matches!(measurement.data, MeasurementData::Rgb(_) | MeasurementData::Depth(_))
}

/// SHA-256 over the times, sizes and pixels of a shot's colour and depth.
pub(super) fn of_frame(Shot { time, depth_time, rgb, depth, .. }: &Shot) -> [u8; 32] {
    let mut hash = Sha256::new();
    if let Some(rgb) = rgb {
        head(&mut hash, *time, rgb.size());
    }
    head(&mut hash, *depth_time, depth.size());
    if let Some(rgb) = rgb {
        hash.update(rgb.pixels().as_flattened());
    }
    hash.update(little_endian(depth.pixels()));
    hash.finalize().into()
}

/// SHA-256 over all that is in a measurement but when it arrived.
pub(super) fn of_measurement(measurement: &Measurement) -> [u8; 32] {
    let Measurement { captured_at, data, .. } = measurement;
    let mut hash = Sha256::new_with_prefix(Sensor::of(data).stem());
    match data {
        MeasurementData::Rgb(image) => {
            head(&mut hash, *captured_at, image.size());
            hash.update(image.pixels().as_flattened());
        }
        MeasurementData::Infrared(image) | MeasurementData::Depth(image) => {
            head(&mut hash, *captured_at, image.size());
            hash.update(little_endian(image.pixels()));
        }
        // Debug writes a float with as many digits as bring its bits back.
        data => hash.update(format!("{captured_at:?} {data:?}")),
    }
    hash.finalize().into()
}

fn head(hash: &mut Sha256, time: Timestamp, (width, height): (usize, usize)) {
    hash.update(time.as_nanos().to_le_bytes());
    hash.update((width as u64).to_le_bytes());
    hash.update((height as u64).to_le_bytes());
}

fn little_endian(pixels: &[u16]) -> Vec<u8> {
    pixels.iter().flat_map(|value| value.to_le_bytes()).collect()
}
