//! Scene files and camera files.
//!
//! - [`load`] reads a scene file into a [`kit::Scene`] in world space, and returns warnings about
//!   everything that it repaired or ignored: a COLLADA file, or by its extension a glTF, OBJ or PLY
//!   file ([`model`]). [`parse`] reads COLLADA from a string. [`collada`] documents the supported
//!   elements. The course's own scenes are in the folder `dae` of this crate.
//! - [`save`] writes a scene as COLLADA.
//! - [`placement`] computes the default view of a scene; [`camera_file`] reads and writes camera
//!   files.
//! - [`diagnostic`] formats errors and warnings.

pub mod camera_file;
pub mod collada;
pub mod diagnostic;
mod limited_file;
mod loaded;
pub mod model;
pub mod placement;
pub mod save;
mod text_file;

pub use camera_file::CameraFile;
pub use collada::parse;
pub use diagnostic::{SceneError, Warning};
pub use loaded::Loaded;
/// Generators of large meshes, for programs outside this workspace.
pub use meshes as generate;
pub use save::SceneFile;

use std::path::Path;

/// Reads a scene file: COLLADA, unless its extension is that of another format.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, SceneError> {
    let path = path.as_ref();
    model::load(path).unwrap_or_else(|| collada::load(path))
}
