//! Recorded work of the reference solutions, with which other solutions are compared.
//!
//! The numbers are printed by `cargo grader part2` for the reference; they are the same on every
//! machine.

use serde::Serialize;

/// The work that a tree over the boxes of a case needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeWork {
    /// Expected number of box and primitive tests of a random line through the scene, by the
    /// surface area heuristic.
    pub cost: f64,
    /// Levels below the root.
    pub depth: u32,
}

/// The recorded work of a case of `part2.task1`; `None` where work is not judged.
pub fn tree(case: &str) -> Option<TreeWork> {
    let (cost, depth) = match case {
        "centroids_on_the_split" => (61.76, 10),
        "long_boxes" => (93.38, 8),
        "far_from_the_origin" => (35.90, 9),
        "strip_along_x" => (10.49, 6),
        "strip_along_y" => (10.41, 6),
        "strip_along_z" => (10.40, 6),
        "large_mesh" => (64.09, 18),
        "halving_distances" => (4.06, 74),
        _ => return None,
    };
    Some(TreeWork { cost, depth })
}

/// The work of a ray through a tree over a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RayWork {
    /// Box tests per ray.
    pub boxes: f64,
    /// Primitive tests per ray.
    pub prims: f64,
}

/// The recorded work of a ray through a mesh of `size` triangles in the table of speedups; NaN for
/// a mesh that is not in the table.
pub fn rays(mesh: &str, size: u32) -> RayWork {
    let (boxes, prims) = match (mesh, size) {
        ("smooth", 1_000) => (16.09, 3.62),
        ("smooth", 10_000) => (21.30, 3.17),
        ("smooth", 100_000) => (25.49, 2.95),
        ("smooth", 1_000_000) => (29.28, 2.86),
        ("terrain", 1_000) => (15.47, 3.37),
        ("terrain", 10_000) => (24.28, 3.64),
        ("terrain", 100_000) => (31.17, 3.55),
        ("terrain", 1_000_000) => (36.48, 3.37),
        _ => (f64::NAN, f64::NAN),
    };
    RayWork { boxes, prims }
}
