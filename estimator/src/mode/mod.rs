//! Which sensors the pose can rest on, told from the images themselves (paper A, §6): what there is in each of them is
//! its `energy`; `fuzzy` rules say how much that speaks for each mode; `switch` changes modes when that lasts, and says
//! which images are wanted.

pub mod energy;
mod fuzzy;
mod switch;
mod video;

pub use energy::{Energies, of_colour, of_depth, of_infrared};
pub use fuzzy::{Breakpoints, Class, Degrees, Inference, Membership, Memberships, RULES, Rule};
pub use switch::{Answer, ModeChoice, ModeReport, ModeSwitch, Stream, SwitchParams};
