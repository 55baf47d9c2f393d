//! A world from above, as an architect draws it.

use super::World;

/// What stands in a robot's way, as outlines: x, y in the world, metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// What is thin seen from above: walls' faces, as lines.
    pub walls: Vec<Vec<[f64; 2]>>,
    /// Everything else: closed outlines, the last point joined to the first.
    pub furniture: Vec<Vec<[f64; 2]>>,
}

impl Plan {
    /// The plan of a world.
    pub fn of(_world: &World) -> Self {
        Self::default()
    }
}
