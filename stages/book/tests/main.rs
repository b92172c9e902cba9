//! All tests of the text, its numbers and its pages.

mod course;
mod numbers;
mod pages;
mod text;
