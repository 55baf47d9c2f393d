//! What the robot drives on, and where.

use super::unevenness::Unevenness;
use crate::robot::RobotModel;
use crate::world::ground::{Cover, CoveredArea, Ground};

/// How one spot of ground holds a tyre. Without unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// α: how much more the ground resists slip along the wheel than across it; 0 for an even ground. Below 0 the
    /// robot turns less for the same wheel speeds.
    pub anisotropy: f64,
    /// s: what share of its turning a driven wheel loses as slip on an even ground. A wheel on grass over-spins.
    pub slip: f64,
    /// μ: friction coefficient between rubber and ground.
    pub friction: f64,
}

/// How unlike two places of one floor are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GripVariation {
    /// Standard deviation of α.
    pub anisotropy: f64,
    /// Standard deviation of s.
    pub slip: f64,
    /// How far apart two places must be to know nothing of one another, metres.
    pub correlation_length: f64,
}

/// A kind of ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// On average.
    pub grip: Grip,
    /// From place to place.
    pub variation: GripVariation,
}

/// The range of α. At −1 the ground would drive the wheel backwards; towards +1 the slip of one step, which the next
/// one answers, would swing from side to side.
const ANISOTROPY: std::ops::RangeInclusive<f64> = -0.65..=0.5;

impl Floor {
    /// Even everywhere, and no slip but that of turning: for tests and for comparison.
    pub const IDEAL: Self = Self {
        grip: Grip { anisotropy: 0.0, slip: 0.0, friction: 0.8 },
        variation: GripVariation { anisotropy: 0.0, slip: 0.0, correlation_length: 1.0 },
    };

    // Friction: rubber on tile and concrete 0.7–0.9, from hand-books. All else in the presets is a guess, made so that
    // dead reckoning without a gyro errs by what users report: 1–2 % of the distance, 5–15 % of the angle turned. Over
    // a square of 20 m with turns on the spot that is a drift of 4.6–5.3 % rms (32 seeds; median 3.4–4.1 %).

    /// Ceramic tile, indoors.
    pub const TILE: Self = Self {
        grip: Grip { anisotropy: 0.0, slip: 0.003, friction: 0.7 },
        variation: GripVariation { anisotropy: 0.2, slip: 0.006, correlation_length: 0.8 },
    };

    /// Short-pile carpet: the pile gives way under a driven wheel and holds a tyre that is dragged across it.
    pub const CARPET: Self = Self {
        grip: Grip { anisotropy: -0.2, slip: 0.012, friction: 0.8 },
        variation: GripVariation { anisotropy: 0.12, slip: 0.008, correlation_length: 1.0 },
    };

    /// Bare concrete.
    pub const CONCRETE: Self = Self {
        grip: Grip { anisotropy: -0.05, slip: 0.005, friction: 0.85 },
        variation: GripVariation { anisotropy: 0.16, slip: 0.006, correlation_length: 0.6 },
    };

    /// Asphalt, some years old: rougher than concrete, without its joints. Friction: hand-books, 0.7–0.9.
    pub const ASPHALT: Self = Self {
        grip: Grip { anisotropy: -0.05, slip: 0.004, friction: 0.8 },
        variation: GripVariation { anisotropy: 0.14, slip: 0.006, correlation_length: 0.8 },
    };

    /// A mown lawn, dry. Friction: hand-books, 0.5–0.6. A driven wheel shears the turf and over-spins by 4 %: users
    /// report distances wrong by 3–5 % on grass and gravel, two or three times as much as on a hard floor.
    pub const GRASS: Self = Self {
        grip: Grip { anisotropy: -0.4, slip: 0.024, friction: 0.5 },
        variation: GripVariation { anisotropy: 0.05, slip: 0.012, correlation_length: 0.7 },
    };

    /// Loose gravel. Friction: hand-books, 0.3–0.4 on loose ground. It gives way even more than turf, by 5 %.
    pub const GRAVEL: Self = Self {
        grip: Grip { anisotropy: -0.45, slip: 0.0275, friction: 0.4 },
        variation: GripVariation { anisotropy: 0.05, slip: 0.015, correlation_length: 0.5 },
    };

    /// How much wider apart two wheels would have to stand to turn the robot as its four do, on average over this
    /// floor: the closed form of the module's head.
    pub fn effective_track_ratio(&self, robot: &RobotModel) -> f64 {
        1.0 + (robot.wheelbase() / robot.track()).powi(2) / (1.0 + self.grip.anisotropy)
    }

