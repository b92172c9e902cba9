//! What crosses between the grader and the worker: [`Case`]s in, [`Record`]s out.
//!
//! Plain data that knows nothing of the course's types. Numbers keep their bits: files are
//! [postcard](https://docs.rs/postcard), so NaN, infinities and -0 arrive as they were sent.
//!
//! [`kinds`] lists the kinds of work, each with its question and its answer. [`work`] has the
//! questions of Parts 1 and 2, [`answer`] their answers and the records around every answer;
//! [`direct`], [`global`] and [`adaptive`] have both for Parts 3 to 5, and [`light`] what lit
//! worlds are made of. [`mod@file`] reads and writes them: what a worker had finished can still be
//! read after it was killed.

pub mod adaptive;
pub mod answer;
pub mod direct;
pub mod file;
pub mod global;
pub mod kinds;
pub mod light;
pub mod work;

pub use answer::{Outcome, Record, RecordFrame};
pub use kinds::{Answer, Work};
pub use work::Case;
