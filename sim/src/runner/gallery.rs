//! The images of a run that are kept for its report.

use sunblind_estimator::image::{Image, InfraredImage, RgbImage};
use sunblind_estimator::odometry::FeatureTrack;
use sunblind_estimator::{Mode, Rig};

use super::log::Snapshot;
use super::pairing::Shot;

/// Instants whose images are kept as they are.
const SNAPSHOTS: usize = 6;
/// Instants whose images are kept small, 16 MB in all: about one a second of the usual run.
const THUMBNAILS: usize = 64;
/// Columns of a small image: a multiple of JPEG's blocks, as its rows are, so that images on one sheet don't mix.
const THUMBNAIL_WIDTH: usize = 192;

/// What has been kept so far.
pub(super) struct Gallery {
    expected_frames: usize,
    next_frame: usize,
    snapshots: Vec<Snapshot>,
    thumbnails: Vec<Snapshot>,
}

impl Gallery {
    /// `expected_frames` decides which are kept.
    pub fn new(expected_frames: usize) -> Self {
        Self { expected_frames, next_frame: 0, snapshots: Vec::new(), thumbnails: Vec::new() }
    }

    /// Looks at the next frame; `seen` is asked for its feature tracks and the mode if it is kept as it is.
    pub fn take(&mut self, shot: &Shot, rig: &Rig, seen: impl FnOnce() -> (Vec<FeatureTrack>, Mode)) {
        let (index, count) = (self.next_frame, self.expected_frames);
        self.next_frame += 1;
        if is_among(SNAPSHOTS, index, count) {
            let (tracks, mode) = seen();
            self.snapshots.push(Snapshot { tracks, mode, ..snapshot(shot, rig) });
        }
        if is_among(THUMBNAILS, index, count) {
            self.thumbnails.push(thumbnail(&snapshot(shot, rig)));
        }
    }

    /// The instants that are kept as they are, and those that are kept small. Where some have an infrared image all do.
    pub fn finish(self) -> [Vec<Snapshot>; 2] {
        [self.snapshots, self.thumbnails].map(|mut kept| {
            if kept.iter().any(|shot| shot.infrared.is_some()) {
                for shot in &mut kept {
                    let (width, height) = shot.depth.size();
                    shot.infrared.get_or_insert_with(|| InfraredImage::filled(width, height, 0));
                }
            }
            kept
        })
    }
}

/// Whether frame `index` of `count` is in the middle of one of `parts` equal parts.
fn is_among(parts: usize, index: usize, count: usize) -> bool {
    (0..parts).any(|part| (2 * part + 1) * count / (2 * parts) == index)
}

fn snapshot(Shot { time, depth, rgb, infrared, .. }: &Shot, rig: &Rig) -> Snapshot {
    let metres = depth.pixels().iter().map(|&value| rig.depth.depth_of(value).unwrap_or(0.0) as f32);
    let (width, height) = depth.size();
    let black = || RgbImage::filled(rig.colour.size().0, rig.colour.size().1, [0; 3]);
    Snapshot {
        time: *time,
        rgb: rgb.as_deref().map_or_else(black, RgbImage::clone),
        infrared: infrared.as_deref().cloned(),
        depth: Image::from_pixels(width, height, metres.collect()).expect("one value a pixel"),
        tracks: Vec::new(),
        mode: Mode::Odometer,
    }
}

fn thumbnail(Snapshot { time, rgb, infrared, depth, .. }: &Snapshot) -> Snapshot {
    let mean_colour = |block: &[[u8; 3]]| [0, 1, 2].map(|channel| mean(block.iter().map(|pixel| pixel[channel])) as u8);
    Snapshot {
        time: *time,
        rgb: shrunk(rgb, mean_colour),
        infrared: infrared.as_ref().map(|image| shrunk(image, |block| mean(block.iter().copied()) as u16)),
        // The median: a mean over an edge or a hole would be a depth that nobody measured.
        depth: shrunk(depth, |block| median(block.to_vec())),
        tracks: Vec::new(),
        mode: Mode::Odometer,
    }
}

fn mean<P: Into<u32>>(values: impl ExactSizeIterator<Item = P>) -> u32 {
    let count = values.len() as u32;
    values.map(Into::into).sum::<u32>() / count
}

/// Panics on nothing.
fn median(mut values: Vec<f32>) -> f32 {
    values.sort_by(f32::total_cmp);
    values[values.len() / 2]
}

/// An image [`THUMBNAIL_WIDTH`] wide, each pixel what `summary` makes of the block in its place. A smaller image, or one
/// without rows, stays as it is.
fn shrunk<P: Copy>(image: &Image<P>, summary: impl Fn(&[P]) -> P) -> Image<P> {
    let (width, height) = image.size();
    if width <= THUMBNAIL_WIDTH || height == 0 {
        return image.clone();
    }
    let small_height = (THUMBNAIL_WIDTH * height / width).max(1);
    let range = |index: usize, size: usize, small: usize| index * size / small..((index + 1) * size).div_ceil(small);
    let mut pixels = Vec::with_capacity(THUMBNAIL_WIDTH * small_height);
    let mut block = Vec::new();
    for y in 0..small_height {
        for x in 0..THUMBNAIL_WIDTH {
            block.clear();
            for row in range(y, height, small_height) {
                block.extend_from_slice(&image.row(row)[range(x, width, THUMBNAIL_WIDTH)]);
            }
            pixels.push(summary(&block));
        }
    }
    Image::from_pixels(THUMBNAIL_WIDTH, small_height, pixels).expect("one value a pixel")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_spread_evenly() {
        let kept = |count| (0..count).filter(|&index| is_among(6, index, count)).collect::<Vec<_>>();
        assert_eq!(kept(300), [25, 75, 125, 175, 225, 275]);
        assert_eq!(kept(3), [0, 1, 2]);
        assert_eq!(kept(1), [0]);
    }

    #[test]
    fn a_small_image_shows_what_the_large_one_does() {
        let slope = |index: usize| 4 * (index % 640) as u16;
        let large = Image::from_pixels(640, 480, (0..640 * 480).map(slope).collect()).unwrap();
        let small = shrunk(&large, |block| mean(block.iter().copied()) as u16);
        assert_eq!(small.size(), (192, 144));
        for (x, value) in small.row(100).iter().enumerate() {
            let expected = 4.0 * ((x as f64 + 0.5) * 640.0 / 192.0 - 0.5);
            assert!((f64::from(*value) - expected).abs() < 2.5, "{x}: {value} for {expected}");
        }
        assert_eq!(shrunk(&small, |block| block[0]), small);
    }
}
