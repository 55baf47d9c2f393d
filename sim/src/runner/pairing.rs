//! Which images of a stream make a frame: a colour and a depth image that were captured together.

use std::sync::Arc;

use sunblind_estimator::{Measurement, MeasurementData};

use crate::record::Frame;

/// Colour and depth further apart than this are not of one frame, seconds: half a period at 30 Hz, rounded up.
const MAX_GAP: f64 = 0.02;

/// The images that have no partner yet: at most the newest of either kind.
#[derive(Default)]
pub(super) struct Pairing {
    rgb: Option<Measurement>,
    depth: Option<Measurement>,
}

/// What a measurement does to the frames.
#[derive(Default)]
pub(super) struct Paired {
    /// It completes this one.
    pub frame: Option<Frame>,
    /// An image that stays without a partner because of it.
    pub alone: Option<Measurement>,
}

impl Pairing {
    /// Takes the next measurement of the stream.
    pub fn take(&mut self, measurement: &Measurement) -> Paired {
        let waiting = match measurement.data {
            MeasurementData::Rgb(_) => &mut self.rgb,
            MeasurementData::Depth(_) => &mut self.depth,
            _ => return Paired::default(),
        };
        let alone = waiting.replace(measurement.clone());
        let frame = self.frame();
        if frame.is_some() {
            *self = Self::default();
        }
        Paired { frame, alone }
    }

    /// The images that have stayed without a partner at the end of the stream.
    pub fn left(self) -> impl Iterator<Item = Measurement> {
        [self.rgb, self.depth].into_iter().flatten()
    }

    fn frame(&self) -> Option<Frame> {
        let (rgb, depth) = (self.rgb.as_ref()?, self.depth.as_ref()?);
        let (MeasurementData::Rgb(colour), MeasurementData::Depth(distance)) = (&rgb.data, &depth.data) else {
            return None;
        };
        (rgb.captured_at.since(depth.captured_at).abs() <= MAX_GAP).then(|| Frame {
            rgb_time: rgb.captured_at,
            depth_time: depth.captured_at,
            rgb: Arc::clone(colour),
            depth: Arc::clone(distance),
        })
    }
}

#[cfg(test)]
mod tests {
    use sunblind_estimator::Timestamp;
    use sunblind_estimator::image::{DepthImage, RgbImage};

    use super::*;

    #[test]
    fn a_frame_is_a_colour_and_a_depth_image_captured_together() {
        let rgb = MeasurementData::Rgb(Arc::new(RgbImage::filled(1, 1, [0; 3])));
        let depth = MeasurementData::Depth(Arc::new(DepthImage::filled(1, 1, 0)));
        let stream = [(0, &rgb), (10, &depth), (33, &rgb), (66, &rgb), (66, &depth), (70, &depth), (99, &rgb)];
        let mut pairing = Pairing::default();
        let (mut frames, mut alone) = (Vec::new(), Vec::new());
        let ms = |time: Timestamp| time.as_nanos() / 1_000_000;
        for (at, data) in stream {
            let time = Timestamp::from_nanos(at * 1_000_000);
            let paired = pairing.take(&Measurement { captured_at: time, available_at: time, data: data.clone() });
            frames.extend(paired.frame.map(|frame| (ms(frame.rgb_time), ms(frame.depth_time))));
            alone.extend(paired.alone.map(|image| ms(image.captured_at)));
        }
        assert_eq!((frames, alone), (vec![(0, 10), (66, 66)], vec![33]));
        assert_eq!(pairing.left().map(|image| ms(image.captured_at)).collect::<Vec<_>>(), [99, 70]);
    }
}
