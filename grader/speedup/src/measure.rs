//! Times the steps of the ladder in turns.

use crate::clock::processor_time;
use crate::rays::{RayKind, RaySets};
use crate::rung::{Rung, RungKind};
use base::GraderError;
use grader::grade::speedup::slope;
use kit::hole::Hole;
use kit::{PrimId, Ray, Triangle};
use meshes::{MeshKind, generate};
use serde::Serialize;
use simd_bvh::TestCounts;
use std::collections::BTreeSet;
use std::fmt;
use std::hint::black_box;
use std::panic::{self, AssertUnwindSafe};
use std::time::{Duration, Instant};

/// What to measure.
#[derive(Clone, Copy, Debug)]
pub struct LadderRequest {
    /// The mesh.
    pub mesh: MeshKind,
    /// The largest number of triangles. Sizes are the powers of ten from 1000 up to it.
    pub largest: usize,
    /// The seed of the directions of bounce rays.
    pub seed: u64,
}

impl LadderRequest {
    /// The numbers of triangles that are measured, in order.
    pub fn sizes(&self) -> impl Iterator<Item = usize> + use<> {
        let largest = self.largest;
        let sizes = (3..).map(|exponent| 10_usize.pow(exponent));
        sizes.take_while(move |&size| size <= largest)
    }
}

/// The results for one mesh.
#[derive(Clone, Debug, Serialize)]
pub struct Ladder {
    /// Name of the mesh.
    pub mesh: String,
    /// One row for each size and step.
    pub rows: Vec<RungCost>,
    /// Why steps are missing, if any are.
    pub missing: BTreeSet<String>,
}

/// What a step costs on a mesh of one size.
#[derive(Clone, Debug, Serialize)]
pub struct RungCost {
    /// The step.
    pub kind: RungKind,
    /// Number of triangles.
    pub triangles: usize,
    /// Seconds to build the tree: the least of the rounds.
    pub build_s: f64,
    /// Bytes of the tree.
    pub bytes: usize,
    /// Results for each of [`RayKind::ALL`].
    pub rays: [RayCost; 3],
    /// Some of the camera rays are traced by brute force, too.
    pub checked_rays: usize,
    /// Those for which the step finds another hit.
    pub differing_hits: usize,
    /// The first of them.
    pub first_differing: Option<DifferingHit>,
}

/// A ray for which a step finds another hit than brute force.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DifferingHit {
    /// The origin of the ray and its direction.
    pub ray: [[f64; 3]; 2],
    /// The hit of brute force: `t` and the number of the triangle.
    pub expected: Option<(f64, u32)>,
    /// The hit of the step.
    pub found: Option<(f64, u32)>,
}

/// What a ray of one kind costs: the median of the rounds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct RayCost {
    /// Seconds per ray.
    pub seconds: f64,
    /// Box tests per ray.
    pub box_tests: f64,
    /// Triangle tests per ray.
    pub prim_tests: f64,
}

/// The number of rounds. Each builds and times every step once, for each kind of ray, with no other
/// tree in memory.
const ROUNDS: usize = 5;

/// The number of rounds for meshes of more than [`LARGE`] triangles, whose trees take seconds to
/// build.
const ROUNDS_OF_LARGE: usize = 3;

/// See [`ROUNDS_OF_LARGE`].
const LARGE: usize = 1_000_000;

/// At least how long a step is timed for one kind of ray in a round. Some systems report the processor
/// time in steps of 4 ms. Tests read no times, and need not wait for them.
const PASS: Duration = Duration::from_millis(if cfg!(test) { 1 } else { 60 });

/// The fewest rays of a pass.
const MIN_RAYS: usize = 8;

/// Measures all steps on the meshes of all sizes. Calls `report` with the results so far whenever a
/// size is measured, with its rows at the end: whoever stops the program keeps them.
///
/// # Errors
///
/// The error of `report`, after which nothing is measured.
pub fn measure(
    request: &LadderRequest,
    report: &mut dyn FnMut(&Ladder) -> Result<(), GraderError>,
) -> Result<Ladder, GraderError> {
    let mut ladder = Ladder {
        mesh: request.mesh.name().into(),
        rows: Vec::new(),
        missing: BTreeSet::new(),
    };
    for size in request.sizes() {
        progress::stage(&format!("{size} triangles"));
        let known = ladder.rows.len();
        measure_size(request, size, &mut ladder);
        if ladder.rows.len() > known {
            report(&ladder)?;
        }
    }
    Ok(ladder)
}

