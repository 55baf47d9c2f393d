//! What the camera saw at a few instants: colour and infrared, one of them with the tracked features, and
//! depth in false colour.

use std::fmt::Write;
use std::io;

use serde::Serialize;
use sunblind_estimator::Mode;
use sunblind_estimator::odometry::FeatureTrack;

use super::format::{duration, length};
use super::imagery::{self, NO_VALUE, Tones, css, jpeg};
use super::judged::Judged;
use crate::false_colour;
use crate::runner::log::Snapshot;

/// Columns of an embedded image.
const WIDTH: u32 = 320;
const QUALITY: u8 = 80;

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
    /// Size in pixels of the image in which the tracks are drawn.
    pub width: usize,
    pub height: usize,
    /// JPEG as base64; empty for an empty image.
    pub colour: String,
    pub infrared: String,
    /// Whether the tracks are in the infrared image.
    pub at_night: bool,
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
pub(super) fn pictures(judged: &Judged, tones: &Tones) -> io::Result<Option<Pictures>> {
    let snapshots = &judged.log.snapshots;
    if snapshots.is_empty() {
        return Ok(None);
    }
    let pictures = snapshots.iter().map(|snapshot| picture(judged, snapshot, tones));
    Ok(Some(Pictures {
        pictures: pictures.collect::<io::Result<_>>()?,
        nearest: length(tones.nearest.into()),
        farthest: length(tones.farthest.into()),
        gradient: (0..=8).map(|step| css(false_colour::of_depth(step as f32 / 8.0))).collect::<Vec<_>>().join(","),
        no_value: css(NO_VALUE),
        any_tracks: snapshots.iter().any(|snapshot| !snapshot.tracks.is_empty()),
    }))
}

fn picture(judged: &Judged, snapshot: &Snapshot, tones: &Tones) -> io::Result<Picture> {
    let (width, height) = match (snapshot.mode, &snapshot.infrared) {
        (Mode::Night, Some(infrared)) => infrared.size(),
        _ => snapshot.rgb.size(),
    };
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
        colour: jpeg(&imagery::colour(&snapshot.rgb, WIDTH), QUALITY)?,
        infrared: match &snapshot.infrared {
            Some(image) => jpeg(&tones.infrared(image, WIDTH), QUALITY)?,
            None => String::new(),
        },
        depth: jpeg(&tones.depth(&snapshot.depth, WIDTH), QUALITY)?,
        at_night: snapshot.mode == Mode::Night,
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
