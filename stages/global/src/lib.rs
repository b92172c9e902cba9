//! Part 4: mirrors, glass and indirect light.
//!
//! Reading order: [`fresnel`] and [`specular`] (task 1, delta materials: mirrors and smooth glass),
//! [`path`] (task 2, path tracing), [`roulette`] (task 3, Russian roulette), and beyond the course
//! [`glossy`] (rough mirrors) and [`rough_glass`].
//!
//! The materials come as [`Scattering`](kit::Scattering), and direct light, roulette and ray
//! tracing as closures, so that each task can be tested before the others are written.

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
