//! Kinds of work that several tasks share, and what several kinds share.

pub(crate) mod brute_force;
pub(crate) mod direct_light;
pub(crate) mod stopping;
