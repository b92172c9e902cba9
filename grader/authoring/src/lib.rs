//! Tools for the authors of the course: [`handout`] creates the projects for students, [`check`]
//! tests the course itself, [`mutants`] grades typical mistakes and correct variants.

pub mod check;
pub mod handout;
pub mod mutants;
