//! The questions of Parts 1 and 2.

use serde::{Deserialize, Serialize};

/// Three coordinates, world space.
pub type Xyz = [f64; 3];

/// Rays to test against single triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TriangleWork {
    /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`.
    pub triangles: Vec<[Xyz; 6]>,
    /// One call of both functions for each probe.
    pub probes: Vec<Probe>,
    /// Whether `record_triangle`, with the hits of `test_triangle`, is called in place of
    /// `intersect_triangle`.
    pub by_record: bool,
}

impl TriangleWork {
    /// The function that is called beside `test_triangle`.
    pub fn function(&self) -> &'static str {
        match self.by_record {
            true => "record_triangle",
            false => "intersect_triangle",
        }
    }
}

/// Rays to test against single spheres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SphereWork {
    /// Centre and radius.
    pub spheres: Vec<(Xyz, f64)>,
    /// One call of both functions for each probe.
    pub probes: Vec<Probe>,
}

/// Rays to trace through a list of shapes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BruteForceWork {
    /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`. Numbered first.
    pub triangles: Vec<[Xyz; 6]>,
    /// Centre and radius. Numbered after the triangles.
    pub spheres: Vec<(Xyz, f64)>,
    /// The rays.
    pub rays: Vec<Ray>,
}

/// Rays to test against single boxes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoxWork {
    /// Corners `min` and `max`.
    pub boxes: Vec<[Xyz; 2]>,
    /// One call for each probe.
    pub probes: Vec<Probe>,
}

/// A tree to build.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildWork {
    /// Corners `min` and `max` of each primitive's box.
    pub bounds: Vec<[Xyz; 2]>,
    /// The largest number of primitives in a leaf.
    pub max_leaf_size: u32,
}

/// Trees to build over ever more primitives: random clouds of boxes of the same density.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BuildGrowthWork {
    /// The numbers of primitives, ascending, at least two.
    pub sizes: Vec<u32>,
    /// The largest number of primitives in a leaf.
    pub max_leaf_size: u32,
    /// How often all sizes are built, unless the largest tree is built fast.
    pub rounds: u32,
    /// A build that takes at most this many times as long as its control is fast.
    pub fast: f64,
    /// If a build takes more than this many times as long as its control, no larger tree is built.
    /// The second size is always built.
    pub enough: f64,
}

/// Rays to trace through a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneWork {
    /// The scene.
    pub scene: SceneSource,
    /// A tree over it.
    pub tree: Tree,
    /// The rays.
    pub rays: Vec<Ray>,
    /// Whether any hit is traced instead of the closest.
    pub any_hit: bool,
}

/// Rays to trace through a scene while its box tests are recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VisitsWork {
    /// The scene.
    pub scene: SceneSource,
    /// A tree over it.
    pub tree: Tree,
    /// The rays; their closest hits are traced.
    pub rays: Vec<Ray>,
}

/// A ray as its four fields.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// Origin.
    pub o: Xyz,
    /// Direction, any length.
    pub d: Xyz,
    /// Nearest `t` that counts.
    pub min_t: f64,
    /// Farthest `t` that counts.
    pub max_t: f64,
}

/// A ray and the shape to test it against.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    /// Index of the shape.
    pub shape: u32,
    /// The ray.
    pub ray: Ray,
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Position.
    pub pos: Xyz,
    /// Columns of the rotation from camera space to world space.
    pub c2w: [Xyz; 3],
    /// Degrees.
    pub h_fov: f64,
    /// Degrees.
    pub v_fov: f64,
    /// Nearest `t`.
    pub n_clip: f64,
    /// Farthest `t`.
    pub f_clip: f64,
}

/// Cameras and the points of their sensors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraWork {
    /// The cameras.
    pub cameras: Vec<Camera>,
    /// Points of the sensor, [0, 1]² from the bottom left. Each camera is called with all of them.
    pub sensor: Vec<[f64; 2]>,
}

/// Pixels to sample in a world of known radiance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PixelWork {
    /// Film width and height.
    pub film: [u32; 2],
    /// Column and row of each pixel.
    pub pixels: Vec<[u32; 2]>,
    /// Camera samples per pixel.
    pub ns_aa: u32,
    /// Seeds of the pixel samplers: each pixel is sampled once with each seed.
    pub seeds: Vec<u64>,
    /// The radiance that `trace_ray` returns.
    pub world: PixelWorld,
    /// A factor of this radiance.
    pub gain: Xyz,
}

