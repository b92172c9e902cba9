//! Part 4: mirrors, glass and light that bounces.
//!
//! Read in this order: [`fresnel`] and [`specular`] (task 1, surfaces that send light in one or two directions only),
//! [`path`] (task 2, light that took several bounces), [`roulette`] (task 3, when to give up on a path), and beyond the
//! course [`glossy`] (rough mirrors) and [`rough_glass`].
//!
//! What surfaces do with light comes in as [`Scattering`](kit::Scattering), and direct light, roulette and rays as
//! closures, so that each task can be tried when the others are still to be written.

pub mod fresnel;
pub mod glossy;
mod microfacets;
pub mod path;
pub mod rough_glass;
pub mod roulette;
pub mod specular;

pub use fresnel::fresnel_dielectric;
pub use glossy::{glossy_f, glossy_pdf, glossy_sample};
pub use path::estimate_radiance;
pub use rough_glass::RoughGlass;
pub use roulette::play_roulette;
pub use specular::{glass_sample, mirror_sample, reflect, refract, refraction_sample};
