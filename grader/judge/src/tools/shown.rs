//! One call, shown: what the function got, what is right, and what the code returned.
//!
//! The one model for whoever draws a call: the page of `grader look`, the text of `grader explain`,
//! the window. A kind of work makes it in `Check::shown`.

use crate::tools::aspects::hits::show;
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
    /// The numbers side by side.
    pub rows: Vec<ComparedNumber>,
}

/// One number or vector of a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComparedNumber {
    /// What is compared.
    pub name: &'static str,
    /// The code's; `None` if it has none.
    pub yours: Option<String>,
    /// The exact one; `None` if there is none.
    pub expected: Option<String>,
    /// Whether the code's scores: it may be off by the rounding errors of correct code.
    pub is_right: bool,
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
            rows: Vec::new(),
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
            rows: rows(expected, yours),
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

    /// A box around the shapes, the ray's origin and its hits.
    pub fn bounds(&self) -> Aabb {
        let shapes = self
            .boxes
            .iter()
            .fold(self.scene.bounds(), |all, b| all.union(*b));
        let hits = self
            .yours
            .iter()
            .chain(&self.expected)
            .map(|&t| self.ray.at(t));
        hits.filter(|p| p.is_finite())
            .fold(shapes.grown_by(self.ray.o), Aabb::grown_by)
    }
}

/// The numbers of a hit record beside the right ones.
fn rows(expected: &Expected, yours: Option<YourHit>) -> Vec<ComparedNumber> {
    let right = expected.hits.first();
    let name = |hit: bool| if hit { "hit" } else { "miss" }.to_owned();
    let right_text = match (right.is_some(), expected.miss) {
        (true, true) => "hit or miss".to_owned(),
        (hit, _) => name(hit),
    };
    let record = yours.and_then(|yours| yours.record);
    let mut rows = vec![ComparedNumber {
        name: "result",
        yours: yours.map(|_| name(record.is_some())),
        expected: Some(right_text),
        is_right: yours.is_some()
            && match record {
                Some(_) => right.is_some(),
                None => expected.miss || right.is_none(),
            },
    }];
    let (Some(hit), Some(right)) = (record, right) else {
        return rows;
    };
    let mut row = |name, yours: String, expected: Option<String>, is_right| {
        rows.push(ComparedNumber {
            name,
            yours: Some(yours),
            expected,
            is_right,
        });
    };
    let is_near = |a: Vec3, b: Vec3, bound: f64| (a - b).abs().max_element() <= bound;
    let is_right = (hit.t - right.t).abs() <= right.t_bound;
    row(
        "t",
        format!("{:?}", hit.t),
        Some(format!("{:?}", right.t)),
        is_right,
    );
    let is_right = expected.hits.iter().any(|one| one.prim == hit.prim);
    row(
        "primitive",
        hit.prim.to_string(),
        Some(right.prim.to_string()),
        is_right,
    );
    let p = Vec3::from(hit.p);
    let is_right = is_near(p, right.p, right.p_bound);
    row("p", show(p), Some(show(right.p)), is_right);
    for (name, yours, right, bound) in [
        ("n", hit.n, right.n, right.n_bound),
        ("ng", hit.ng, right.ng, right.ng_bound),
    ] {
        let yours = Vec3::from(yours);
        let is_right = right.is_none_or(|right| is_near(yours, right, bound));
        row(name, show(yours), right.map(show), is_right);
    }
    rows
}
