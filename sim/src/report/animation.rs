//! The run as a short animation: the robot on the map, and what its cameras saw. The page's script moves what is drawn
//! here; without it the whole paths and the first images are shown.

use std::io;
use std::ops::Range;

use image::imageops::replace;
use image::{GrayImage, ImageBuffer, PixelWithColorType, RgbImage};
use serde::Serialize;

use super::figures::{Key, floor, seconds, track_class};
use super::format::duration;
use super::imagery::{self, Tones, jpeg};
use super::judged::Judged;
use crate::evaluation::true_pose_at;
use crate::runner::log::{FrameLog, Snapshot};

/// Poses that the animation knows; between them the robot moves evenly.
const POSES: usize = 400;
const QUALITY: u8 = 50;
/// How much faster than the run it plays.
const SPEED: f64 = 5.0;
/// But it lasts this long, seconds.
const LENGTH: Range<f64> = 6.0..20.0;

#[derive(Serialize)]
pub(super) struct Animation {
    /// Holds nothing from outside, and goes into the page as it is.
    pub map: String,
    pub legend: Vec<Key>,
    pub films: Vec<Film>,
    /// [`Run`] as JSON.
    pub run: String,
    pub duration_s: f64,
    pub duration: String,
    pub speed: String,
}

/// Images of one kind on one sheet, row after row.
#[derive(Serialize)]
pub(super) struct Film {
    pub title: &'static str,
    /// JPEG as base64.
    pub sheet: String,
    /// Of one image and of the sheet, pixels.
    pub size: [u32; 2],
    pub sheet_size: [u32; 2],
}

/// What the script reads. Times are seconds from the first frame; places are in the map's user units.
#[derive(Serialize)]
struct Run {
    times: Vec<f64>,
    /// x, y, and degrees clockwise, which run on beyond 360.
    robot: Vec<[f64; 3]>,
    estimate: Vec<[f64; 2]>,
    /// When the images were taken, and how many stand in a row.
    images: Vec<f64>,
    columns: u32,
    /// Seconds of the run in a second.
    speed: f64,
}

/// `None` without images, or where "above" means nothing: of a camera without truth.
pub(super) fn animation(judged: &Judged, tones: &Tones) -> io::Result<Option<Animation>> {
    let log = judged.log;
    let has_truth = !log.truth.is_empty();
    let thumbnails = alike(&log.thumbnails);
    let moments = moments(judged);
    let (Some(first), true, true) = (moments.first(), has_truth || log.has_wheels, !thumbnails.is_empty()) else {
        return Ok(None);
    };
    let robot = || moments.iter().map(|moment| (moment.robot[0], moment.robot[1]));
    let estimate = || moments.iter().map(|moment| (moment.estimate[0], moment.estimate[1]));
    let (mut chart, mut legend) = floor(judged, robot().chain(estimate()));
    if has_truth {
        chart.line("truth trail", &robot().collect::<Vec<_>>());
        legend.push(Key::new("line truth", "truth"));
    }
    chart.line(&format!("{} trail", track_class(0)), &estimate().collect::<Vec<_>>());
    legend.push(Key::new(format!("line {}", track_class(0)), judged.track.label.as_str()));
    chart.robot([first.robot[0], first.robot[1]], log.has_wheels.then_some(first.robot[2]));

    let round = |value: f64| (10.0 * value).round() / 10.0;
    let on_map = |x: f64, y: f64| chart.on_map([x, y]).map(round);
    let columns = (thumbnails.len() as f64).sqrt().ceil() as u32;
    let speed = judged.duration() / (judged.duration() / SPEED).clamp(LENGTH.start, LENGTH.end);
    let run = Run {
        times: moments.iter().map(|moment| (1e3 * moment.time).round() * 1e-3).collect(),
        robot: moments
            .iter()
            .map(|Moment { robot: [x, y, heading], .. }| {
                let [x, y] = on_map(*x, *y);
                [x, y, round(-heading)]
            })
            .collect(),
        estimate: moments.iter().map(|moment| on_map(moment.estimate[0], moment.estimate[1])).collect(),
        images: thumbnails.iter().map(|image| round(seconds(judged, image.time))).collect(),
        columns,
        speed,
    };
    Ok(Some(Animation {
        films: films(&thumbnails, columns, tones)?,
        run: serde_json::to_string(&run)?,
        duration_s: judged.duration(),
        duration: duration(judged.duration()),
        speed: format!("{speed:.1}"),
        map: chart.into_svg("x, m", "y, m", "The robot's way from above"),
        legend,
    }))
}

