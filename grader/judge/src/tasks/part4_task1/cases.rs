//! Cases of mirrors, refraction and glass.

use crate::tools::findings::Aspect::{Bsdf, Fresnel, Mean, Pdf, SampleOrNone, SampledDirection};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use kit::Vec3;
use wire::global::SpecularCall::{
    self, Fresnel as Share, Glass, Mirror, Reflect, Refract, Refraction,
};
use wire::kind;
use wire::work::Xyz;

/// Tints whose channels differ.
const TINT: Xyz = [1.0, 0.5, 0.25];
const OTHER_TINT: Xyz = [0.2, 0.6, 0.9];

/// Indices of water, glass and diamond, and of a bubble in water.
const INDICES: [f64; 4] = [1.33, 1.5, 2.4, 0.75];

/// The cases of `part4.task1`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "mirror",
            "A mirror reflects wo about the normal, on both sides of the surface; the share \
             `reflectance` of the light arrives, so f contains 1 / |cos θ|.",
            calls("mirror", 0, 100, |rng| {
                let wo = any_side(rng);
                vec![
                    Reflect { wo },
                    Mirror {
                        reflectance: TINT,
                        wo,
                    },
                ]
            }),
        ),
        case(
            "edge_on",
            "wo in the plane of the surface is on neither side: no sample, no direction, and no \
             division by 0.",
            edge_on(),
        )
        .only(&[SampleOrNone]),
        case(
            "snells_law",
            "sin θi = η · sin θo on the other side of the normal and of the surface: η is 1 / ior \
             where wo is outside, ior where it is inside.",
            calls("snells_law", 0, 100, |rng| {
                let ior = rng.one_of(&INDICES);
                let wo = away_from_critical(rng, ior);
                vec![Refract { wo, ior }]
            }),
        ),
        case(
            "total_internal_reflection",
            "From inside, beyond the critical angle, no light is transmitted: refract returns \
             None, and glass reflects all light for any choice.",
            calls("total_internal_reflection", 0, 60, |rng| {
                let ior = rng.one_of(&[1.33, 1.5, 2.4]);
                let sine = rng.range(1.02 / ior, 0.999);
                let turn = rng.range(0.0, 6.0);
                let height = (1.0 - sine * sine).sqrt();
                let wo = [sine * turn.cos(), sine * turn.sin(), -height];
                vec![
                    Refract { wo, ior },
                    Refraction {
                        transmittance: TINT,
                        ior,
                        wo,
                    },
                    glass(ior, wo, rng.range(0.0, 1.0)),
                ]
            }),
        ),
        case(
            "no_boundary",
            "An index of 1 is no boundary: light passes straight through and nothing is \
             reflected.",
            calls("no_boundary", 0, 60, |rng| {
                let (ior, wo) = (1.0, any_side(rng));
                let (cos_i, eta) = (wo[2].abs(), 1.0);
                vec![
                    Refract { wo, ior },
                    Share { cos_i, eta },
                    glass(ior, wo, rng.range(0.01, 1.0)),
                ]
            }),
        )
        .only(&[SampleOrNone, SampledDirection, Fresnel, Bsdf]),
        case(
            "fresnel",
            "The Fresnel reflectance from normal incidence (0.04 for glass) to grazing incidence \
             (1), into the denser material and out of it. Pitfall: Schlick's formula is only an \
             approximation.",
            shares(),
        ),
        case(
            "squeezed_light",
            "Radiance that enters a denser material is compressed into a narrower cone: \
             transmittance · η² arrives, where η is the index on the side of wo over the index on \
             the other side.",
            calls("squeezed_light", 0, 80, |rng| {
                let ior = rng.one_of(&INDICES);
                let wo = away_from_critical(rng, ior);
                vec![Refraction {
                    transmittance: TINT,
                    ior,
                    wo,
                }]
            }),
        )
        .only(&[Bsdf, Pdf, SampleOrNone]),
        case(
            "either_way",
            "Glass reflects if choice < F and refracts otherwise; the pdf is F or 1 - F, and f \
             contains it as a factor, so that the chosen direction has its full weight.",
            calls("either_way", 0, 80, |rng| {
                let ior = rng.one_of(&[1.33, 1.5, 2.4]);
                let wo = away_from_critical(rng, ior);
                [0.0, 0.003, 0.3, 0.999]
                    .map(|choice| glass(ior, wo, choice))
                    .to_vec()
            }),
        )
        .only(&[Bsdf, Pdf, SampledDirection]),
        case(
            "how_often",
            "Over many choices, the share of reflections is the Fresnel reflectance. A bias of 25 \
             % is always detected.",
            many_choices(),
        )
        .only(&[Mean]),
        case(
            "fresh_boundaries",
            "Random directions and indices that depend on the seed.",
            calls("fresh_boundaries", seed, 60, |rng| {
                let ior = rng.range(1.1, 2.5);
                let wo = away_from_critical(rng, ior);
                let (cos_i, eta) = (wo[2].abs(), if wo[2] > 0.0 { 1.0 / ior } else { ior });
                vec![
                    Reflect { wo },
                    Refract { wo, ior },
                    Share { cos_i, eta },
                    Refraction {
                        transmittance: OTHER_TINT,
                        ior,
                        wo,
                    },
                    glass(ior, wo, rng.range(0.0, 1.0)),
                ]
            }),
        ),
        case(
            "nearly_grazing",
            "Light at nearly grazing incidence. Pitfall: 1 - cos² rounds to 1, and the digits of \
             the cosine are lost; η² cos² + (1 - η)(1 + η) keeps them.",
            grazing(),
        )
        .only(&[SampleOrNone, SampledDirection, Fresnel]),
    ]
}

