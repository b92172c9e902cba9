//! Makes the inputs of cases.

pub(crate) mod crosses;
pub(crate) mod eye;
pub(crate) mod picture_shapes;
pub mod probes;
pub(crate) mod scattering;
pub(crate) mod tree_plan;
