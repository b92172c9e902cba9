//! The sums that common mistakes compute from the same rays. They depend on the rays, so that a
//! mistake is recognised whatever rays are sampled.

use super::lamps::ShadingPlace;
use kit::{Spectrum, Vec3};
use wire::direct::RecordedRay;

/// The sum of a hemisphere estimate for each of several mistakes.
#[derive(Default)]
pub(crate) struct HemisphereMistakes {
    without_cosine: Vec3,
    cosine_of_wo: Vec3,
    swapped: Vec3,
    without_background: Vec3,
    cosine_twice: Vec3,
    sine: Vec3,
    clamped: Vec3,
    local: Vec3,
    world_wi: Vec3,
    world_wo: Vec3,
    world_both: Vec3,
    all_in_world: Vec3,
    world_up: Vec3,
    world_z: Vec3,
    geometric: Vec3,
    grey: Vec3,
    last: Vec3,
    right: Vec3,
    rays: u32,
    rays_to_light: u32,
}

impl HemisphereMistakes {
    /// Adds one ray and the radiance along it.
    pub(crate) fn add(&mut self, place: &ShadingPlace, recorded: &RecordedRay) {
        let (wo, wi) = (place.wo, place.frame.to_local(recorded.ray.d.into()));
        let seen = Vec3::from(recorded.seen);
        let light = place.f(wo, wi) * seen;
        self.without_cosine += light;
        self.cosine_of_wo += light * wo.z.abs();
        self.swapped += place.f(wi, wo) * seen * wi.z.abs();
        if recorded.hit {
            self.without_background += light * wi.z.abs();
        }
        self.cosine_twice += light * wi.z * wi.z;
        self.sine += light * (1.0 - wi.z * wi.z).max(0.0).sqrt();
        self.clamped += place.f(wo, wi) * seen.min(Vec3::ONE) * wi.z.abs();
        let d = Vec3::from(recorded.ray.d);
        self.local += place.f(wo, d) * seen * d.z.abs();
        self.world_wi += place.f(wo, d) * seen * wi.z.abs();
        self.world_wo += place.f(place.frame.to_world(wo), wi) * seen * wi.z.abs();
        let in_world = place.f(place.frame.to_world(wo), d) * seen;
        self.world_both += in_world * wi.z.abs();
        self.all_in_world += in_world * d.z.abs();
        self.world_z += light * d.z.abs();
        self.geometric += light * d.dot(place.ng).abs();
        self.world_up += light * d.y.abs();
        let luminance = Spectrum::from(recorded.seen).luminance();
        self.grey += place.f(wo, wi) * luminance * wi.z.abs();
        self.last = light * wi.z.abs();
        self.right += light * wi.z.abs();
        self.rays += 1;
        self.rays_to_light += u32::from(seen != Vec3::ZERO);
    }

    /// The sums, with `share` as the weight of each ray, and the names of the mistakes.
    pub(crate) fn sums(&self, share: f64) -> [(&'static str, Vec3); 18] {
        let of_those = f64::from(self.rays) / f64::from(self.rays_to_light.max(1));
        [
            ("without the cosine", self.without_cosine * share),
            ("the cosine of wo", self.cosine_of_wo * share),
            ("wo and wi swapped", self.swapped * share),
            ("without the background", self.without_background * share),
            ("the cosine twice", self.cosine_twice * share),
            ("the sine", self.sine * share),
            ("light clamped", self.clamped * share),
            ("along local directions", self.local * share),
            ("f of the world's wi", self.world_wi * share),
            ("the cosine to the world's up", self.world_up * share),
            ("the cosine to the geometric normal", self.geometric * share),
            ("f of the world's wo", self.world_wo * share),
            ("the cosine to the world's z", self.world_z * share),
            ("f of both in the world", self.world_both * share),
            ("f and the cosine in the world", self.all_in_world * share),
            ("grey light", self.grey * share),
            ("the last ray alone", self.last * share),
            ("mean of what finds light", self.right * share * of_those),
        ]
    }
}
