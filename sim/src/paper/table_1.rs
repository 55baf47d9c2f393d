//! The first paper's Table 1: how well points of a board are placed in space, each by single frames.

use std::fmt::Write;

use nalgebra::{Isometry3, Point2, Point3, UnitQuaternion, Vector3};
use rand::RngExt;
use sunblind_estimator::camera::CameraModel;
use sunblind_estimator::features::surf::{Surf, SurfParams};
use sunblind_estimator::image::{GrayImage, Image};
use sunblind_estimator::structure::{AlbedoCamera, DepthNoise, Registration, Stereo, depth_at};
use sunblind_estimator::{Mode, Rig};

use super::board::{Board, CARBON, Shot, shots};
use super::corner::corner;
use super::{Goal, Section};
use crate::kinect::KinectFrame;
use crate::kinect::calibration::{Calibration, Residual};
use crate::random::stream;
use crate::render::RenderError;
use crate::validation::Effort;
use crate::validation::scene::Light;

/// What calibration leaves, as in every scenario.
const RESIDUAL: Residual = Residual { pixels: 0.1, degrees: 0.01 };
/// A board's square by the least distance that it is seen from: there the board fills the view. Outdoors smaller ones
/// would repeat within the 28 px over which the pair of cameras is matched.
const SQUARE: f64 = 1.0 / 16.0;
/// A corner is sought in a window of so many squares to all sides: no other is in it.
const REACH: f64 = 0.45;
/// A person points at a corner give or take so much, pixels. A guess.
const POINTED: f64 = 2.0;
/// Albedo's grey levels for each factor of e, and that of its median.
const LEVELS: [f32; 2] = [50.0, 128.0];
/// Least scale of features at night, pixels, as odometry has it.
const NIGHT_SCALE: f32 = 2.8;
/// Blue skylight in which depth by the projector and by the two cameras both hold, lux. Measured: corners have the
/// projector's at 100 to 500 lx, and the dots mislead the cameras below 100 lx.
const DUSK_LX: f32 = 200.0;
/// Full sun on an upright board, kilolux.
const SUN_KLX: f32 = 60.0;

/// A column of the paper's table.
struct Column {
    mode: Mode,
    name: &'static str,
    light: Light,
    /// Metres, least and most.
    z: [f64; 2],
    /// σ of x, y, z, millimetres.
    paper: [f64; 3],
}

fn columns() -> [Column; 3] {
    let of = |mode, name, light, z, paper| Column { mode, name, light, z, paper };
    [
        of(Mode::Indoor, "indoors, colour and depth", Light::LED, [0.8, 2.0], [7.0, 10.0, 30.0]),
        of(Mode::Outdoor, "outdoors, colour and infrared", Light::sun(SUN_KLX), [1.4, 2.2], [15.0, 20.0, 37.0]),
        of(Mode::Night, "at night, infrared and depth", Light::NONE, [0.8, 2.0], [10.0, 15.0, 33.0]),
    ]
}

impl Column {
    fn board(&self) -> Board {
        Board { square: SQUARE * self.z[0], black: CARBON }
    }

    /// So many distances at which all of the board is within the column's.
    fn distances(&self, count: usize) -> Vec<f64> {
        let margin = 1.2 * self.board().square;
        let (first, last) = (self.z[0] + margin, self.z[1] - margin);
        (0..count).map(|step| first + (last - first) * step as f64 / (count - 1) as f64).collect()
    }
}

/// What was sought, and how far what was found is from where it is; metres, in the colour camera's frame.
#[derive(Clone, Debug, Default)]
struct Errors {
    sought: usize,
    errors: Vec<Vector3<f64>>,
}

impl Errors {
    fn add(&mut self, found: impl IntoIterator<Item = Option<Point3<f64>>>, truth: &[Point3<f64>]) {
        self.sought += truth.len();
        self.errors.extend(found.into_iter().zip(truth).filter_map(|(found, truth)| Some(found? - truth)));
    }

    /// Root mean square of x, y, z, millimetres.
    fn rms(&self) -> [f64; 3] {
        let mean =
            |axis: usize| self.errors.iter().map(|error| error[axis].powi(2)).sum::<f64>() / self.errors.len() as f64;
        [0, 1, 2].map(|axis| 1000.0 * mean(axis).sqrt())
    }

    fn found_percent(&self) -> f64 {
        100.0 * self.errors.len() as f64 / self.sought as f64
    }
}

/// What came of a column.
#[derive(Default)]
struct Measured {
    corners: Errors,
    /// Had calibration left nothing.
    perfect: Errors,
    /// As calibration left the device, before its look at the board by dusk.
    before: Errors,
    surf: Errors,
}

/// The table, measured.
///
/// # Errors
/// Nothing here can render.
pub fn table_1(effort: Effort) -> Result<Section, RenderError> {
    let (units, distances) = match effort {
        Effort::Full => (10, 5),
        Effort::Reduced => (3, 3),
    };
    let table: Vec<_> = columns()
        .into_iter()
        .map(|column| Ok((column.measure(1..=units, distances)?, column)))
        .collect::<Result<_, RenderError>>()?;
    Ok(Section { text: text(&table, units, distances), goals: goals(&table) })
}

