//! Simple boxes and rays.

use crate::tools::convert;
use crate::tools::simple::rays::{self, permuted};
use crate::tools::simple::{complexity, sorted};
use kit::{Aabb, Vec3};
use wire::work::{BoxWork, Probe, Ray, Xyz};

/// Corners of the boxes.
const BOXES: [[Xyz; 2]; 4] = [
    [[0.0; 3], [2.0; 3]],
    [[-1.0; 3], [1.0; 3]],
    [[1.0; 3], [2.0; 3]],
    [[0.0; 3], [1.0, 2.0, 4.0]],
];

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

/// Coordinates of origins: inside and outside the boxes, on none of their planes.
const COORDINATES: [f64; 4] = [0.5, 3.0, -2.0, 1.5];

const RANGES: [[f64; 2]; 5] = [
    [0.0, f64::INFINITY],
    [0.0, 1.0],
    [4.0, f64::INFINITY],
    [0.0, 9.0],
    [-9.0, 9.0],
];

/// How much larger or smaller a box may be without a change of the answer.
const MARGIN: f64 = 0.125;

/// The simple questions about boxes.
pub(crate) fn questions() -> Vec<BoxWork> {
    let mut probes = Vec::new();
    for shape in 0..BOXES.len() {
        let directions = DIRECTIONS
            .iter()
            .flat_map(|d| (0..3).map(|turn| permuted(*d, turn)));
        for d in directions {
            for o in origins() {
                let rays = RANGES.map(|[min_t, max_t]| Ray { o, d, min_t, max_t });
                let shape = shape as u32;
                probes.extend(rays.map(|ray| Probe { shape, ray }));
            }
        }
    }
    let corners = |probe: &Probe| BOXES[probe.shape as usize];
    let probes = sorted(probes, |probe| {
        rays::complexity_of(&probe.ray) + complexity(corners(probe).into_iter().flatten())
    });
    let decided = probes.into_iter();
    let decided = decided.filter(|probe| is_decided(&corners(probe), &probe.ray));
    vec![BoxWork {
        boxes: BOXES.to_vec(),
        probes: decided.take(MOST).collect(),
    }]
}

/// The most questions.
const MOST: usize = 600;

fn origins() -> impl Iterator<Item = Xyz> {
    let [x, y, z] = [COORDINATES; 3];
    x.into_iter().flat_map(move |x| {
        y.into_iter()
            .flat_map(move |y| z.into_iter().map(move |z| [x, y, z]))
    })
}

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
