//! The commands: their arguments, and the functions that run them.

pub(crate) mod handout;
pub(crate) mod start;

use base::program::whole_number;

/// Reads the number of a part.
fn part_number(value: &str) -> Result<u32, String> {
    whole_number(value, 1, u32::MAX).map_err(|_| "expected a part's number, such as 1".to_owned())
}
