//! Which images of a stream make a frame: a colour and a depth image that were captured together. An infrared image of
//! that instant goes with it.

use std::sync::Arc;

use sunblind_estimator::image::InfraredImage;
use sunblind_estimator::{Measurement, MeasurementData};

use crate::record::Frame;

/// Colour and depth further apart than this are not of one frame, seconds: half a period at 30 Hz, rounded up.
const MAX_GAP: f64 = 0.02;

/// The images that have no partner yet: at most the newest of each kind.
#[derive(Default)]
pub(super) struct Pairing {
    rgb: Option<Measurement>,
    depth: Option<Measurement>,
    infrared: Option<Measurement>,
}

/// All images of one instant.
pub(super) struct Shot {
    pub frame: Frame,
    /// If it came before the frame was complete.
    pub infrared: Option<Arc<InfraredImage>>,
}

/// What a measurement does to the frames.
#[derive(Default)]
pub(super) struct Paired {
    /// It completes this one.
    pub shot: Option<Shot>,
    /// An image that stays without a partner because of it.
    pub alone: Option<Measurement>,
}

impl Pairing {
    /// Takes the next measurement of the stream.
    pub fn take(&mut self, measurement: &Measurement) -> Paired {
        let waiting = match measurement.data {
            MeasurementData::Rgb(_) => &mut self.rgb,
            MeasurementData::Depth(_) => &mut self.depth,
            MeasurementData::Infrared(_) => {
                self.infrared = Some(measurement.clone());
                return Paired::default();
            }
            _ => return Paired::default(),
        };
        let alone = waiting.replace(measurement.clone());
        let shot = self.frame().map(|frame| Shot { infrared: self.infrared_of(&frame), frame });
        if shot.is_some() {
            *self = Self::default();
        }
        Paired { shot, alone }
    }

    /// The colour and depth images that have stayed without a partner at the end of the stream.
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

    fn infrared_of(&self, frame: &Frame) -> Option<Arc<InfraredImage>> {
        let Measurement { captured_at, data: MeasurementData::Infrared(image), .. } = self.infrared.as_ref()? else {
            return None;
        };
        (captured_at.since(frame.depth_time).abs() <= MAX_GAP).then(|| Arc::clone(image))
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
            frames.extend(paired.shot.map(|Shot { frame, .. }| (ms(frame.rgb_time), ms(frame.depth_time))));
            alone.extend(paired.alone.map(|image| ms(image.captured_at)));
        }
        assert_eq!((frames, alone), (vec![(0, 10), (66, 66)], vec![33]));
        assert_eq!(pairing.left().map(|image| ms(image.captured_at)).collect::<Vec<_>>(), [99, 70]);
    }

    #[test]
    fn an_infrared_image_goes_with_the_frame_of_its_instant() {
        let rgb = MeasurementData::Rgb(Arc::new(RgbImage::filled(1, 1, [0; 3])));
        let depth = MeasurementData::Depth(Arc::new(DepthImage::filled(1, 1, 0)));
        let infrared = |value| MeasurementData::Infrared(Arc::new(InfraredImage::filled(1, 1, value)));
        let stream =
            [(0, rgb.clone()), (0, infrared(7)), (0, depth.clone()), (33, infrared(8)), (66, rgb), (66, depth)];
        let mut pairing = Pairing::default();
        let mut seen = Vec::new();
        for (at, data) in stream {
            let time = Timestamp::from_nanos(at * 1_000_000);
            let paired = pairing.take(&Measurement { captured_at: time, available_at: time, data });
            seen.extend(paired.shot.map(|shot| shot.infrared.map(|image| image.at(0, 0))));
        }
        assert_eq!(seen, [Some(7), None]);
    }
}
