//! Colours of answers, for pictures.

use wire::answer::Hit;
use wire::work::Xyz;

/// The colour of a hit: its normal.
pub fn hit(hit: Option<&Hit>) -> Xyz {
    hit.map_or([0.0; 3], |hit| direction(hit.n))
}

/// The colour of a unit vector: maps each component from -1..1 to 0..1.
pub(crate) fn direction(d: Xyz) -> Xyz {
    d.map(|component| component / 2.0 + 0.5)
}

/// The colour of a distance along a ray.
pub(crate) fn distance(t: Option<f64>) -> Xyz {
    t.map_or([0.0; 3], |t| {
        [0.2, 0.5, 1.0].map(|tint| (-tint * t / 4.0).exp())
    })
}
