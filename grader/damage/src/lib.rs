//! Damages bytes and JSON at random, for tests of what reads them: the same damage for the same seed.
//!
//! A test damages a valid input once for each seed of [`seeds`], and an ignored test for those of
//! [`seeds_for_a_while`]. [`Naming`] names the seed of a failure, and `FIRSTLIGHT_FUZZ_SEED` begins
//! with it.

mod bytes;
mod json;
mod random;

pub use bytes::damage;
pub use json::damage_json;
pub use random::Random;

use std::time::{Duration, Instant};

/// So many seeds from the first one on.
pub fn seeds(count: u64) -> impl Iterator<Item = u64> {
    let first = number_in("FIRSTLIGHT_FUZZ_SEED").unwrap_or(0);
    first..first + count
}

/// Seeds for `FIRSTLIGHT_FUZZ_SECONDS` seconds, 60 if it is not set.
pub fn seeds_for_a_while() -> impl Iterator<Item = u64> {
    let seconds = number_in("FIRSTLIGHT_FUZZ_SECONDS").unwrap_or(60);
    let end = Instant::now() + Duration::from_secs(seconds);
    seeds(u64::MAX / 2).take_while(move |_| Instant::now() < end)
}

/// Prints the seed if the test panics while this exists.
#[derive(Debug)]
pub struct Naming(pub u64);

impl Drop for Naming {
    fn drop(&mut self) {
        if std::thread::panicking() {
            println!("repeat it with FIRSTLIGHT_FUZZ_SEED={}", self.0);
        }
    }
}

fn number_in(variable: &str) -> Option<u64> {
    std::env::var(variable).ok()?.parse().ok()
}
