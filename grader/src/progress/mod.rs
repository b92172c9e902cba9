//! What is known from earlier runs: the stored [`results`], and the [`next_task`] by them.

pub mod next_task;
pub mod results;
