//! `grader gym`: mistakes to recognize by what they do.
//!
//! An [`exercise`] has the picture of a mistake and calls that it gets wrong, and four names of which one is right.
//! Everything is data that handouts contain: the book's pictures and lists of mistakes, stored signatures, goldens.
//! [`round`] asks, repeats what was missed, and stores that for the next round.

pub mod exercise;
pub mod round;
