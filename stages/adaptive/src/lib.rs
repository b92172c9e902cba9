//! Part 5: adaptive sampling.
//!
//! Reading order: [`stop`] (task 1, the stopping criterion; task 2, the criterion with less bias),
//! [`pixel`] (task 1, the sampling loop that uses it), [`rate`] (the image of the sampling rate).

pub mod pixel;
pub mod rate;
pub mod stop;

pub use pixel::raytrace_pixel_adaptive;
pub use rate::rate_colour;
pub use stop::{has_converged, has_surely_converged};
