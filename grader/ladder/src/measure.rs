//! Times the steps of the ladder in turns.

use crate::clock::processor_time;
use crate::rays::{RayKind, RaySets};
use crate::rung::{Rung, RungKind};
use grader::speedup::slope;
use kit::hole::Hole;
use kit::{Ray, Triangle, Vec3};
use meshes::{MeshKind, generate};
use serde::Serialize;
use simd_bvh::TestCounts;
use std::collections::BTreeSet;
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

/// The number of rounds. Each times every step once, for each kind of ray.
const ROUNDS: usize = 5;

/// At least how long a step is timed for one kind of ray in a round. Some systems report the processor
/// time in steps of 4 ms.
const PASS: Duration = Duration::from_millis(60);

/// The fewest rays of a pass.
const MIN_RAYS: usize = 8;

/// Measures all steps on the meshes of all sizes.
pub fn measure(request: &LadderRequest) -> Ladder {
    let mut ladder = Ladder {
        mesh: request.mesh.name().into(),
        rows: Vec::new(),
        missing: BTreeSet::new(),
    };
    let sizes = (3..).map(|exponent| 10_usize.pow(exponent));
    for size in sizes.take_while(|&size| size <= request.largest) {
        measure_size(request, size, &mut ladder);
    }
    ladder
}

fn measure_size(request: &LadderRequest, size: usize, ladder: &mut Ladder) {
    let triangles = generate(request.mesh, size);
    let mut rungs = Vec::new();
    for kind in RungKind::ALL {
        match build(kind, &triangles) {
            Ok(built) => rungs.extend(built),
            Err(why) => drop(ladder.missing.insert(why)),
        }
    }
    let (Some(brute), Some(fastest)) = (rungs.first(), rungs.last()) else {
        return;
    };
    let sets = RaySets::new(&triangles, &fastest.rung, request.seed);
    let mut turns: Vec<Turns> = rungs.iter().map(|built| Turns::new(built, &sets)).collect();
    for _ in 0..ROUNDS {
        turns.iter_mut().for_each(Turns::time);
    }
    let checked = turns[0].passes[0].rays;
    let camera = sets.of(RayKind::Camera);
    let checked: Vec<Ray> = (0..checked)
        .map(|i| camera[i * camera.len() / checked])
        .collect();
    for (built, turns) in rungs.iter().zip(turns) {
        let hit = |rung: &Rung, ray: &Ray| rung.closest(ray, &mut TestCounts::default());
        let differs = |ray: &&Ray| hit(&built.rung, ray) != hit(&brute.rung, ray);
        ladder.rows.push(RungCost {
            kind: built.kind,
            triangles: triangles.len(),
            build_s: built.seconds,
            bytes: built.rung.bytes(),
            rays: turns.passes.map(Pass::cost),
            checked_rays: checked.len(),
            differing_hits: checked.iter().filter(differs).count(),
        });
    }
}

/// A step that is built.
struct Built<'a> {
    kind: RungKind,
    rung: Rung<'a>,
    seconds: f64,
}

/// Builds a step twice and traces a ray. An error says why that is not possible.
fn build(kind: RungKind, triangles: &[Triangle]) -> Result<Option<Built<'_>>, String> {
    let attempt = || {
        let mut best = f64::INFINITY;
        let mut built = None;
        for _ in 0..2 {
            let start = Instant::now();
            let rung = Rung::build(kind, triangles)?;
            best = best.min(start.elapsed().as_secs_f64());
            built = Some(rung);
        }
        let rung = built?;
        let ray = Ray::new(Vec3::splat(3.0), -Vec3::ONE.normalize());
        rung.closest(&ray, &mut TestCounts::default());
        rung.occluded(&ray, &mut TestCounts::default());
        Some(Built {
            kind,
            rung,
            seconds: best,
        })
    };
    panic::catch_unwind(AssertUnwindSafe(attempt)).map_err(|payload| {
        let why = match payload.downcast_ref::<Hole>() {
            Some(hole) => hole.to_string(),
            None => "the code panics".into(),
        };
        format!("{} is not measured: {why}", kind.name())
    })
}

