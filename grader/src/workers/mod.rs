//! Runs cases in workers: one worker for many cases, another one after a crash.
//!
//! - [`worker_set`]: the workers of a run, each built from the stages that compile together;
//!   [`stage_workers`]: one for each stage
//! - [`runner`]: runs cases in a worker, started by a [`launcher`], over a channel of their own
//! - [`records`]: reads the answers as untrusted data
//! - [`printed`]: what the code printed; [`death`] and [`crash`]: how a worker ended, in a sentence

mod channel;
pub mod crash;
pub mod death;
pub mod launcher;
pub mod printed;
pub mod records;
pub mod runner;
pub mod stage_workers;
pub mod worker_set;
