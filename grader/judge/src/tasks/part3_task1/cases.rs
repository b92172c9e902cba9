//! Cases of diffuse surfaces: value, density and samples of the BSDF.

use super::turns;
use crate::tools::findings::Aspect::{
    Bsdf, Pdf, SampleOrNone, SampleRecord, SampledDirection, Spread,
};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use kit::Vec3;
use wire::direct::LambertProbe;
use wire::kind;

/// The cases of `part3.task1`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "value",
            "For two directions above the surface, f is reflectance / π, whatever the directions \
             are. Pitfall: without the division by π a white wall reflects three times the light \
             that it receives.",
            probes("value", 0, 200, |rng| (above(rng), above(rng))),
        )
        .only(&[Bsdf]),
        case(
            "both_sides",
            "Two directions below the surface are on the same side, too. With one above and one \
             below, f is black and the density 0: no light passes through.",
            probes("both_sides", 0, 200, |rng| {
                let (wo, wi) = (above(rng), above(rng));
                (rng.one_of(&[-wo, wo]), rng.one_of(&[-wi, wi]))
            }),
        )
        .only(&[Bsdf, Pdf]),
        case(
            "density",
            "The density is |cos θ| / π of wi. Pitfall: the density of wo is a different one, and \
             so is 1 / 2π.",
            probes("density", 0, 200, |rng| (above(rng), above(rng))),
        )
        .only(&[Pdf]),
        case(
            "in_the_plane",
            "A direction in the plane of the surface, z = 0, is on neither side: f is black, the \
             density is 0, and no direction is sampled. A direction just above the plane, z = \
             0.000001, is above the surface like any other. Pitfall: a threshold instead of 0.",
            probes("in_the_plane", 0, 80, |rng| {
                let flat = rng.one_of(&[Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, -0.8, 0.0)]);
                let just_above = (flat + 1e-6 * Vec3::Z).normalize();
                let near_the_plane = rng.one_of(&[flat, just_above]);
                let other = above(rng);
                rng.one_of(&[(near_the_plane, other), (other, near_the_plane)])
            }),
        )
        .only(&[Bsdf, Pdf, SampleOrNone]),
        case(
            "sampled_directions",
            "Many samples: unit vectors on the side of wo, with a density proportional to the \
             cosine to the normal (a χ² test over 512 cells). A deviation of 24 % is always \
             detected. Pitfall: a radius of u instead of its square root concentrates them around \
             the normal. Regular numbers after the random ones count how often the directions go \
             round the normal while one number goes from 0 to 1. Pitfall: an azimuth in degrees.",
            sampled_directions(),
        )
        .only(&[SampledDirection, Spread]),
        case(
            "seen_from_below",
            "wo is below the surface, and so is the sampled direction.",
            probes("seen_from_below", 0, 100, |rng| (-above(rng), -above(rng))),
        )
        .only(&[SampledDirection, SampleRecord]),
        case(
            "record_of_the_sample",
            "A sample has the f and the density of its own direction, and delta is false: f · cos \
             θ / pdf is the reflectance for every sample.",
            probes("record_of_the_sample", 0, 200, |rng| {
                (above(rng), above(rng))
            }),
        )
        .only(&[SampleRecord]),
        case(
            "fresh_directions",
            "Random directions and numbers that depend on the seed. A deviation of 40 % is always \
             detected.",
            probes("fresh_directions", seed, 4000, |rng| {
                let (wo, wi) = (above(rng), above(rng));
                (rng.one_of(&[wo, -wo]), rng.one_of(&[wi, -wi]))
            }),
        ),
        case(
            "corners_of_the_square",
            "u at the corners of the unit square: the direction and f / pdf are finite, and the \
             lowest directions are near the plane of the surface. Pitfall: \
             1 - x² - y² rounds to 0 or below at the rim, so that the density is 0 and f / pdf \
             infinite; the height is the square root of 1 - u, which is exact.",
            corners(),
        )
        .only(&[SampledDirection, SampleRecord]),
    ]
}

fn case(name: &'static str, about: &'static str, probes: Vec<LambertProbe>) -> Spec {
    Spec::new::<kind::Lambert>("part3.task1", name, about, probes)
}

/// Random directions on both sides, then the lines along which turns are counted.
fn sampled_directions() -> Vec<LambertProbe> {
    let mut all = probes("sampled_directions", 0, 16_000, |rng| {
        let wo = above(rng);
        (rng.one_of(&[wo, -wo]), wo)
    });
    all.extend(turns::lines());
    all
}

/// A unit direction above the surface, not near its plane.
fn above(rng: &mut ProbeRng) -> Vec3 {
    loop {
        let d = rng.direction();
        if d.z > 0.05 {
            return d;
        }
    }
}

fn probes(
    name: &str,
    seed: u64,
    count: usize,
    mut directions: impl FnMut(&mut ProbeRng) -> (Vec3, Vec3),
) -> Vec<LambertProbe> {
    let mut rng = ProbeRng::new(name, seed);
    let probe = |_| {
        let (wo, wi) = directions(&mut rng);
        LambertProbe {
            reflectance: [rng.range(0.1, 1.0), rng.range(0.1, 1.0), 0.0],
            wo: wo.into(),
            wi: wi.into(),
            u: [rng.range(0.0, 1.0), rng.range(0.0, 1.0)],
        }
    };
    (0..count).map(probe).collect()
}

/// The largest number below 1.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// The corners of the unit square.
pub(super) const CORNERS: [[f64; 2]; 4] = [
    [0.0, 0.0],
    [0.0, BELOW_ONE],
    [BELOW_ONE, 0.0],
    [BELOW_ONE, BELOW_ONE],
];

fn corners() -> Vec<LambertProbe> {
    let numbers = [0.0, 1e-300, 0.5, 1.0 - 1e-12, 1.0 - 1e-14, BELOW_ONE];
    let squares = numbers
        .iter()
        .flat_map(|&x| numbers.iter().map(move |&y| [x, y]));
    squares
        .map(|u| LambertProbe {
            reflectance: [0.5; 3],
            wo: [0.6, 0.0, 0.8],
            wi: [0.0, 0.0, 1.0],
            u,
        })
        .collect()
}
