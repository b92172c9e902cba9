//! One call, shown: what the function got, what is right, and what the code returned.
//!
//! The one model for whoever draws a call: the page of `grader look`, the text of `grader explain`. A
//! kind of work makes it in `Check::shown`.

use crate::tools::truth::expected::{Expected, HitOrMiss};
use kit::{Aabb, Camera, Ray, Scene, Vec2, Vec3};
use wire::answer::Hit;
use wire::direct::{LambertProbe, RecordedRay, ShadedPoint};
use wire::light::LitWorld;
use wire::work::{NodeKind, Tree, Xyz};

/// One call.
#[derive(Clone, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "there are as many as calls of one case, and most are rays"
)]
pub enum ShownCall {
    /// A ray, and what it is tested against or made from.
    Ray(ShownRay),
    /// A pixel that is sampled.
    Pixel(ShownPixel),
    /// Two directions in local space, in which the normal is +z.
    Directions(LambertProbe),
    /// A point of a surface among lights.
    LitPoint(ShownPoint),
    /// A direction that a mirror or glass sends on.
    Bounce(ShownBounce),
    /// A tree whose boxes are in a row: along an axis, or along a ray.
    Spans(ShownSpans),
    /// A path over given surfaces.
    Path(ShownPath),
}

/// A ray, the shapes that it is tested against, and where it meets them.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownRay {
    /// The triangles and spheres.
    pub scene: Scene,
    /// The boxes.
    pub boxes: Vec<Aabb>,
    /// The camera that makes the ray, and the point of its sensor.
    pub camera: Option<(Camera, Vec2)>,
    /// The ray; that of a camera is the one that the code returned.
    pub ray: Ray,
    /// The `t` of each point where the ray meets the shapes.
    pub expected: Vec<f64>,
    /// The same, as the code returned it.
    pub yours: Vec<f64>,
    /// The hit points, expected and yours, if both are known.
    pub points: Option<[Vec3; 2]>,
    /// Whether a hit, a miss or either is right.
    pub decision: HitOrMiss,
    /// The normals at the hit, expected and yours, if both are known.
    pub normals: Option<[Vec3; 2]>,
}

/// A pixel that is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownPixel {
    /// Width and height of the film.
    pub film: [u32; 2],
    /// Column and row.
    pub pixel: [u32; 2],
    /// The number of samples.
    pub samples: u32,
    /// The seed of the pixel's sampler.
    pub seed: u64,
    /// The points of the sensor that the code chose.
    pub yours: Vec<[f64; 2]>,
}

/// A direction to the viewer in local space, in which the normal is +z, and the directions that a
/// mirror or glass sends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownBounce {
    /// To the viewer.
    pub wo: Xyz,
    /// The right direction, if there is one.
    pub expected: Option<Xyz>,
    /// The code's, if it has one.
    pub yours: Option<Xyz>,
}

/// Intervals on a line: those of the boxes of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownSpans {
    /// What is measured along the line: "x" or "t".
    pub along: &'static str,
    /// What the rows are: "boxes, then your tree".
    pub about: &'static str,
    /// From top to bottom: the root's level, then those below it.
    pub rows: Vec<Vec<Span>>,
    /// The right result on the line, if there is one.
    pub expected: Option<f64>,
    /// The code's.
    pub yours: Option<f64>,
}

/// An interval on a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    /// Its ends.
    pub ends: [f64; 2],
    /// The numbers of the primitives in it, or empty.
    pub label: String,
}

/// A path over given surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownPath {
    /// The surfaces, in order: "diffuse", "mirror".
    pub surfaces: Vec<&'static str>,
    /// How many rays the code traced; `None` without an answer.
    pub yours: Option<usize>,
}

/// The most intervals that a drawing can show.
pub(crate) const MOST_SPANS: usize = 16;

/// The most levels of a tree that a drawing can show.
const MOST_LEVELS: usize = 6;

/// A point of a surface among lights, and the rays that the code traced.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownPoint {
    /// The lights and other surfaces.
    pub world: LitWorld,
    /// The point.
    pub point: ShadedPoint,
    /// The rays.
    pub rays: Vec<RecordedRay>,
}

/// The nodes of a tree, level by level, each with its interval `span`; a leaf is labelled by its
/// primitives. `None` for a tree that is too large to draw. The tree may be wrong in any way.
pub(crate) fn tree_rows(
    tree: &Tree,
    span: impl Fn(usize) -> Option<[f64; 2]>,
) -> Option<Vec<Vec<Span>>> {
    let mut rows = Vec::new();
    let mut level = Vec::from_iter((!tree.nodes.is_empty()).then_some(0_usize));
    let mut count = 0;
    while !level.is_empty() {
        count += level.len();
        if count > MOST_SPANS || rows.len() == MOST_LEVELS {
            return None;
        }
        let spans = level.iter().filter_map(|&at| {
            let ends = span(at)?;
            let label = match tree.nodes.get(at)?.kind {
                NodeKind::Interior { .. } => String::new(),
                NodeKind::Leaf { first, count } => {
                    let ids: Vec<String> = tree
                        .order
                        .iter()
                        .skip(first as usize)
                        .take(count as usize)
                        .map(u32::to_string)
                        .collect();
                    ids.join(" ")
                }
            };
            Some(Span { ends, label })
        });
        rows.push(spans.collect());
        let children = level.iter().filter_map(|&at| tree.nodes.get(at));
        level = children
            .flat_map(|node| match node.kind {
                NodeKind::Interior { left, right } => vec![left as usize, right as usize],
                NodeKind::Leaf { .. } => Vec::new(),
            })
            .collect();
    }
    Some(rows)
}

/// What the code returned for a ray: a hit without a record has only its `t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct YourHit {
    pub(crate) t: Option<f64>,
    pub(crate) record: Option<Hit>,
}

impl ShownRay {
    /// A ray that meets nothing.
    pub fn new(ray: Ray) -> ShownRay {
        ShownRay {
            scene: Scene::default(),
            boxes: Vec::new(),
            camera: None,
            ray,
            expected: Vec::new(),
            yours: Vec::new(),
            points: None,
            decision: HitOrMiss::Miss,
            normals: None,
        }
    }

    /// A ray that is tested against triangles and spheres.
    pub(crate) fn of_hit(
        scene: Scene,
        ray: Ray,
        expected: &Expected,
        yours: Option<YourHit>,
    ) -> ShownRay {
        let right = expected.hits.first();
        let record = yours.and_then(|yours| yours.record);
        let normals = right
            .and_then(|right| right.n)
            .zip(record.map(|hit| Vec3::from(hit.n)))
            .map(|(right, yours)| [right, yours]);
        ShownRay {
            scene,
            expected: right.map(|hit| hit.t).into_iter().collect(),
            yours: yours.and_then(|yours| yours.t).into_iter().collect(),
            points: right
                .zip(record)
                .map(|(right, hit)| [right.p, hit.p.into()]),
            decision: expected.decision(),
            normals,
            ..ShownRay::new(ray)
        }
    }

    /// The same without what the code returned, as of an answer that is a miss.
    pub fn without_yours(self) -> ShownRay {
        ShownRay {
            yours: Vec::new(),
            points: None,
            normals: None,
            ..self
        }
    }
}
