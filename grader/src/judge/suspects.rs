//! What typical mistakes make of the same rays: whoever draws other rays makes the same mistake in other numbers.

use super::lamps::Place;
use kit::Vec3;
use wire::direct::AskedRay;

/// What an estimate by looking around adds up to if it is wrong in one of these ways.
#[derive(Default)]
pub(super) struct LookingAround {
    without_cosine: Vec3,
    cosine_of_wo: Vec3,
    swapped: Vec3,
    without_background: Vec3,
}

impl LookingAround {
    /// Takes in one ray and what it sees.
    pub(super) fn see(&mut self, place: &Place, asked: &AskedRay) {
        let (wo, wi) = (place.wo, place.frame.to_local(asked.ray.d.into()));
        let seen = Vec3::from(asked.seen);
        let light = place.f(wo, wi) * seen;
        self.without_cosine += light;
        self.cosine_of_wo += light * wo.z.abs();
        self.swapped += place.f(wi, wo) * seen * wi.z.abs();
        if asked.hit {
            self.without_background += light * wi.z.abs();
        }
    }

    /// The sums, each ray weighed by `share`, with the names of their mistakes.
    pub(super) fn sums(&self, share: f64) -> [(&'static str, Vec3); 4] {
        [
            ("without the cosine", self.without_cosine * share),
            ("the cosine of wo", self.cosine_of_wo * share),
            ("wo and wi swapped", self.swapped * share),
            ("without the background", self.without_background * share),
        ]
    }
}
