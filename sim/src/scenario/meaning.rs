//! What a scenario's names stand for: the world and its light, the floors, the robot.

use glam::DVec3;
use nalgebra::Point2;

use super::light::lamp_groups;
use super::{Fault, Floor, Quality, Robot, Scenario, WorldName};
use crate::kinect::Imaging;
use crate::kinect::calibration::{Calibration, Residual};
use crate::physics::{self, FloorPlan};
use crate::robot::{CameraMount, InertialNoise, RobotModel};
use crate::world::bake::{Effort, bake_cached, cache_folder};
use crate::world::campus::campus;
use crate::world::gltf;
use crate::world::ground::Ground;
use crate::world::laboratory::laboratory;
use crate::world::rays::Rays;
use crate::world::yard::yard;
use crate::world::{Object, World};

/// A world is the same in each run: a scenario's seed moves noise and slip, not furniture.
const WORLD_SEED: u64 = 1;

impl WorldName {
    /// Builds the world, without its light.
    pub fn build(self) -> World {
        match self {
            Self::Laboratory => laboratory(WORLD_SEED),
            Self::Yard => yard(WORLD_SEED),
            Self::Campus => campus(WORLD_SEED),
        }
    }
}

impl super::World {
    /// Builds the world, without its light.
    ///
    /// # Errors
    /// Neither a name nor a file, both, or a file that gives no world.
    pub fn build(&self) -> Result<World, Fault> {
        match (self.name, &self.gltf) {
            (Some(name), None) => Ok(name.build()),
            (None, Some(file)) => gltf::load(file).map_err(|error| Fault::new("world.gltf", error.to_string())),
            (None, None) => Err(Fault::new(
                "world",
                "which world? write name = \"laboratory\", or gltf = \"file.glb\" for your own",
            )),
            (Some(_), Some(_)) => Err(Fault::new("world.gltf", "a file beside a name: delete one of them")),
        }
    }
}

impl From<Floor> for physics::Floor {
    fn from(floor: Floor) -> Self {
        match floor {
            Floor::Tile => Self::TILE,
            Floor::Carpet => Self::CARPET,
            Floor::Concrete => Self::CONCRETE,
            Floor::Asphalt => Self::ASPHALT,
            Floor::Grass => Self::GRASS,
            Floor::Gravel => Self::GRAVEL,
            Floor::Ideal => Self::IDEAL,
        }
    }
}

impl Robot {
    /// Which floor lies where in a world with this ground.
    pub fn floor_plan(&self, ground: &Ground) -> FloorPlan {
        let area =
            |area: &super::FloorArea| physics::FloorArea { min: area.min, max: area.max, floor: area.floor.into() };
        let mut plan = match self.floor {
            Some(floor) => FloorPlan::from(physics::Floor::from(floor)),
            None => FloorPlan::from(ground),
        };
        plan.areas.extend(self.floor_areas.iter().map(area));
        plan
    }
}

impl From<&super::Kinect> for Imaging {
    fn from(kinect: &super::Kinect) -> Self {
        Self {
            noise: kinect.noise,
            motion_blur: kinect.motion_blur,
            rolling_shutter: kinect.rolling_shutter,
            white_balance: kinect.white_balance,
            infrared_exposure: kinect.infrared_exposure,
            warm_up: kinect.warm_up.unwrap_or(f64::INFINITY),
            interval: kinect.rate.recip(),
        }
    }
}

impl super::Kinect {
    /// How the unit is truly built.
    pub fn unit(&self) -> Calibration {
        let unit = self.unit_seed.map_or_else(Calibration::nominal, Calibration::drawn);
        match self.quality {
            Quality::Fast => unit.halved(),
            Quality::Full => unit,
        }
    }

    /// How far what is believed of it may be from that.
    pub fn residual(&self) -> Residual {
        Residual { pixels: self.residual_px / self.quality.coarseness(), degrees: self.residual_deg }
    }
}

impl Scenario {
    /// The world, with the ways that light takes in it. That takes half a minute once for a world, and is kept in the
    /// user's [`cache_folder`]. `progress` is told the share done, 0 to 1, from any thread.
    ///
    /// # Errors
    /// There is no such world, or it has no such lamps.
    pub fn lit_world(&self, progress: &(dyn Fn(f32) + Sync)) -> Result<World, Fault> {
        let mut world = self.world.build()?;
        self.light.check_groups(&lamp_groups(&world))?;
        // Where nothing can be kept the light is computed each time, and is the same.
        let _ = bake_cached(&mut world, &Effort::default(), &cache_folder(), progress);
        Ok(world)
    }

