//! Grades a class: hundreds of submissions, on one machine or on a cluster, and nothing twice.
//!
//! The program is `grader class`. The work is divided into *units*: the key of a unit is a hash of
//! the submission, the course, what is graded, the seed and the limits. The result of a unit is one
//! file, `OUT/units/KEY.json`, which is written to a temporary file and renamed. So a run that is
//! killed loses only the units in progress. Machines that share a folder need no server, and the
//! tables depend on the folder `OUT` alone.
//!
//! Read the modules in this order:
//!
//! - [`entries`] and [`reading`]: the folder of the class; archives, clones and odd layouts
//! - [`course_hash`]: what scores depend on
//! - [`plan`]: which units a class needs; `OUT/class.json`
//! - [`out`]: the folder `OUT`
//! - [`mod@unit`]: the result of one unit, and how it is graded
//! - [`pool`]: grades units on this machine, several at a time
//! - [`tables`]: writes [`gradebook`] and [`pages`], with [`likeness`], from what [`collect`] reads
//! - [`late`]: when something was handed in, and what late work loses
//! - [`roster`]: which student each submission belongs to, and marks in the form that course
//!   systems import
//! - [`by_hand`]: marks and words that the teacher gives by hand; [`decisions`]: these and the roster,
//!   and what changed in both since the last run
//! - [`regrade`]: old and new scores, before they are replaced

pub mod alike;
pub mod by_hand;
pub mod cli;
pub mod collect;
pub mod course_hash;
pub mod decisions;
pub mod entries;
pub mod gradebook;
pub mod hash;
pub mod late;
pub mod likeness;
pub mod out;
pub mod pages;
pub mod plan;
pub mod pool;
pub mod progress;
pub mod reading;
pub mod regrade;
pub mod roster;
mod row;
pub mod sheet;
pub mod tables;
pub mod unit;