/// Of each column σ of x, y and z, at most the paper's.
fn goals(table: &[(Measured, Column)]) -> Vec<Goal> {
    let of_column = |(measured, column): &(Measured, Column)| {
        let figures = ["x", "y", "z"].into_iter().zip(measured.corners.rms()).zip(column.paper);
        let goal = |((axis, here), paper)| Goal::at_most(format!("σ of {axis}, {}, mm", column.name), paper, here);
        figures.map(goal).collect::<Vec<_>>()
    };
    table.iter().flat_map(of_column).collect()
}

fn text(table: &[(Measured, Column)], units: u64, distances: usize) -> String {
    let squares: Vec<_> = table.iter().map(|(_, column)| format!("{:.2}", 100.0 * column.board().square)).collect();
    let mut text = format!(
        "## Table 1: accuracy in space\n\n\
         A board of 11 × 11 squares, printed in carbon black (ink-jet's is blank at 830 nm), its 100 corners found in single \
         frames near where a person points, give or take {POINTED} px; squares as large as the view holds: {} cm. {units} \
         units as different as real ones, calibrated to {} px and {}°, at {distances} distances each, in 500 lx of LED, \
         {SUN_KLX} klx of sun, and none. σ: root mean square of measured minus true place in the colour camera's frame, mm. \
         *Perfect*: σ of z had calibration left nothing. *SURF*: σ of z of all features on the board; x and y follow.\n\n\
         | | Z, m | x, paper | here | y, paper | here | z, paper | here | found, % | z, perfect | z, SURF | found, % |\n\
         |---|---|{}\n",
        squares.join(", "),
        RESIDUAL.pixels,
        RESIDUAL.degrees,
        "--:|".repeat(10),
    );
    for (measured, Column { name, z: [least, most], paper, .. }) in table {
        let _ = write!(text, "| {name} | {least:.1}–{most:.1} |");
        for (paper, here) in paper.iter().zip(measured.corners.rms()) {
            let _ = write!(text, " {paper} | {here:.1} |");
        }
        let [[.., perfect], [.., surf]] = [measured.perfect.rms(), measured.surf.rms()];
        let [found, of_surf] = [&measured.corners, &measured.surf].map(Errors::found_percent);
        let _ = writeln!(text, " {found:.0} | {perfect:.1} | {surf:.1} | {of_surf:.0} |");
    }
    for (measured, _) in table.iter().filter(|(_, column)| column.mode == Mode::Outdoor) {
        let [.., before] = measured.before.rms();
        let _ = write!(
            text,
            "\nOutdoors the cameras are a pair 25 mm apart: at 2 m a tenth of a pixel is 3 cm, and what calibration leaves \
             shifts all points alike. So each unit first looks at the board once by dusk, at {DUSK_LX} lx, where the \
             projector's depth holds too, and its calibration is turned about the vertical until both agree. Without that \
             σ of z is {before:.0} mm.\n\n"
        );
    }
    text
}

impl Column {
    fn measure(&self, units: impl Iterator<Item = u64>, distances: usize) -> Result<Measured, RenderError> {
        let (board, z) = (self.board(), self.distances(distances));
        let mut measured = Measured::default();
        for number in units {
            let unit = Calibration::drawn(number);
            let truth = unit.rig(Isometry3::identity());
            let calibrated = RESIDUAL.of(truth.clone(), number);
            let believed = match self.mode {
                Mode::Outdoor => looked_at_by_dusk(&board, &unit, &calibrated, number, z[z.len() / 2])?,
                _ => calibrated.clone(),
            };
            for (at, shot) in shots(&board, self.light, &unit, number, &z)?.iter().enumerate() {
                let seen = Seen::of(self.mode, &believed, shot);
                let (pixels, places): (Vec<_>, Vec<_>) =
                    seen.corners(&board, shot, number, at as u64).into_iter().unzip();
                measured.corners.add(lifted(self.mode, &believed, shot, &pixels), &places);
                measured.perfect.add(lifted(self.mode, &truth, shot, &pixels), &places);
                measured.before.add(lifted(self.mode, &calibrated, shot, &pixels), &places);
                let (pixels, places): (Vec<_>, Vec<_>) = seen.surf(&board, shot).into_iter().unzip();
                measured.surf.add(lifted(self.mode, &believed, shot, &pixels), &places);
            }
        }
        Ok(measured)
    }
}

/// The image that a mode takes its points from.
struct Seen {
    is_infrared: bool,
    /// Proportional to the light, or to the albedo.
    image: Image<f32>,
    grey: GrayImage,
}

impl Seen {
    fn of(mode: Mode, rig: &Rig, shot: &Shot) -> Self {
        let KinectFrame { rgb, infrared, depth_raw } = &shot.frame;
        let is_infrared = mode == Mode::Night;
        let (values, grey): (Vec<f32>, _) = if is_infrared {
            let albedo = AlbedoCamera::new(&rig.depth).recover(infrared, depth_raw);
            let [per_e, median] = LEVELS;
            let linear = |&level: &f32| if level > 0.0 { ((level - median) / per_e).exp() } else { f32::NAN };
            (albedo.levels.pixels().iter().map(linear).collect(), albedo.image)
        } else {
            let luma = rgb.to_luma();
            (luma.pixels().iter().map(|&level| f32::from(level)).collect(), luma)
        };
        let (width, height) = grey.size();
        Self { is_infrared, image: Image::from_pixels(width, height, values).expect("as many pixels"), grey }
    }

