//! The COLLADA reader: what files mean, what is mended, what is refused.

mod errors;
mod meaning;
mod mended;
mod small;
mod textures;
