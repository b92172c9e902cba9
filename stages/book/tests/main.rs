//! All tests of the text, its numbers and its pages.

mod course;
mod explore;
mod hard_cases;
mod numbers;
mod pages;
mod text;
