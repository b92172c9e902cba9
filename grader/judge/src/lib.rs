//! Judges the results of the student's code: which aspects of them are right, and which are wrong.
//!
//! Three floors; each imports only from the floors below. The highest is `face`: what other crates
//! call. [`fits`] validates the form of an answer. [`judge`] judges the values in the aspects that
//! a case is about; [`whole`] judges all aspects, before an answer becomes a golden. [`cases`] has
//! the cases, [`snapshot`] writes goldens, and [`repro`] writes Rust tests. [`picture`] has the
//! colours of answers, [`pictures`] the pictures that students see of their code.
//!
//! In the middle is `tasks`: a folder for each task, with its cases and the `Check` of its kind of
//! work, and a list of all tasks.
//!
//! The lowest is `tools`: what the tasks are made of, without any code for a certain task. All that
//! depends on a kind of work is a function of the trait `check::Check`.

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
pub use tools::{Tier, convert, errors, findings, plural, shown};
pub use tools::{compressed, packed_truth};
