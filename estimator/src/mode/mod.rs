//! Which sensors the pose can rest on, told from the images themselves (paper A, §6): what there is in each of them is
//! its `energy`.

pub mod energy;

pub use energy::{Energies, of_colour, of_depth, of_infrared};
