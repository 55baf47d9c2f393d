//! `sunblind render`: what a scenario's Kinect sees, as pictures.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use image::codecs::jpeg::JpegEncoder;
use image::{GrayImage, ImageBuffer, ImageResult, Luma, RgbImage};
use nalgebra::Isometry3;
use sunblind_estimator::guidance::{self, PathPoint};
use sunblind_estimator::image::Image;

use super::contact_sheet::{self, Seen};
use super::scenario_args::ScenarioArgs;
use super::{Failure, answer, stage};
use crate::kinect::{FRAME_INTERVAL, Kinect};
use crate::light::illuminance;
use crate::new_folder::{FolderError, Kind, NewFolder};
use crate::render::{Adapter, RenderError, Sweep};
use crate::robot::RobotModel;
use crate::scenario::light::lamp_groups;
use crate::scenario::{AnyScenario, Fault, Scenario, Source};
use crate::world::World;
use crate::world::ground::Ground;

const HELP: &str = "\
Examples:
  sunblind render scenarios/lab_loop.toml --at 20 --out out/view
      what the Kinect sees 20 s after the start
  sunblind render scenarios/lab_loop.toml --at 0 --at 10 --at 20 --out out/views --set light.lamps=false
      three places by daylight, one below the other on the contact sheet
  sunblind render scenarios/yard_noon.toml scenarios/night.toml --at 10 --out out/lights
      one place in two lights

The robot is not simulated: the Kinect is put where the path leads in that time at the path's speed, moving as one who
drives it would. The folder holds for each instant, in a folder of its own (20s/; of several scenarios night/20s/):
  rgb.png          the colour image, 8-bit sRGB
  ir.png           the infrared image with the projector's dots; 8-bit, the square root of the 10-bit values, so that
                   shade shows as well as dots
  depth.png        what the device makes of it: 16-bit, millimetres, 0 = none, in the infrared camera's pixels
  true_depth.png   how far away things are: 16-bit, millimetres, 0 = nothing there
and contact_sheet.png with all of them: depth in colours from bright (near) to dark, holes black, and below it the share
of the pixels that have one. Several scenarios stand side by side, and each instant has a sheet of its own (20s.jpg). The
folder appears whole at the end or not at all; earlier pictures there are replaced. The light of a world is computed
once, in about half a minute, and kept: `sunblind doctor` says where.";

/// Show what the Kinect of some scenarios sees at some instants.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Render {
    /// The scenarios' files
    #[arg(required = true, value_name = "SCENARIO")]
    scenarios: Vec<PathBuf>,
    /// Seconds after the start; may be repeated
    #[arg(
        long = "at",
        value_name = "SECONDS",
        default_value = "0",
        value_parser = seconds,
        allow_negative_numbers = true
    )]
    instants: Vec<f64>,
    /// Where the pictures go
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    changes: ScenarioArgs,
}

fn seconds(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|seconds: &f64| seconds.is_finite() && *seconds >= 0.0);
    value.ok_or_else(|| "write a number of seconds, 0 or more".to_owned())
}

static PICTURES: Kind = Kind { whose: "pictures", mark: "a folder with a contact_sheet.png", is: is_pictures };

const SHEET: &str = "contact_sheet.png";
/// JPEG quality of an instant's sheet, 1–100: dots and noise still look like dots and noise.
const SHEET_QUALITY: u8 = 80;

/// Nothing beside sheets but folders with pictures.
fn is_pictures(folder: &Path) -> bool {
    folder.join(SHEET).is_file()
        && holds_only(folder, |path| path.ends_with(SHEET) || is_instants_sheet(path) || is_instants(path))
}

/// One instant of several scenarios: 20s.jpg, as it is called here and by nobody's camera.
fn is_instants_sheet(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str());
    name.and_then(|name| name.strip_suffix("s.jpg")).is_some_and(|at| seconds(at).is_ok())
}

/// One instant's pictures, or a scenario's: a folder with nothing but those.
fn is_instants(folder: &Path) -> bool {
    folder.join("true_depth.png").is_file() || folder.is_dir() && holds_only(folder, is_instants)
}

fn holds_only(folder: &Path, ours: impl Fn(&Path) -> bool) -> bool {
    let ours = |entry: io::Result<std::fs::DirEntry>| entry.is_ok_and(|entry| ours(&entry.path()));
    std::fs::read_dir(folder).is_ok_and(|mut entries| entries.all(ours))
}

/// A scenario's file, read.
struct Shot {
    name: String,
    source: Source,
    scenario: Box<Scenario>,
    path: guidance::Path,
    robot: RobotModel,
}

