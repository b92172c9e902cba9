//! All tests of the goldens.

mod certainty;
mod claims;
mod goldens;
mod growth;
mod main_answers;
mod mistakes;
mod moves;
mod shared;
mod simple_questions;
mod untrusted_records;
