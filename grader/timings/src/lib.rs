//! Benchmarks of the stages and of the oracle: `cargo bench -p timings --bench bvh`.
//!
//! They have a crate of their own, outside the default members: as development dependencies of each
//! stage, criterion and its libraries would be compiled by every `cargo test`.
