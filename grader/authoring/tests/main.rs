//! All tests that carve, mutate or repeat the whole course.

mod contracts;
mod empty_solutions;
mod formulas;
mod handouts;
mod mistake_pictures;
mod mutants;
mod new_stage;
mod repro;
mod term;
mod versions_crate;
