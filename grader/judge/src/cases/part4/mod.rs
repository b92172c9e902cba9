//! Mirrors and glass, paths, Russian roulette.

mod paths;
mod roulette;
mod specular;

use super::Spec;

/// The cases of Part 4.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    [
        specular::cases(seed),
        paths::cases(seed),
        roulette::cases(seed),
    ]
    .concat()
}
