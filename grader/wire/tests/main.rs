//! What grader and worker send each other is read back, and nothing else is.

mod damaged_streams;
mod frames;
mod lines;
