//! Simple paths: straight down to a floor, with a factor of a half at each surface.

use wire::global::{ScriptedPath, Step};
use wire::light::{BsdfSample, Material};
use wire::work::{Ray, Xyz};

const UP: Xyz = [0.0, 1.0, 0.0];
const COLOUR: Xyz = [2.0, 1.0, 0.0];
const GREY: Material = Material::Diffuse([0.5; 3]);

/// Kinds of paths: D for diffuse, M for a mirror, L for a lamp, B for the back of one.
const KINDS: [&str; 12] = [
    "", "L", "D", "M", "B", "D D", "M L", "M D", "D L", "D M", "D D D", "M M L",
];

/// Kinds of paths with one thing more: P for a pdf that is not 1, S for a slanted sample, C for a
/// coloured surface, K for a coloured lamp.
const SPECIAL: [&str; 8] = ["P", "S", "C", "K", "P D", "S D", "C D", "M K"];

/// The simple questions about paths: short ones first, each with a few depths.
pub(crate) fn questions() -> Vec<Vec<ScriptedPath>> {
    let paths = KINDS
        .iter()
        .flat_map(|kind| [0, 1, 2, 3, 5].map(|depth| path(kind, depth, 1.0)));
    let special = SPECIAL
        .iter()
        .flat_map(|kind| [2, 3].map(|depth| path(kind, depth, 1.0)));
    let survivors = ["D D", "M D", "D D D"].map(|kind| path(kind, 5, 2.0));
    let ended = ["D D", "M D"].into_iter().flat_map(|kind| {
        let without = |end: fn(&mut Step)| {
            let mut path = path(kind, 5, 1.0);
            end(&mut path.steps[0]);
            path
        };
        [
            without(|step| step.sample = None),
            without(|step| step.roulette = None),
        ]
    });
    vec![paths.chain(special).chain(survivors).chain(ended).collect()]
}

/// The path over the surfaces of `kind`; `factor` is what roulette multiplies by.
fn path(kind: &str, max_depth: u32, factor: f64) -> ScriptedPath {
    let surfaces = kind.split_whitespace().enumerate();
    ScriptedPath {
        ray: Ray {
            o: [0.0, 2.0, 0.0],
            d: [0.0, -1.0, 0.0],
            min_t: 0.0,
            max_t: f64::INFINITY,
        },
        max_depth,
        steps: surfaces
            .map(|(i, letter)| step(letter, i, factor))
            .collect(),
        background: [4.0; 3],
        below: [1.0; 3],
        seed: 0,
    }
}

/// The surface number `i` of a path. The path goes straight up and down: every other surface is a
/// ceiling.
fn step(letter: &str, i: usize, factor: f64) -> Step {
    let side = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    let front = if letter == "B" { -side } else { side };
    let up = |delta: bool| BsdfSample {
        wi: [0.0, 0.0, 1.0],
        f: [0.5; 3],
        pdf: 1.0,
        delta,
    };
    let (material, direct, sample) = match letter {
        "M" => (Material::Mirror([0.5; 3]), [0.0; 3], Some(up(true))),
        "L" | "B" => (Material::Emission([2.0; 3]), [0.0; 3], None),
        "K" => (Material::Emission(COLOUR), [0.0; 3], None),
        "P" => (
            GREY,
            [1.0; 3],
            Some(BsdfSample {
                pdf: 2.0,
                ..up(false)
            }),
        ),
        "S" => {
            let wi = [0.6, 0.0, 0.8];
            (GREY, [1.0; 3], Some(BsdfSample { wi, ..up(false) }))
        }
        "C" => {
            let f = [0.5, 1.0, 0.0];
            (
                Material::Diffuse(f),
                COLOUR,
                Some(BsdfSample { f, ..up(false) }),
            )
        }
        _ => (GREY, [1.0; 3], Some(up(false))),
    };
    Step {
        p: [0.0, 1.0 + (i % 2) as f64, 0.0],
        n: UP.map(|up| up * front),
        material,
        direct,
        sample,
        roulette: Some(factor),
    }
}
