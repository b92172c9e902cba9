//! Scene files and camera files.
//!
//! - [`load`] reads a COLLADA file into a [`kit::Scene`] in world space, and returns warnings about
//!   everything that it repaired or ignored. [`parse`] reads the same from a string. [`collada`]
//!   documents the supported elements. The course's own scenes are in the folder `dae` of this
//!   crate.
//! - [`save`] writes a scene as COLLADA.
//! - [`placement`] computes the default view of a scene; [`camera_file`] reads and writes camera
//!   files.
//! - [`diagnostic`] formats errors and warnings.

pub mod camera_file;
pub mod collada;
pub mod diagnostic;
pub mod placement;
pub mod save;
mod text_file;

pub use camera_file::CameraFile;
pub use collada::{Loaded, load, parse};
pub use diagnostic::{SceneError, Warning};
/// Generators of large meshes, for programs outside this workspace.
pub use meshes as generate;
pub use save::SceneFile;
