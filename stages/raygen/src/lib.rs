//! Part 1, tasks 1 and 2: ray generation.
//!
//! Read [`pixel`] first (the number of rays per pixel, and their positions), then [`camera_ray`]
//! (the ray through a point of the film).

pub mod camera_ray;
pub mod pixel;

pub use camera_ray::generate_ray;
pub use pixel::raytrace_pixel;
