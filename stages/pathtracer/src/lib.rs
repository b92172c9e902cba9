//! The renderer: the stages, connected to a scene, a camera and picture files.
//!
//! Reading order: [`world`] (the scene as a ray tests it, and the counters), [`accel`] (brute force
//! or a tree), [`normals`] and [`lit`] (from pixel to radiance), `integrator` and `packet` (scalar
//! paths, and paths in packets of eight), [`pixel_contents`] (where there is nothing to hit),
//! `materials` (scattering), `clamp` (fireflies), [`textures`], [`lens`] and [`environment_file`]
//! (what flags add to a scene), [`mod@darkness`]
//! (why a picture is black), [`trial`] (whether the stages for a picture are written), [`rendered`]
//! (a job and its result), [`layers`] (albedo, normal, depth),
//! [`lobe`] (scattering at a point, for drawings), [`progressive`] (rendering that can be
//! stopped and resumed) and [`passes`] (how many samples each pass takes), [`tone`],
//! [`rate_picture`](mod@rate_picture), [`output`] and [`part_file`] (picture files), [`exact_sum`],
//! [`sums_file`] and [`merge`](mod@merge) (parts of a picture), [`mitsuba`] (export for another
//! renderer). The program is in `src/bin/pathtracer`.

pub mod accel;
pub mod args;
mod clamp;
pub mod darkness;
pub mod environment_file;
pub mod exact_sum;
mod integrator;
mod lamp_edge;
pub mod layers;
pub mod lens;
pub mod lit;
pub mod lobe;
mod materials;
pub mod merge;
pub mod mitsuba;
pub mod normals;
pub mod output;
mod packet;
pub mod part_file;
pub mod passes;
pub mod picture;
pub mod pixel_contents;
pub mod progressive;
pub mod rate_picture;
pub mod rendered;
pub mod replay;
pub mod sums_file;
mod texture_file;
pub mod textures;
mod tiles;
pub mod tone;
pub mod tracer;
pub mod trial;
pub mod world;

pub use accel::{Accel, AccelKind};
pub use adaptive::rate_colour;
pub use darkness::{Darkness, darkness};
pub use environment_file::{EnvironmentFileError, load_environment};
pub use exact_sum::{ExactSum, PixelSum};
pub use lens::Lens;
pub use lit::{DirectSampling, LightSettings, render_lit};
pub use materials::nearly_smooth;
pub use merge::merge;
pub use mitsuba::to_mitsuba;
pub use output::{Output, OutputError};
pub use packet::Guide;
pub use part_file::PartFile;
pub use passes::Passes;
pub use picture::{Picture, PreparedScene};
pub use progressive::{ProgressiveRender, TileDone};
pub use rate_picture::{RateScale, rate_picture};
pub use rendered::{Job, Rendered, RenderedTile};
pub use replay::replay_pixel;
pub use sums_file::SumsFile;
pub use texture_file::read_texture;
pub use textures::Textures;
pub use tone::{Tone, ToneCurve};
pub use tracer::RayRole;
pub use world::{Counters, SceneWorld};
