//! Part 4: mirrors, glass and indirect light.
//!
//! Reading order: [`fresnel`] and [`specular`] (task 1, delta materials: mirrors and smooth glass),
//! [`path`] (task 2, path tracing), [`roulette`] (task 3, Russian roulette). [`glossy`]
//! (rough mirrors) and [`rough_glass`] belong to no task.
//!
//! [`path`] gets the materials as a [`Scattering`](kit::Scattering), and ray tracing, direct light
//! and roulette as closures. So each task can be tested before the others are written.

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
