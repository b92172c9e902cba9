//! All tests of grading a class.

mod alike;
mod damaged;
mod fake_class;
mod forms;
mod git;
mod hostile_forms;
mod likeness;
mod reading;
mod real;
mod teams;
mod units;