    /// The board's corners as found, and where they truly are in the colour camera's frame.
    fn corners(&self, board: &Board, shot: &Shot, seed: u64, at: u64) -> Vec<(Option<Point2<f64>>, Point3<f64>)> {
        let mut random = stream(seed, "pointing at a corner", at);
        let camera = shot.camera(self.is_infrared);
        let found = |corner_at| {
            let [in_infrared, in_colour] = shot.true_place(corner_at);
            let place = if self.is_infrared { in_infrared } else { in_colour };
            let pixel = camera.project(&place).expect("the board is in front");
            let pointed = pixel.map(|along| along + random.random_range(-POINTED..=POINTED));
            (corner(&self.image, pointed, REACH * board.square * camera.fx / place.z), in_colour)
        };
        board.corners().into_iter().map(found).collect()
    }

    /// SURF features on the board, and what they truly show in the colour camera's frame.
    fn surf(&self, board: &Board, shot: &Shot) -> Vec<(Option<Point2<f64>>, Point3<f64>)> {
        let is_large = |_, _, scale: f32| !self.is_infrared || scale >= NIGHT_SCALE;
        let points = Surf::new(SurfParams::default()).points(&self.grey, is_large);
        let on_board = points.iter().filter_map(|point| {
            let pixel = Point2::new(f64::from(point.x), f64::from(point.y));
            Some((Some(pixel), shot.truth_at(board, self.is_infrared, pixel)?))
        });
        on_board.collect()
    }
}

/// Where the estimator has what pixels show, in the colour camera's frame, metres: pixels of the infrared image at night,
/// else of the colour image.
fn lifted(mode: Mode, rig: &Rig, shot: &Shot, pixels: &[Option<Point2<f64>>]) -> Vec<Option<Point3<f64>>> {
    let KinectFrame { rgb, infrared, depth_raw } = &shot.frame;
    let by_depth = |camera: &CameraModel, depth: &Image<f32>| -> Vec<Option<Point3<f64>>> {
        let place = |pixel: &Point2<f64>| {
            let (z, _) = depth_at(pixel.x as f32, pixel.y as f32, depth, &DepthNoise::default())?;
            Some(Point3::from(camera.ray(pixel) * z))
        };
        pixels.iter().map(|pixel| pixel.as_ref().and_then(place)).collect()
    };
    match mode {
        Mode::Night => {
            let albedo = AlbedoCamera::new(&rig.depth).recover(infrared, depth_raw);
            let places = by_depth(&rig.depth.model, &albedo.depth);
            places.into_iter().map(|place| Some(rig.colour_from_depth * place?)).collect()
        }
        Mode::Outdoor => {
            let mut stereo = Stereo::new(rig).expect("a unit's cameras are side by side");
            let known: Vec<_> = pixels.iter().flatten().map(|pixel| (pixel.x as f32, pixel.y as f32)).collect();
            let mut inverse = stereo.inverse_depths(&known, &rgb.to_luma(), infrared).into_iter();
            let place = |pixel: &Option<Point2<f64>>| {
                let pixel = pixel.as_ref()?;
                let found = inverse.next()??;
                (found.value > 0.0).then(|| Point3::from(rig.colour.ray(pixel) / found.value))
            };
            pixels.iter().map(place).collect()
        }
        _ => by_depth(&rig.colour, &Registration::new(rig).register(depth_raw)),
    }
}

/// The rig turned about the vertical until the two cameras as a pair have the board where depth has it.
fn looked_at_by_dusk(board: &Board, unit: &Calibration, rig: &Rig, seed: u64, z: f64) -> Result<Rig, RenderError> {
    let shot = shots(board, Light::shade(DUSK_LX / 1000.0), unit, seed, &[z])?.remove(0);
    let corners = Seen::of(Mode::Outdoor, rig, &shot).corners(board, &shot, seed, u64::MAX);
    let pixels: Vec<_> = corners.into_iter().map(|(pixel, _)| pixel).collect();
    let places = [Mode::Outdoor, Mode::Indoor].map(|mode| lifted(mode, rig, &shot, &pixels));
    let pairs = places[0].iter().zip(&places[1]);
    let mut differences: Vec<f64> =
        pairs.filter_map(|(a, b)| Some(1.0 / a.as_ref()?.z - 1.0 / b.as_ref()?.z)).collect();
    differences.sort_by(f64::total_cmp);
    let mut turned = rig.clone();
    if let Some(median) = differences.get(differences.len() / 2) {
        // Disparity, as a tangent, is the baseline by the distance.
        let angle = median * rig.colour_from_depth.translation.x;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle);
        turned.colour_from_depth.rotation = turn * rig.colour_from_depth.rotation;
    }
    Ok(turned)
}

#[cfg(test)]
mod tests;
