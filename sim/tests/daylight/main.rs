//! Sun and sky on small worlds, against closed forms and geometry.

#[path = "../scene/mod.rs"]
mod scene;

mod outdoors;
mod shadow;
mod sky;
