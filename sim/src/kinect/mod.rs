//! What a Kinect v1 makes of light: a colour image, an infrared image with the projector's dots in it, and depth
//! computed from that infrared image alone. Knows no truth.
//!
//! The device's frame is its infrared camera's: x right, y down, z forward.

pub mod calibration;
mod exposure;
mod hand;
pub mod matcher;
mod metering;
pub mod pattern;
pub mod projector;
pub mod sensors;
pub mod warm_up;

use glam::DAffine3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use sunblind_estimator::image::{DepthImage, Image, InfraredImage, RgbImage};

use crate::light::LightState;
use crate::render::{
    Adapter, Begun, CameraFrame, ColourSensor, Frame, Images, InfraredSensor, Optics, ProjectorLight, RenderError,
    Renderer, StageCost, Sweep, affine,
};
use crate::world::World;
use calibration::Calibration;
pub use exposure::InfraredExposure;
use exposure::{AutoExposure, infrared_brightness};
use matcher::Matcher;
use metering::{Metered, WhiteBalance};
use projector::Projector;
use sensors::{Exposure, colour, infrared};

/// From one frame to the next, seconds.
pub const FRAME_INTERVAL: f64 = 1.0 / 30.0;
/// Images taken and thrown away when switched on, until the exposure fits. Enough for any light.
const SETTLING_IMAGES: usize = 8;
/// An exposure fits when the next correction would be no larger than this factor.
const SETTLED: f64 = 1.02;

/// How a device is used, and which of its imperfections take part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imaging {
    /// Photon and read noise of both cameras, and speckle.
    pub noise: bool,
    /// What moves during the exposure is blurred.
    pub motion_blur: bool,
    /// Rows are exposed one after the other.
    pub rolling_shutter: bool,
    /// The colour camera takes the mean of what it sees for grey; without, its light for the screen's white.
    pub white_balance: bool,
    /// How the infrared camera follows the light.
    pub infrared_exposure: InfraredExposure,
    /// How long the device had been on when the first frame was taken, seconds; infinite: it is warm.
    pub warm_up: f64,
    /// From one frame that is taken to the next, seconds. The device itself has 30 a second; fewer are every so manieth.
    pub interval: f64,
}

impl Default for Imaging {
    fn default() -> Self {
        Self {
            noise: true,
            motion_blur: true,
            rolling_shutter: true,
            white_balance: true,
            infrared_exposure: InfraredExposure::default(),
            warm_up: f64::INFINITY,
            interval: FRAME_INTERVAL,
        }
    }
}

/// What the device gives out at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct KinectFrame {
    /// Colour.
    pub rgb: RgbImage,
    /// 10 bits.
    pub infrared: InfraredImage,
    /// Raw 11-bit disparity in the infrared camera's pixels, 2047 = none; the calibration's
    /// [`depth_encoding`](Calibration::depth_encoding) says what it means.
    pub depth_raw: DepthImage,
}

/// One simulated unit in one world.
pub struct Kinect {
    calibration: Calibration,
    imaging: Imaging,
    seed: u64,
    infrared_from_colour: DAffine3,
    renderer: Renderer,
    matcher: Matcher,
    colour_exposure: AutoExposure,
    infrared_exposure: AutoExposure,
    balance: WhiteBalance,
    /// The exposures fit the light.
    settled: bool,
    /// A hand lies on it.
    covered: bool,
    /// How long it has been on, seconds.
    on_for: f64,
}

impl Kinect {
    /// Builds the unit and puts it into the world.
    ///
    /// # Errors
    /// No graphics adapter, or a world that it cannot hold.
    pub fn new(world: &World, calibration: Calibration, imaging: Imaging, seed: u64) -> Result<Self, RenderError> {
        let projector = Projector::of(&calibration);
        let optics = Optics {
            colour: calibration.colour,
            infrared: calibration.infrared,
            projector: projector_light(&calibration, &projector),
        };
        let renderer = Renderer::new(world, &optics)?;
        Ok(Self {
            matcher: Matcher::new(&calibration, &projector),
            infrared_from_colour: affine(&calibration.colour_from_infrared.inverse()),
            calibration,
            imaging,
            seed,
            renderer,
            colour_exposure: AutoExposure::colour(),
            infrared_exposure: AutoExposure::infrared(imaging.infrared_exposure),
            balance: WhiteBalance::neutral(),
            settled: false,
            covered: false,
            on_for: imaging.warm_up,
        })
    }

    /// How this unit is really built.
    pub fn calibration(&self) -> &Calibration {
        &self.calibration
    }

    /// What renders.
    pub fn adapter(&self) -> &Adapter {
        self.renderer.adapter()
    }

