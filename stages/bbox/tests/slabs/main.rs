//! What rays do at boxes.
//!
//! [`plain`] holds the plain cases, [`hard_cases`] those where a slab test falls into 0·∞ or a rounding error,
//! each with a line on how; [`properties`] holds the test against exact arithmetic.

mod hard_cases;
mod plain;
mod properties;
