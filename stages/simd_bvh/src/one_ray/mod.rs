//! The traversal by one ray. Reading order: `stack`, `traversal`, `unusual_ray` (rays that are too
//! large, too small or too far away for single precision).

pub(crate) mod stack;
pub(crate) mod traversal;
pub(crate) mod unusual_ray;
