//! Picture files of the renderer and the window: PNG, EXR, HDR, JPEG, BMP, TGA.
//!
//! What `image` and `exr` compile anew for each type of reader and writer is compiled here, once
//! and hardly optimised: no function has a type parameter, so that no other crate repeats it.

mod exr_file;
mod read;
mod write;

pub use exr_file::{FileLayer, read_layers};
pub use image::ImageError;
pub use read::{Picture, Pixels, decode};
pub use write::{Channel, Values, write_exr, write_hdr, write_png};
