//! Simple spheres and rays.

use crate::tools::simple::rays::{self, permuted};
use crate::tools::simple::{complexity, sorted};
use wire::work::{Probe, Ray, SphereWork, Xyz};

/// Spheres: centre and radius.
const SPHERES: [(Xyz, f64); 5] = [
    ([0.0, 0.0, 0.0], 1.0),
    ([0.0, 0.0, 0.0], 2.0),
    ([0.0, 0.0, 0.0], 5.0),
    ([1.0, 0.0, 0.0], 1.0),
    ([1.0, 2.0, 3.0], 2.0),
];

/// Distances of a ray from the centre, in radii, and half the length of its chord, in radii: whole
/// numbers for a radius of 5. At 2 radii it misses.
const CHORDS: [(f64, f64); 4] = [(0.0, 1.0), (0.6, 0.8), (0.8, 0.6), (2.0, 0.0)];

/// Where a ray starts, along its direction from the point nearest to the centre, in whole lengths
/// beyond the chord's end: before the sphere, behind it.
const STARTS: [f64; 4] = [-1.0, -2.0, 1.0, 2.0];

/// The simple questions about single spheres.
pub(crate) fn questions() -> Vec<SphereWork> {
    let mut decided = Vec::new();
    let mut conventions = Vec::new();
    for (shape, &(center, radius)) in SPHERES.iter().enumerate() {
        let probe = |ray: Ray| Probe {
            shape: shape as u32,
            ray,
        };
        for turn in 0..3 {
            for length in [1.0, 2.0, -1.0, -2.0, 0.5] {
                for (aside, half) in CHORDS.map(|(aside, half)| (aside * radius, half * radius)) {
                    let inside = (half > 0.0).then_some(0.0);
                    let beyond = STARTS.map(|start| start + half * f64::signum(start));
                    for start in beyond.into_iter().chain(inside) {
                        let offset = [aside, 0.0, start * f64::signum(length)];
                        let ray = ray(center, offset, length, turn);
                        let ends = [-half - start, half - start].map(|end| end / length.abs());
                        decided.extend(ranges(ends).map(|[min_t, max_t]| {
                            probe(Ray {
                                min_t,
                                max_t,
                                ..ray
                            })
                        }));
                    }
                }
            }
            // Nothing may round, also in code that divides by the radius.
            if radius == 5.0 {
                continue;
            }
            let outside = ray(center, [0.0, 0.0, -radius - 1.0], 1.0, turn);
            let far = 1.0 + 2.0 * radius;
            for [min_t, max_t] in [[0.0, 1.0], [1.0, 2.0], [far, far + 1.0], [2.0, far]] {
                conventions.push(probe(Ray {
                    min_t,
                    max_t,
                    ..outside
                }));
            }
        }
    }
    let numbers = |probe: &Probe| {
        let (center, radius) = SPHERES[probe.shape as usize];
        rays::complexity_of(&probe.ray) + complexity(center) + complexity([radius])
    };
    let mut probes = sorted(decided, numbers);
    probes.truncate(MOST);
    probes.extend(sorted(conventions, numbers));
    vec![SphereWork {
        spheres: SPHERES.to_vec(),
        probes,
    }]
}

/// The most questions in which no convention decides.
const MOST: usize = 600;

/// The ray from `offset` beside `center` along the z axis, turned to another axis.
fn ray(center: Xyz, offset: Xyz, length: f64, turn: usize) -> Ray {
    let offset = permuted(offset, turn);
    Ray {
        o: [0, 1, 2].map(|i| center[i] + offset[i] + 0.0),
        d: permuted([0.0, 0.0, length], turn),
        min_t: 0.0,
        max_t: f64::INFINITY,
    }
}

/// Ranges whose ends are not near the ends of the chord, of small numbers.
fn ranges(chord: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let [near, far] = chord;
    let middle = 0.5 * (near + far);
    let ranges = [
        [0.0, f64::INFINITY],
        [0.0, 0.5 * near],
        [0.0, middle],
        [middle, f64::INFINITY],
        [0.0, far + 1.0],
        [far + 1.0, f64::INFINITY],
        [-9.0, 9.0],
    ];
    let is_apart = move |end: &f64| (end - near).abs() >= 0.25 && (end - far).abs() >= 0.25;
    ranges
        .into_iter()
        .filter(move |range| range.iter().all(is_apart) && range[0] <= range[1])
}
