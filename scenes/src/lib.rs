//! Scene files and generators.
