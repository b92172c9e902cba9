//! Simple lists of shapes: nearest first and nearest last.

use crate::tools::simple::rays::through;
use wire::work::BruteForceWork;

/// The simple questions about several triangles on one ray: parallel ones, nearest first and
/// nearest last.
pub(crate) fn triangles() -> Vec<BruteForceWork> {
    let at = |z: f64| {
        let corners = [[0.0, 0.0, z], [4.0, 0.0, z], [0.0, 4.0, z]];
        let [a, b, c] = corners;
        [a, b, c, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    };
    let rays = |d: f64| {
        let places = [[1.0, 1.0], [2.0, 1.0], [-1.0, 1.0], [3.0, 3.0]];
        places.map(|[x, y]| through([x, y, 0.0], [0.0, 0.0, d], 0.0, [0.0, f64::INFINITY]))
    };
    let heights: [&[f64]; 6] = [
        &[1.0],
        &[1.0, 2.0],
        &[2.0, 1.0],
        &[2.0, 4.0, 1.0],
        &[-1.0, 1.0],
        &[1.0, -1.0],
    ];
    let question = |heights: &&[f64]| BruteForceWork {
        triangles: heights.iter().map(|&z| at(z)).collect(),
        spheres: Vec::new(),
        rays: [rays(1.0), rays(2.0)].concat(),
    };
    heights.iter().map(question).collect()
}

/// The simple questions about several spheres on one ray: nearest first and nearest last.
pub(crate) fn spheres() -> Vec<BruteForceWork> {
    let rays =
        [1.0, 2.0].map(|length| through([0.0; 3], [0.0, 0.0, length], 0.0, [0.0, f64::INFINITY]));
    let distances: [&[f64]; 5] = [
        &[3.0],
        &[3.0, 6.0],
        &[6.0, 3.0],
        &[-3.0, 3.0],
        &[6.0, 9.0, 3.0],
    ];
    let question = |distances: &&[f64]| BruteForceWork {
        triangles: Vec::new(),
        spheres: distances.iter().map(|&z| ([0.0, 0.0, z], 1.0)).collect(),
        rays: rays.to_vec(),
    };
    distances.iter().map(question).collect()
}
