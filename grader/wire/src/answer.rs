//! Records: what the student's code answered.

use crate::kinds::Answer;
use crate::work::{Ray, Tree, Xyz};
use serde::{Deserialize, Serialize};

/// What the worker writes, in this order: a start for each case, then its record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RecordFrame {
    /// Work on the case with this index begins. If nothing follows, this case ended the worker.
    Started {
        /// Index in the list of cases.
        case: u32,
    },
    /// The student's code ran longer than the case allows; the worker ends.
    TimedOut {
        /// Index in the list of cases.
        case: u32,
        /// Which of its calls was running, counted from 0.
        call: u32,
    },
    /// The case has run.
    Done(Record),
}

/// What became of one case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Index in the list of cases.
    pub case: u32,
    /// Tasks whose given start was still in place.
    pub untouched: Vec<String>,
    /// How it ended.
    pub outcome: Outcome,
}

/// How a case ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// The student's code answered.
    Answered(Answer),
    /// It came to a hole.
    NotAttempted {
        /// Key of the task that is not written yet.
        task: String,
    },
    /// It panicked.
    Panicked {
        /// The panic's message.
        message: String,
        /// File and line, if known.
        location: String,
        /// Which of the case's calls was running, counted from 0.
        call: u32,
    },
    /// The worker cannot do this work: a stage is not linked or a file is missing.
    Unable {
        /// Why.
        reason: String,
    },
}

/// What `raytrace_pixel` did with one pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PixelAnswer {
    /// Points that the camera was asked for.
    pub points: Vec<[f64; 2]>,
    /// For each traced ray the index of the point it came from; `None` if no camera ray had its
    /// origin and direction.
    pub traced: Vec<Option<u32>>,
    /// What `trace_ray` answered, call after call.
    pub traced_radiance: Vec<Xyz>,
    /// The pixel's radiance.
    pub radiance: Xyz,
    /// The pixel's count of samples.
    pub samples: u32,
}

/// A `Hit`.
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

/// What the two triangle functions answered to one probe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TriangleAnswer {
    /// `test_triangle`: `t`, `b1`, `b2`.
    pub test: Option<[f64; 3]>,
    /// `intersect_triangle`.
    pub hit: Option<Hit>,
    /// The ray after `intersect_triangle`.
    pub ray_after: Ray,
}

/// What the two sphere functions answered to one probe.
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
    /// For each ray its hit. Of an any-hit query only whether there was one counts.
    pub hits: Vec<Option<Hit>>,
    /// For each ray its `max_t` afterwards.
    pub max_t: Vec<f64>,
    /// Box tests over all rays.
    pub box_tests: u64,
    /// Primitive tests over all rays.
    pub prim_tests: u64,
}

/// What `construct_bvh` built.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildAnswer {
    /// The tree.
    pub tree: Tree,
    /// Whether building it again gave the same tree.
    pub repeatable: bool,
}

/// What a traversal answered to one ray of a scripted world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraverseAnswer {
    /// The closest hit's `t` and primitive; of an any-hit query, whether there is one (`t` and
    /// primitive 0).
    pub hit: Option<(f64, u32)>,
    /// The ray afterwards.
    pub ray_after: Ray,
    /// How many boxes were asked for.
    pub box_tests: u32,
    /// How many primitives were asked for.
    pub prim_tests: u32,
    /// How many primitives were hit, in the range that the ray had when they were asked for.
    pub prim_hits: u32,
    /// How many primitives had been asked for before with the same ray.
    pub repeated_prims: u32,
    /// How many boxes were asked for that the tree does not have.
    pub unknown_boxes: u32,
}

/// Times and counts of one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimingAnswer {
    /// Primitives in the scene.
    pub primitives: u64,
    /// Seconds to build the tree, one entry a round.
    pub build_s: Vec<f64>,
    /// Seconds for all rays through the tree, one entry a round.
    pub tree_s: Vec<f64>,
    /// Rays through the tree, each round.
    pub tree_rays: u64,
    /// Seconds for the brute-force rays, one entry a round.
    pub brute_s: Vec<f64>,
    /// Rays through brute force, each round.
    pub brute_rays: u64,
    /// Box tests of the tree, one round.
    pub box_tests: u64,
    /// Primitive tests of the tree, one round.
    pub prim_tests: u64,
    /// Rays whose closest hit differs between tree and brute force.
    pub differing_hits: u64,
    /// Rays of the tree that hit something.
    pub tree_hits: u64,
}

/// For which boxes of a tree a traversal asks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VisitsAnswer {
    /// For each ray its visits in order. Boxes that the tree does not have are left out.
    pub rays: Vec<Vec<Visit>>,
}

/// A box that a traversal asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Visit {
    /// Index of the node.
    pub node: u32,
    /// Whether the ray meets its box.
    pub met: bool,
}
