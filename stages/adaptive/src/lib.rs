//! Part 5: as many samples as a pixel needs.
//!
//! Read in this order: [`stop`] (task 1, the rule that says when a pixel is done; task 2, the same rule without
//! its blind spots), [`pixel`] (task 1, the sample loop that asks it), [`rate`] (the picture of how many samples went
//! where).

pub mod pixel;
pub mod rate;
pub mod stop;

pub use pixel::raytrace_pixel_adaptive;
pub use rate::rate_colour;
pub use stop::{has_converged, has_surely_converged};