fn measure_size(request: &LadderRequest, size: usize, ladder: &mut Ladder) {
    let triangles = generate(request.mesh, size);
    // The fastest step that works finds the hits from which rays start.
    let sets = RungKind::ALL.into_iter().rev().find_map(|kind| {
        let sets = guarded(kind, || {
            let rung = Rung::build(kind, &triangles)?;
            Some(RaySets::new(&triangles, &rung, request.seed))
        });
        sets.unwrap_or_else(|why| {
            ladder.missing.insert(why);
            None
        })
    });
    let Some(sets) = sets else {
        return;
    };
    let rounds = if size > LARGE {
        ROUNDS_OF_LARGE
    } else {
        ROUNDS
    };
    let mut truth = Vec::new();
    let mut steps: Vec<Step> = RungKind::ALL.map(|kind| Step::new(kind, &sets)).into();
    progress::expect((rounds * steps.len()) as u64);
    for _ in 0..rounds {
        steps.retain_mut(|step| {
            progress::advance(1);
            let measured = guarded(step.kind, || step.measure_round(&triangles, &mut truth));
            measured.unwrap_or_else(|why| {
                ladder.missing.insert(why);
                false
            })
        });
    }
    let rows = steps.into_iter().map(|step| step.cost(triangles.len()));
    ladder.rows.extend(rows);
}

/// Runs code that may contain gaps. An error says why the step is not measured.
fn guarded<T>(kind: RungKind, measure: impl FnOnce() -> T) -> Result<T, String> {
    // What the code says when it panics is in the error.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let measured = panic::catch_unwind(AssertUnwindSafe(measure));
    panic::set_hook(hook);
    measured.map_err(|payload| {
        let literal = payload.downcast_ref::<&str>().map(ToString::to_string);
        let text = literal.or_else(|| payload.downcast_ref::<String>().cloned());
        let why = match payload.downcast_ref::<Hole>() {
            Some(hole) => hole.to_string(),
            None => format!("the code panics: {}", text.unwrap_or_default()),
        };
        format!("{} is not measured: {why}", kind.name())
    })
}

fn hit(rung: &Rung, ray: &Ray) -> TrueHit {
    rung.closest(ray, &mut TestCounts::default())
}

/// The hit of a ray, or a miss.
type TrueHit = Option<(f64, PrimId)>;

/// By how much of its size a `t` may differ between two right tests of a triangle: the wide tree
/// has a test of its own. The errors of the mesh's nearly parallel rays are below this.
const SAME_T: f64 = 1e-9;

/// Whether two hits are the same: both miss, or both hit at the same `t`, up to rounding. At an
/// edge either triangle may be hit.
fn is_same(a: TrueHit, b: TrueHit) -> bool {
    match (a, b) {
        (Some((a, _)), Some((b, _))) => (a - b).abs() <= SAME_T * a.abs(),
        _ => a.is_none() && b.is_none(),
    }
}

/// What is known about a step after some rounds.
struct Step<'a> {
    kind: RungKind,
    build_s: f64,
    bytes: usize,
    passes: [Pass<'a>; 3],
    checked_rays: usize,
    differing: Vec<DifferingHit>,
}

impl<'a> Step<'a> {
    fn new(kind: RungKind, sets: &'a RaySets) -> Step<'a> {
        Step {
            kind,
            build_s: f64::INFINITY,
            bytes: 0,
            passes: RayKind::ALL.map(|rays| Pass::new(rays, sets.of(rays))),
            checked_rays: 0,
            differing: Vec::new(),
        }
    }

    /// Builds the step and times it. The first step to be measured fills `truth`. Returns whether
    /// this checkout contains the step.
    fn measure_round(&mut self, triangles: &[Triangle], truth: &mut Vec<(Ray, TrueHit)>) -> bool {
        let start = Instant::now();
        let Some(rung) = Rung::build(self.kind, triangles) else {
            return false;
        };
        let is_first_round = self.build_s.is_infinite();
        self.build_s = self.build_s.min(start.elapsed().as_secs_f64());
        if is_first_round {
            self.bytes = rung.bytes();
            for pass in &mut self.passes {
                pass.choose_rays(&rung);
            }
            // The first step is brute force, which can trace only a few rays of a large mesh.
            if truth.is_empty() {
                let rays = self.passes[RayKind::Camera as usize].rays();
                truth.extend(rays.map(|ray| (*ray, hit(&rung, ray))));
            }
            let number = |hit: TrueHit| hit.map(|(t, id)| (t, id.0));
            let differs = |(ray, expected): &(Ray, TrueHit)| {
                let found = hit(&rung, ray);
                (!is_same(*expected, found)).then(|| DifferingHit {
                    ray: [ray.o.to_array(), ray.d.to_array()],
                    expected: number(*expected),
                    found: number(found),
                })
            };
            self.checked_rays = truth.len();
            self.differing = truth.iter().filter_map(differs).collect();
        }
        for pass in &mut self.passes {
            pass.time(&rung);
        }
        true
    }

    fn cost(self, triangles: usize) -> RungCost {
        RungCost {
            kind: self.kind,
            triangles,
            build_s: self.build_s,
            bytes: self.bytes,
            rays: self.passes.map(Pass::cost),
            checked_rays: self.checked_rays,
            differing_hits: self.differing.len(),
            first_differing: self.differing.first().copied(),
        }
    }
}

/// Rays of one kind that a step traces again and again.
struct Pass<'a> {
    kind: RayKind,
    set: &'a [Ray],
    /// The number of rays: a regular part of the set, or all. A pass traces them several times.
    count: usize,
    tests: TestCounts,
    /// Seconds per ray, by round.
    seconds: Vec<f64>,
}

