//! Judges the results of the student's code: which aspects of them are right, and which are wrong.
//!
//! Three floors; each imports only from those below. Above, `face`: what other crates call.
//! [`fits`] validates the form of an answer, [`judge`] its values, in the aspects that a case is
//! about; [`whole`] judges an answer in all its aspects, before it becomes a golden. [`cases`] has
//! the cases, [`snapshot`] writes goldens, [`repro`] Rust tests, [`picture`] the colours of
//! answers; [`pictures`] are those that students see of their code.
//!
//! In the middle, `tasks`: a folder each, with its cases and the `Check` of its kind of work. One
//! list there has them all.
//!
//! Below, `tools`: what the tasks are made of, which knows none of them. Its `check::Check` is the
//! seam: all that depends on a kind of work is one of its functions.

mod face;
mod tasks;
mod tools;

pub use face::judgement::{calls, fits, judge, judge_each, judge_written};
pub use face::{
    cases, examples, moved, own_cases, picture, pictures, repro, snapshot, truth_tables, whole,
};
pub use tasks::part2_task1::exact_boxes;
pub use tasks::part3_task1::diffuse_density;
pub use tasks::part4_task1::right_reflectance;
pub use tools::simple::variations;
pub use tools::truth::{self, expected, scene};
pub use tools::{Tier, convert, errors, plural, shown, tally};
pub use tools::{compressed, packed_truth};