impl PixelWork {
    /// The calls of `raytrace_pixel`, each with a pixel and a seed: all pixels with the first seed,
    /// then all with the next.
    pub fn calls(&self) -> impl Iterator<Item = ([u32; 2], u64)> + '_ {
        let seeds = self.seeds.iter();
        seeds.flat_map(|&seed| self.pixels.iter().map(move |&pixel| (pixel, seed)))
    }
}

/// The radiance that the scripted `trace_ray` returns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum PixelWorld {
    /// The same radiance everywhere.
    Constant(Xyz),
    /// The channels are `u`, `v` and `u * v` of the point with which the camera was called.
    Ramp,
    /// Alternates between this radiance and black from call to call.
    Flicker(Xyz),
    /// A number that `trace_ray` draws from the sampler it is given, in all channels.
    Numbers,
    /// Coloured rings around the centre of the film that get narrower outward (a Fresnel zone
    /// plate): where they are too narrow for the pixels, aliasing shows false rings.
    Rings,
}

/// A world whose box and primitive test results are given: no intersection code runs.
///
/// Boxes are identified by their corners, so that a traversal may test them in any order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScriptedWorld {
    /// The tree to traverse.
    pub tree: Tree,
    /// Whether to trace any hit instead of the closest.
    pub any_hit: bool,
    /// The rays and their test results.
    pub rays: Vec<ScriptedRay>,
}

/// A ray and its test results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScriptedRay {
    /// The ray.
    pub ray: Ray,
    /// For each node of the tree, the interval in which the infinite line of the ray is inside its
    /// box.
    pub spans: Vec<Option<[f64; 2]>>,
    /// For each primitive, the `t` at which the line hits it.
    pub prims: Vec<Option<f64>>,
    /// Whether the worker gets neither of both lists and asks for each result that it needs
    /// ([`crate::question`]). No case of the judge's is.
    pub is_hidden: bool,
}

/// A tree, given to the student's code or built by it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// Nodes, the root first.
    pub nodes: Vec<Node>,
    /// The index of every primitive, once.
    pub order: Vec<u32>,
}

/// A node of a [`Tree`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// Corners `min` and `max`.
    pub bounds: [Xyz; 2],
    /// The children or primitives.
    pub kind: NodeKind,
}

/// The children or primitives of a [`Node`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NodeKind {
    /// Two nodes.
    Interior {
        /// Index of a node.
        left: u32,
        /// Index of a node.
        right: u32,
    },
    /// A run of [`Tree::order`].
    Leaf {
        /// Where it starts.
        first: u32,
        /// How long it is.
        count: u32,
    },
}

/// Where the primitives of a scene come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum SceneSource {
    /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`.
    Triangles(Vec<[Xyz; 6]>),
    /// A generated mesh: the generator's name and the requested number of triangles.
    Generated(String, u32),
    /// A generated mesh in a Cornell box.
    InCornellBox(String, u32),
}

/// A scene to time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimingWork {
    /// The scene.
    pub scene: SceneSource,
    /// The largest number of primitives in a leaf.
    pub max_leaf_size: u32,
    /// Rays for the tree.
    pub rays: Vec<Ray>,
    /// How many of the rays, at regular intervals, are also traced by brute force.
    pub brute_force_rays: u32,
    /// The number of rounds. Each times construction, then the tree, then brute force; the two
    /// passes of rays are timed after an untimed one.
    pub rounds: u32,
}

/// A test to time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TestTiming {
    /// The shapes to test rays against.
    pub shapes: Shapes,
    /// Each is tested against the next `per_ray` of the shapes.
    pub rays: Vec<Ray>,
    /// The number of shapes that each ray is tested against.
    pub per_ray: u32,
    /// For each timed round, the indices of the rays in the order in which they are tested.
    pub orders: Vec<Vec<u32>>,
}

/// Shapes of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shapes {
    /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`. For `test_triangle`.
    Triangles(Vec<[Xyz; 6]>),
    /// Centre and radius. For `test_sphere`.
    Spheres(Vec<(Xyz, f64)>),
    /// Corners `min` and `max`. For `intersect_bbox`.
    Boxes(Vec<[Xyz; 2]>),
}
