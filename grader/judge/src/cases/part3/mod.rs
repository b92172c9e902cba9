//! Direct light: matte surfaces, looking around, looking at the lights.

mod lambert;
mod lights;
mod looking_around;
mod worlds;

use super::Spec;

/// The cases of Part 3.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    [
        lambert::cases(seed),
        looking_around::cases(seed),
        lights::cases(seed),
    ]
    .concat()
}
