//! The COLLADA reader: the meaning of valid files, warnings, and errors.

mod cameras;
mod errors;
mod exporters;
mod meaning;
mod repairs;
mod small;
mod textures;
mod warning_counts;
mod warnings;
mod xml;
