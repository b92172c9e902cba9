//! The `pathtracer` program.

fn main() {}
