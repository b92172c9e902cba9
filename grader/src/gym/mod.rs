//! `grader gym`: mistakes to recognize by what they do.
//!
//! An [`exercise`] has the picture of a mistake, calls that the mistake makes wrong, and four
//! names, of which one is right. Everything is data that handouts contain: the book's pictures
//! ([`mistake_sheet`]) and lists of mistakes, stored signatures, goldens. [`round`] asks, repeats
//! missed exercises, and stores them for the next round.

pub mod exercise;
pub mod mistake_sheet;
pub mod round;
