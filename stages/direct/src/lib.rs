//! Part 3: direct light.
//!
//! Reading order: [`lambert`] (task 1, diffuse surfaces), [`hemisphere`] (task 2, emission, and
//! direct light by hemisphere sampling), [`importance`] (task 3, direct light by light sampling).
//! [`mis`] (a combination of both) belongs to no task.
//!
//! Tasks 2 and 3 estimate the same integral, over the unit directions `wi` above a surface with the
//! normal `n`:
//!
//! ```text
//! Lo(wo) = Le(wo) + ∫ f(wo, wi) · Li(wi) · |cos θi| dwi
//! ```
//!
//! where `Li` is the radiance that arrives directly from lights. Every estimate is the mean of
//! `f · Li · |cos θi| / pdf` over directions sampled with the density `pdf`. It is unbiased for any
//! density that is not 0 where there is light; its noise depends on the density. The materials come
//! as [`Scattering`](kit::Scattering) and rays are traced by closures, so that each task can be
//! tested before the others are written.

pub mod hemisphere;
pub mod importance;
pub mod lambert;
pub mod mis;

pub use hemisphere::{estimate_direct_lighting_hemisphere, zero_bounce_radiance};
pub use importance::estimate_direct_lighting_importance;
pub use lambert::{lambert_f, lambert_pdf, lambert_sample};
pub use mis::estimate_direct_lighting_mis;
