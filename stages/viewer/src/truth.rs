//! The exact truth about a recorded ray: the first event where the stages and the truth part.
//!
//! The oracle computes what a ray hits in integers, without rounding. It contains no code of a
//! stage and no solution, so a handout has it, too.

use crate::project::Projection;
use kit::{Aabb, Camera, Hit, PrimId, Primitive, Ray, Scene};
use oracle::{Closest, KernelClass, may_touch};
use pathtracer::RayRole;
use pathtracer::replay::text::vector;
use pathtracer::replay::{Outcome, PixelReplay, PrimAnswer, RayRecord, Test, Visit};

/// What is right, and where a ray's record leaves it.
#[derive(Clone, Debug, PartialEq)]
pub struct RayTruth {
    /// The exact closest hit: primitive and `t`; `None` for a miss. For a shadow ray the nearest
    /// primitive that blocks it.
    pub right: Option<(PrimId, f64)>,
    /// The first event that is wrong, if the ray's result is.
    pub parting: Option<Parting>,
}

/// The first event where a ray's record and the truth part.
#[derive(Clone, Debug, PartialEq)]
pub struct Parting {
    /// The index of the test; `None` if every test is right, but not the result.
    pub test: Option<usize>,
    /// A sentence: what is wrong, and what is right.
    pub sentence: String,
}

/// The first wrong ray of a replay.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelTruth {
    /// The sample and the ray, with its truth.
    pub first_wrong: Option<(usize, usize, RayTruth)>,
    /// How many rays were checked.
    pub checked: usize,
    /// How many rays were recorded.
    pub recorded: usize,
}

/// The kernels that answers are judged as: what textbook formulas return in `f64` is right.
const KERNEL: KernelClass = KernelClass::Textbook;

/// The number of exact tests of one check: it takes seconds at most.
const MAX_TESTS: usize = 20_000_000;

/// The largest distance between the position on the film of a sample and of the point where its
/// camera ray goes, in film units.
const SENSOR_TOLERANCE: f64 = 1e-9;

/// Checks the rays of a replay in order, until one is wrong. `has_lens` says that camera rays start
/// on a lens.
pub fn check_pixel(
    scene: &Scene,
    camera: &Camera,
    has_lens: bool,
    replay: &PixelReplay,
) -> PixelTruth {
    let recorded = replay.samples.iter().map(|sample| sample.rays.len()).sum();
    let mut truth = PixelTruth {
        first_wrong: None,
        checked: 0,
        recorded,
    };
    let primitives: Vec<Primitive<'_>> = scene.primitives().collect();
    let most = MAX_TESTS / primitives.len().max(1);
    for (s, sample) in replay.samples.iter().enumerate() {
        for (r, record) in sample.rays.iter().enumerate() {
            if truth.checked == most {
                return truth;
            }
            truth.checked += 1;
            let mut of_ray = check_ray(&primitives, record);
            if record.role == RayRole::Camera && !has_lens {
                let wrong = wrong_camera_ray(camera, record, sample.sensor);
                of_ray.parting = wrong.or(of_ray.parting);
            }
            if of_ray.parting.is_some() {
                truth.first_wrong = Some((s, r, of_ray));
                return truth;
            }
        }
    }
    truth
}

/// The parting of a camera ray that does not go through its position on the film.
fn wrong_camera_ray(camera: &Camera, record: &RayRecord, sensor: kit::Vec2) -> Option<Parting> {
    let part = |sentence: String| {
        Some(Parting {
            test: None,
            sentence,
        })
    };
    if record.ray.o != camera.pos {
        return part(format!(
            "generate_ray: the camera is at {}, but the ray starts at {}",
            vector(camera.pos),
            vector(record.ray.o)
        ));
    }
    match Projection::new(camera).point(record.ray.o + record.ray.d) {
        Some(seen) if seen.distance(sensor) <= SENSOR_TOLERANCE => None,
        Some(seen) => part(format!(
            "generate_ray: the sample is at ({:?}, {:?}) on the film, but the ray goes through ({:?}, {:?})",
            sensor.x, sensor.y, seen.x, seen.y
        )),
        None => part("generate_ray: the ray points behind the camera".to_owned()),
    }
}

