//! Sun and sky on small worlds, against closed forms and geometry.

mod glint;
mod outdoors;
mod shadow;
mod sky;
