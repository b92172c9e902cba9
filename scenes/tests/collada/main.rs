//! The COLLADA reader: the meaning of valid files, warnings, and errors.

mod errors;
mod meaning;
mod small;
mod textures;
mod warnings;
