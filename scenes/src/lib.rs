//! Scene files, camera files and generators of large meshes.
//!
//! [`load`] reads a COLLADA file into a [`kit::Scene`] in world space, with warnings about what it mended;
//! [`parse`] does the same with a text. [`placement`] says where to look from, [`camera_file`] reads and writes that. [`diagnostic`] is how errors
//! and warnings are told. The scenes of the course itself are in the folder `dae` of this crate.

pub mod camera_file;
mod collada;
pub mod diagnostic;
pub mod placement;

pub use camera_file::CameraFile;
pub use collada::{Loaded, load, parse};
pub use diagnostic::{SceneError, Warning};
