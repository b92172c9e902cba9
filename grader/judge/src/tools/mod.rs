//! What the tasks are made of: nothing here knows a task.
//!
//! [`findings`] counts right and wrong answers by aspect, [`errors`] summarises numerical errors.
//! [`truth`] computes the exact results with the oracle, [`packed_truth`] keeps those of formulas
//! for handouts, [`compressed`] makes files short. [`aspects`] judges hit records, numbers,
//! statistics of many samples. [`snapshot`] writes and compares goldens, [`repro`] parts of Rust
//! tests. [`questions`] makes the inputs of cases, [`simple`] those that a person can work on
//! paper. [`check`] has the operations on a kind of work, [`spec`] a case, [`moves`] the symmetries
//! of its question, [`kinds`] what several tasks share.

pub(crate) mod aspects;
pub(crate) mod call_text;
pub(crate) mod check;
pub(crate) mod colours;
pub mod compressed;
pub mod convert;
pub mod errors;
pub mod findings;
pub(crate) mod kinds;
pub(crate) mod moves;
pub mod packed_truth;
mod plural;
pub(crate) mod questions;
pub mod recorded;
pub(crate) mod repro;
pub mod shown;
pub(crate) mod simple;
pub(crate) mod snapshot;
pub(crate) mod spec;
mod tier;
pub mod truth;

pub use plural::plural;
pub use tier::Tier;
