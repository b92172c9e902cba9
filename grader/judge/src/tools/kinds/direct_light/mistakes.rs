//! The sums that common mistakes compute from the same rays. They depend on the rays, so that a
//! mistake is recognised whatever rays are sampled.

use super::lamps::ShadingPlace;
use kit::{Frame, Spectrum, Vec3};
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
    geometric_frame: Vec3,
    both_sides: Vec3,
    backs: Vec3,
    last: Vec3,
    right: Vec3,
    rays: u32,
    rays_to_light: u32,
}

impl HemisphereMistakes {
    /// Adds one ray, the radiance along it, and that of the `lamp` that it hits on either side.
    pub(crate) fn add(&mut self, place: &ShadingPlace, recorded: &RecordedRay, lamp: Vec3) {
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
        let of_lamp = place.f(wo, wi) * lamp * wi.z.abs();
        let background = if recorded.hit {
            Vec3::ZERO
        } else {
            light * wi.z.abs()
        };
        self.both_sides += of_lamp + background;
        if recorded.hit && seen == Vec3::ZERO {
            self.backs += of_lamp;
        }
        self.backs += background;
        let around_ng = Frame::around(place.ng);
        let (to_viewer, to_light) = (
            around_ng.to_local(place.frame.to_world(wo)),
            around_ng.to_local(d),
        );
        self.geometric_frame += place.f(to_viewer, to_light) * seen * to_light.z.abs();
        self.last = light * wi.z.abs();
        self.right += light * wi.z.abs();
        self.rays += 1;
        self.rays_to_light += u32::from(seen != Vec3::ZERO);
    }

    /// The sums, with `share` as the weight of each ray, and the names of the mistakes.
    pub(crate) fn sums(&self, share: f64) -> [(&'static str, Vec3); 21] {
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
            ("around the geometric normal", self.geometric_frame * share),
            ("lamps on both sides", self.both_sides * share),
            ("lamps from behind", self.backs * share),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::lamps::first_lamp;
    use super::super::worlds::{floor, of_panels};
    use super::*;
    use wire::light::{Material, Panel};
    use wire::work::Ray;

    #[test]
    fn a_lamp_that_is_seen_from_behind_has_a_sum_of_its_own() {
        let place = ShadingPlace::of(&floor());
        let d = Vec3::Y;
        let sums = |faces: f64| {
            let lamp = Panel {
                axis: 1,
                at: place.p.y + 1.0,
                min: [-9.0; 2],
                max: [9.0; 2],
                faces,
                material: Material::Emission([1.0; 3]),
            };
            let seen = if faces < 0.0 { [1.0; 3] } else { [0.0; 3] };
            let ray = RecordedRay {
                ray: Ray {
                    o: place.start(d).into(),
                    d: d.into(),
                    min_t: 0.0,
                    max_t: f64::INFINITY,
                },
                seen,
                hit: true,
            };
            let mut mistakes = HemisphereMistakes::default();
            mistakes.add(&place, &ray, first_lamp(&of_panels(vec![lamp]), &ray));
            let sums = mistakes.sums(1.0);
            ["lamps on both sides", "lamps from behind"].map(|name| {
                sums.into_iter()
                    .find(|(own, _)| *own == name)
                    .map(|(_, sum)| sum)
            })
        };
        let lit = Some(place.scattered(d));
        assert_eq!(sums(1.0), [lit, lit]);
        assert_eq!(sums(-1.0), [lit, Some(Vec3::ZERO)]);
    }
}
