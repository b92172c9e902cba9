//! Part 1, tasks 1 and 2: where rays come from.
//!
//! Read [`pixel`] first (how many rays go through a pixel, and where), then [`camera_ray`] (which way
//! a point on the sensor looks).

pub mod camera_ray;
pub mod pixel;

pub use camera_ray::generate_ray;
pub use pixel::raytrace_pixel;