    /// The exposures of the next frame: colour, infrared.
    pub fn exposures(&self) -> [Exposure; 2] {
        [self.colour_exposure.exposure(), self.infrared_exposure.exposure()]
    }

    /// The chips as they take the next frame but for the draws of their noise: colour's, infrared's.
    pub fn chips(&self) -> (ColourSensor, InfraredSensor) {
        let [colour_exposure, infrared_exposure] = self.exposures();
        let noise = self.imaging.noise;
        let mut colour = colour::sensor(colour_exposure, self.balance.gains, noise, 0);
        let mut infrared = infrared::sensor(infrared_exposure, noise, 0, 0);
        if self.covered {
            hand::cover(&mut colour, &mut infrared);
        }
        (colour, infrared)
    }

    /// From the next frame on a hand lies on the device's front, or does no longer.
    pub fn cover(&mut self, covered: bool) {
        self.covered = covered;
    }

    /// Switches the device off and on again: before the next frame the exposures fit the light anew.
    pub fn restart(&mut self) {
        self.settled = false;
    }

    /// Has the world under this light from the next frame on. At first, it is the light's default.
    pub fn illuminate(&mut self, light: &LightState) {
        self.renderer.illuminate(light);
    }

    /// Takes one frame. `world_from_infrared`: the device's pose over the frame interval, in whose middle the exposures
    /// have theirs. Equal sequences of calls give equal bytes.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn capture(&mut self, world_from_infrared: &Sweep, frame: u64) -> Result<KinectFrame, RenderError> {
        let begun = self.expose(world_from_infrared, frame)?;
        self.develop(&begun)
    }

    /// The first half of [`capture`](Self::capture): has the graphics adapter begin. Develop the frame before the next.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn expose(&mut self, world_from_infrared: &Sweep, frame: u64) -> Result<Begun, RenderError> {
        if !self.settled {
            self.settle(world_from_infrared)?;
        }
        Ok(self.renderer.begin(&self.frame(world_from_infrared, frame)))
    }

    /// The second half: finds depth in infrared, while the graphics adapter may still be busy with colour, and has the
    /// exposures follow the light.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn develop(&mut self, begun: &Begun) -> Result<KinectFrame, RenderError> {
        let interval = self.imaging.interval;
        let infrared = image(self.calibration.infrared.size(), self.renderer.infrared(begun)?);
        let depth_raw = self.matcher.depth(&infrared);
        let rgb = image(self.calibration.colour.size(), self.renderer.colour(begun)?);
        let metered = Metered::of(rgb.pixels());
        let frame = KinectFrame { rgb, infrared, depth_raw };
        self.colour_exposure.follow(metered.brightness(), interval);
        self.infrared_exposure.follow(brightness_of(&frame), interval);
        if self.imaging.white_balance {
            self.balance.follow(&metered, interval);
        }
        self.on_for += interval;
        Ok(frame)
    }

    /// True depth (z, metres) of each of the last frame's infrared pixels. For judging, never for the estimator.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn true_depth(&self) -> Result<Image<f32>, RenderError> {
        self.true_depth_of_every(1)
    }

    /// The same of every `step`th pixel, across and down.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn true_depth_of_every(&self, step: usize) -> Result<Image<f32>, RenderError> {
        let (width, height) = self.calibration.infrared.size();
        Ok(image((width.div_ceil(step), height.div_ceil(step)), self.renderer.true_depth(step)?))
    }

    /// What the stages of rendering one frame take; the frame itself is thrown away.
    ///
    /// # Errors
    /// The graphics adapter stopped working.
    pub fn profile(&mut self, world_from_infrared: &Sweep) -> Result<Vec<StageCost>, RenderError> {
        self.renderer.profile(&self.frame(world_from_infrared, 0))
    }

    /// Triangles that one frame has the graphics adapter draw: for the projector, for the colour and for the infrared
    /// camera.
    pub fn triangles_drawn(&self, world_from_infrared: &Sweep) -> [usize; 3] {
        self.renderer.triangles_drawn(&self.frame(world_from_infrared, 0))
    }

    /// Lets the exposures adapt as they do in the first seconds after switching on.
    fn settle(&mut self, world_from_infrared: &Sweep) -> Result<(), RenderError> {
        for _ in 0..SETTLING_IMAGES {
            let images = self.renderer.render(&self.frame(world_from_infrared, 0))?;
            let metered = Metered::of(&images.colour);
            let frame = self.find_depth(images);
            let colour = self.colour_exposure.settle(metered.brightness());
            let infrared = self.infrared_exposure.settle(brightness_of(&frame));
            let before = self.balance;
            if self.imaging.white_balance {
                self.balance.follow(&metered, f64::INFINITY);
            }
            if colour.max(infrared).max(self.balance.change_from(&before)) < SETTLED {
                break;
            }
        }
        self.settled = true;
        Ok(())
    }

    fn find_depth(&self, images: Images) -> KinectFrame {
        let infrared = image(self.calibration.infrared.size(), images.infrared);
        let depth_raw = self.matcher.depth(&infrared);
        KinectFrame { rgb: image(self.calibration.colour.size(), images.colour), infrared, depth_raw }
    }

    fn frame(&self, world_from_infrared: &Sweep, frame: u64) -> Frame {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(frame);
        let [colour_exposure, infrared_exposure] = self.exposures();
        let (colour_sensor, infrared_sensor) = self.chips();
        let [colour_key, infrared_key] = [random.next_u32(), random.next_u32()];
        let speckle_key = pose_key(&world_from_infrared.middle());
        let world_from_colour = world_from_infrared.of_other(&self.infrared_from_colour);
        Frame {
            colour: self.camera(world_from_colour, colour_exposure, colour::READOUT, colour::VIGNETTING),
            colour_sensor: ColourSensor { noise_key: colour_key, ..colour_sensor },
            infrared: self.camera(*world_from_infrared, infrared_exposure, infrared::READOUT, infrared::VIGNETTING),
            infrared_sensor: InfraredSensor { noise_key: infrared_key, speckle_key, ..infrared_sensor },
            projector_turn: warm_up::projector_turn(self.on_for) as f32,
        }
    }

    fn camera(&self, sweep: Sweep, exposure: Exposure, readout: f64, vignetting: f32) -> CameraFrame {
        let share = |on: bool, seconds: f64| if on { (seconds / FRAME_INTERVAL) as f32 } else { 0.0 };
        CameraFrame {
            sweep,
            exposure: share(self.imaging.motion_blur, exposure.time),
            readout: share(self.imaging.rolling_shutter, readout),
            vignetting,
        }
    }
}

