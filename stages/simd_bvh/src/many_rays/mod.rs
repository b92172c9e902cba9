//! The traversal by many rays together. Reading order: `stream_traversal`, `slot_queue`, `ray_slot` and
//! `slot_stack` (rays of any directions, a step of each by turns), `region` (the primitives that
//! many rays may hit).

pub(crate) mod ray_slot;
pub(crate) mod region;
pub(crate) mod slot_queue;
pub(crate) mod slot_stack;
pub(crate) mod stream_traversal;
