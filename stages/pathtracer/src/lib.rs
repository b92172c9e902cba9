//! The renderer: the stages put together.
//!
//! Read in this order: [`world`] (a scene as the tree sees it, and what is counted), [`accel`] (brute force or
//! the tree), [`normals`] and [`lit`] (from pixel to colour), [`materials`] (how surfaces scatter), [`textures`] (the
//! pictures on them), [`lens`] and [`environment_file`] (what the flags add to a scene), [`rendered`] (a picture and its noise), [`layers`]
//! (what else is known of it), [`tone`], [`output`] and [`part_file`] (from colour to file), [`mitsuba`] (the scene for another
//! renderer). The program
//! around it is in `src/bin/pathtracer`.

pub mod accel;
pub mod environment_file;
pub mod layers;
pub mod lens;
pub mod lit;
pub mod materials;
pub mod mitsuba;
pub mod normals;
mod octet;
pub mod output;
pub mod part_file;
pub mod rendered;
pub mod textures;
pub mod tone;
mod walk;
pub mod world;

pub use accel::{Accel, AccelKind};
pub use environment_file::{EnvironmentFileError, load_environment};
pub use lens::Lens;
pub use lit::{LightSettings, Looking, render_lit};
pub use mitsuba::to_mitsuba;
pub use normals::render_normals;
pub use output::{Output, OutputError};
pub use part_file::PartFile;
pub use rendered::{Job, Rendered};
pub use textures::Textures;
pub use world::{Counters, SceneWorld};