fn brightness_of(frame: &KinectFrame) -> f64 {
    infrared_brightness(frame.infrared.pixels(), frame.depth_raw.pixels())
}

fn projector_light<'a>(calibration: &Calibration, projector: &'a Projector) -> ProjectorLight<'a> {
    ProjectorLight {
        baseline: calibration.baseline as f32,
        toe_in: projector.toe_in as f32,
        pitch: projector.pitch as f32,
        pincushion: projector::PINCUSHION as f32,
        peak_irradiance: projector::PEAK_IRRADIANCE_AT_1_M as f32,
        tile_grid: [pattern::TILE_WIDTH, pattern::TILE_HEIGHT],
        tile_brightness: projector::TILE_BRIGHTNESS,
        tile_image: ([projector.tile.width, projector.tile.height], &projector.tile.samples),
    }
}

fn image<P>((width, height): (usize, usize), pixels: Vec<P>) -> Image<P> {
    Image::from_pixels(width, height, pixels).expect("the renderer makes images of the camera's size")
}

/// A number that changes with the least motion.
fn pose_key(pose: &DAffine3) -> u32 {
    let bits = pose.to_cols_array().map(f64::to_bits);
    let mixed = bits.iter().fold(0_u64, |key, bits| (key ^ bits).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29));
    (mixed >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validation::scene::looking;
    use crate::world::laboratory::{laboratory, loop_waypoints};

    #[test]
    fn what_walls_hide_is_not_missed() {
        let mut world = laboratory(1);
        for object in &mut world.objects {
            object.mesh.irradiance = vec![[300.0, 300.0, 300.0, 0.1]; object.mesh.positions.len()];
        }
        let unit = || Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1).expect("an adapter");
        let (mut culling, mut drawing_all) = (unit(), unit());
        drawing_all.renderer.forget_occluders();
        let way = loop_waypoints();
        let (mut most, mut most_of_all) = (0, 0);
        for (at, pair) in way.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]].map(glam::DVec2::from);
            let (ahead, eye) = ((to - from).normalize().extend(0.0), from.extend(0.6));
            let sweep = Sweep::still(looking(eye, ahead));
            let most_of = |kinect: &Kinect| kinect.triangles_drawn(&sweep).into_iter().max().unwrap_or(0);
            most = most.max(most_of(&culling));
            most_of_all = most_of_all.max(most_of(&drawing_all));
            if at % 12 == 0 {
                let images = |kinect: &mut Kinect| kinect.capture(&sweep, 0).expect("a frame");
                assert!(images(&mut culling) == images(&mut drawing_all), "at {from}, looking along {ahead}");
            }
        }
        assert!(most <= 20_000, "{most} triangles in a view, of {most_of_all}");
    }
}
