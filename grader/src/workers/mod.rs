//! Runs cases in workers: one worker for many cases, another one after a crash.
//!
//! - [`worker_set`]: the workers of a run, each built from the stages that compile together;
//!   [`stage_workers`]: one for each stage
//! - [`runner`]: runs cases in a worker, started by a [`launcher`], over a channel of their own;
//!   [`awake`]: the clock of its end
//! - [`records`]: reads the answers as untrusted data; `asked`: results of tests that a worker has
//!   to ask for; `task_time`: how long the cases of a task may take together
//! - [`printed`]: what the code printed; [`death`] and [`crash`]: how a worker ended, in a sentence

mod asked;
pub mod awake;
mod channel;
pub mod crash;
pub mod death;
mod excess;
pub mod launcher;
pub mod printed;
pub mod records;
pub mod runner;
pub mod stage_workers;
mod task_time;
pub mod worker_set;
