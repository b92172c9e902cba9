//! Cases and their questions: what the worker does with the student's code.

use crate::kinds::Work;
use serde::{Deserialize, Serialize};

/// Three coordinates, world space.
pub type Xyz = [f64; 3];

/// One isolated check of one task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// Key of the task, such as `part1.task3`.
    pub task: String,
    /// Name of the case, unique in its task.
    pub name: String,
    /// After this many milliseconds the case has failed.
    pub limit_ms: u64,
    /// What to do.
    pub work: Work,
}

/// Which rays against which triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TriangleWork {
    /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`.
    pub triangles: Vec<[Xyz; 6]>,
    /// One call of both functions each.
    pub probes: Vec<Probe>,
}

/// Which rays against which spheres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SphereWork {
    /// Centre and radius.
    pub spheres: Vec<(Xyz, f64)>,
    /// One call of both functions each.
    pub probes: Vec<Probe>,
}

/// Rays against a list of shapes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BruteForceWork {
    /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`. Numbered first.
    pub triangles: Vec<[Xyz; 6]>,
    /// Centre and radius. Numbered after the triangles.
    pub spheres: Vec<(Xyz, f64)>,
    /// The rays.
    pub rays: Vec<Ray>,
}

/// Which rays against which boxes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoxWork {
    /// Corners `min` and `max`.
    pub boxes: Vec<[Xyz; 2]>,
    /// One call each.
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

/// Rays through a scene.
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

/// Rays through a scene whose box tests are recorded.
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

/// One ray against one shape.
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
    /// Camera samples a pixel.
    pub ns_aa: u32,
    /// Seed of the pixel samplers.
    pub seed: u64,
    /// What `trace_ray` answers.
    pub world: PixelWorld,
}

/// What the stand-in for `trace_ray` answers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum PixelWorld {
    /// The same radiance everywhere.
    Constant(Xyz),
    /// The red channel is `u`, the green is `v`, the blue is `u * v`, of the point the camera was
    /// asked for.
    Ramp,
    /// By turns this radiance and black, call after call.
    Flicker(Xyz),
    /// Coloured rings around the centre of the film, ever narrower (a Fresnel zone plate): what is
    /// too narrow for the pixels shows as rings in other places.
    Rings,
}

/// A world whose every answer is written down: no intersection code runs.
///
/// Boxes are known by their corners, so that a traversal may ask in any order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScriptedWorld {
    /// The tree to walk.
    pub tree: Tree,
    /// Ask for any hit instead of the closest.
    pub any_hit: bool,
    /// The rays and what they meet.
    pub rays: Vec<ScriptedRay>,
}

/// A ray and what it meets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScriptedRay {
    /// The ray.
    pub ray: Ray,
    /// For each node of the tree, where the infinite line of the ray is inside its box.
    pub spans: Vec<Option<[f64; 2]>>,
    /// For each primitive, the `t` at which the line meets it.
    pub prims: Vec<Option<f64>>,
}

/// A tree, as the student's crate is given it or as it built it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// Nodes, the root first.
    pub nodes: Vec<Node>,
    /// Every primitive once.
    pub order: Vec<u32>,
}

/// A node of a [`Tree`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// Corners `min` and `max`.
    pub bounds: [Xyz; 2],
    /// What lies below.
    pub kind: NodeKind,
}

/// What lies below a [`Node`].
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
    /// A generated mesh: the generator's name and the number of triangles asked for.
    Generated(String, u32),
    /// The same in a Cornell box.
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
    /// How many of them, evenly spread, brute force traces too.
    pub brute_force_rays: u32,
    /// How often brute force and tree take turns.
    pub rounds: u32,
}

/// One test to time, over and over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TestTiming {
    /// What rays are tested against.
    pub shapes: Shapes,
    /// Each is tested against the next `per_ray` of the shapes.
    pub rays: Vec<Ray>,
    /// How many shapes belong to a ray.
    pub per_ray: u32,
    /// How often all rays are gone through between two looks at the clock.
    pub passes: u32,
    /// How often the clock is looked at.
    pub rounds: u32,
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