/// Checks one ray against the exact answer over all `primitives` of its scene.
pub fn check_ray(primitives: &[Primitive<'_>], record: &RayRecord) -> RayTruth {
    let is_near = |(id, primitive): &(u32, Primitive<'_>)| {
        record.skip != Some(PrimId(*id)) && may_touch(primitive, &record.ray, KERNEL)
    };
    let numbered = (0..).zip(primitives.iter().copied());
    let near: Vec<(u32, Primitive<'_>)> = numbered.filter(is_near).collect();
    let exact = oracle::closest(near.iter().map(|n| n.1), &record.ray);
    // The oracle counts the primitives that it was given.
    let id = |i: PrimId| PrimId(near[i.0 as usize].0);
    let right = exact.nearest.map(|(i, t)| (id(i), t.to_f64()));
    let sentence = wrong_outcome(&exact, &id, &near, record);
    let parting = sentence.map(|outcome| {
        first_wrong_test(primitives, record)
            .unwrap_or_else(|| untested(primitives, record, right, &outcome))
    });
    let parting = parting.or_else(|| wrong_normal(primitives, record));
    RayTruth { right, parting }
}

/// What is wrong with a ray's result.
fn wrong_outcome(
    exact: &Closest,
    id: &impl Fn(PrimId) -> PrimId,
    near: &[(u32, Primitive<'_>)],
    record: &RayRecord,
) -> Option<String> {
    let right = match exact.nearest {
        Some((i, t)) => format!("the ray hits primitive {} at t = {:?}", id(i).0, t.to_f64()),
        None => "the ray hits nothing".to_owned(),
    };
    let (scores, answer) = match record.outcome {
        Outcome::Hit(Hit { prim, t, .. }) => {
            let own = near.iter().position(|n| n.0 == prim.0);
            let scores =
                own.is_some_and(|i| exact.judge(KERNEL, Some((PrimId(i as u32), t))).scores());
            (scores, format!("primitive {} at t = {t:?}", prim.0))
        }
        Outcome::Miss => (exact.judge(KERNEL, None).scores(), "a miss".to_owned()),
        Outcome::Blocked => (exact.judge_any(KERNEL, true), "blocked".to_owned()),
        Outcome::Unblocked => (exact.judge_any(KERNEL, false), "not blocked".to_owned()),
    };
    (!scores).then(|| format!("the result is {answer}; exactly, {right}"))
}

/// The first test of the ray whose answer is wrong.
fn first_wrong_test(primitives: &[Primitive<'_>], record: &RayRecord) -> Option<Parting> {
    record.tests.iter().enumerate().find_map(|(i, test)| {
        let sentence = match test {
            Test::Box {
                node,
                bounds,
                max_t,
                visit: visit @ (Visit::Missed | Visit::Behind { .. }),
            } => {
                let ray = Ray {
                    max_t: *max_t,
                    ..record.ray
                };
                let verdict = oracle::bbox(bounds, &ray);
                let is_wrong = !verdict.judge(KERNEL, None).scores();
                let name = node.map_or("a box".to_owned(), |node| format!("box {node}"));
                let said = match visit {
                    Visit::Missed => "missed",
                    _ => "behind max_t",
                };
                let inside = verdict.inside.ok();
                let (is_wrong, inside) = (is_wrong && inside.is_some(), inside);
                is_wrong.then(|| {
                    let enters = inside.map_or(f64::NAN, |inside| inside.min.to_f64());
                    format!("intersect_bbox: {name} is {said}; exactly, the ray enters it at t = {enters:?}")
                })
            }
            Test::Box { .. } => None,
            Test::Primitive {
                prim,
                max_t,
                answer,
            } => wrong_primitive(primitives, record, *prim, *max_t, *answer),
        };
        sentence.map(|sentence| Parting {
            test: Some(i),
            sentence,
        })
    })
}

/// What is wrong with the test of a primitive.
fn wrong_primitive(
    primitives: &[Primitive<'_>],
    record: &RayRecord,
    prim: PrimId,
    max_t: f64,
    answer: PrimAnswer,
) -> Option<String> {
    let ray = Ray {
        max_t,
        ..record.ray
    };
    let (hits, t, answers) = match primitives.get(prim.0 as usize)? {
        Primitive::Triangle(triangle) => {
            let verdict = oracle::triangle(triangle, &ray);
            let t = verdict.crossing.map(|at| at.t.to_f64());
            (verdict.hits(), t, verdict.answers)
        }
        Primitive::Sphere(sphere) => {
            let verdict = oracle::sphere(sphere, &ray);
            (
                verdict.hits(),
                verdict.t.map(|t| t.to_f64()),
                verdict.answers,
            )
        }
    };
    let answers = answers.get(KERNEL);
    let (scores, said) = match answer {
        PrimAnswer::Skipped => return None,
        PrimAnswer::Hit(t) => (
            answers.judge(Some(t)).scores(),
            format!("a hit at t = {t:?}"),
        ),
        PrimAnswer::Miss => (answers.judge(None).scores(), "a miss".to_owned()),
        PrimAnswer::Blocks => (hits || answers.undecidable(), "a hit".to_owned()),
    };
    (!scores).then(|| {
        let right = match t.filter(|_| hits) {
            Some(t) => format!("hits it at t = {t:?}"),
            None => "misses it".to_owned(),
        };
        format!(
            "primitive {}: the test says {said}; exactly, the ray {right}",
            prim.0
        )
    })
}

/// The parting of a ray whose tests are all right, but whose result is not.
fn untested(
    primitives: &[Primitive<'_>],
    record: &RayRecord,
    right: Option<(PrimId, f64)>,
    outcome: &str,
) -> Parting {
    let was_tested = |id: PrimId| {
        record
            .tests
            .iter()
            .any(|test| matches!(test, Test::Primitive { prim, .. } if *prim == id))
    };
    let Some((id, _)) = right.filter(|(id, _)| !was_tested(*id)) else {
        return Parting {
            test: None,
            sentence: format!("every test is right, but {outcome}"),
        };
    };
    let bounds = primitives[id.0 as usize].bounds();
    // The smallest box around the primitive that the traversal did not look into.
    let area = |b: &Aabb| b.surface_area();
    let skipped = record
        .tests
        .iter()
        .enumerate()
        .filter_map(|(i, test)| match test {
            Test::Box {
                bounds: b,
                visit: Visit::Pruned { .. },
                ..
            } if b.contains(&bounds) => Some((i, area(b))),
            _ => None,
        });
    Parting {
        test: skipped.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i),
        sentence: format!("primitive {} is never tested: {outcome}", id.0),
    }
}

/// The parting of a ray with the right hit and a wrong normal.
fn wrong_normal(primitives: &[Primitive<'_>], record: &RayRecord) -> Option<Parting> {
    let Outcome::Hit(hit) = record.outcome else {
        return None;
    };
    let Primitive::Triangle(triangle) = primitives.get(hit.prim.0 as usize)? else {
        return None;
    };
    let crossing = oracle::triangle(triangle, &record.ray).crossing?;
    let judged = [
        (
            "normal",
            hit.n,
            oracle::surface::triangle_normal(triangle, &crossing),
        ),
        (
            "geometric normal",
            hit.ng,
            oracle::surface::geometric_normal(triangle),
        ),
    ];
    let wrong = |(_, n, right): &(&str, _, oracle::NormalTruth)| !right.accepts(KERNEL, *n);
    let (name, answer, right) = judged.into_iter().find(wrong)?;
    let right = match right.n.get(KERNEL) {
        Some(n) => format!("exactly, it is {}", vector(*n)),
        None => "it must have length 1".to_owned(),
    };
    Some(Parting {
        test: None,
        sentence: format!("the {name} is {}; {right}", vector(answer)),
    })
}
