//! The `viewer` program.
fn main() {}
