//! The data that the grader and the worker exchange: [`Case`]s in, [`Record`]s out.
//!
//! Plain data that does not depend on the course's types. Numbers keep their bits: files are
//! [postcard](https://docs.rs/postcard), so NaN, infinities and -0 arrive as they were sent.
//!
//! [`kinds`] lists the kinds of work, each with its question and its answer. [`work`] has the
//! questions of Parts 1 and 2, [`answer`] their answers; [`direct`], [`global`] and [`adaptive`]
//! have both for Parts 3 to 5, and [`light`] the materials and lights of scripted worlds.
//! [`record`] has the records of all answers. [`mod@picture`] has the pictures of tasks, [`question`] what a worker asks
//! while a case runs. [`mod@file`] reads and writes all
//! of them: the records that a worker has finished can be read even if it is killed.

pub mod adaptive;
pub mod answer;
mod case;
pub mod direct;
pub mod file;
pub mod global;
pub mod kinds;
pub mod light;
pub mod picture;
mod printed;
pub mod question;
pub mod record;
pub mod work;

pub use case::Case;
pub use kinds::{Answer, Kind, Work, kind};
pub use printed::{case_of_marker, output_marker};
pub use record::{Excess, Outcome, Record, RecordFrame};
