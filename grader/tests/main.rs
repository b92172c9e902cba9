//! All tests of the program `grader` and of the workspace as a whole.

mod benchmarks;
mod closed_pipe;
mod dependencies;
mod language_server;
mod modules;
mod names;
mod palette;
mod pictures;
mod repository;
mod sizes;
mod sketch;
mod student_loop;
mod test_files;
