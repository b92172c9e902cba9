//! JSON Schemas of the formats that other systems read, one file a format.
//!
//! `tests/schemas.rs` validates a file of every outcome. The validator has 35 crates from the
//! registry, an eighth of what `cargo test` would compile, so this crate is outside the default
//! members: `.ci/nightly schemas` runs its test.
