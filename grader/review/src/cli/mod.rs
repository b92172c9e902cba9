//! The commands: their arguments, and the functions that run them.

#[cfg(feature = "submissions")]
pub(crate) mod bless;
pub(crate) mod look;
#[cfg(feature = "submissions")]
pub(crate) mod review;
