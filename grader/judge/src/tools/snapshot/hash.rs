//! The hash of all rows.

use std::fmt;
use std::str::FromStr;

/// The 128-bit FNV-1a hash of a text (Fowler, Noll, Vo; draft-eastlake-fnv). Any changed byte
/// changes the hash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowsHash(u128);

const OFFSET_BASIS: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;

const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

impl RowsHash {
    /// The hash of the empty text.
    pub(super) const EMPTY: RowsHash = RowsHash(OFFSET_BASIS);

    /// The hash of the text so far, followed by `text`.
    pub(super) fn then(self, text: &str) -> RowsHash {
        let byte = |hash: u128, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME);
        RowsHash(text.bytes().fold(self.0, byte))
    }
}

impl fmt::Display for RowsHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl FromStr for RowsHash {
    type Err = std::num::ParseIntError;

    fn from_str(text: &str) -> Result<RowsHash, Self::Err> {
        u128::from_str_radix(text, 16).map(RowsHash)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_are_those_of_the_draft() {
        // Appendix C of draft-eastlake-fnv: FNV-1a with 128 bits of "", "a" and "foobar".
        for (text, hash) in [
            ("", "6c62272e07bb014262b821756295c58d"),
            ("a", "d228cb696f1a8caf78912b704e4a8964"),
            ("foobar", "343e1662793c64bf6f0d3597ba446f18"),
        ] {
            let of_text = RowsHash::EMPTY.then(text);
            assert_eq!(of_text.to_string(), hash);
            assert_eq!(hash.parse(), Ok(of_text));
        }
    }
}