    /// True speed over what the encoders say, driving straight, on average over this floor.
    pub fn speed_ratio(&self) -> f64 {
        1.0 - self.grip.slip / (1.0 + self.grip.anisotropy)
    }
}

/// A rectangle of one floor in the world's x and y, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorArea {
    /// South-west corner.
    pub min: [f64; 2],
    /// North-east corner.
    pub max: [f64; 2],
    /// What lies there.
    pub floor: Floor,
}

/// Which floor lies where.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorPlan {
    /// Wherever no area is.
    pub elsewhere: Floor,
    /// The last one that covers a place counts, as with carpets.
    pub areas: Vec<FloorArea>,
}

impl From<Cover> for Floor {
    fn from(cover: Cover) -> Self {
        match cover {
            Cover::Tile => Self::TILE,
            Cover::Carpet => Self::CARPET,
            Cover::Concrete => Self::CONCRETE,
            Cover::Asphalt => Self::ASPHALT,
            Cover::Grass => Self::GRASS,
            Cover::Gravel => Self::GRAVEL,
        }
    }
}

impl From<&Ground> for FloorPlan {
    /// As the world has it.
    fn from(ground: &Ground) -> Self {
        let area = |area: &CoveredArea| FloorArea { min: area.min, max: area.max, floor: area.cover.into() };
        Self { elsewhere: ground.elsewhere.into(), areas: ground.areas.iter().map(area).collect() }
    }
}

impl From<Floor> for FloorPlan {
    fn from(floor: Floor) -> Self {
        Self { elsewhere: floor, areas: Vec::new() }
    }
}

impl FloorPlan {
    /// The floor at a place.
    pub fn floor_at(&self, x: f64, y: f64) -> &Floor {
        let covers =
            |area: &&FloorArea| (area.min[0]..area.max[0]).contains(&x) && (area.min[1]..area.max[1]).contains(&y);
        self.areas.iter().rev().find(covers).map_or(&self.elsewhere, |area| &area.floor)
    }

    /// How the spot at (x, y) holds a tyre in the run with `seed`.
    pub fn grip_at(&self, seed: u64, x: f64, y: f64) -> Grip {
        let Floor { grip, variation } = *self.floor_at(x, y);
        if variation.anisotropy == 0.0 && variation.slip == 0.0 {
            return grip;
        }
        let [first, second] = Unevenness::new(seed, variation.correlation_length).at(x, y);
        Grip {
            anisotropy: (grip.anisotropy + variation.anisotropy * first).clamp(*ANISOTROPY.start(), *ANISOTROPY.end()),
            slip: grip.slip + variation.slip * second,
            friction: grip.friction,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn carpet_on_tile() -> FloorPlan {
        let carpet = FloorArea { min: [1.0, 1.0], max: [3.0, 2.0], floor: Floor::CARPET };
        FloorPlan { elsewhere: Floor::TILE, areas: vec![carpet] }
    }

    #[test]
    fn the_carpet_ends_at_its_edge() {
        let plan = carpet_on_tile();
        assert_eq!(plan.floor_at(1.5, 1.5), &Floor::CARPET);
        assert_eq!(plan.floor_at(3.5, 1.5), &Floor::TILE);
        assert_eq!(plan.floor_at(1.5, 0.5), &Floor::TILE);
    }

    #[test]
    fn the_ground_stays_within_what_can_be_driven_on() {
        let wild = GripVariation { anisotropy: 10.0, ..Floor::TILE.variation };
        let plan = FloorPlan::from(Floor { variation: wild, ..Floor::TILE });
        for step in 0..1000 {
            let anisotropy = plan.grip_at(1, f64::from(step) * 0.37, 0.0).anisotropy;
            assert!(ANISOTROPY.contains(&anisotropy), "{anisotropy}");
        }
    }

    #[test]
    fn a_seed_gives_its_own_floor() {
        let plan = carpet_on_tile();
        assert_eq!(plan.grip_at(1, 0.3, 0.4), plan.grip_at(1, 0.3, 0.4));
        assert_ne!(plan.grip_at(1, 0.3, 0.4), plan.grip_at(2, 0.3, 0.4));
        assert_eq!(FloorPlan::from(Floor::IDEAL).grip_at(1, 0.3, 0.4), Floor::IDEAL.grip);
    }
}
