//! Part 3: light that reaches a surface straight from its source.
//!
//! Read in this order: [`lambert`] (task 1, how matte surfaces scatter), [`hemisphere`] (task 2, what emits by itself,
//! and direct light by looking around at random), [`importance`] (task 3, direct light by looking at the lights), and
//! beyond the course [`mis`] (both at once).
//!
//! Tasks 2 and 3 estimate the same integral, over the unit directions `wi` above a surface with the normal `n`:
//!
//! ```text
//! Lo(wo) = Le(wo) + ∫ f(wo, wi) · Li(wi) · |cos θi| dwi
//! ```
//!
//! where `Li` is what lights send straight here. Every estimate is the mean of `f · Li · |cos θi| / pdf` over directions
//! that were drawn with the density `pdf`: with any density that is nowhere 0 where there is light, the mean is right
//! in the long run; how noisy it is depends on the density. What surfaces do with light comes in as
//! [`Scattering`](kit::Scattering) and rays are traced by closures, so that each task can be tried when the others
//! are still to be written.

pub mod hemisphere;
pub mod importance;
pub mod lambert;
pub mod mis;

pub use hemisphere::{estimate_direct_lighting_hemisphere, zero_bounce_radiance};
pub use importance::estimate_direct_lighting_importance;
pub use lambert::{lambert_f, lambert_pdf, lambert_sample};
pub use mis::estimate_direct_lighting_mis;