impl Render {
    pub fn run(&self) -> Result<(), Failure> {
        let mut shots: Vec<Shot> = self.scenarios.iter().map(|file| self.read(file)).collect::<Result<_, _>>()?;
        for index in 1..shots.len() {
            let (before, shot) = shots.split_at_mut(index);
            if before.iter().any(|other| other.name == shot[0].name) {
                shot[0].name += &format!("-{}", index + 1);
            }
        }
        // Both before the light is computed, which takes a while.
        let folder = NewFolder::begin(&self.out, &PICTURES)?;
        Adapter::find()?;
        // By instant, and in each by scenario.
        let mut seen: Vec<Vec<Seen>> = self.instants.iter().map(|_| Vec::new()).collect();
        for shot in &shots {
            let mut view = View::new(shot, &stage::lit_world(&shot.source, &shot.scenario)?)?;
            let mut place = folder.path().to_owned();
            if shots.len() > 1 {
                place.push(&shot.name);
            }
            for (&at, of_instant) in self.instants.iter().zip(&mut seen) {
                let sight = view.at(at, &shot.path.at(at * shot.scenario.path.speed))?;
                write(&place.join(format!("{at}s")), &sight).map_err(|source| self.unwritable(source))?;
                of_instant.push(sight);
            }
        }
        self.write_sheets(folder.path(), seen).map_err(|error| self.unwritable(io::Error::other(error)))?;
        folder.publish()?;
        answer(&format!("{}", self.out.join(SHEET).display()));
        Ok(())
    }

    /// The contact sheet, and of several scenarios one for each instant.
    fn write_sheets(&self, folder: &Path, seen: Vec<Vec<Seen>>) -> ImageResult<()> {
        let sheet = if self.scenarios.len() == 1 {
            contact_sheet::below_each_other(&seen.into_iter().flatten().collect::<Vec<_>>())
        } else {
            let sheets: Vec<RgbImage> = seen.iter().map(|scenarios| contact_sheet::side_by_side(scenarios)).collect();
            for (at, sheet) in self.instants.iter().zip(&sheets) {
                let mut file = BufWriter::new(File::create(folder.join(format!("{at}s.jpg")))?);
                sheet.write_with_encoder(JpegEncoder::new_with_quality(&mut file, SHEET_QUALITY))?;
                file.flush()?;
            }
            contact_sheet::stacked(&sheets)
        };
        sheet.save(folder.join(SHEET))
    }

    fn read(&self, file: &Path) -> Result<Shot, Failure> {
        let (source, scenario) = self.changes.load(file)?;
        let AnyScenario::Robot(scenario) = scenario else {
            let problem = "only a world that a robot drives through can be rendered; write name = \"laboratory\", or see \
                           the textured room with `sunblind record`";
            return Err(source.blame(Fault::new("world.name", problem)).into());
        };
        let path = scenario.path.shape().map_err(|fault| source.blame(fault))?;
        let robot = scenario.robot_model().map_err(|fault| source.blame(fault))?;
        let end = path.length() / scenario.path.speed;
        if let Some(&at) = self.instants.iter().find(|at| **at > end) {
            return Err(Failure::BeyondPath { at, end });
        }
        let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        Ok(Shot { name, source, scenario, path, robot })
    }

    fn unwritable(&self, source: io::Error) -> FolderError {
        FolderError::Unwritable { folder: self.out.clone(), source }
    }
}

/// A scenario's Kinect in its world.
struct View<'a> {
    shot: &'a Shot,
    kinect: Kinect,
    robot_from_infrared: Isometry3<f64>,
    ground: Ground,
    lamp_groups: Vec<String>,
    /// From the robot's middle to its axles, metres.
    reach: f64,
}

impl<'a> View<'a> {
    fn new(shot: &'a Shot, world: &World) -> Result<Self, RenderError> {
        let Shot { scenario, robot, .. } = shot;
        let calibration = scenario.kinect.unit();
        let robot_from_infrared = robot.robot_from_camera * calibration.colour_from_infrared;
        let kinect = Kinect::new(world, calibration, (&scenario.kinect).into(), scenario.seed)?;
        let (ground, reach) = (world.ground.clone(), robot.wheelbase() / 2.0);
        let lamp_groups = lamp_groups(world);
        Ok(Self { shot, kinect, robot_from_infrared, ground, lamp_groups, reach })
    }

