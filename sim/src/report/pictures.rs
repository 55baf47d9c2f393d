//! What the camera saw at a few instants: colour with the tracked features, depth in false colour.

use std::fmt::Write;
use std::io;

use base64::Engine;
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{FilterType, resize};
use image::{ExtendedColorType, RgbImage};
use serde::Serialize;
use sunblind_estimator::image::Image;
use sunblind_estimator::odometry::FeatureTrack;

use super::format::{duration, length};
use super::judged::Judged;
use super::timing::quantile;
use crate::false_colour;
use crate::runner::log::Snapshot;

/// Columns of an embedded image.
const WIDTH: u32 = 320;
const JPEG_QUALITY: u8 = 80;
/// What a depth pixel without a value is drawn in: a grey, which the colours of depth never are.
const NO_VALUE: [u8; 3] = [128, 132, 138];

/// All pictures, and the key to their depth.
#[derive(Serialize)]
pub(super) struct Pictures {
    pub pictures: Vec<Picture>,
    pub nearest: String,
    pub farthest: String,
    /// Colours from near to far, for a CSS gradient.
    pub gradient: String,
    pub no_value: String,
    pub any_tracks: bool,
}

/// One instant.
#[derive(Serialize)]
pub(super) struct Picture {
    pub time: String,
    pub caption: String,
    /// Size of the colour image in pixels, in which the tracks are drawn.
    pub width: usize,
    pub height: usize,
    /// JPEG as base64; empty for an empty image.
    pub colour: String,
    pub depth: String,
    /// SVG path data.
    pub inliers: Flow,
    pub outliers: Flow,
}

/// Feature tracks as SVG path data: the ways gone, and the points reached.
#[derive(Serialize)]
pub(super) struct Flow {
    pub lines: String,
    pub ends: String,
}

/// `None` without snapshots.
pub(super) fn pictures(judged: &Judged) -> io::Result<Option<Pictures>> {
    let snapshots = &judged.log.snapshots;
    if snapshots.is_empty() {
        return Ok(None);
    }
    let (nearest, farthest) = depth_range(snapshots);
    let pictures = snapshots.iter().map(|snapshot| picture(judged, snapshot, nearest, farthest));
    Ok(Some(Pictures {
        pictures: pictures.collect::<io::Result<_>>()?,
        nearest: length(nearest.into()),
        farthest: length(farthest.into()),
        gradient: (0..=8).map(|step| css(false_colour::of_depth(step as f32 / 8.0))).collect::<Vec<_>>().join(","),
        no_value: css(NO_VALUE),
        any_tracks: snapshots.iter().any(|snapshot| !snapshot.tracks.is_empty()),
    }))
}

fn picture(judged: &Judged, snapshot: &Snapshot, nearest: f32, farthest: f32) -> io::Result<Picture> {
    let (width, height) = snapshot.rgb.size();
    let (inliers, outliers): (Vec<_>, Vec<_>) = snapshot.tracks.iter().partition(|track| track.inlier);
    let since_start = judged.start().map_or(0.0, |start| snapshot.time.since(start));
    Ok(Picture {
        time: duration(since_start),
        caption: match snapshot.tracks.len() {
            0 => "no matches".into(),
            matches => format!("{} of {matches} matches agree", inliers.len()),
        },
        width,
        height,
        colour: to_jpeg(&small_colour(&snapshot.rgb))?,
        depth: to_jpeg(&small_depth(&snapshot.depth, nearest, farthest))?,
        inliers: flow(&inliers),
        outliers: flow(&outliers),
    })
}

fn flow(tracks: &[&FeatureTrack]) -> Flow {
    let (mut lines, mut ends) = (String::new(), String::new());
    let finite = |track: &&&FeatureTrack| track.from.iter().chain(&track.to).all(|value| value.is_finite());
    for FeatureTrack { from, to, .. } in tracks.iter().filter(finite) {
        // Whole pixels do for a picture at half its size, and halve the page.
        let [from_x, from_y, x, y] = [from[0], from[1], to[0], to[1]].map(|value| value.round() as i32);
        write!(lines, "M{from_x} {from_y}L{x} {y}").expect("a string takes all that is written to it");
        write!(ends, "M{x} {y}h0").expect("a string takes all that is written to it");
    }
    Flow { lines, ends }
}

/// The range that holds all but the outermost 2 % of the depths at either end, metres; over all snapshots, so that one
/// colour means one depth throughout.
fn depth_range(snapshots: &[Snapshot]) -> (f32, f32) {
    let values = snapshots.iter().flat_map(|snapshot| snapshot.depth.pixels());
    let mut values: Vec<f64> = values.filter(|z| has_value(**z)).map(|&z| f64::from(z)).collect();
    if values.is_empty() {
        return (0.5, 5.0);
    }
    values.sort_by(f64::total_cmp);
    let (near, far) = (quantile(&values, 0.02), quantile(&values, 0.98));
    let (near, far) = ((10.0 * near).floor() / 10.0, (10.0 * far).ceil() / 10.0);
    (near as f32, far.max(near + 0.1) as f32)
}

fn has_value(z: f32) -> bool {
    z.is_finite() && z > 0.0
}

fn small_colour(image: &sunblind_estimator::image::RgbImage) -> RgbImage {
    let (width, height) = (image.width() as u32, image.height() as u32);
    let full = RgbImage::from_raw(width, height, image.pixels().as_flattened().to_vec());
    let full = full.expect("an image has as many pixels as its size says");
    let (small_width, small_height) = small_size(width, height);
    if small_width == width { full } else { resize(&full, small_width, small_height, FilterType::Triangle) }
}

/// By nearest neighbour: a mean over an edge or a hole would show a depth that nobody measured.
fn small_depth(image: &Image<f32>, nearest: f32, farthest: f32) -> RgbImage {
    let (width, height) = (image.width() as u32, image.height() as u32);
    let small = small_size(width, height);
    RgbImage::from_fn(small.0, small.1, |x, y| {
        let z = image.at((x * width / small.0) as usize, (y * height / small.1) as usize);
        image::Rgb(if has_value(z) { false_colour::of_depth((z - nearest) / (farthest - nearest)) } else { NO_VALUE })
    })
}

/// What no wider than [`WIDTH`] is stays as it is, and so does an image without rows.
fn small_size(width: u32, height: u32) -> (u32, u32) {
    if width <= WIDTH || height == 0 { (width, height) } else { (WIDTH, (WIDTH * height / width).max(1)) }
}

fn css([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn to_jpeg(image: &RgbImage) -> io::Result<String> {
    if image.is_empty() {
        return Ok(String::new());
    }
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY)
        .encode(image, image.width(), image.height(), ExtendedColorType::Rgb8)
        .map_err(io::Error::other)?;
    Ok(base64::engine::general_purpose::STANDARD.encode(bytes))
}