/// The passes of one step over each kind of ray.
struct Turns<'a> {
    passes: [Pass<'a>; 3],
}

impl<'a> Turns<'a> {
    fn new(built: &'a Built, sets: &'a RaySets) -> Turns<'a> {
        Turns {
            passes: RayKind::ALL.map(|kind| Pass::new(&built.rung, kind, sets.of(kind))),
        }
    }

    fn time(&mut self) {
        for pass in &mut self.passes {
            pass.time();
        }
    }
}

/// One step that traces rays of one kind again and again.
struct Pass<'a> {
    rung: &'a Rung<'a>,
    kind: RayKind,
    set: &'a [Ray],
    /// The number of rays: a regular part of the set, or all. A pass traces them several times.
    rays: usize,
    counts: TestCounts,
    /// Seconds per ray, by round.
    seconds: Vec<f64>,
}

impl<'a> Pass<'a> {
    /// Chooses the number of rays so that tracing them once takes about as long as [`PASS`] at
    /// most.
    fn new(rung: &'a Rung, kind: RayKind, set: &'a [Ray]) -> Pass<'a> {
        let mut pass = Pass {
            rung,
            kind,
            set,
            rays: MIN_RAYS.min(set.len()),
            counts: TestCounts::default(),
            seconds: Vec::new(),
        };
        loop {
            pass.counts = TestCounts::default();
            let start = Instant::now();
            pass.trace();
            let elapsed = start.elapsed();
            let is_long = 4 * elapsed > PASS;
            if pass.rays < set.len() && !is_long {
                pass.rays = (4 * pass.rays).min(set.len());
                continue;
            }
            return pass;
        }
    }

    /// Traces the rays once.
    fn trace(&mut self) {
        let mut hits = 0;
        for i in 0..self.rays {
            let ray = &self.set[i * self.set.len() / self.rays];
            hits += usize::from(match self.kind {
                RayKind::Shadow => self.rung.occluded(ray, &mut self.counts),
                _ => self.rung.closest(ray, &mut self.counts).is_some(),
            });
        }
        black_box(hits);
    }

    /// Times a pass; the first repetition is not timed.
    fn time(&mut self) {
        self.counts = TestCounts::default();
        self.trace();
        let counts = self.counts;
        let start = Instant::now();
        let before = processor_time(start);
        let mut traced = 0;
        let elapsed = loop {
            self.trace();
            traced += self.rays.max(1);
            let elapsed = processor_time(start) - before;
            if elapsed >= PASS {
                break elapsed;
            }
        };
        self.seconds.push(elapsed.as_secs_f64() / traced as f64);
        self.counts = counts;
    }

    fn cost(mut self) -> RayCost {
        self.seconds.sort_by(f64::total_cmp);
        let rays = self.rays.max(1) as f64;
        RayCost {
            seconds: self.seconds[self.seconds.len() / 2],
            box_tests: self.counts.box_tests as f64 / rays,
            prim_tests: self.counts.prim_tests as f64 / rays,
        }
    }
}

impl Ladder {
    /// How the time of a ray grows with the number of triangles n: the exponent k of n^k.
    pub fn slope(&self, kind: RungKind, rays: RayKind) -> Option<f64> {
        let rows = self.rows.iter().filter(|row| row.kind == kind);
        let points: Vec<(f64, f64)> = rows
            .map(|row| (row.triangles as f64, row.rays[rays as usize].seconds))
            .collect();
        slope(&points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_finds_the_hits_of_brute_force_with_fewer_tests() {
        let ladder = measure(&LadderRequest {
            mesh: MeshKind::Smooth,
            largest: 1000,
            seed: 0,
        });
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
}
