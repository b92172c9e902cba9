//! FNV-1a with 64 bits: a hash that is the same with every compiler. It finds changes; it proves
//! nothing about who made them.
//!
//! ```
//! use base::fnv;
//! assert_eq!(b"a".iter().copied().fold(fnv::START, fnv::add), 0xaf63_dc4c_8601_ec8c);
//! ```

/// The hash of nothing.
pub const START: u64 = 0xcbf2_9ce4_8422_2325;

/// The hash of what `hash` is of, and then of a byte; or of a number, as a byte that is wider.
pub fn add(hash: u64, part: impl Into<u64>) -> u64 {
    (hash ^ part.into()).wrapping_mul(0x0100_0000_01b3)
}
