//! `grader predict`: asks what a student expects before the code is written.
//!
//! - [`questions`]: the two questions of a chapter, with choices.
//! - [`worked_examples`]: variants of the chapters' worked examples, with numbers that are drawn.
//!   The oracle and integers compute the truth; the answers of typical mistakes are known, too.
//! - `draw`: draws whole numbers and orders.
//! - [`number`]: reads a number as people write it.
//! - [`store`]: keeps the answers, for oneself.
//! - [`session`]: asks and answers.

pub(crate) mod draw;
pub mod number;
pub mod questions;
pub mod session;
pub mod store;
pub mod worked_examples;
