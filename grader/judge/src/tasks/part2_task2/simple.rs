//! Simple boxes and rays.

use crate::tools::convert;
use crate::tools::simple::rays::{self, permuted};
use crate::tools::simple::{complexity, sorted};
use kit::{Aabb, Vec3};
use wire::work::{BoxWork, Probe, Ray, Xyz};

/// Corners of the boxes.
const BOXES: [[Xyz; 2]; 6] = [
    [[0.0; 3], [2.0; 3]],
    [[-1.0; 3], [1.0; 3]],
    [[1.0; 3], [2.0; 3]],
    [[0.0; 3], [1.0, 2.0, 4.0]],
    // What is compared across axes is wrong here.
    [[0.0, 2.0, 4.0], [1.0, 3.0, 5.0]],
    [[4.0, 2.0, 0.0], [5.0, 3.0, 1.0]],
];

/// A box without extent along z, which rays hit or miss by a margin.
const FLAT: [Xyz; 2] = [[0.0; 3], [2.0, 2.0, 0.0]];

/// Directions of rays, turned to all axes.
const DIRECTIONS: [Xyz; 10] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [-2.0, 0.0, 0.0],
    [0.5, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 1.0, 1.0],
    [1.0, 2.0, -1.0],
];

const RANGES: [[f64; 2]; 5] = [
    [0.0, f64::INFINITY],
    [0.0, 1.0],
    [4.0, f64::INFINITY],
    [0.0, 9.0],
    [-9.0, 9.0],
];

/// How much larger or smaller a box may be without a change of the answer.
const MARGIN: f64 = 0.125;

/// The simple questions about boxes: the simplest of each direction and range, then those in which
/// a convention decides.
pub(crate) fn questions() -> Vec<BoxWork> {
    let mut decided = Vec::new();
    for d in DIRECTIONS {
        for [min_t, max_t] in RANGES {
            let mut of_kind = Vec::new();
            for turn in 0..3 {
                let d = permuted(d, turn);
                for (shape, corners) in (0..).zip(&BOXES) {
                    let rays = origins(corners, d).map(|o| Ray { o, d, min_t, max_t });
                    of_kind.extend(rays.map(|ray| Probe { shape, ray }));
                }
            }
            let corners = |probe: &Probe| BOXES[probe.shape as usize];
            let simplest = sorted(of_kind, complexity_of)
                .into_iter()
                .filter(|probe| is_decided(&corners(probe), &probe.ray));
            decided.extend(simplest.take(MOST_OF_A_KIND));
        }
    }
    let mut probes = sorted(decided, complexity_of);
    probes.extend(conventions());
    vec![BoxWork {
        boxes: BOXES.into_iter().chain([FLAT]).collect(),
        probes,
    }]
}

/// The most questions with the same direction, but for the order of axes, and the same range.
const MOST_OF_A_KIND: usize = 16;

fn complexity_of(probe: &Probe) -> u32 {
    let corners = BOXES[probe.shape as usize];
    rays::complexity_of(&probe.ray) + complexity(corners.into_iter().flatten())
}

/// Rays along z that start at, pass through or end at a face, and rays at a flat box: nothing
/// rounds.
fn conventions() -> Vec<Probe> {
    let ray = |shape: usize, o: Xyz, d: Xyz, [min_t, max_t]: [f64; 2]| Probe {
        shape: shape as u32,
        ray: Ray { o, d, min_t, max_t },
    };
    let (up, slanted) = ([0.0, 0.0, 1.0], [0.5, 0.25, 1.0]);
    let below = [1.0, 1.0, -2.0];
    let open = [0.0, f64::INFINITY];
    let flat = BOXES.len();
    let ends = [[0.0, 2.0], [4.0, 9.0]];
    let touching = ends
        .into_iter()
        .flat_map(|range| [up, slanted].map(|d| ray(0, [0.5, 0.5, -2.0], d, range)));
    let flat = [
        ray(flat, below, up, open),
        ray(flat, [0.0, 0.5, -2.0], slanted, open),
        ray(flat, [1.0, 1.0, 2.0], [0.0, 0.0, -1.0], open),
        ray(flat, [3.0, 1.0, -2.0], up, open),
    ];
    touching.chain(flat).collect()
}

/// Origins of rays along `d`: before the box, inside and behind it, on lines through its middle and
/// beside it; on none of its planes.
fn origins([min, max]: &[Xyz; 2], d: Xyz) -> impl Iterator<Item = Xyz> {
    let middle = [0, 1, 2].map(|i| 0.5 * (min[i] + max[i]));
    let asides = (0..3).flat_map(|axis| {
        [0.0, 2.0, -2.0].map(|aside| {
            let mut offset = [0.0; 3];
            offset[axis] = aside;
            offset
        })
    });
    asides.flat_map(move |aside| {
        STARTS.map(|t| [0, 1, 2].map(|i| middle[i] + aside[i] + t * d[i] + 0.0))
    })
}

/// Where a ray starts, in multiples of its direction from the middle of the box.
const STARTS: [f64; 5] = [-3.0, 0.0, 3.0, -4.0, 4.0];

/// Whether the ray hits a box that is a little smaller and one that is a little larger, or misses
/// both.
fn is_decided([min, max]: &[Xyz; 2], ray: &Ray) -> bool {
    let hits = |margin: f64| {
        let bounds = Aabb {
            min: Vec3::from(*min) - margin,
            max: Vec3::from(*max) + margin,
        };
        oracle::bbox(&bounds, &convert::ray(ray)).hits()
    };
    hits(MARGIN) == hits(-MARGIN)
}
