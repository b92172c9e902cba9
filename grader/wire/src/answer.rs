//! The answers of Parts 1 and 2.

use crate::work::{Ray, Tree, Xyz};
use serde::{Deserialize, Serialize};

/// The calls and the result of `raytrace_pixel` for one pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PixelAnswer {
    /// The points with which `camera_ray` was called.
    pub points: Vec<[f64; 2]>,
    /// For each traced ray the index of the point it came from; `None` if no camera ray had its
    /// origin and direction.
    pub traced: Vec<Option<u32>>,
    /// The radiance that each call of `trace_ray` returned.
    pub traced_radiance: Vec<Xyz>,
    /// The pixel's radiance.
    pub radiance: Xyz,
    /// The pixel's count of samples.
    pub samples: u32,
}

/// A `kit::Hit`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hit {
    /// Distance along the ray.
    pub t: f64,
    /// Hit point.
    pub p: Xyz,
    /// Shading normal.
    pub n: Xyz,
    /// Geometric normal.
    pub ng: Xyz,
    /// Surface parameters.
    pub uv: [f64; 2],
    /// Number of the primitive.
    pub prim: u32,
}

/// The results of the two triangle functions for one probe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TriangleAnswer {
    /// `test_triangle`: `t`, `b1`, `b2`.
    pub test: Option<[f64; 3]>,
    /// `intersect_triangle`, or `record_triangle`.
    pub hit: Option<Hit>,
    /// The ray after that call.
    pub ray_after: Ray,
}

/// The results of the two sphere functions for one probe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SphereAnswer {
    /// `test_sphere`: `t`.
    pub test: Option<f64>,
    /// `intersect_sphere`.
    pub hit: Option<Hit>,
    /// The ray after `intersect_sphere`.
    pub ray_after: Ray,
}

/// Closest or any hits of many rays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HitsAnswer {
    /// The hit of each ray. For any-hit queries only whether there is one counts.
    pub hits: Vec<Option<Hit>>,
    /// The `max_t` of each ray after the call.
    pub max_t: Vec<f64>,
    /// Box tests over all rays.
    pub box_tests: u64,
    /// Primitive tests over all rays.
    pub prim_tests: u64,
}

/// The result of `construct_bvh`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildAnswer {
    /// The tree.
    pub tree: Tree,
    /// Whether a second build gave the same tree.
    pub repeatable: bool,
}

/// The processor time of `construct_bvh`, beside that of a control.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildGrowthAnswer {
    /// For each size that was built: the number of nodes of the tree.
    pub nodes: Vec<u32>,
    /// The rounds, of which each built these sizes.
    pub rounds: Vec<Vec<BuildTime>>,
}

/// The processor time of a build, and that of the control directly before and after it. The control
/// sorts as many boxes at each level of a tree, so it reads and writes as much memory.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildTime {
    /// Seconds of the build.
    pub seconds: f64,
    /// Seconds of the control before and after.
    pub control: [f64; 2],
}

impl BuildTime {
    /// Whether the build took at most `times` as long as the slower control.
    pub fn is_within(&self, times: f64) -> bool {
        let [before, after] = self.control;
        self.seconds <= times * before.max(after)
    }
}

/// The result of a traversal for one ray of a scripted world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraverseAnswer {
    /// The `t` and primitive of the closest hit; for an any-hit query, `(0.0, 0)` if there is a
    /// hit.
    pub hit: Option<(f64, u32)>,
    /// The ray after the call.
    pub ray_after: Ray,
    /// The number of box tests.
    pub box_tests: u32,
    /// The number of primitive tests.
    pub prim_tests: u32,
    /// The number of primitive tests that were hits.
    pub prim_hits: u32,
    /// The number of primitive tests that repeat one with the same ray.
    pub repeated_prims: u32,
    /// The number of tests of boxes that are not in the tree.
    pub unknown_boxes: u32,
}

/// Times and counts of one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimingAnswer {
    /// Primitives in the scene.
    pub primitives: u64,
    /// Seconds to build the tree, in each round.
    pub build_s: Vec<f64>,
    /// Seconds to trace all rays through the tree, in each round.
    pub tree_s: Vec<f64>,
    /// Rays traced through the tree in each round.
    pub tree_rays: u64,
    /// Seconds to trace the brute-force rays, in each round.
    pub brute_s: Vec<f64>,
    /// Rays traced by brute force in each round.
    pub brute_rays: u64,
    /// Box tests of the tree in one round.
    pub box_tests: u64,
    /// Primitive tests of the tree in one round.
    pub prim_tests: u64,
    /// Rays whose closest hit differs between tree and brute force.
    pub differing_hits: u64,
    /// Rays through the tree that hit a primitive.
    pub tree_hits: u64,
}

/// The boxes of a tree that a traversal tests.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VisitsAnswer {
    /// The box tests of each ray, in order, without boxes that are not in the tree.
    pub rays: Vec<Vec<Visit>>,
}

/// A box test of a traversal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Visit {
    /// Index of the node.
    pub node: u32,
    /// Whether the ray hits its box.
    pub met: bool,
}