impl<'a> Pass<'a> {
    fn new(kind: RayKind, set: &'a [Ray]) -> Pass<'a> {
        Pass {
            kind,
            set,
            count: MIN_RAYS.min(set.len()),
            tests: TestCounts::default(),
            seconds: Vec::new(),
        }
    }

    /// Chooses the number of rays so that tracing them once takes about as long as [`PASS`] at
    /// most.
    fn choose_rays(&mut self, rung: &Rung) {
        loop {
            let start = Instant::now();
            self.trace(rung);
            let is_long = 4 * start.elapsed() > PASS;
            if self.count == self.set.len() || is_long {
                return;
            }
            self.count = (4 * self.count).min(self.set.len());
        }
    }

    /// The rays that are traced.
    fn rays(&self) -> impl Iterator<Item = &'a Ray> {
        let (set, count) = (self.set, self.count);
        (0..count).map(move |i| &set[i * set.len() / count])
    }

    /// Traces the rays once and counts their tests.
    fn trace(&mut self, rung: &Rung) {
        let mut tests = TestCounts::default();
        let hits = self.rays().filter(|ray| match self.kind {
            RayKind::Shadow => rung.occluded(ray, &mut tests),
            _ => rung.closest(ray, &mut tests).is_some(),
        });
        black_box(hits.count());
        self.tests = tests;
    }

    /// Times a pass; the first repetition is not timed.
    fn time(&mut self, rung: &Rung) {
        self.trace(rung);
        let start = Instant::now();
        let before = processor_time(start);
        let mut traced = 0;
        let elapsed = loop {
            self.trace(rung);
            traced += self.count.max(1);
            let elapsed = processor_time(start) - before;
            if elapsed >= PASS {
                break elapsed;
            }
        };
        self.seconds.push(elapsed.as_secs_f64() / traced as f64);
    }

    fn cost(mut self) -> RayCost {
        self.seconds.sort_by(f64::total_cmp);
        let rays = self.count.max(1) as f64;
        RayCost {
            seconds: self.seconds[self.seconds.len() / 2],
            box_tests: self.tests.box_tests as f64 / rays,
            prim_tests: self.tests.prim_tests as f64 / rays,
        }
    }
}

impl fmt::Display for DifferingHit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [o, d] = self.ray;
        let shown = |hit: Option<(f64, u32)>| match hit {
            Some((t, id)) => format!("triangle {id} at t = {t}"),
            None => "a miss".into(),
        };
        let (found, expected) = (shown(self.found), shown(self.expected));
        write!(f, "ray o = {o:?}, d = {d:?}: {found} instead of {expected}")
    }
}

impl Ladder {
    /// How the time of a ray grows with the number of triangles n: the exponent k of n^k.
    pub fn slope(&self, kind: RungKind, rays: RayKind) -> Option<f64> {
        self.exponent(kind, &|row| row.rays[rays as usize].seconds)
    }

    /// The same of the time to build, if the step has a tree.
    pub fn build_slope(&self, kind: RungKind) -> Option<f64> {
        self.exponent(kind, &|row| row.build_s)
            .filter(|_| kind != RungKind::BruteForce)
    }

    fn exponent(&self, kind: RungKind, seconds: &dyn Fn(&RungCost) -> f64) -> Option<f64> {
        let rows = self.rows.iter().filter(|row| row.kind == kind);
        let points: Vec<(f64, f64)> = rows
            .map(|row| (row.triangles as f64, seconds(row)))
            .collect();
        slope(&points)
    }

