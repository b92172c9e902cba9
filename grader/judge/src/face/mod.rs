//! What other crates call: the cases, the judgement of an answer, what is written about it.

pub mod cases;
pub mod examples;
pub(crate) mod judgement;
pub mod moved;
mod order;
pub mod own_cases;
pub mod picture;
pub mod pictures;
pub mod repro;
pub mod snapshot;
pub mod truth_tables;
pub mod whole;
