//! Cases of scripted paths, whose surfaces and samples are given.

use crate::tools::findings::Aspect::{
    Direction, Origin, Questions, Radiance, Rays, SampledDirection, Spread, Throughput,
};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use kit::{Frame, Vec3};
use wire::global::{ScriptedPath, Step};
use wire::kind;
use wire::light::{BsdfSample, Material};
use wire::work::{Ray, Xyz};

/// The cases of `part4.task2`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "depth_0",
            "-m 0 shows emitted light only: direct light is not computed.",
            every(&["D", "L", "B", "M L", ""], &[0]),
        )
        .only(&[Radiance, Rays, Questions]),
        case(
            "depth_1",
            "-m 1 adds the direct light of the first surface; the path ends there.",
            every(&["D D", "L", "M L", "G D", ""], &[1]),
        )
        .only(&[Radiance, Rays, Questions]),
        case(
            "geometric_series",
            "Diffuse surfaces that each scatter half of the light and receive 1 as direct light: 1, \
             1.5, 1.75, ... as the depth grows.",
            series(),
        )
        .only(&[Radiance, Rays]),
        case(
            "depth",
            "A path has at most -m rays, including the first, however large -m is, and goes on \
             from surfaces in shadow. Pitfall: a limit of your own on the number of bounces.",
            [
                every(&["D D D D D D"], &[2, 3, 4, 5, 6, 9]),
                vec![long()],
                every(&["S D", "D S S D"], &[5]),
            ]
            .concat(),
        )
        .only(&[Radiance, Rays]),
        case(
            "lamp_met_by_chance",
            "A diffuse surface has received the lamp's light as direct light when a sampled ray \
             hits the lamp: the lamp counts once. Pitfall: adding the emitted light there counts \
             it twice.",
            every(&["D L", "D D L", "M D L"], &[2, 3, 5]),
        )
        .only(&[Radiance]),
        case(
            "lamp_in_a_mirror",
            "Mirrors and glass get no direct light: a lamp seen in them adds the light that it \
             emits, on its front and not on its back, however bright it is. Pitfall: clamping the \
             light of a path.",
            bright(every(
                &["M L", "G L", "M M L", "D M L", "G G L", "M B"],
                &[2, 3, 5],
            )),
        )
        .only(&[Radiance]),
        case(
            "sky_in_a_mirror",
            "The background counts where the eye sees it, directly or in a mirror, but not after \
             a diffuse surface. It differs above and below. Pitfall: looking it up \
             against the direction of the ray.",
            over_ground(every(
                &["", "M", "G G", "D", "D M", "M D"],
                &[0, 1, 2, 3, 5],
            )),
        )
        .only(&[Radiance, Rays]),
        case(
            "direct_light",
            "Direct light is computed once at each surface except mirrors and glass; wo is the \
             unit world direction back along the ray.",
            every(&["D M D D", "G G D", "M D L"], &[1, 2, 4, 7]),
        )
        .only(&[Questions]),
        case(
            "rays_leave_the_surface",
            "Each ray starts at the origin that Surface::leave returns, on the side to which it \
             goes, along the sample's direction in world space.",
            every(&["D G G D", "M M M", "G D"], &[5]),
        )
        .only(&[Origin, Direction]),
        case(
            "drawn_directions",
            "Scattering::sample gets wo in local space. Every random number comes from the sampler \
             and is used once.",
            every(&["D D D", "M G D D"], &[5]),
        )
        .only(&[SampledDirection, Spread]),
        case(
            "throughput",
            "Roulette gets the product of all f · |cos θ| / pdf, including that of the new \
             bounce, which may be above 1, and the number of bounces, 1, 2, ...; the throughput \
             that it returns is used from there on.",
            with_roulette(),
        )
        .only(&[Throughput, Radiance]),
        case(
            "roulette_ends_the_path",
            "Where roulette returns None, the path ends with the radiance it has so far.",
            ended(|step| step.roulette = None),
        )
        .only(&[Radiance, Rays]),
        case(
            "no_direction",
            "Where no direction can be sampled, the path ends with the radiance it has so far.",
            ended(|step| step.sample = None),
        )
        .only(&[Radiance, Rays]),
        case(
            "fresh_paths",
            "Random paths that depend on the seed.",
            fresh(seed),
        ),
    ]
}

fn case(name: &'static str, about: &'static str, paths: Vec<ScriptedPath>) -> Spec {
    Spec::new::<kind::Paths>("part4.task2", name, about, paths)
}

/// A path over the surfaces in `letters`: D for diffuse, S for diffuse in shadow, M for a mirror, G
/// for glass, L for a lamp, B for the back of one.
fn path(letters: &str, max_depth: u32, rng: &mut ProbeRng) -> ScriptedPath {
    let first = rng.direction();
    let mut d = first;
    let steps = letters.split_whitespace().map(|letter| {
        let step = step(letter, d, rng);
        if let Some(sample) = step.sample {
            d = Frame::around(step.n.into()).to_world(sample.wi.into());
        }
        step
    });
    ScriptedPath {
        steps: steps.collect(),
        ray: Ray {
            o: rng.in_cube().into(),
            d: first.into(),
            min_t: 0.5,
            max_t: 100.0,
        },
        max_depth,
        background: SKY,
        below: SKY,
        seed: 0,
    }
}