    /// Says whether all steps find the hits of brute force, or which do not.
    pub fn agreement(&self) -> String {
        let checked: usize = self.rows.iter().map(|row| row.checked_rays).sum();
        let differing = self.rows.iter().filter(|row| row.differing_hits > 0);
        let steps: Vec<String> = differing
            .map(|row| {
                let (name, of, n) = (row.kind.name(), row.checked_rays, row.differing_hits);
                let first = row
                    .first_differing
                    .map(|first| format!(" (first: {first})"));
                format!(
                    "{n} of {of} of {name} on {} triangles{}",
                    row.triangles,
                    first.unwrap_or_default()
                )
            })
            .collect();
        match steps.is_empty() {
            true => format!(
                "All steps find the hits of brute force, up to rounding of t, in {checked} comparisons."
            ),
            false => format!(
                "Hits that differ from those of brute force by more than rounding of t: {}.",
                steps.join("; ")
            ),
        }
    }

    /// How many times the time of a ray is on a mesh with ten times the triangles.
    pub fn tenfold(&self, kind: RungKind, rays: RayKind) -> Option<f64> {
        Some(10.0_f64.powf(self.slope(kind, rays)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_finds_the_hits_of_brute_force_with_fewer_tests() {
        let request = LadderRequest {
            mesh: MeshKind::Smooth,
            largest: 1000,
            seed: 0,
        };
        let ladder = measure(&request, &mut |_| Ok(())).expect("the report succeeds");
        assert!(ladder.missing.is_empty(), "{:?}", ladder.missing);
        assert_eq!(ladder.rows.len(), RungKind::ALL.len());
        for row in &ladder.rows {
            assert_eq!(row.differing_hits, 0, "{row:?}");
            assert!(row.checked_rays >= MIN_RAYS, "{row:?}");
            let bounce = &row.rays[RayKind::Bounce as usize];
            if row.kind == RungKind::BruteForce {
                assert_eq!(bounce.prim_tests, row.triangles as f64);
            } else {
                assert!(
                    bounce.prim_tests < 50.0 && bounce.box_tests > 1.0,
                    "{row:?}"
                );
                assert!(row.bytes > 10 * row.triangles, "{row:?}");
            }
        }
    }

    #[test]
    fn hits_that_differ_are_told_with_their_step() {
        let kind = RungKind::BruteForce;
        let row = RungCost {
            kind,
            triangles: 1000,
            build_s: 0.0,
            bytes: 0,
            rays: Default::default(),
            checked_rays: 8192,
            differing_hits: 618,
            first_differing: Some(DifferingHit {
                ray: [[0.0; 3], [0.0, 0.0, 1.0]],
                expected: Some((2.5, 7)),
                found: None,
            }),
        };
        let ladder = Ladder {
            mesh: "terrain".into(),
            rows: vec![row],
            missing: BTreeSet::new(),
        };
        let ray =
            "ray o = [0.0, 0.0, 0.0], d = [0.0, 0.0, 1.0]: a miss instead of triangle 7 at t = 2.5";
        let told = format!(
            "618 of 8192 of {} on 1000 triangles (first: {ray}).",
            kind.name()
        );
        assert!(
            ladder.agreement().ends_with(&told),
            "{}",
            ladder.agreement()
        );
    }

    /// Möller and Trumbore's test and that of the wide tree round `t` differently.
    #[test]
    fn two_right_tests_of_a_triangle_find_the_same_hit() {
        let near = Some((3.0, PrimId(1)));
        assert!(is_same(near, Some((3.0 + 4.0 * f64::EPSILON, PrimId(1)))));
        assert!(is_same(near, Some((3.0, PrimId(2)))));
        assert!(is_same(None, None));
        assert!(!is_same(near, None) && !is_same(None, near));
        assert!(!is_same(near, Some((3.0001, PrimId(1)))));
    }

    #[test]
    fn why_a_step_is_not_measured_has_the_message_of_its_panic() {
        let measured = guarded(RungKind::BruteForce, || -> () { panic!("at {}", 7) });
        let why = measured.expect_err("it panics");
        assert!(
            why.ends_with("is not measured: the code panics: at 7"),
            "{why}"
        );
    }

    #[test]
    fn each_size_is_reported_before_the_next_is_measured() {
        let request = LadderRequest {
            mesh: MeshKind::Terrain,
            largest: 10_000_000,
            seed: 0,
        };
        let mut reported = Vec::new();
        let stopped = measure(&request, &mut |ladder| {
            reported.extend(ladder.rows.iter().map(|row| row.triangles));
            Err(GraderError::new("stop"))
        });
        assert_eq!(stopped.expect_err("it is stopped").to_string(), "stop");
        assert_eq!(reported, [1000; RungKind::ALL.len()]);
    }
}
