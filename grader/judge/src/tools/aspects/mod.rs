//! Judges one aspect of answers: hit records, numbers and directions, statistics of many samples,
//! the samples of different pixels.

pub(crate) mod chance;
pub(crate) mod hits;
pub(crate) mod independence;
pub(crate) mod numbers;