fn case(name: &'static str, about: &'static str, calls: Vec<SpecularCall>) -> Spec {
    Spec::new::<kind::Specular>("part4.task1", name, about, calls)
}

fn calls(
    name: &str,
    seed: u64,
    rounds: usize,
    mut round: impl FnMut(&mut ProbeRng) -> Vec<SpecularCall>,
) -> Vec<SpecularCall> {
    let mut rng = ProbeRng::new(name, seed);
    (0..rounds).flat_map(|_| round(&mut rng)).collect()
}

fn glass(ior: f64, wo: Xyz, choice: f64) -> SpecularCall {
    Glass {
        reflectance: TINT,
        transmittance: OTHER_TINT,
        ior,
        wo,
        choice,
    }
}

/// A direction on either side of the surface, not near its plane.
fn any_side(rng: &mut ProbeRng) -> Xyz {
    loop {
        let wo = rng.direction();
        if wo.z.abs() > 0.05 {
            return wo.into();
        }
    }
}

/// A direction on either side that is transmitted, away from the critical angle.
fn away_from_critical(rng: &mut ProbeRng, ior: f64) -> Xyz {
    loop {
        let wo = any_side(rng);
        let n = if wo[2] > 0.0 { ior } else { 1.0 / ior };
        let sine = Vec3::new(wo[0], wo[1], 0.0).length();
        if sine < 0.98 * n {
            return wo;
        }
    }
}

fn edge_on() -> Vec<SpecularCall> {
    let flat = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.8, 0.0]];
    let each = flat.into_iter().flat_map(|wo| {
        [1.5, 0.75].into_iter().flat_map(move |ior| {
            [
                Refract { wo, ior },
                Mirror {
                    reflectance: TINT,
                    wo,
                },
                Refraction {
                    transmittance: TINT,
                    ior,
                    wo,
                },
                glass(ior, wo, 0.5),
            ]
        })
    });
    // A direction that is transmitted, so that a function which always returns None does not pass.
    let passes = Refract {
        wo: [0.0, 0.6, 0.8],
        ior: 1.5,
    };
    each.chain([passes]).collect()
}

fn shares() -> Vec<SpecularCall> {
    let etas = [1.0 / 1.33, 1.0 / 1.5, 1.0 / 2.4, 1.33, 1.5, 2.4];
    let cosines = (0..=40).map(|i| f64::from(i) / 40.0);
    cosines
        .flat_map(|cos_i| etas.map(|eta| Share { cos_i, eta }))
        .collect()
}

fn many_choices() -> Vec<SpecularCall> {
    let wo = Vec3::new(0.9, 0.1, 0.25).normalize().into();
    calls("how_often", 0, 8000, |rng| {
        vec![glass(1.5, wo, rng.range(0.0, 1.0))]
    })
}

fn grazing() -> Vec<SpecularCall> {
    let cosines = [1e-3, 1e-5, 1e-7, 1e-9];
    let each = cosines.into_iter().flat_map(|cos_i: f64| {
        [1.33, 1.5, 2.4].into_iter().flat_map(move |ior| {
            let wo = [(1.0 - cos_i * cos_i).sqrt(), 0.0, cos_i];
            [
                Share {
                    cos_i,
                    eta: 1.0 / ior,
                },
                Refract { wo, ior },
                Refract { wo, ior: 1.0 },
                Share { cos_i, eta: 1.0 },
            ]
        })
    });
    each.collect()
}
