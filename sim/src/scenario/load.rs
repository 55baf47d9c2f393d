//! From a file to a scenario.

use std::path::Path;

use schemars::JsonSchema;

use super::error::{Fault, ScenarioError, nearest};
use super::{Scenario, Source};
use crate::textured_room;

/// The world that has scenarios of its own.
const TEXTURED_ROOM: &str = "textured_room";
/// All that `world.name` can be.
const WORLDS: [&str; 4] = ["laboratory", "yard", "campus", TEXTURED_ROOM];

/// A scenario of either kind; `world.name` decides.
#[derive(Clone, Debug, PartialEq, JsonSchema)]
#[schemars(untagged, title = "Sunblind scenario")]
pub enum AnyScenario {
    /// A robot drives through a world.
    Robot(Box<Scenario>),
    /// A camera is carried through the textured room.
    TexturedRoom(textured_room::Scenario),
}

/// Reads and checks a scenario file.
///
/// # Errors
/// The first thing wrong, with file, line, column and what to write instead.
pub fn load(file: &Path) -> Result<AnyScenario, ScenarioError> {
    Source::read(file, &[])?.scenario()
}

impl Source {
    /// The scenario that is written here, checked. What its world stands in the way of is not known yet: see
    /// [`Scenario::check_way`].
    ///
    /// # Errors
    /// The first thing wrong, with its place and what to write instead.
    pub fn scenario(&self) -> Result<AnyScenario, ScenarioError> {
        let blame = |fault| self.blame(fault);
        match self.text_at("world.name")?.as_deref() {
            Some(TEXTURED_ROOM) => {
                let scenario: textured_room::Scenario = self.parse()?;
                scenario.check().map_err(blame)?;
                Ok(AnyScenario::TexturedRoom(scenario))
            }
            Some(name) if !WORLDS.contains(&name) => Err(blame(unknown_world(name))),
            _ => {
                let mut scenario: Scenario = self.parse()?;
                if let (Some(urdf), Some(folder)) = (&mut scenario.robot.urdf, self.file().parent()) {
                    *urdf = folder.join(&urdf);
                }
                if let (Some(gltf), Some(folder)) = (&mut scenario.world.gltf, self.file().parent()) {
                    *gltf = folder.join(&gltf);
                }
                scenario.check().map_err(blame)?;
                Ok(AnyScenario::Robot(Box::new(scenario)))
            }
        }
    }
}

impl AnyScenario {
    /// The short form.
    pub fn shortened(self) -> Self {
        match self {
            Self::Robot(scenario) => Self::Robot(Box::new(scenario.shortened())),
            Self::TexturedRoom(scenario) => Self::TexturedRoom(scenario.shortened()),
        }
    }
}

fn unknown_world(name: &str) -> Fault {
    let nearest = nearest(name, WORLDS).unwrap_or_default();
    let known = WORLDS.map(|world| format!("`{world}`")).join(" or ");
    Fault::new("world.name", format!("unknown world `{name}`, expected {known}; did you mean `{nearest}`?"))
}
