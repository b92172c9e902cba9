//! Scene files and camera files.
//!
//! - [`load`] reads a COLLADA file into a [`kit::Scene`] in world space, with warnings about what it mended;
//!   [`parse`] does the same with a text. [`collada`] says what is read, mended and refused. The scenes of the course itself are in this crate's folder `dae`.
//! - [`placement`] says where to look from; [`camera_file`] reads and writes that.
//! - [`diagnostic`] is how errors and warnings are told.

pub mod camera_file;
pub mod collada;
pub mod diagnostic;
pub mod placement;

pub use camera_file::CameraFile;
pub use collada::{Loaded, load, parse};
pub use diagnostic::{SceneError, Warning};