    /// The robot with its Kinect mounted, and with a gyro if one is wanted.
    ///
    /// # Errors
    /// The description file can't be read, or describes no such robot.
    pub fn robot_model(&self) -> Result<RobotModel, Fault> {
        let mount =
            CameraMount { height: Some(self.kinect.lens_height), tilt: Some(self.kinect.tilt_deg.to_radians()) };
        let mut model = match &self.robot.urdf {
            Some(urdf) => {
                let advice = "correct it, or delete the key for the built-in robot";
                let fault = |error| Fault::new("robot.urdf", format!("{}: {error}; {advice}", urdf.display()));
                RobotModel::load(urdf, &mount).map_err(fault)?
            }
            None => RobotModel::p3at(&mount),
        };
        model.gyro = self.robot.gyro.then(InertialNoise::pioneer_gyro);
        Ok(model)
    }
}

/// What stands in a robot's way.
pub struct Obstacles {
    /// `None` in an empty world.
    rays: Option<Rays>,
    ground: Ground,
}

/// The robot in a ball about its middle, metres above the floor: a P3-AT is 0.5 m wide, the Kinect 0.65 m high.
const BALL_HEIGHT: f64 = 0.35;
/// The ball's radius, metres. It must not touch the floor.
const BALL_RADIUS: f64 = 0.3;
/// How far apart a way is probed, metres.
const PROBE: f64 = 0.1;

impl Obstacles {
    /// Everything in a world that a robot bumps into.
    pub fn of(world: &World) -> Self {
        let objects = world.objects.iter().filter(|Object { collides, .. }| *collides);
        Self { rays: Rays::new(objects), ground: world.ground.clone() }
    }

    /// Whether the robot fits through from one point to another.
    pub fn leave_free(&self, from: &Point2<f64>, to: &Point2<f64>) -> bool {
        let Some(rays) = &self.rays else { return true };
        let steps = ((to - from).norm() / PROBE).ceil().max(1.0) as usize;
        (0..=steps).all(|step| {
            let at = from + (to - from) * (step as f64 / steps as f64);
            rays.distance(DVec3::new(at.x, at.y, self.ground.height(at.x, at.y) + BALL_HEIGHT)) > BALL_RADIUS
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::path::Path;

    use super::*;
    use crate::scenario::tests::{robot, shipped};
    use crate::scenario::{AnyScenario, load};

    #[test]
    fn no_shipped_scenario_drives_into_something() {
        let worlds = [WorldName::Laboratory, WorldName::Yard, WorldName::Campus];
        let obstacles: BTreeMap<_, _> = worlds.map(|world| (world, Obstacles::of(&world.build()))).into();
        let check = |scenario: &Scenario| {
            let obstacles = &obstacles[&scenario.world.name.expect("a world of ours")];
            scenario.check_way(|from: &Point2<f64>, to: &Point2<f64>| obstacles.leave_free(from, to))
        };
        for file in shipped() {
            if let AnyScenario::Robot(scenario) = load(&file).unwrap() {
                assert_eq!(check(&scenario), Ok(()), "{}", file.display());
            }
        }
        let through_the_wall = "seed = 1\nduration_s = 60.0\n[world]\nname = \"laboratory\"\n[path]\n\
                                kind = \"waypoints\"\npoints_m = [[4.0, 1.2], [4.0, 4.0]]\n";
        let fault = check(&robot(through_the_wall)).unwrap_err();
        assert!(fault.problem.starts_with("the path is blocked near (4.00, 1."), "{}", fault.problem);
    }

    #[test]
    fn the_lab_loop_is_the_laboratorys() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios/lab_loop.toml");
        let AnyScenario::Robot(scenario) = load(&file).unwrap() else { panic!("a robot's scenario") };
        let path = scenario.path.shape().unwrap();
        for [x, y] in crate::world::laboratory::loop_waypoints() {
            let distance = path.points().iter().map(|point| (point.position - Point2::new(x, y)).norm());
            assert!(distance.fold(f64::INFINITY, f64::min) < 0.01, "({x}, {y}) is not on the path");
        }
    }

    #[test]
    fn floors_camera_and_gyro_are_as_written() {
        let scenario = robot(
            "seed = 1\nduration_s = 60.0\n[world]\nname = \"laboratory\"\n[path]\nkind = \"circle\"\n\
             start_m = [4.0, 1.0]\nradius_m = 0.5\n[kinect]\nlens_height_m = 0.9\n[robot]\nfloor = \"concrete\"\n\
             gyro = true\nfloor_areas = [{ floor = \"carpet\", min_m = [1, 1], max_m = [2, 2] }]\n",
        );
        let plan = scenario.robot.floor_plan(&Ground::default());
        assert_eq!(plan.floor_at(1.5, 1.5), &physics::Floor::CARPET);
        assert_eq!(plan.floor_at(0.0, 0.0), &physics::Floor::CONCRETE);
        let model = scenario.robot_model().unwrap();
        assert!(model.gyro.is_some());
        assert!((model.robot_from_camera.translation.z - 0.9).abs() < 1e-9);
    }
}