    /// `at`: seconds after the start.
    fn at(&mut self, at: f64, place: &PathPoint) -> Result<Seen, RenderError> {
        // An image of another place, long ago, says nothing of the exposure here.
        self.kinect.restart();
        let Shot { name, scenario, .. } = self.shot;
        let light = scenario.light.at(at, &self.lamp_groups);
        self.kinect.illuminate(&light);
        self.kinect.cover(scenario.kinect.covered.iter().any(|covered| covered.contains(at)));
        let frame = self.kinect.capture(&self.sweep(place), (at * scenario.kinect.rate).round() as u64)?;
        let true_depth = self.kinect.true_depth()?;
        let camera = self.kinect.calibration().rig(Isometry3::identity()).depth;
        let measured = |&raw: &u16| camera.depth_of(raw).unwrap_or(0.0) as f32;
        let (width, height) = frame.depth_raw.size();
        let measured = frame.depth_raw.pixels().iter().map(measured).collect();
        let measured = Image::from_pixels(width, height, measured).expect("one value a pixel");
        let [x, y] = place.position.into();
        let (width, height) = (frame.rgb.width() as u32, frame.rgb.height() as u32);
        let colour = RgbImage::from_raw(width, height, frame.rgb.pixels().as_flattened().to_vec());
        Ok(Seen {
            light: format!("{name}: {} under the sky", lux(illuminance(&light.on_the_ground()))),
            place: format!("{at} s, at ({x:.1}, {y:.1}) m, {:.0} deg", place.heading.to_degrees()),
            colour: colour.expect("one value a pixel and channel"),
            infrared: shown(&frame.infrared),
            depth: if scenario.kinect.truth_depth { true_depth.clone() } else { measured },
            true_depth,
        })
    }

    /// The motion of the infrared camera during a frame interval in whose middle the robot is at `place`, driving along
    /// the path.
    fn sweep(&self, place: &PathPoint) -> Sweep {
        let world_from_robot = self.ground.standing(place.position.x, place.position.y, place.heading, self.reach);
        let motion = [self.shot.scenario.path.speed, place.curvature];
        Sweep::driving(&world_from_robot, &self.robot_from_infrared, motion, FRAME_INTERVAL)
    }
}

/// As a picture: the square root.
fn shown(infrared: &Image<u16>) -> GrayImage {
    GrayImage::from_fn(infrared.width() as u32, infrared.height() as u32, |x, y| {
        let share = f32::from(infrared.at(x as usize, y as usize)) / 1023.0;
        Luma([(255.0 * share.sqrt()).round() as u8])
    })
}

/// To two digits: nobody reads a light meter to more.
fn lux(value: f32) -> String {
    if value < 1e-4 {
        return "0 lx".to_owned();
    }
    let unit = 10_f64.powf((f64::from(value).log10() - 1.0).floor());
    let rounded = (f64::from(value) / unit).round() * unit;
    if rounded >= 10_000.0 {
        format!("{:.0} klx", rounded / 1000.0)
    } else {
        format!("{rounded:.0$} lx", (-unit.log10().round()).max(0.0) as usize)
    }
}

/// Writes one instant's pictures into a new folder.
fn write(folder: &Path, seen: &Seen) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let saved = [
        seen.colour.save(folder.join("rgb.png")),
        seen.infrared.save(folder.join("ir.png")),
        millimetres(&seen.depth).save(folder.join("depth.png")),
        millimetres(&seen.true_depth).save(folder.join("true_depth.png")),
    ];
    saved.into_iter().collect::<Result<(), _>>().map_err(io::Error::other)
}

/// 0 for what has no depth, and for what is beyond 65 m.
fn millimetres(depth: &Image<f32>) -> ImageBuffer<Luma<u16>, Vec<u16>> {
    ImageBuffer::from_fn(depth.width() as u32, depth.height() as u32, |x, y| {
        let value = (1000.0 * depth.at(x as usize, y as usize)).round();
        Luma([if value <= f32::from(u16::MAX) { value as u16 } else { 0 }])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_is_in_millimetres_and_nothing_is_0() {
        let depth = Image::from_pixels(4, 1, vec![0.0, 1.2344, f32::INFINITY, 65.535]).unwrap();
        assert_eq!(millimetres(&depth).into_raw(), [0, 1234, 0, 65535]);
    }

    #[test]
    fn light_is_told_in_two_digits() {
        for (value, told) in [
            (104_321.0, "100 klx"),
            (12_600.0, "13 klx"),
            (843.0, "840 lx"),
            (3.12, "3.1 lx"),
            (0.0512, "0.051 lx"),
            (0.0, "0 lx"),
        ] {
            assert_eq!(lux(value), told);
        }
    }

    #[test]
    fn an_instant_is_a_number_of_seconds_from_the_start() {
        assert_eq!(seconds("12.5"), Ok(12.5));
        for wrong in ["-1", "nan", "inf", "soon"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn only_pictures_are_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let sheet = folder.path().join(SHEET);
        std::fs::write(&sheet, "").unwrap();
        assert!(is_pictures(folder.path()));
        let instant = folder.path().join("night/20s");
        std::fs::create_dir_all(&instant).unwrap();
        std::fs::write(instant.join("true_depth.png"), "").unwrap();
        std::fs::write(folder.path().join("20s.jpg"), "").unwrap();
        assert!(is_pictures(folder.path()));
        let holiday = folder.path().join("holidays.jpg");
        std::fs::write(&holiday, "").unwrap();
        assert!(!is_pictures(folder.path()));
        std::fs::remove_file(holiday).unwrap();
        std::fs::write(folder.path().join("night/thesis.tex"), "").unwrap();
        assert!(!is_pictures(folder.path()));
    }
}