/// Where everything is at one instant.
struct Moment {
    /// Seconds from the first frame.
    time: f64,
    /// x, y in metres and the heading in degrees anticlockwise, without jumps: the truth, or the estimate if there is none.
    robot: [f64; 3],
    estimate: [f64; 2],
}

/// Up to about [`POSES`] of the judged track's frames, evenly chosen.
fn moments(judged: &Judged) -> Vec<Moment> {
    let frames = &judged.track.frames;
    let step = frames.len().div_ceil(POSES).max(1);
    let mut moments: Vec<Moment> = frames.iter().step_by(step).filter_map(|frame| moment(judged, frame)).collect();
    for index in 1..moments.len() {
        let turn = moments[index].robot[2] - moments[index - 1].robot[2];
        moments[index].robot[2] -= 360.0 * (turn / 360.0).round();
    }
    moments
}

fn moment(judged: &Judged, frame: &FrameLog) -> Option<Moment> {
    let estimate = frame.world_from_body;
    let robot = if judged.log.truth.is_empty() { estimate } else { true_pose_at(&judged.log.truth, frame.time)? };
    let heading = robot.rotation.euler_angles().2.to_degrees();
    let [robot, estimate] = [robot, estimate].map(|pose| pose.translation.vector);
    let moment = Moment {
        time: seconds(judged, frame.time),
        robot: [robot.x, robot.y, heading],
        estimate: [estimate.x, estimate.y],
    };
    moment.robot.iter().chain(&moment.estimate).all(|value| value.is_finite()).then_some(moment)
}

/// Those of the first one's sizes that are not empty: one sheet holds images of one size.
fn alike(thumbnails: &[Snapshot]) -> Vec<&Snapshot> {
    let sizes = |image: &Snapshot| (image.rgb.size(), image.depth.size(), image.infrared.as_ref().map(|i| i.size()));
    let is_empty = |image: &Snapshot| image.rgb.pixels().is_empty() || image.depth.pixels().is_empty();
    let whole = || thumbnails.iter().filter(|image| !is_empty(image));
    let Some(first) = whole().next().map(sizes) else { return Vec::new() };
    whole().filter(|image| sizes(image) == first).collect()
}

fn films(thumbnails: &[&Snapshot], columns: u32, tones: &Tones) -> io::Result<Vec<Film>> {
    let images = || thumbnails.iter();
    let colour: Vec<RgbImage> = images().map(|image| imagery::colour(&image.rgb, u32::MAX)).collect();
    let infrared: Vec<GrayImage> =
        images().filter_map(|image| Some(tones.infrared(image.infrared.as_ref()?, u32::MAX))).collect();
    let depth: Vec<RgbImage> = images().map(|image| tones.depth(&image.depth, u32::MAX)).collect();
    let films = [
        Some(film("Colour", &colour, columns)),
        (!infrared.is_empty()).then(|| film("Infrared", &infrared, columns)),
        Some(film("Depth", &depth, columns)),
    ];
    films.into_iter().flatten().collect()
}

fn film<P: PixelWithColorType<Subpixel = u8>>(
    title: &'static str,
    images: &[ImageBuffer<P, Vec<u8>>],
    columns: u32,
) -> io::Result<Film> {
    let (width, height) = images[0].dimensions();
    let mut sheet = ImageBuffer::new(columns * width, (images.len() as u32).div_ceil(columns) * height);
    for (index, image) in (0_u32..).zip(images) {
        replace(&mut sheet, image, (index % columns * width).into(), (index / columns * height).into());
    }
    Ok(Film { title, sheet: jpeg(&sheet, QUALITY)?, size: [width, height], sheet_size: sheet.dimensions().into() })
}
