//! Limits what a program may do before it runs code that is not trusted.
//!
//! A [`Policy`] lists what a program needs. The launcher, the program `sandbox` of this crate,
//! contains no code of anybody else: it gives up every other right ([`confine::enter`]) and then
//! becomes the program (`exec`), so that not even code that runs before `main` has more. A worker
//! gives up the rest on each of its threads, right before the student's code runs
//! ([`confine::seal_thread`]). [`probe`] tries on this machine which limits hold, and says so in
//! one line.
//!
//! Only Linux has these means (Landlock, seccomp, resource limits). On other systems the crate
//! compiles and reports that only time is limited.

pub mod confine;
pub mod policy;
pub mod probe;

pub use policy::{Limits, Policy, Without};
pub use probe::Support;
