//! All tests of grading a class.

mod alike;
mod fake_class;
mod forms;
mod likeness;
mod reading;
mod real;
mod units;
