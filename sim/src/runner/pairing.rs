//! Which images of a stream belong together: depth and the colour image that was captured with it, or, where the device
//! gives no colour for the time being, the infrared image.

use std::sync::Arc;

use sunblind_estimator::image::{DepthImage, InfraredImage, RgbImage};
use sunblind_estimator::{Measurement, MeasurementData, Timestamp};

/// Images further apart than this were not captured together, seconds: half a period at 30 Hz, rounded up.
const MAX_GAP: f64 = 0.02;
/// Colour that has been silent for so long is not waited for, seconds: two periods at 15 Hz, rounded up.
const MAX_SILENCE: f64 = 0.15;

/// The images that have no partner yet: at most the newest of each kind.
#[derive(Default)]
pub(super) struct Pairing {
    rgb: Option<Measurement>,
    depth: Option<Measurement>,
    infrared: Option<Measurement>,
    /// When colour was captured last.
    colour_seen: Option<Timestamp>,
}

/// All images of one instant.
pub(super) struct Shot {
    /// When its colour image was captured; where there is none, its infrared image.
    pub time: Timestamp,
    /// When the depth image was captured.
    pub depth_time: Timestamp,
    /// In the rig's encoding.
    pub depth: Arc<DepthImage>,
    /// `None` where the device gave infrared instead.
    pub rgb: Option<Arc<RgbImage>>,
    /// If it came before the others.
    pub infrared: Option<Arc<InfraredImage>>,
}

/// What a measurement does to the shots.
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
            MeasurementData::Rgb(_) => {
                self.colour_seen = Some(measurement.captured_at);
                &mut self.rgb
            }
            MeasurementData::Depth(_) => &mut self.depth,
            MeasurementData::Infrared(_) => &mut self.infrared,
            _ => return Paired::default(),
        };
        let replaced = waiting.replace(measurement.clone());
        // Infrared is never part of a frame's digest.
        let alone = replaced.filter(|image| !matches!(image.data, MeasurementData::Infrared(_)));
        let shot = self.shot();
        if shot.is_some() {
            (self.rgb, self.depth, self.infrared) = (None, None, None);
        }
        Paired { shot, alone }
    }

    /// The colour and depth images that have stayed without a partner at the end of the stream.
    pub fn left(self) -> impl Iterator<Item = Measurement> {
        [self.rgb, self.depth].into_iter().flatten()
    }

    fn shot(&self) -> Option<Shot> {
        let Measurement { captured_at: depth_time, data: MeasurementData::Depth(depth), .. } = self.depth.as_ref()?
        else {
            return None;
        };
        let with_depth = |image: &&Measurement| image.captured_at.since(*depth_time).abs() <= MAX_GAP;
        let rgb = self.rgb.as_ref().filter(with_depth);
        let infrared = self.infrared.as_ref().filter(with_depth);
        let is_coloured = |seen: Timestamp| depth_time.since(seen) <= MAX_SILENCE;
        if rgb.is_none() && self.colour_seen.is_some_and(is_coloured) {
            return None;
        }
        Some(Shot {
            time: rgb.or(infrared)?.captured_at,
            depth_time: *depth_time,
            depth: Arc::clone(depth),
            rgb: rgb.and_then(|image| match &image.data {
                MeasurementData::Rgb(image) => Some(Arc::clone(image)),
                _ => None,
            }),
            infrared: infrared.and_then(|image| match &image.data {
                MeasurementData::Infrared(image) => Some(Arc::clone(image)),
                _ => None,
            }),
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
            frames.extend(paired.shot.map(|Shot { time, depth_time, .. }| (ms(time), ms(depth_time))));
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

    #[test]
    fn where_colour_has_gone_silent_infrared_and_depth_make_a_shot() {
        let rgb = MeasurementData::Rgb(Arc::new(RgbImage::filled(1, 1, [0; 3])));
        let depth = MeasurementData::Depth(Arc::new(DepthImage::filled(1, 1, 0)));
        let infrared = MeasurementData::Infrared(Arc::new(InfraredImage::filled(1, 1, 7)));
        // The device switches after 66 ms, and back before 500.
        let with_infrared = [0, 200, 266].map(|at| [(at, &infrared), (at, &depth)]);
        let stream = [(0, &rgb), (0, &depth), (66, &infrared), (66, &depth)];
        let stream = stream.into_iter().chain(with_infrared[1..].as_flattened().iter().copied());
        let stream = stream.chain([(500, &rgb), (500, &depth)]);
        let mut pairing = Pairing::default();
        let (mut shots, mut alone) = (Vec::new(), Vec::new());
        for (at, data) in stream {
            let time = Timestamp::from_nanos(at * 1_000_000);
            let paired = pairing.take(&Measurement { captured_at: time, available_at: time, data: data.clone() });
            shots.extend(paired.shot.map(|shot| (shot.time.as_nanos() / 1_000_000, shot.rgb.is_some())));
            alone.extend(paired.alone.map(|image| image.captured_at.as_nanos() / 1_000_000));
        }
        assert_eq!(shots, [(0, true), (200, false), (266, false), (500, true)]);
        assert_eq!(alone, [66], "colour might still have come");
    }
}