/// A surface that is hit along `d` on its front; glass on either side, "B" on its back.
fn step(letter: &str, d: Vec3, rng: &mut ProbeRng) -> Step {
    let mut n = rng.direction();
    while n.dot(d).abs() < 0.2 {
        n = rng.direction();
    }
    let from_behind = letter == "B" || letter == "G" && rng.below(2) == 0;
    if from_behind != (n.dot(d) > 0.0) {
        n = -n;
    }
    let wo = Frame::around(n).to_local(-d);
    let share = |rng: &mut ProbeRng| [0.9, 0.8, 0.7].map(|most| rng.range(0.3, most));
    let delta = |wi: Vec3, f: Xyz| BsdfSample {
        wi: wi.into(),
        f: f.map(|f| f / wi.z.abs()),
        pdf: 1.0,
        delta: true,
    };
    let (material, sample) = match letter {
        "M" => {
            let tint = share(rng);
            let wi = Vec3::new(-wo.x, -wo.y, wo.z);
            (Material::Mirror(tint), Some(delta(wi, tint)))
        }
        "G" => (Material::Glass(1.5), Some(delta(-wo, share(rng)))),
        "L" | "B" => {
            let radiance = [5.0, 4.0, 3.0].map(|most| rng.range(1.0, most));
            (Material::Emission(radiance), None)
        }
        _ => {
            let tint = share(rng);
            let wi = loop {
                let wi = rng.direction();
                if wi.z > 0.2 {
                    break wi;
                }
            };
            let sample = BsdfSample {
                wi: wi.into(),
                f: tint.map(|tint| 0.3 * tint),
                pdf: rng.range(0.2, 0.6),
                delta: false,
            };
            (Material::Diffuse(tint), Some(sample))
        }
    };
    let is_dark = letter == "S" || matches!(material, Material::Emission(_));
    Step {
        p: (3.0 * rng.in_cube()).into(),
        n: n.into(),
        material,
        direct: if is_dark {
            [0.0; 3]
        } else {
            [1.0, 2.0, 3.0].map(|most| rng.range(0.1, most))
        },
        sample,
        roulette: Some(1.0),
    }
}

/// Each kind of path with each depth, three times.
fn every(kinds: &[&str], depths: &[u32]) -> Vec<ScriptedPath> {
    let mut rng = ProbeRng::new(&kinds.join("/"), 0);
    let pairs = kinds
        .iter()
        .flat_map(|kind| depths.iter().map(move |depth| (kind, *depth)));
    pairs
        .flat_map(|pair| [pair; 3])
        .map(|(kind, depth)| path(kind, depth, &mut rng))
        .collect()
}

/// The background of all paths but those over [`over_ground`].
const SKY: Xyz = [0.3, 0.6, 1.2];

/// The paths with another background below than above.
fn over_ground(mut paths: Vec<ScriptedPath>) -> Vec<ScriptedPath> {
    for path in &mut paths {
        path.below = [0.4, 0.2, 0.1];
    }
    paths
}

/// The paths with lamps a million times as bright.
fn bright(mut paths: Vec<ScriptedPath>) -> Vec<ScriptedPath> {
    for step in paths.iter_mut().flat_map(|path| &mut path.steps) {
        if let Material::Emission(radiance) = &mut step.material {
            *radiance = radiance.map(|radiance| 1e6 * radiance);
        }
    }
    paths
}

/// A path over 150 surfaces that scatter nearly all light.
fn long() -> ScriptedPath {
    const SURFACES: u32 = 150;
    let mut rng = ProbeRng::new("long", 0);
    let mut path = path(&"D ".repeat(SURFACES as usize), SURFACES, &mut rng);
    for step in &mut path.steps {
        step.direct = [1.0; 3];
        if let Some(sample) = &mut step.sample {
            // f · |cos θ| / pdf = 63/64.
            sample.f = [63.0 / 64.0 * sample.pdf / sample.wi[2]; 3];
        }
    }
    path
}

fn series() -> Vec<ScriptedPath> {
    let mut rng = ProbeRng::new("geometric_series", 0);
    let half = |depth: u32| {
        let mut path = path("D D D D D D D D D D D D", depth, &mut rng);
        for step in &mut path.steps {
            step.direct = [1.0; 3];
            if let Some(sample) = &mut step.sample {
                // f · |cos θ| / pdf = 1/2.
                sample.f = [0.5 * sample.pdf / sample.wi[2]; 3];
            }
        }
        path
    };
    (1..=10).map(half).collect()
}

/// Paths whose throughput roulette increases, and diffuse bounces, too: they sample directions that
/// bring much light less often than in proportion.
fn with_roulette() -> Vec<ScriptedPath> {
    let mut rng = ProbeRng::new("lucky", 0);
    let mut with_roulette = |letters: &str| {
        let mut path = path(letters, 7, &mut rng);
        for step in &mut path.steps {
            step.roulette = Some(rng.range(1.0, 3.0));
            if let Some(sample) = &mut step.sample
                && !sample.delta
            {
                sample.f = sample.f.map(|f| 5.0 * f);
            }
        }
        path
    };
    ["D D D D", "M D G D D", "D M L", "G G D D D"]
        .iter()
        .flat_map(|letters| [with_roulette(letters), with_roulette(letters)])
        .collect()
}

/// Paths that `end` ends at one of their surfaces.
fn ended(end: impl Fn(&mut Step)) -> Vec<ScriptedPath> {
    let mut rng = ProbeRng::new("ended", 0);
    let ended = (0..12).map(|i| {
        let mut path = path("D M D G D", 7, &mut rng);
        end(&mut path.steps[i % 5]);
        path
    });
    ended.collect()
}

fn fresh(seed: u64) -> Vec<ScriptedPath> {
    let mut rng = ProbeRng::new("fresh_paths", seed);
    let fresh = (0..60).map(|_| {
        let letters: Vec<&str> = (0..rng.below(7))
            .map(|_| rng.one_of(&["D", "D", "M", "G", "L", "B"]))
            .collect();
        let depth = rng.below(8) as u32;
        ScriptedPath {
            seed,
            ..path(&letters.join(" "), depth, &mut rng)
        }
    });
    fresh.collect()
}
