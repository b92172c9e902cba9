//! All tests of the text and its numbers.

mod course;
mod english;
mod explore;
mod hard_cases;
mod labels;
mod numbers;
mod text;
