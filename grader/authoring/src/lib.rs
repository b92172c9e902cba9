//! For authors of the course: [`handout`] carves what a student is given, [`check`] tests the course itself, [`mutants`]
//! grades typical mistakes and correct variants.

pub mod check;
pub mod handout;
pub mod mutants;
